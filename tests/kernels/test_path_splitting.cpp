// What camera paths see by lobes that they are unlikely to take, against paths that leave it to chance.
#include <cmath>
#include <cstdio>
#include <tuple>

#include "catch2.hpp"
#include "device_scene/device_scene.hpp"
#include "device_scene/params.hpp"
#include "render/render_fixture.hpp"
#include "vector_inputs.hpp"

using namespace causticl;

namespace {

const std::string source = R"(
#include "passes/pass_path.cl"
kernel void seen(SCENE_PARAMETERS, global const float4 *targets, global float4 *out, uint count, uint each, Params params,
                 volatile global Counters *counters) {
  uint i = get_global_id(0);
  if (i >= count) return;
  SCENE_INIT(params);
  PathSampler sampler = path_sampler(params.seed, 0, i, 0, 1, 0u);
  Ray ray = {params.camera.origin.xyz, normalize(targets[i / each].xyz - params.camera.origin.xyz)};
  Radiance radiance;
  uint rays = 0;
  path_radiance(&scene, ray, 0, &sampler, params.max_depth, &radiance, &rays, counters);
  out[i] = (float4)(radiance.sum, rays);
}
)";

/// A lamp, a sky, and balls of glass, of glass in a mirror's view, of coated diffuse and of absorbing,
/// dispersing glass.
Scene balls() {
  std::string materials, objects;
  double x = -3.6;
  const auto add = [&](const std::string& name, const std::string& material) {
    materials += ", \"" + name + "\": {" + material + "}";
    // Before it stands a smaller ball of clear glass, through which it is seen too.
    for (const auto& [what, radius, z] :
         {std::tuple{name, 0.42, 0.0}, std::tuple{std::string("glass"), 0.2, 1.0}})
      objects += R"(, {"type": "sphere", "material": ")" + what + R"(", "radius": )" +
                 std::to_string(radius) + R"(, "transform": [{"type": "shift", "x": )" +
                 std::to_string(x * (1 - z / 6)) + R"(, "y": 0.8, "z": )" + std::to_string(z) + "}]}";
    x += 0.9;
  };
  add("mirror", R"("type": "mirror", "color": [0.9, 0.9, 0.9])");
  add("dense", R"("type": "glass", "ior": 2.4)");
  add("thin", R"("type": "glass", "ior": 0.6)");
  add("amber", R"("type": "glass", "cauchy": [1.5, 0.01], "absorption": [0.1, 0.3, 0.6])");
  add("rough", R"("type": "glass", "ior": 1.5, "roughness": 0.3)");
  add("faint", R"("type": "glass", "cauchy": [1.0, 0.01], "roughness": 0.3)");
  add("coated", R"("type": "plastic", "color": [0.2, 0.4, 0.6])");
  add("black", R"("type": "plastic", "color": [0, 0, 0])");
  add("gold", R"("type": "conductor", "eta": [0.2, 0.4, 1.4], "k": [3.9, 2.4, 1.6])");
  return scene_from_text(R"({
    "camera": {"position": [0, 1, 6], "target": [0, 1, 0], "fov": 60},
    "lights": [{"type": "environment", "radiance": [0.1, 0.2, 0.3]}],
    "materials": {"grey": {"type": "diffuse", "color": [0.3, 0.3, 0.3]}, "glass": {"type": "glass", "ior": 1.5},
                  "lamp": {"type": "diffuse", "color": [0, 0, 0], "emission": [40, 50, 60]})" +
                         materials + R"(},
    "objects": [{"type": "box", "material": "grey", "size": [9, 0.2, 9],
                 "transform": [{"type": "shift", "x": 0, "y": -0.2, "z": 0}]},
                {"type": "sphere", "material": "lamp", "radius": 0.8,
                 "transform": [{"type": "shift", "x": 0.5, "y": 4.5, "z": 3}]})" +
                         objects + "]}");
}

constexpr cl_uint each = 1 << 13;

struct Estimate {
  double mean = 0, variance = 0;  // of one path
};

