// What camera paths see by lobes that they are unlikely to take, against paths that leave it to chance.
#include <catch2/catch.hpp>
#include <cmath>

#include "params.hpp"
#include "render/render_fixture.hpp"
#include "upload.hpp"
#include "vector_inputs.hpp"

using namespace causticl;

namespace {

const std::string source = R"(
#include "pass_path.cl"
kernel void seen(SCENE_PARAMETERS, global const float4 *targets, global float2 *out, uint count, uint each, Params params,
                 volatile global Counters *counters) {
  uint i = get_global_id(0);
  if (i >= count) return;
  SCENE_INIT(params);
  RandomStream stream = {params.seed, 0, i};
  Ray ray = {params.camera.origin.xyz, normalize(targets[i / each].xyz - params.camera.origin.xyz)};
  Radiance radiance;
  uint rays = 0;
  path_radiance(&scene, ray, 0, stream, params.max_depth, &radiance, &rays, counters);
  out[i] = (float2)(radiance.sum.y, rays);
}
)";

/// A lamp, a sky, and balls of glass, of glass in a mirror's view, of varnish and of absorbing, dispersing
/// glass.
Scene balls() {
  return scene_from_text(R"({
    "max_depth": 12,
    "camera": {"position": [0, 1, 6], "target": [0, 1, 0], "fov": 60},
    "lights": [{"type": "environment", "radiance": [0.1, 0.2, 0.3]}],
    "materials": {"grey": {"type": "diffuse", "color": [0.3, 0.3, 0.3]},
                  "lamp": {"type": "diffuse", "color": [0, 0, 0], "emission": [40, 50, 60]},
                  "mirror": {"type": "mirror", "color": [0.9, 0.9, 0.9]},
                  "glass": {"type": "glass", "ior": 1.5},
                  "amber": {"type": "glass", "cauchy": [1.5, 0.01], "absorption": [0.1, 0.3, 0.6]},
                  "varnish": {"type": "plastic", "color": [0.2, 0.4, 0.6]}},
    "objects": [{"type": "box", "material": "grey", "size": [9, 0.2, 9],
                 "transform": [{"type": "shift", "x": 0, "y": -0.2, "z": 0}]},
                {"type": "sphere", "material": "lamp", "radius": 0.8,
                 "transform": [{"type": "shift", "x": 0.5, "y": 4.5, "z": 3}]},
                {"type": "sphere", "material": "mirror", "radius": 0.7,
                 "transform": [{"type": "shift", "x": -2.4, "y": 0.8, "z": -1}]},
                {"type": "sphere", "material": "glass", "radius": 0.7,
                 "transform": [{"type": "shift", "x": -0.8, "y": 0.8, "z": 0}]},
                {"type": "sphere", "material": "amber", "radius": 0.7,
                 "transform": [{"type": "shift", "x": 0.8, "y": 0.8, "z": 0}]},
                {"type": "sphere", "material": "varnish", "radius": 0.7,
                 "transform": [{"type": "shift", "x": 2.4, "y": 0.8, "z": 0}]}]})");
}

constexpr cl_uint each = 1 << 15;

struct Estimate {
  double mean = 0, variance = 0;  // of one path
};

/// What paths toward each target see.
std::vector<Estimate> seen(const Scene& scene, const std::vector<float4>& targets,
                           const std::string& definitions) {
  cl::Program program = build_test_program((definitions + source).c_str());
  const DeviceScene device_scene = upload_scene(scene, test_device());
  Params params = scene_params(scene, device_scene, 5);
  begin_pass(params, 0);
  const auto in = test_device().upload(targets, "targets");
  const auto counters = test_device().upload(std::vector<Counters>{{}}, "counters");
  const std::size_t count = targets.size() * each;
  const auto out = test_device().buffer(count * sizeof(float2), "radiance");
  cl::Kernel kernel(program, "seen");
  const cl_uint index = set_scene_arguments(kernel, device_scene);
  kernel.setArg(index, in);
  kernel.setArg(index + 1, out);
  kernel.setArg(index + 2, static_cast<cl_uint>(count));
  kernel.setArg(index + 3, each);
  kernel.setArg(index + 4, params);
  kernel.setArg(index + 5, counters);
  test_device().launch(kernel, count);
  const auto radiance = test_device().download<float2>(out, count);
  std::vector<Estimate> result(targets.size());
  for (std::size_t t = 0; t < targets.size(); ++t) {
    double sum = 0, sum2 = 0;
    for (std::size_t i = t * each; i < (t + 1) * each; ++i) {
      sum += radiance[i].x;
      sum2 += static_cast<double>(radiance[i].x) * radiance[i].x;
    }
    result[t].mean = sum / each;
    result[t].variance = sum2 / each - result[t].mean * result[t].mean;
  }
  return result;
}

}  // namespace

TEST_CASE("looking along unlikely lobes leaves what paths see as it is, and takes its noise") {
  RandomInputs random(74);
  std::vector<float4> targets;
  for (const double x : {-2.4, -0.8, 0.8, 2.4})
    for (int i = 0; i < 24; ++i)
      targets.push_back(
          to_float4({x + random.uniform(-0.6, 0.6), 0.8 + random.uniform(-0.6, 0.6), x < -2 ? -1.0 : 0.0}));
  const Scene scene = balls();
  const auto looking = seen(scene, targets, ""),
             chance = seen(scene, targets, "#define LOOKING_VERTICES 0u\n");
  std::size_t apart = 0;
  double worst = 0, looking_mean = 0, chance_mean = 0, looking_variance = 0, chance_variance = 0;
  for (std::size_t t = 0; t < targets.size(); ++t) {
    const double difference = std::fabs(looking[t].mean - chance[t].mean);
    const double deviation = std::sqrt((looking[t].variance + chance[t].variance) / each);
    worst = std::max(worst, deviation > 0 ? difference / deviation : 0);
    apart += difference > 5 * deviation + 1e-5;
    looking_mean += looking[t].mean, chance_mean += chance[t].mean;
    looking_variance += looking[t].variance, chance_variance += chance[t].variance;
  }
  std::printf(
      "looking: means of all targets %.5f and %.5f, variances %.2f and %.2f, at most %.2f deviations apart\n",
      looking_mean, chance_mean, looking_variance, chance_variance, worst);
  CHECK(apart == 0);
  CHECK(std::fabs(looking_mean - chance_mean) < 4 * std::sqrt((looking_variance + chance_variance) / each));
  CHECK(looking_variance < 0.2 * chance_variance);
}
