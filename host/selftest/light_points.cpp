// Hard case 23: points on lights, and the densities that are stated for them.
#include "selftest/histogram_check.hpp"
#include "selftest/lit_scene.hpp"
#include "selftest/stability_checks.hpp"
#include "selftest/vectors.hpp"
#include "shared/effects.h"

namespace causticl {
namespace {

constexpr const char* source = R"(
#include "lights/light.cl"
typedef struct {
  float4 point;   // from the lit point at the origin
  float pdf;      // of light_sample
  float hit_pdf;  // of light_pdf, where a ray met the light
  float hit_t;
  uint emitter;
} Drawn;
OUTLINE void draw_light(const Scene *scene, real4 random, global Drawn *out) {
  LightSample light = light_sample(scene, (real3)(0, 0, 0), random);
  out->point = (float4)(convert_float3(light.direction * light.distance), 0);
  out->pdf = light.pdf;
  out->hit_pdf = 0;
  out->hit_t = 0;
  out->emitter = emitter_choose(scene, random.x, random.w);
  Ray ray = {(real3)(0, 0, 0), light.direction};
  Hit hit = hit_none(INFINITY);
  if (!geometry_closest(&scene->geometry, ray, &hit)) return;
  Surface surface;
  geometry_surface(&scene->geometry, ray, hit, &surface);
  out->hit_pdf = light_pdf(scene, ray.origin, ray.direction, hit, &surface, scene->materials + surface.material);
  out->hit_t = hit.t;
}
kernel void draw(global const float4 *in, global Drawn *out, uint count, Params params, SCENE_PARAMETERS) {
  uint i = get_global_id(0);
  if (i >= count) return;
  SCENE_INIT(params);
  draw_light(&scene, (real4)(in[i].x, in[i].y, in[i].z, in[i].w), out + i);
}
kernel void draw_at_random(global Drawn *out, uint count, uint first, uint seed, Params params, SCENE_PARAMETERS) {
  uint i = get_global_id(0);
  if (i >= count) return;
  SCENE_INIT(params);
  RandomStream stream = {seed, 1, first + i};
  draw_light(&scene, random_at(stream, 0, DIM_LIGHT), out + i);
}
)";

struct Drawn {
  float4 point;
  float pdf, hit_pdf, hit_t;
  std::uint32_t emitter;
};

/// A rectangle (emitters 0 and 1), a disk, a sphere and a revolved curve around the origin, the lit point,
/// none before another. Each is two-sided, so that every drawn point counts.
enum Light { rectangle, disk, sphere, curve, light_count };
constexpr Light light_of[] = {rectangle, rectangle, disk, sphere, curve};

struct Lights : LitScene {
  std::vector<double> step_ends;  // of the curve: the fraction of its area up to the end of each step in t

  explicit Lights(Device& device) {
    using Shape = Object::Shape;
    const Transform tilt = Transform::rotate(0, 0.4).followed_by(Transform::rotate(1, 0.7));
    add(Shape::rectangle, tilt.followed_by(Transform::shift({0, 0, 3})), 1);
    add(Shape::disk, tilt.followed_by(Transform::shift({0, 3, 0})), 0.8);
    add(Shape::sphere, Transform::shift({5, -1, 0}), 1.2);
    add(Shape::bezier, tilt.followed_by(Transform::shift({0, 0, -5})), 1);
    upload(device);
    double sum = 0;
    for (std::size_t step = 0; step < EMITTER_AREA_STEPS; ++step) {
      constexpr int midpoints = 64;
      for (int i = 0; i < midpoints; ++i)
        sum += area_element((static_cast<double>(step) + (i + 0.5) / midpoints) / EMITTER_AREA_STEPS);
      step_ends.push_back(sum);
    }
    for (double& end : step_ends) end /= sum;
  }

  void add(Object::Shape shape, const Transform& transform, double radius) {
    Object object;
    object.shape = shape;
    object.transform = transform;
    object.radius = radius;
    if (shape == Object::Shape::bezier) object.points = {{0.4, -1}, {1.5, -0.4}, {0.1, 0.5}, {0.8, 1}};
    object.material = static_cast<int>(scene.materials.size());
    MaterialSpec material;
    material.emission = {1 + object.material * 0.5, 1, 0.5};
    material.two_sided = true;
    scene.materials.push_back(material);
    scene.objects.push_back(object);
  }

  /// Radius and height of the curve and their derivatives, in its own space.
  struct Profile {
    double r, y, dr, dy;
  };
  Profile profile(double t) const {
    const auto& p = scene.objects[curve].points;
    const double s = 1 - t, b[] = {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t},
                 d[] = {-3 * s * s, 3 * s * s - 6 * s * t, 6 * s * t - 3 * t * t, 3 * t * t};
    Profile out{0, 0, 0, 0};
    for (int i = 0; i < 4; ++i) {
      out.r += b[i] * p[i][0];
      out.y += b[i] * p[i][1];
      out.dr += d[i] * p[i][0];
      out.dy += d[i] * p[i][1];
    }
    return out;
  }
  /// Area per t and turn.
  double area_element(double t) const {
    const Profile p = profile(t);
    return 2 * std::numbers::pi * p.r * std::hypot(p.dr, p.dy);
  }
  /// The parameter at a height, which grows with it.
  double parameter(double y) const {
    double low = 0, high = 1;
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (low + high);
      (profile(middle).y < y ? low : high) = middle;
    }
    return low;
  }
  Vec3 local(Light light, Vec3 p) const { return scene.objects[light].transform.inverse().point(p); }
  /// The probability with which a light is chosen, in proportion to its power.
  double pmf(Light light) const {
    const Object& object = scene.objects[light];
    double area = 1;
    if (light == disk) area = std::numbers::pi * object.radius * object.radius;
    if (light == sphere) area = 4 * std::numbers::pi * object.radius * object.radius;
    if (light == curve) {
      area = 0;
      for (int i = 0; i < 4096; ++i) area += area_element((i + 0.5) / 4096) / 4096;
    }
    return 2 * area * max_component(scene.materials[light].emission) / uploaded.emitted_power;
  }
};

