// Hard case 23: light without surface, as it arrives at a point and as photons carry it.
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
  float position[3];
  float u[4];
} Place;
typedef struct {
  float4 direction;  // from the position to the light; w: distance
  float4 weight;     // of light_sample; w: the emitter
} Arrival;
kernel void arrive(global const Place *in, global Arrival *out, uint count, Params params, SCENE_PARAMETERS) {
  uint i = get_global_id(0);
  if (i >= count) return;
  SCENE_INIT(params);
  real3 position = (real3)(in[i].position[0], in[i].position[1], in[i].position[2]);
  LightSample light = light_sample(&scene, position, (real4)(in[i].u[0], in[i].u[1], in[i].u[2], in[i].u[3]));
  out[i].direction = convert_float4((real4)(light.direction, light.distance));
  out[i].weight = convert_float4((real4)(light.weight, emitter_choose(&scene, in[i].u[0], in[i].u[3])));
}
typedef struct {
  float4 origin;     // w: the emitter
  float4 direction;
  float4 flux;
} Emitted;
kernel void emit(global Emitted *out, uint count, uint first, uint seed, Params params, SCENE_PARAMETERS) {
  uint i = get_global_id(0);
  if (i >= count) return;
  SCENE_INIT(params);
  RandomStream stream = {seed, 5, first + i};
  real4 choice = random4(stream, DIM_EMITTER);
  real3 flux;
  real4 direction = random4(stream, DIM_EMISSION);
  Ray ray = photon_emit_from(&scene, photon_emitter(&scene, stream), random4(stream, DIM_EMITTER), direction.x, direction.y, &flux);
  out[i].origin = convert_float4((real4)(ray.origin, emitter_choose(&scene, choice.x, choice.w)));
  out[i].direction = convert_float4((real4)(ray.direction, 0));
  out[i].flux = convert_float4((real4)(flux, 0));
}
)";

struct Place {
  float position[3], u[4];
};
struct Arrival {
  float4 direction, weight;
};
struct Emitted {
  float4 origin, direction, flux;
};

constexpr std::size_t light_count = 5, sky = light_count;

/// A point, spots with a wide soft and a narrow hard border and one that is soft throughout, and a
/// directional light, beside a sky of even radiance, all around a ball.
struct Lights : LitScene {
  double powers[light_count + 1], power = 0;  // over pi

  explicit Lights(Device& device) {
    scene.materials.resize(1);
    scene.objects.push_back(make_sphere({1, 2, 3}, 2, 0));
    using Kind = LightSpec::Kind;
    add(Kind::point, {1, 3, 2}, {1, 2, 3}, 0, 0);
    add(Kind::spot, {-2, 1, 0}, {9, 5, 7}, 100, 0.4);
    add(Kind::spot, {3, 0, 1}, {3e6, 2e6, 1e6}, 0.05, 0);
    add(Kind::spot, {0, 4, -1}, {2, 30, 4}, 30, 1);
    add(Kind::directional, {}, {0.4, 0.3, 0.1}, 0, 0);
    LightSpec environment;
    environment.kind = LightSpec::Kind::environment;
    environment.map.width = 64;
    environment.map.height = 32;
    environment.map.rgba.assign(4 * 64 * 32, 0.25f);
    scene.lights.push_back(environment);
    upload(device);
    for (std::size_t i = 0; i < light_count; ++i) power += powers[i] = power_of(scene.lights[i]);
    // Rows of a map stand for their middles: its integral is that of the midpoint rule.
    double sines = 0;
    for (int row = 0; row < 32; ++row) sines += std::sin(std::numbers::pi * (row + 0.5) / 32);
    power += powers[sky] = 0.25 * 2 * std::numbers::pi * std::numbers::pi * sines / 32 * square_radius();
  }

