#include "shape_fixture.hpp"

using namespace causticl;

namespace {

Transform random_affine(RandomInputs& random, double scale) {
  return Transform::scale({scale * random.uniform(0.3, 3), scale * random.uniform(0.3, 3), scale})
      .followed_by(Transform::rotate(0, random.uniform(0, 6.28)))
      .followed_by(Transform::rotate(2, random.uniform(0, 6.28)))
      .followed_by(Transform::shift(random_direction(random) * (scale * random.uniform(0, 10))));
}

}  // namespace

TEST_CASE("plane: t, position, normal and uv against double precision on random rays") {
  RandomInputs random(201);
  ShapeScene scene;
  for (int i = 0; i < 1000; ++i)
    scene.shapes.push_back(make_shape(SHAPE_PLANE, random_affine(random, random_scale(random, -8, 8))));
  std::vector<ShapeRay> rays;
  std::vector<float4> spawned;
  for (std::size_t i = 0; i < 1000000; ++i) {
    const Transform to_world = rows_transform(scene.shapes[i % 1000].to_world);
    const Vec3 origin{random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-5, 5)};
    rays.push_back(make_ray(to_world.point(origin), random_direction(random), i % 1000));
    spawned.push_back(to_float4(random_direction(random)));
  }
  const auto results = scene.trace(rays, spawned);
  std::size_t hits = 0, wrong = 0, wrong_t = 0, wrong_surface = 0, wrong_uv = 0, again = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Shape& shape = scene.shapes[i % 1000];
    const Transform to_world = rows_transform(shape.to_world);
    Transform to_local = rows_transform(shape.to_local);
    // The plane goes through the image of the origin as stored.
    to_local.translation = -to_local.vector(to_world.translation);
    const Vec3 row = to_local.rows[2], o = to_vec3(rays[i].origin), d = to_vec3(rays[i].direction);
    const double height = to_local.point(o).z, t = -height / dot(row, d), cosine = dot(row, d) / length(row);
    // The rounding of the four terms of the height, as a distance along the ray.
    const double noise = 4e-7 *
                             (std::abs(row.x * o.x) + std::abs(row.y * o.y) + std::abs(row.z * o.z) +
                              std::abs(to_local.translation.z)) /
                             std::abs(dot(row, d)) +
                         1e-6 * std::abs(t) / std::abs(cosine);
    wrong += std::abs(t) > noise && (t > 0) != (results[i].hit.w == 1);
    if (results[i].hit.w != 1 || !(t > 0)) continue;
    ++hits;
    wrong_t += !(std::abs(results[i].hit.x - t) <= noise);
    const Vec3 p = to_vec3(results[i].position), n = to_vec3(results[i].geometric_normal);
    wrong_surface += !(std::abs(to_local.point(p).z) / length(row) <= results[i].position.w) ||
                     !(results[i].position.w <= 1e-5 * (length(p) + length(to_world.translation))) ||
                     !(length(n - normalize(row)) < 1e-6);
    const Vec3 from_origin = p - to_world.translation;
    const double u = dot(normalize(to_world.vector({1, 0, 0})), from_origin);
    const double v = dot(normalize(to_world.vector({0, 1, 0})), from_origin);
    const double tolerance = 1e-6 * (length(p) + length(to_world.translation));
    wrong_uv +=
        !(std::abs(results[i].uv.x - u) <= tolerance) || !(std::abs(results[i].uv.y - v) <= tolerance);
    again += std::isfinite(results[i].again.x);
  }
  CHECK(hits > rays.size() / 3);
  CHECK(wrong == 0);
  CHECK(wrong_t == 0);
  CHECK(wrong_surface == 0);
  CHECK(wrong_uv == 0);
  CHECK(again == 0);  // a ray that leaves a plane never meets it again
}

TEST_CASE("plane: a ray in the plane, along its normal, on it and beyond t_max") {
  ShapeScene scene;
  scene.shapes.push_back(make_shape(SHAPE_PLANE, Transform{}));
  const auto results = scene.trace({make_ray({0, 0, 0}, {1, 0, 0}), make_ray({0, 0, 1}, {1, 0, 0}),
                                    make_ray({3, 4, 2}, {0, 0, -1}), make_ray({3, 4, 2}, {0, 0, -1}, 0, 2),
                                    make_ray({0, 0, 0}, {0, 0, 1}), make_ray({0, 0, 1}, {0, 0, 1})});
  const std::vector<float> expected{0, 0, 1, 0, 0, 0};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    INFO("ray " << i);
    CHECK(results[i].hit.w == expected[i]);
    CHECK(results[i].uv.w == expected[i]);
  }
  CHECK(results[2].hit.x == 2);
  CHECK(results[2].uv.x == 3);
  CHECK(results[2].uv.y == 4);
}