cl::Program program(CheckContext& context) {
  return context.program(source, EFFECT_TRIANGLES | EFFECT_SPHERES | EFFECT_DISKS | EFFECT_BEZIER);
}

/// Each light in coordinates in which its density is uniform: those of its area, or of the cone of a sphere.
/// A curve is uniform in t within each of the steps of its table.
CheckResult points(CheckContext& context) {
  const Lights lights(context.device);
  constexpr SquareBins bins{16, 16};
  std::vector<Histogram> histograms(light_count, flat_histogram(bins.count()));
  for (std::size_t x = 0; x < bins.nx; ++x) {
    constexpr std::size_t steps = EMITTER_AREA_STEPS / bins.nx;
    const double start = x == 0 ? 0 : lights.step_ends[x * steps - 1];
    for (std::size_t y = 0; y < bins.ny; ++y)
      histograms[curve].probabilities[y * bins.nx + x] =
          (lights.step_ends[(x + 1) * steps - 1] - start) / static_cast<double>(bins.ny);
  }
  const Vec3 center = lights.scene.objects[sphere].transform.translation;
  const Frame frame(normalize(center));
  const double sine = lights.scene.objects[sphere].radius / length(center),
               one_minus_cos = 1 - std::sqrt(1 - sine * sine);
  SampleKernel<Drawn> draw(context, program(context), "draw_at_random", lights);
  return run_histogram_check(context, std::move(histograms), draw,
                             [&](const Drawn& drawn, std::uint64_t, std::vector<Histogram>& to) {
                               const Light light = light_of[drawn.emitter];
                               const Vec3 point = to_vec3(drawn.point), p = lights.local(light, point);
                               const double radius = lights.scene.objects[light].radius;
                               std::size_t bin = bins.count();
                               if (light == rectangle) bin = bins.bin(p.x + 0.5, p.y + 0.5);
                               if (light == disk)
                                 bin = bins.bin((p.x * p.x + p.y * p.y) / (radius * radius), turn(p.y, p.x));
                               if (light == sphere) {
                                 const Vec3 direction = frame.to_local(normalize(point));
                                 bin = bins.bin((1 - direction.z) / one_minus_cos,
                                                turn(direction.y, direction.x), 1e-4);
                               }
                               if (light == curve) bin = bins.bin(lights.parameter(p.y), turn(p.z, p.x));
                               to[light].add(drawn.pdf > 0 ? bin : bins.count());
                             });
}

/// Both densities, that of the sample and that of a ray which meets the light there, against the one that
/// integrates to 1: the light's pmf over its area or cone, times distance^2 / cosine. A point is
/// known to 1e-6 of its distance of 5; on a curve it moves by that over the cosine, the normal turns by as
/// much again, and the density changes by that over the cosine: 1e-4 at the cosine of 0.2 from which it is
/// compared.
CheckResult densities(CheckContext& context) {
  const Lights lights(context.device);
  double pmfs[light_count];
  for (int light = 0; light < light_count; ++light) pmfs[light] = lights.pmf(static_cast<Light>(light));
  CheckKernel kernel(context, program(context), "draw");
  kernel.with(lights);
  return run_random_check(
      context, 2e-4, "relative", random_numbers,
      [&](const auto& inputs) { return kernel.run<Drawn>(inputs); },
      [&](const Numbers&, const Drawn& drawn) {
        const Light light = light_of[drawn.emitter];
        const Object& object = lights.scene.objects[light];
        const Vec3 point = to_vec3(drawn.point), p = lights.local(light, point);
        const double distance = length(point);
        double density = pmfs[light];
        if (light == sphere) {
          const double sine = object.radius / length(object.transform.translation);
          density /= 2 * std::numbers::pi * (1 - std::sqrt(1 - sine * sine));
        } else {
          Vec3 n{0, 0, 1};
          if (light == disk) density /= std::numbers::pi * object.radius * object.radius;
          if (light == curve) {
            const double t = lights.parameter(p.y), scaled = t * EMITTER_AREA_STEPS;
            const auto step = std::min<std::size_t>(static_cast<std::size_t>(scaled), EMITTER_AREA_STEPS - 1);
            // Between two steps of the table a point may belong to either.
            if (std::fabs(scaled - std::round(scaled)) < 1e-3) return 0.0;
            const double start = step == 0 ? 0 : lights.step_ends[step - 1];
            density *= (lights.step_ends[step] - start) * EMITTER_AREA_STEPS / lights.area_element(t);
            const auto [r, y, dr, dy] = lights.profile(t);
            const double around = std::hypot(p.x, p.z);
            n = normalize(Vec3{dy * p.x / around, -dr, dy * p.z / around});
          }
          // The transforms are rotations and shifts.
          const double cosine = std::fabs(dot(object.transform.vector(n), point)) / distance;
          if (cosine < 0.2) return 0.0;
          density *= distance * distance / cosine;
        }
        double error = std::fabs(drawn.pdf / density - 1);
        // The ray may meet a nearer part of the curve.
        if (std::fabs(drawn.hit_t - distance) <= 1e-3 * distance)
          error = std::max(error, std::fabs(drawn.hit_pdf / density - 1));
        return error;
      });
}

}  // namespace

std::vector<Check> light_point_checks() {
  return {{23, "points of every kind of light", 4, points},
          {23, "densities of lights, which integrate to 1", 4, densities}};
}

}  // namespace causticl