/// What paths toward each target see, channel after channel.
std::vector<Estimate> seen(const Scene& scene, const std::vector<float4>& targets,
                           const std::string& definitions) {
  cl::Program program = build_test_program((definitions + source).c_str());
  const DeviceScene device_scene = update_device_scene(scene, test_device());
  Params params = scene_params(scene, device_scene, 5);
  begin_pass(params, 0);
  const auto in = test_device().upload(targets, "targets");
  const auto counters = test_device().upload(std::vector<Counters>{{}}, "counters");
  const std::size_t count = targets.size() * each;
  const auto out = test_device().buffer(count * sizeof(float4), "radiance");
  cl::Kernel kernel(program, "seen");
  const cl_uint index = set_scene_arguments(kernel, device_scene);
  kernel.setArg(index, in);
  kernel.setArg(index + 1, out);
  kernel.setArg(index + 2, static_cast<cl_uint>(count));
  kernel.setArg(index + 3, each);
  kernel.setArg(index + 4, params);
  kernel.setArg(index + 5, counters);
  test_device().launch(kernel, count);
  const auto radiance = test_device().download<float4>(out, count);
  std::vector<Estimate> result;
  for (std::size_t t = 0; t < targets.size(); ++t)
    for (const auto channel : {&float4::x, &float4::y, &float4::z}) {
      double sum = 0, sum2 = 0;
      for (std::size_t i = t * each; i < (t + 1) * each; ++i) {
        const double value = radiance[i].*channel;
        sum += value, sum2 += value * value;
      }
      result.push_back({sum / each, sum2 / each - sum / each * sum / each});
    }
  return result;
}

}  // namespace

TEST_CASE("looking along unlikely lobes leaves what paths see as it is, and takes its noise") {
  RandomInputs random(74);
  std::vector<float4> targets;
  for (int ball = 0; ball < 9; ++ball)
    for (int i = 0; i < 16; ++i)
      targets.push_back(
          to_float4({-3.6 + 0.9 * ball + random.uniform(-0.4, 0.4), 0.8 + random.uniform(-0.4, 0.4), 0.0}));
  Scene scene = balls();
  for (const int max_depth : {1, 2, 3, 12}) {
    CAPTURE(max_depth);
    scene.max_depth = max_depth;
    const auto looking = seen(scene, targets, ""),
               chance = seen(scene, targets, "#define SPLITTING_VERTICES 0u\n");
    double worst = 0, looking_mean = 0, chance_mean = 0, looking_variance = 0, chance_variance = 0;
    for (std::size_t i = 0; i < looking.size(); ++i) {
      const double difference = std::fabs(looking[i].mean - chance[i].mean);
      // A path in thousands may bring what the others have not seen: 1e-3 of the lamp is below that.
      const double deviation = std::sqrt((looking[i].variance + chance[i].variance) / each) + 60e-3 / each;
      worst = std::max(worst, difference / deviation);
      looking_mean += looking[i].mean, chance_mean += chance[i].mean;
      looking_variance += looking[i].variance, chance_variance += chance[i].variance;
    }
    std::printf(
        "looking, %2d hits: means of all targets %.4f and %.4f, variances %.2f and %.2f, at most %.2f "
        "deviations apart\n",
        max_depth, looking_mean, chance_mean, looking_variance, chance_variance, worst);
    CHECK(worst < 6);
    CHECK(std::fabs(looking_mean - chance_mean) < 4 * std::sqrt((looking_variance + chance_variance) / each));
    CHECK(looking_variance < 0.5 * chance_variance);
  }
}

TEST_CASE("a look ends at glass that its index at one wavelength makes rough") {
  // A coated diffuse box reflects a lamp that lies behind a ball whose index is that of air but for
  // dispersion.
  const Scene scene = scene_from_text(R"({
    "max_depth": 8, "camera": {"position": [0, 1, 4], "target": [0, 0, 0], "fov": 60},
    "materials": {"coated": {"type": "plastic", "color": [0, 0, 0]},
                  "faint": {"type": "glass", "cauchy": [1.0, 0.01], "roughness": 0.3},
                  "lamp": {"type": "diffuse", "color": [0, 0, 0], "emission": [40, 50, 60]}},
    "objects": [{"type": "box", "material": "coated", "size": [4, 0.2, 4],
                 "transform": [{"type": "shift", "x": 0, "y": -0.1, "z": 0}]},
                {"type": "sphere", "material": "faint", "radius": 0.5,
                 "transform": [{"type": "shift", "x": 0, "y": 1, "z": -4}]},
                {"type": "sphere", "material": "lamp", "radius": 1.5,
                 "transform": [{"type": "shift", "x": 0, "y": 2, "z": -8}]}]})");
  const std::vector<float4> targets{to_float4({0, 0, 0}), to_float4({0.05, 0, 0.02})};
  const auto looking = seen(scene, targets, ""),
             chance = seen(scene, targets, "#define SPLITTING_VERTICES 0u\n");
  for (std::size_t i = 0; i < looking.size(); ++i) {
    const double deviation = std::sqrt((looking[i].variance + chance[i].variance) / each);
    INFO(looking[i].mean << " and " << chance[i].mean << ", deviation " << deviation);
    CHECK(chance[i].mean > 0.5);
    CHECK(std::fabs(looking[i].mean - chance[i].mean) < 5 * deviation + 1e-4);
  }
}
