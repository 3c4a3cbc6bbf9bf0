#include "world/emitters.hpp"

#include <algorithm>
#include <cmath>

#include "scene/float4.hpp"
#include "scene/light_kind.hpp"
#include "world/environment.hpp"
#include "world/light_records.hpp"

namespace causticl {
namespace {

/// Centre and radius of a sphere around all that is bounded, which light from beyond the scene has to cover.
/// The sphere about the bounding box, a little larger, so that no rounding in a kernel cuts it.
float4 scene_sphere(const TreeInput& tree) {
  Vec3 low{INFINITY, INFINITY, INFINITY}, high = -low;
  const auto add = [&](const float(&p)[3]) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min<double>(low[axis], p[axis]);
      high[axis] = std::max<double>(high[axis], p[axis]);
    }
  };
  for (const auto& triangle : tree.triangles)
    for (const auto& corner : triangle.position) add(corner);
  for (const auto& shape : tree.shapes) {
    add(shape.bounds.low);
    add(shape.bounds.high);
  }
  if (!(low.x <= high.x)) return {0, 0, 0, 1};  // infinite planes alone
  const Vec3 centre = 0.5 * (low + high);
  const double largest = max_component({std::fabs(centre.x), std::fabs(centre.y), std::fabs(centre.z)});
  return to_float4(centre, 1.0001 * length(0.5 * (high - low)) + 1e-6 * largest);
}

/// The sphere that light from beyond the scene has to cover, all that is bounded in its midst. What infinite
/// planes are outside of it is far to kernels (cl/lights/horizon.cl), which read it from the records of
/// planes. Where nothing is bounded it lies about the camera, as large as its distance to the next plane.
LitRegion lit_region(const Scene& scene, FlatScene& world) {
  LitRegion region{scene_sphere(world.tree)};
  if (world.plane_count == 0 || !has_infinite_light(scene)) return region;
  const auto distance_to = [&](uint i, Vec3 point) {
    const float4* rows = world.shapes[i].to_world;
    const float4& row = world.shapes[i].to_local[2];
    return std::fabs(
        dot(normalize(Vec3{row.x, row.y, row.z}), point - Vec3{rows[0].w, rows[1].w, rows[2].w}));
  };
  if (world.tree.triangles.empty() && world.tree.shapes.empty()) {
    double radius = INFINITY;
    for (uint i = 0; i < world.plane_count; ++i) {
      const double distance = distance_to(i, scene.camera.origin);
      if (distance > 0) radius = std::min(radius, distance);
    }
    region.sphere = to_float4(scene.camera.origin, std::isfinite(radius) ? radius : 1);
  }
  constexpr float around = 1.5f;  // what lies just beside bounded things gets as much light as these
  constexpr double farthest = 1000;
  region.sphere.w *= around;
  const Vec3 centre{region.sphere.x, region.sphere.y, region.sphere.z};
  for (uint i = 0; i < world.plane_count; ++i) {
    world.shapes[i].sphere = region.sphere;
    const double reach = distance_to(i, centre) / region.sphere.w;
    region.reach = static_cast<float>(std::clamp<double>(reach, region.reach, farthest));
  }
  return region;
}

/// Probabilities in proportion to power, as numbers owned: what kernels draw and what they state agree
/// exactly. Emitters with less than 2^-48 of all power may own none.
void assign_numbers(FlatScene& world) {
  const auto power = [](const Emitter& light) {
    return std::max({light.radiance.x, light.radiance.y, light.radiance.z}) *
           static_cast<double>(light.radiance.w) * (light.two_sided ? 2 : 1);
  };
  for (const auto& light : world.emitters) world.emitted_power += power(light);
  constexpr double numbers = static_cast<double>(std::uint64_t{1} << EMITTER_CHOICE_BITS);
  double sum = 0;
  std::uint64_t before = 0;
  for (auto& light : world.emitters) {
    sum += power(light);
    light.cdf = static_cast<std::uint64_t>(std::llround(sum / world.emitted_power * numbers));
    light.probability = static_cast<float>(static_cast<double>(light.cdf - before) / numbers);
    before = light.cdf;
  }
}

/// The lights that are emitters, in their order: the background is the last, as kernels expect.
std::vector<std::size_t> lit_lights(const Scene& scene) {
  std::vector<std::size_t> lit;
  for (std::size_t i = 0; i < scene.lights.size(); ++i)
    if (is_lit(scene.lights[i])) lit.push_back(i);
  std::stable_partition(lit.begin(), lit.end(),
                        [&](std::size_t i) { return !has_property(scene.lights[i].kind, BACKGROUND); });
  return lit;
}

/// The texels of the lights that have maps, the background's first. Emitters from `first` on are `lights`.
void add_maps(const Scene& scene, const std::vector<std::size_t>& lights, std::size_t first,
              FlatScene& world) {
  for (std::size_t i = lights.size(); i-- > 0;) {
    const LightSpec& light = scene.lights[lights[i]];
    if (light.map.rgba.empty()) continue;
    Emitter& emitter = world.emitters[first + i];
    const std::uint64_t numbers = emitter.cdf - (first + i > 0 ? (&emitter)[-1].cdf : 0);
    const bool background = has_property(light.kind, BACKGROUND);
    if (!background) emitter.shape = static_cast<uint>(world.environment.size());
    const auto table = background ? environment_table(light.map, numbers) : flat_table(light.map, numbers);
    world.environment.insert(world.environment.end(), table.begin(), table.end());
  }
}

}  // namespace

std::size_t emitters_from(const Scene& scene, int light) {
  const auto lit = lit_lights(scene);
  return static_cast<std::size_t>(lit.end() -
                                  std::find(lit.begin(), lit.end(), static_cast<std::size_t>(light)));
}

void finish_emitters(const Scene& scene, const Dielectrics& dielectrics, FlatScene& world) {
  const std::size_t first = world.emitters.size();
  const auto lights = lit_lights(scene);
  const LitRegion region = lights.empty() ? LitRegion{} : lit_region(scene, world);
  for (const std::size_t i : lights) {
    const LightSpec& light = scene.lights[i];
    Emitter record = light_record(scene, light, region);
    if (!dielectrics.bodies.empty())
      record.in_dielectric = light.object < 0
                                 ? dielectrics.holds_light[i]
                                 : dielectrics.holds_emitter[static_cast<std::size_t>(light.object)];
    world.emitters.push_back(record);
  }
  assign_numbers(world);
  add_maps(scene, lights, first, world);
}

}  // namespace causticl
