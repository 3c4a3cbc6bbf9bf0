// Hard case 23: directions drawn from an environment, and the densities that are stated for them.
#include "selftest/histogram_check.hpp"
#include "selftest/lit_scene.hpp"
#include "selftest/scene_parts.hpp"
#include "selftest/stability_checks.hpp"
#include "selftest/vectors.hpp"
#include "shared/effects.h"

namespace causticl {
namespace {

constexpr const char* source = R"(
#include "lights/light.cl"
typedef struct {
  float4 direction;  // w: density of light_sample; 0 where another light was drawn
  float4 weight;     // radiance / density of light_sample
  float4 found;      // radiance that a ray in this direction finds; w: density that goes with it
} Drawn;
OUTLINE void draw_direction(const Scene *scene, real4 random, global Drawn *out) {
  LightSample light = light_sample(scene, (real3)(0, 0, 0), random);
  bool distant = emitter_choose(scene, random.x, random.w) == scene->emitter_count - 1;
  real pdf;
  real3 radiance = background_radiance(scene, light.direction, &pdf);
  out->direction = convert_float4((real4)(light.direction, distant ? light.pdf : 0));
  out->weight = convert_float4((real4)(light.weight, 0));
  out->found = convert_float4((real4)(radiance, pdf));
}
kernel void draw(global const float4 *in, global Drawn *out, uint count, Params params, SCENE_PARAMETERS) {
  uint i = get_global_id(0);
  if (i >= count) return;
  SCENE_INIT(params);
  draw_direction(&scene, convert_real4(in[i]), out + i);
}
kernel void draw_at_random(global Drawn *out, uint count, uint first, uint seed, Params params, SCENE_PARAMETERS) {
  uint i = get_global_id(0);
  if (i >= count) return;
  SCENE_INIT(params);
  RandomStream stream = {seed, 3, first + i};
  draw_direction(&scene, random_at(stream, 0, DIM_LIGHT), out + i);
}
)";

struct Drawn {
  float4 direction, weight, found;
};

/// A sky of 32 x 16 texels of three decades of brightness with a sun a thousand times as bright and a black
/// quarter, beside a point light that has a third of the power.
struct Sky : LitScene {
  static constexpr int width = 32, height = 16;
  static constexpr SquareBins bins{width, height};
  std::vector<double> weights;  // of each texel: brightness times sine of its row's middle
  double total = 0;

  explicit Sky(Device& device) {
    scene.objects.push_back(make_sphere({0, 0, 0}, 1, 0));
    scene.materials.resize(1);
    LightSpec sky;
    sky.kind = LightSpec::Kind::environment;
    sky.rotation = 77;
    sky.map.width = width;
    sky.map.height = height;
    InputRandom random(7, 0);
    for (int row = 0; row < height; ++row)
      for (int column = 0; column < width; ++column) {
        const bool sun = row == 11 && column == 20, black = row < 8 && column < 16;
        const double level = sun ? 1000 : black ? 0 : random.scale(-3, 0);
        const float rgb[] = {static_cast<float>(level * random.uniform()), static_cast<float>(level),
                             static_cast<float>(level * random.uniform())};
        for (const float value : {rgb[0], rgb[1], rgb[2], 1.0f}) sky.map.rgba.push_back(value);
        weights.push_back(rgb[1] * std::sin(std::numbers::pi * (row + 0.5) / height));
        total += weights.back();
      }
    LightSpec point;
    point.intensity = {0, 0, 50};
    scene.lights = {sky, point};
    upload(device);
  }

  std::size_t texel(int column, int row) const {
    return static_cast<std::size_t>(std::clamp(row, 0, height - 1) * width + (column + width) % width);
  }
  /// The probability of draws in the square of a texel: of a tent, 3/4 lie in its own and 1/8 in each of its
  /// neighbours.
  double pmf(int column, int row) const {
    constexpr double part[] = {0.125, 0.75, 0.125};
    double sum = 0;
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) sum += part[x + 1] * part[y + 1] * weights[texel(column + x, row + y)];
    return sum / total;
  }
  /// u and v of a direction.
  std::pair<double, double> position(Vec3 d) const {
    const double turns = turn(d.x, -d.z) + 0.5 + scene.lights[0].rotation / 360;
    return {turns - std::floor(turns), std::atan2(std::hypot(d.x, d.z), -d.y) / std::numbers::pi};
  }