  void add(LightSpec::Kind kind, Vec3 position, Color intensity, double angle, double blend) {
    LightSpec light;
    light.kind = kind;
    light.position = position;
    light.intensity = intensity;
    light.direction = normalize(Vec3{0.3, -0.8, 0.5 - static_cast<double>(scene.lights.size())});
    light.angle = angle;
    light.blend = blend;
    scene.lights.push_back(light);
  }

  /// Of the sphere about the box about the ball.
  static double square_radius() {
    const double radius = 1.0001 * 2 * std::sqrt(3.0) + 1e-6 * 3;
    return radius * radius;
  }
  static double outer(const LightSpec& light) { return light.angle * std::numbers::pi / 360; }
  /// 1 - cos x.
  static double drop(double x) { return 2 * std::sin(x / 2) * std::sin(x / 2); }

  /// Fraction of a spot's intensity at an angle to its axis.
  static double falloff(const LightSpec& light, double angle) {
    const double end = drop(outer(light)), even = drop(outer(light) * (1 - light.blend)), at = drop(angle);
    if (at <= even) return 1;
    if (at >= end) return 0;
    const double t = (end - at) / (end - even);
    return t * t * (3 - 2 * t);
  }
  static double power_of(const LightSpec& light) {
    const double intensity = max_component(light.intensity);
    if (light.kind == LightSpec::Kind::point) return 4 * intensity;
    if (light.kind == LightSpec::Kind::directional) return square_radius() * intensity;
    // The integral of the falloff over 1 - cosine by the midpoint rule.
    double sum = 0;
    constexpr int steps = 4096;
    const double end = drop(outer(light));
    for (int i = 0; i < steps; ++i)
      sum += falloff(light, 2 * std::asin(std::sqrt((i + 0.5) / steps * end / 2))) * end / steps;
    return 2 * intensity * sum;
  }
};

cl::Program program(CheckContext& context) {
  return context.program(source, EFFECT_SPHERES | EFFECT_ENVIRONMENT | EFFECT_DELTA_LIGHTS);
}

/// Irradiance over probability, by the inverse square law and the falloff of spots. Half of the positions lie
/// in the beams of spots. The slope of the narrowest cone's edge is that of a step: positions near it are not
/// compared.
CheckResult arrivals(CheckContext& context) {
  const Lights lights(context.device);
  CheckKernel kernel(context, program(context), "arrive");
  kernel.with(lights);
  return run_random_check(
      context, 1e-5, "of the light's greatest",
      [&](InputRandom& random, std::uint64_t index) {
        const LightSpec& beam = lights.scene.lights[1 + random.below(3)];
        const Frame frame(beam.direction);
        const double angle = 1.2 * Lights::outer(beam) * random.uniform(), around = random.uniform(0, 7);
        const Vec3 in_beam = frame.to_world(
            {std::sin(angle) * std::cos(around), std::sin(angle) * std::sin(around), std::cos(angle)});
        const Vec3 p = index % 2 ? beam.position + in_beam * random.scale(-1, 2)
                                 : random.direction() * random.scale(-1, 2);
        Place in;
        for (int axis = 0; axis < 3; ++axis) in.position[axis] = static_cast<float>(p[axis]);
        for (float& u : in.u) u = random.uniform24();
        return in;
      },
      [&](const auto& inputs) { return kernel.run<Arrival>(inputs); },
      [&](const Place& in, const Arrival& out) {
        const auto index = static_cast<std::size_t>(out.weight.w);
        if (index >= light_count) return index == sky ? 0.0 : INFINITY + 0.0;
        const LightSpec& light = lights.scene.lights[index];
        const double probability = lights.powers[index] / lights.power;
        Vec3 direction = -light.direction;
        double expected = 1, distance = INFINITY;
        if (light.kind != LightSpec::Kind::directional) {
          const Vec3 to_light = light.position - Vec3{in.position[0], in.position[1], in.position[2]};
          distance = length(to_light);
          direction = to_light / distance;
          if (light.kind == LightSpec::Kind::spot) {
            const Vec3 chord = -direction - light.direction;
            const double angle = 2 * std::asin(std::min(1.0, length(chord) / 2)), end = Lights::outer(light);
            expected = Lights::falloff(light, angle);
            // A direction is known to 1e-7, which is that much of the width of the border.
            if (light.blend * end < 0.01 && std::fabs(angle - end) < 1e-6) return 0.0;
          }
        }
        double error = std::fabs(length(to_vec3(out.direction) - direction));
        const double unit = light.kind == LightSpec::Kind::directional ? 1 : distance * distance;
        if (std::isfinite(distance))
          error = std::max(error, std::fabs(out.direction.w / distance - 1));
        else if (!std::isinf(out.direction.w))
          return INFINITY + 0.0;
        const Vec3 weight = to_vec3(out.weight) * (probability * unit);
        for (int c = 0; c < 3; ++c)
          error = std::max(error, std::fabs(weight[c] / light.intensity[c] - expected));
        return error;
      });
}

