#include "selftest/sphere_oracle.hpp"
#include "shape_fixture.hpp"

using namespace causticl;

namespace {

Shape sphere(Vec3 centre, double radius) {
  return make_shape(SHAPE_SPHERE,
                    Transform::scale({radius, radius, radius}).followed_by(Transform::shift(centre)));
}

SphereRoots exact_roots(const Shape& shape, const ShapeRay& ray) {
  return sphere_roots(to_vec3(shape.sphere), shape.sphere.w, to_vec3(ray.origin), to_vec3(ray.direction));
}

}  // namespace

TEST_CASE("sphere: nearest root, position, normal and uv against long double on random rays") {
  RandomInputs random(101);
  ShapeScene scene;
  for (int i = 0; i < 1000; ++i) {
    const double radius = random_scale(random, -8, 8);
    scene.shapes.push_back(sphere(random_direction(random) * radius * random.uniform(0, 20), radius));
  }
  const std::size_t count = 1000000;
  std::vector<ShapeRay> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t index = i % scene.shapes.size();
    const Vec3 centre = to_vec3(scene.shapes[index].sphere);
    const double radius = scene.shapes[index].sphere.w;
    // From outside, near the surface and inside, towards points in and around the sphere.
    const double distance = radius * (i % 3 ? random.uniform(0, 2) : random_scale(random, 0, 2));
    const Vec3 origin = centre + random_direction(random) * distance;
    const Vec3 target = centre + random_direction(random) * (radius * random.uniform(0, 1.3));
    rays.push_back(make_ray(origin, target - origin, index));
  }
  const auto results = scene.trace(rays);
  std::size_t wrong = 0, wrong_t = 0, wrong_surface = 0, wrong_occlusion = 0, hits = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Shape& shape = scene.shapes[i % scene.shapes.size()];
    const SphereRoots roots = exact_roots(shape, rays[i]);
    const ShapeResult& result = results[i];
    const double radius = shape.sphere.w;
    wrong_occlusion += (result.uv.w == 1) != (result.hit.w == 1);
    const long double approach = roots.approach / radius;
    // Within rounding of a tangent ray or of an origin on the surface, either answer is right.
    const double size = length(to_vec3(rays[i].origin) - to_vec3(shape.sphere)) + radius;
    if (std::fabs(approach - 1) < 1e-6 * size / radius || std::fabs(roots.near) < 4e-6 * size ||
        std::fabs(roots.far) < 4e-6 * size)
      continue;
    const bool expected = approach < 1 && roots.far > 0;
    wrong += expected != (result.hit.w == 1);
    if (!expected || result.hit.w != 1) continue;
    ++hits;
    const double t = static_cast<double>(roots.near > 0 ? roots.near : roots.far);
    // Near-tangent roots are ill-conditioned: an error e of the approach moves t by e / cos.
    const double cosine = std::sqrt(std::fmax(1 - static_cast<double>(approach * approach), 1e-6));
    wrong_t += !(std::fabs(result.hit.x - t) <= 1e-6 * size / cosine);
    const Vec3 p = to_vec3(result.position), n = to_vec3(result.geometric_normal);
    const double off_surface = std::fabs(length(p - to_vec3(shape.sphere)) - radius);
    const Vec3 q = normalize(rows_transform(shape.to_local).point(p));
    const Vec3 expected_n = normalize(p - to_vec3(shape.sphere));
    const double uv_tolerance = 1e-6 + 4 * result.position.w / radius;
    wrong_surface += !(off_surface <= result.position.w) || !(result.position.w < 2e-5 * radius) ||
                     !(length(n - expected_n) < uv_tolerance) || !(std::fabs(length(n) - 1) < 3e-7) ||
                     !(std::fabs(result.uv.x - (q.x / 2 + 0.5)) < uv_tolerance) ||
                     !(std::fabs(result.uv.y - (q.y / 2 + 0.5)) < uv_tolerance) || result.uv.z != 7;
  }
  CHECK(hits > count / 2);
  CHECK(wrong == 0);
  CHECK(wrong_t == 0);
  CHECK(wrong_surface == 0);
  CHECK(wrong_occlusion == 0);
}