  /// What interpolation between texel centres makes of a quantity of texels, and the largest of the four.
  struct Value {
    double mixed = 0, largest = 0;
  };
  template <typename Quantity>
  Value interpolate(double u, double v, const Quantity& quantity) const {
    const double x = u * width - 0.5, y = v * height - 0.5, left = std::floor(x), low = std::floor(y);
    Value result;
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i) {
        const double value = quantity(texel(static_cast<int>(left) + i, static_cast<int>(low) + j));
        result.mixed += (i ? x - left : 1 - x + left) * (j ? y - low : 1 - y + low) * value;
        result.largest = std::max(result.largest, value);
      }
    return result;
  }
};

cl::Program program(CheckContext& context) {
  return context.program(source, EFFECT_SPHERES | EFFECT_ENVIRONMENT | EFFECT_DELTA_LIGHTS);
}

CheckResult directions(CheckContext& context) {
  const Sky sky(context.device);
  Histogram histogram(sky.bins.count());
  for (int row = 0; row < Sky::height; ++row)
    for (int column = 0; column < Sky::width; ++column)
      histogram.probabilities[static_cast<std::size_t>(row) * Sky::width + static_cast<std::size_t>(column)] =
          sky.pmf(column, row);
  SampleKernel<Drawn> draw(context, program(context), "draw_at_random", sky);
  return run_histogram_check(context, {histogram}, draw,
                             [&](const Drawn& drawn, std::uint64_t, std::vector<Histogram>& to) {
                               if (drawn.direction.w == 0) return;
                               const auto [u, v] = sky.position(to_vec3(drawn.direction));
                               to[0].add(sky.bins.bin(u, v));
                             });
}

/// Radiance and both densities against interpolation in double. The density that integrates to the
/// environment's pmf is pmf * weight / total * texels / (2 pi^2 sine). A position is known
/// to some roundings of 1, which is 3e-6 texels, of a slope that is at most the largest texel around.
CheckResult densities(CheckContext& context) {
  const Sky sky(context.device);
  const std::vector<float>& rgba = sky.scene.lights[0].map.rgba;
  const double integral = 2 * std::numbers::pi * std::numbers::pi * sky.total / (Sky::width * Sky::height);
  // The power over pi of the sphere of the scene, sqrt(3) in radius and a little more, and of the point
  // light.
  const double radius = 1.0001 * std::sqrt(3.0), distant = integral * radius * radius;
  const double pmf = distant / (distant + 4 * 50);
  CheckKernel kernel(context, program(context), "draw");
  kernel.with(sky);
  return run_random_check(
      context, 5e-5, "of the largest texel around", random_numbers,
      [&](const auto& inputs) { return kernel.run<Drawn>(inputs); },
      [&](const Numbers&, const Drawn& drawn) {
        if (drawn.direction.w == 0) return 0.0;
        const Vec3 d = to_vec3(drawn.direction);
        const auto [u, v] = sky.position(d);
        const double sine = std::hypot(d.x, d.z);
        const auto weight = sky.interpolate(u, v, [&](std::size_t i) { return sky.weights[i]; });
        const double unit =
            pmf / sky.total * (Sky::width * Sky::height) / (2 * std::numbers::pi * std::numbers::pi);
        double error = std::fabs(drawn.direction.w * sine / unit - weight.mixed) / weight.largest;
        error = std::max(error, std::fabs(drawn.found.w * sine / unit - weight.mixed) / weight.largest);
        const Vec3 found = to_vec3(drawn.found), drawn_radiance = to_vec3(drawn.weight) * drawn.direction.w;
        for (int c = 0; c < 3; ++c) {
          const auto radiance =
              sky.interpolate(u, v, [&](std::size_t i) { return rgba[4 * i + static_cast<std::size_t>(c)]; });
          const double scale = std::max(radiance.largest, 1e-30);
          error = std::max(error, std::fabs(found[c] - radiance.mixed) / scale);
          error = std::max(error, std::fabs(drawn_radiance[c] - radiance.mixed) / scale);
        }
        return error;
      });
}

}  // namespace

std::vector<Check> environment_checks() {
  return {{23, "directions of an environment", 4, directions},
          {23, "densities of an environment, which integrate to 1", 4, densities}};
}

}  // namespace causticl
