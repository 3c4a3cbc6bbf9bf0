#include "world/light_records.hpp"

#include <cmath>
#include <numbers>

#include "scene/float4.hpp"
#include "scene/light_kind.hpp"
#include "world/environment.hpp"

namespace causticl {
namespace {

double square(float x) { return static_cast<double>(x) * x; }

// A function for each row of LIGHT_TABLE that has no object.

void write_point(const LightSpec& light, const LitRegion&, Emitter& record) {
  record.a = to_float4(light.position);
  record.radiance = to_float4(light.intensity, 4);
}

void write_spot(const LightSpec& light, const LitRegion&, Emitter& record) {
  // 1 - cos x = 2 sin^2(x / 2), which keeps narrow cones exact.
  const double half = light.angle / 2 * std::numbers::pi / 180;
  const double sine = std::sin(half / 2), even_sine = std::sin(half * (1 - light.blend) / 2);
  record.a = to_float4(light.position);
  record.b = to_float4(light.direction);
  record.c = to_float4({2 * sine * sine, 2 * even_sine * even_sine, 0});
  // The falloff is symmetric about 1/2 in the cosine, so that its border counts half.
  record.radiance = to_float4(light.intensity, static_cast<double>(record.c.x) + record.c.y);
}

void write_directional(const LightSpec& light, const LitRegion& region, Emitter& record) {
  record.a = region.sphere;
  record.b = to_float4(light.direction);
  record.c.x = region.reach;
  record.radiance = to_float4(light.intensity, square(region.sphere.w));
}

void write_environment(const LightSpec& light, const LitRegion& region, Emitter& record) {
  const double integral = environment_integral(light.map);
  record.a = region.sphere;
  record.b = to_float4({light.rotation / 360, 0, 0});
  record.c.x = region.reach;
  record.radiance = to_float4({integral, integral, integral}, square(region.sphere.w));
  record.shape = static_cast<uint>(light.map.width);
  record.first_area = static_cast<uint>(light.map.height);
}

/// An image that lies on an object: from its corner along u and v.
void write_surface(const Scene& scene, const LightSpec& light, Emitter& record) {
  const Object& object = scene.objects[static_cast<std::size_t>(light.object)];
  const Vec3 u = object.transform.vector({1, 0, 0}), v = object.transform.vector({0, 1, 0});
  const double mean = mean_radiance(light.map);
  record.a = to_float4(object.transform.point({-0.5, -0.5, 0}));
  record.b = to_float4(u, light.map.width);
  record.c = to_float4(v, light.map.height);
  record.radiance = to_float4({mean, mean, mean}, length(cross(u, v)));
  record.two_sided = scene.materials[static_cast<std::size_t>(object.material)].two_sided;
}

}  // namespace

Emitter light_record(const Scene& scene, const LightSpec& light, const LitRegion& region) {
  Emitter record{};
  record.type = row_of(light.kind).number;
  if (has_property(light.kind, SURFACE)) write_surface(scene, light, record);
#define WRITE_EMISSIVE(name)
#define WRITE_DELTA(name) \
  if (light.kind == LightSpec::Kind::name) write_##name(light, region, record);
#define WRITE_SURFACE(name)
#define WRITE_BACKGROUND(name) WRITE_DELTA(name)
#define WRITE_LIGHT(x, NAME, number, name, effect, family, ...) WRITE_##family(name)
  LIGHT_TABLE(WRITE_LIGHT, )
  return record;
}

}  // namespace causticl