TEST_CASE("sphere: far and small, no miss to distance / radius 1e5 at 0.95 radii") {
  RandomInputs random(102);
  ShapeScene scene;
  scene.shapes.push_back(sphere({0, 0, 0}, 1));
  std::vector<ShapeRay> rays;
  for (int i = 0; i < 200000; ++i) {
    const double distance = random_scale(random, 1, 5);
    const Vec3 away = random_direction(random);
    const Vec3 across = normalize(cross(away, random_direction(random)));
    rays.push_back(make_ray(away * distance, across * random.uniform(0, 0.95) - away * distance));
  }
  const auto results = scene.trace(rays);
  std::size_t missed = 0, inaccurate = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    // Rounding of the direction alone moves a far ray sideways; the true approach decides.
    const SphereRoots roots = exact_roots(scene.shapes[0], rays[i]);
    if (roots.approach > 0.96L) continue;  // of radius 1
    missed += results[i].hit.w != 1;
    const double ulp = length(to_vec3(rays[i].origin)) * 1.2e-7;
    inaccurate += results[i].hit.w == 1 && !(std::fabs(results[i].hit.x - roots.near) <= 4 * ulp + 1e-6);
  }
  CHECK(missed == 0);
  CHECK(inaccurate == 0);
}

TEST_CASE("sphere: spawned rays neither meet their own surface nor pass it, over scales 1e-8 to 1e8") {
  RandomInputs random(103);
  for (const double offset : {0.0, 10.0, 1000.0}) {  // centre from the origin, in radii
    ShapeScene scene;
    for (int i = 0; i < 1000; ++i) {
      const double radius = random_scale(random, -8, 8);
      scene.shapes.push_back(sphere(random_direction(random) * radius * offset, radius));
    }
    std::vector<ShapeRay> rays;
    std::vector<float4> spawned;
    for (std::size_t i = 0; i < 1000000; ++i) {
      const Shape& shape = scene.shapes[i % 1000];
      const Vec3 centre = to_vec3(shape.sphere), point = random_direction(random);
      const double radius = shape.sphere.w;
      const Vec3 origin = centre + random_direction(random) * (radius * (i & 1 ? 3 : 0.5));
      rays.push_back(make_ray(origin, centre + point * radius - origin, i % 1000));
      spawned.push_back(to_float4(random_direction(random)));
    }
    const auto first = scene.trace(rays);  // to graze the surface with half the spawned rays
    for (std::size_t i = 0; i < rays.size(); i += 2) {
      const Vec3 n = to_vec3(first[i].geometric_normal);
      const Vec3 along = normalize(cross(n, to_vec3(spawned[i])));
      const double sine = (i & 2 ? -1 : 1) * random_scale(random, -6, -1);
      spawned[i] = to_float4(normalize(along + n * sine));
    }
    const auto results = scene.trace(rays, spawned);
    std::size_t again = 0, leaks = 0, missed = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      missed += results[i].hit.w != 1 && (i & 1) == 0;  // from inside every ray hits
      if (results[i].hit.w != 1) continue;
      const Vec3 n = to_vec3(results[i].geometric_normal), d = to_vec3(spawned[i]);
      const float side = static_cast<float>(n.x) * spawned[i].x + static_cast<float>(n.y) * spawned[i].y +
                         static_cast<float>(n.z) * spawned[i].z;
      if (std::fabs(dot(n, d)) < 3e-7) continue;  // the device's side may differ
      again += side > 0 && std::isfinite(results[i].again.x);
      leaks += side < 0 && !std::isfinite(results[i].again.x);
    }
    INFO("centre at " << offset << " radii");
    CHECK(missed == 0);
    CHECK(again == 0);
    CHECK(leaks == 0);
  }
}

TEST_CASE("sphere: corner cases of origin and t_max") {
  ShapeScene scene;
  scene.shapes.push_back(sphere({0, 0, 0}, 1));
  const std::vector<ShapeRay> rays{
      make_ray({0, 0, 0}, {0, 0, 1}),           // centre
      make_ray({0, 0, -3}, {0, 0, 1}),          // outside
      make_ray({0, 0, -3}, {0, 0, -1}),         // behind
      make_ray({0, 0, -3}, {0, 0, 1}, 0, 1.9),  // beyond t_max
      make_ray({2, 0, 0}, {0, 0, 1}),           // beside
      make_ray({0, 0, -1}, {0, 0, 1}),          // on the surface, inward
      make_ray({0, 0, -1}, {0, 0, -1}),         // on the surface, outward
      make_ray({0, 0, 1}, {1, 0, 0}),           // tangent at its origin
  };
  const auto results = scene.trace(rays);
  const std::vector<float> expected{1, 2, INFINITY, 1.9f, INFINITY, 2, INFINITY, INFINITY};
  for (std::size_t i = 0; i < rays.size(); ++i) {
    INFO("ray " << i);
    CHECK(results[i].hit.x == expected[i]);
    CHECK((results[i].hit.w == 1) == (i == 0 || i == 1 || i == 5));
  }
}
