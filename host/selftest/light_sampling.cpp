// Hard case 23: the choice among many lights, each as often as its probability says.

#include "selftest/histogram_check.hpp"
#include "selftest/stability_checks.hpp"
#include "world/flat_scene.hpp"

namespace causticl {
namespace {

constexpr const char* source = R"(
#include "lights/light.cl"
typedef struct {
  float u, v;
} Numbers;
kernel void choose(global const Numbers *in, global uint *out, uint count, global const Emitter *emitters,
                   uint emitter_count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  Scene scene;
  scene.emitters = emitters;
  scene.emitter_count = emitter_count;
  out[i] = emitter_choose(&scene, in[i].u, in[i].v);
}
kernel void choose_at_random(global uint *out, uint count, uint first, uint seed, global const Emitter *emitters,
                             uint emitter_count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  Scene scene;
  scene.emitters = emitters;
  scene.emitter_count = emitter_count;
  RandomStream stream = {seed, 0, first + i};
  real4 random = random_at(stream, 0, DIM_LIGHT);
  out[i] = emitter_choose(&scene, random.x, random.w);
}
)";

constexpr double numbers = static_cast<double>(std::uint64_t{1} << EMITTER_CHOICE_BITS);

double power(const Emitter& light) {
  return static_cast<double>(std::max({light.radiance.x, light.radiance.y, light.radiance.z})) *
         light.radiance.w * (light.two_sided ? 2 : 1);
}

/// A mesh of 2^18 emissive triangles whose areas spread over eight decades.
struct ManyLights {
  std::vector<Emitter> emitters;
  std::vector<double> ends;  // the running sum of power after each, over all power
  ManyLights() {
    Scene scene;
    scene.materials.resize(1);
    scene.materials[0].emission = {1, 2, 3};
    Object object;
    object.shape = Object::Shape::mesh;
    object.mesh = 0;
    scene.objects.push_back(object);
    Mesh mesh;
    InputRandom random(1, 0);
    for (std::uint32_t t = 0; t < 1u << 18; ++t) {
      const double size = random.scale(-4, 0);
      for (int corner = 0; corner < 3; ++corner) {
        const Vec3 p = size * random.direction();
        mesh.positions.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
      }
      mesh.position_index.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    scene.meshes.push_back(std::move(mesh));
    emitters = flatten_scene(scene).emitters;
    long double sum = 0;
    std::vector<long double> sums;
    for (const auto& light : emitters) sums.push_back(sum += power(light));
    for (const long double end : sums) ends.push_back(static_cast<double>(end / sum));
  }
  double start(std::size_t emitter) const { return emitter == 0 ? 0 : ends[emitter - 1]; }
};

struct Numbers {
  float u, v;
  std::uint64_t number() const {
    return static_cast<std::uint64_t>(u * 0x1p24f) << 23 |
           (static_cast<std::uint32_t>(v * 0x1p24f) & 0x7fffffu);
  }
};

/// Half of the numbers are at the border of two lights, all of which are equally likely to be tried. The
/// light that a number chooses must be the one that owns it, and its stated probability the fraction of
/// numbers that it owns; that is its fraction of all power, but for the rounding of both ends to whole
/// numbers. What is drawn is then what is stated. A running sum in single precision is off by 2^22 numbers.
CheckResult exact_choice(CheckContext& context) {
  const ManyLights lights;
  const auto emitters = context.device.upload(lights.emitters, "emitters of a check");
  const auto count = static_cast<std::uint32_t>(lights.emitters.size());
  CheckKernel kernel(context, context.program(source, 0), "choose");
  kernel.with(emitters, static_cast<cl_uint>(count));
  return run_random_check(
      context, 1.05, "2^-47",
      [&](InputRandom& random, std::uint64_t index) {
        if (index % 2) return Numbers{random.uniform24(), random.uniform24()};
        const double end = std::floor(lights.ends[random.below(count)] * numbers + random.uniform(-2, 2));
        const auto number = static_cast<std::uint64_t>(std::clamp(end, 0.0, numbers - 1));
        const auto low = static_cast<std::uint32_t>(number & 0x7fffffu) | random.below(2) << 23;
        return Numbers{static_cast<float>(number >> 23) * 0x1p-24f, static_cast<float>(low) * 0x1p-24f};
      },
      [&](const auto& inputs) { return kernel.run<std::uint32_t>(inputs); },
      [&](const Numbers& in, std::uint32_t chosen) {
        if (chosen >= count) return INFINITY + 0.0;
        const std::uint64_t start = chosen == 0 ? 0 : lights.emitters[chosen - 1].cdf,
                            end = lights.emitters[chosen].cdf;
        if (in.number() < start || in.number() >= end) return INFINITY + 0.0;
        const double owned = static_cast<double>(end - start);
        if (lights.emitters[chosen].probability != static_cast<float>(owned / numbers)) return INFINITY + 0.0;
        return std::fabs(owned - (lights.ends[chosen] - lights.start(chosen)) * numbers);
      });
}

/// How often lights are chosen, in 256 groups of consecutive ones.
CheckResult chosen_lights(CheckContext& context) {
  const ManyLights lights;
  const auto emitters = context.device.upload(lights.emitters, "emitters of a check");
  const std::size_t group = lights.emitters.size() / 256;
  Histogram histogram(256);
  for (std::size_t i = 0; i < lights.emitters.size(); ++i)
    histogram.probabilities[i / group] += lights.ends[i] - lights.start(i);
  SampleKernel<std::uint32_t> draw(context, context.program(source, 0), "choose_at_random", emitters,
                                   static_cast<cl_uint>(lights.emitters.size()));
  return run_histogram_check(
      context, {histogram}, draw,
      [&](std::uint32_t chosen, std::uint64_t, std::vector<Histogram>& to) { to[0].add(chosen / group); });
}

}  // namespace

std::vector<Check> light_sampling_checks() {
  return {{23, "each of many lights is drawn as often as stated", 2, exact_choice},
          {23, "choice of a light", 2, chosen_lights}};
}

}  // namespace causticl