/// Which light photons come from; their directions, uniform over a sphere or cone; and where on the disc they
/// start. A spot's flux must be in proportion to its falloff.
CheckResult photons(CheckContext& context) {
  const Lights lights(context.device);
  constexpr SquareBins bins{16, 16};
  std::vector<Histogram> histograms(light_count + 2, flat_histogram(bins.count()));
  Histogram& choice = histograms[light_count + 1];
  choice = Histogram(light_count + 1);
  for (std::size_t i = 0; i <= light_count; ++i) choice.probabilities[i] = lights.powers[i] / lights.power;
  SampleKernel<Emitted> draw(context, program(context), "emit", lights);
  const Vec3 centre{1, 2, 3};
  const double radius2 = Lights::square_radius();
  return run_histogram_check(
      context, std::move(histograms), draw,
      [&](const Emitted& photon, std::uint64_t, std::vector<Histogram>& to) {
        const auto index = static_cast<std::size_t>(photon.origin.w);
        to[light_count + 1].add(index);
        const Vec3 origin = to_vec3(photon.origin), d = to_vec3(photon.direction),
                   flux = to_vec3(photon.flux);
        if (index == sky || lights.scene.lights[index].kind == LightSpec::Kind::directional) {
          // The disc touches the sphere where the light comes from.
          const Vec3 local = Frame(d).to_local(origin - centre);
          const bool right = std::fabs(local.z + std::sqrt(radius2)) < 1e-5 &&
                             std::fabs(length(d) - 1) < 1e-6 &&
                             (index == sky || length(d - lights.scene.lights[index].direction) < 1e-6);
          to[index].add(
              right ? bins.bin((local.x * local.x + local.y * local.y) / radius2, turn(local.y, local.x))
                    : bins.count());
          return;
        }
        const LightSpec& light = lights.scene.lights[index];
        const Vec3 local = Frame(light.direction).to_local(d), chord = d - light.direction;
        const double end = light.kind == LightSpec::Kind::spot ? Lights::drop(Lights::outer(light)) : 2,
                     drop = dot(chord, chord) / 2;
        double weight = 1;
        if (light.kind == LightSpec::Kind::spot) {
          weight = Lights::falloff(light, 2 * std::asin(std::sqrt(drop / 2))) * 2 * end *
                   max_component(light.intensity) / lights.powers[index];
          // The edge of the narrowest cone is a step.
          if (light.blend == 0 && drop > 0.999 * end) weight = max_component(flux);
        }
        const Vec3 expected = light.intensity * (weight / max_component(light.intensity));
        const bool right = length(flux - expected) < 1e-3 && origin == light.position;
        to[index].add(right ? bins.bin(drop / end, turn(local.y, local.x), 1e-3) : bins.count());
      });
}

}  // namespace

std::vector<Check> delta_light_checks() {
  return {{23, "light that arrives from points, spots and afar", 2, arrivals},
          {23, "photons of points, spots and from afar", 4, photons}};
}

}  // namespace causticl
