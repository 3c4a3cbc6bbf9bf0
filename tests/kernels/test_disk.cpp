#include "shape_fixture.hpp"

using namespace causticl;

TEST_CASE("disk: hits, position, normal and uv against double precision on random rays") {
  RandomInputs random(301);
  ShapeScene scene;
  for (int i = 0; i < 1000; ++i) {
    const double scale = random_scale(random, -8, 8);
    scene.shapes.push_back(make_shape(
        SHAPE_DISK,
        Transform::scale({scale * random.uniform(0.3, 3), scale * random.uniform(0.3, 3), scale})
            .followed_by(Transform::rotate(0, random.uniform(0, 6.28)))
            .followed_by(Transform::rotate(2, random.uniform(0, 6.28)))
            .followed_by(Transform::shift(random_direction(random) * (scale * random.uniform(0, 10))))));
  }
  std::vector<ShapeRay> rays;
  std::vector<float4> spawned;
  for (std::size_t i = 0; i < 1000000; ++i) {
    const Transform to_world = rows_transform(scene.shapes[i % 1000].to_world);
    const Vec3 origin{random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)};
    const Vec3 target{random.uniform(-1.2, 1.2), random.uniform(-1.2, 1.2), 0};
    rays.push_back(make_ray(to_world.point(origin), to_world.vector(target - origin), i % 1000));
    spawned.push_back(to_float4(random_direction(random)));
  }
  const auto results = scene.trace(rays, spawned);
  std::size_t hits = 0, wrong = 0, wrong_t = 0, wrong_surface = 0, wrong_occlusion = 0, again = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    Transform to_local = rows_transform(scene.shapes[i % 1000].to_local);
    // The disc lies round the image of the origin as stored.
    to_local.translation = -to_local.vector(rows_transform(scene.shapes[i % 1000].to_world).translation);
    const Vec3 o = to_local.point(to_vec3(rays[i].origin)), d = to_local.vector(to_vec3(rays[i].direction));
    const double t = -o.z / d.z;
    const Vec3 at = o + d * t;
    const double radius = std::hypot(at.x, at.y);
    // Local coordinates of a disc ten radii from the origin are known to about 1e-5 of a radius, and a
    // slanting ray moves that much farther within the disc.
    const double noise = 2e-5 * (1 + std::hypot(d.x, d.y) / std::abs(d.z));
    const bool found = results[i].hit.w == 1;
    wrong_occlusion += found != (results[i].uv.w == 1);
    if (std::abs(radius - 1) < noise || std::abs(o.z) < 1e-4) continue;
    wrong += (t > 0 && radius < 1) != found;
    if (!found || !(t > 0)) continue;
    ++hits;
    wrong_t += !(std::abs(results[i].hit.x - t) * length(d) <= noise + 2e-6);
    const Vec3 p = to_vec3(results[i].position), local = to_local.point(p);
    const Vec3 n = normalize(to_local.rows[2]);
    wrong_surface += !(std::abs(local.z) / length(to_local.rows[2]) <= results[i].position.w) ||
                     !(length(to_vec3(results[i].geometric_normal) - n) < 1e-6) ||
                     !(std::abs(results[i].uv.x - (at.x / 2 + 0.5)) <= noise) ||
                     !(std::abs(results[i].uv.y - (at.y / 2 + 0.5)) <= noise);
    again += std::isfinite(results[i].again.x);
  }
  CHECK(hits > rays.size() / 4);
  CHECK(wrong == 0);
  CHECK(wrong_t == 0);
  CHECK(wrong_surface == 0);
  CHECK(wrong_occlusion == 0);
  CHECK(again == 0);
}

TEST_CASE("disk: rim, centre, either side, in its plane") {
  ShapeScene scene;
  scene.shapes.push_back(make_shape(SHAPE_DISK, Transform::scale({2, 3, 1})));
  const auto results = scene.trace({make_ray({1.99, 0, 5}, {0, 0, -1}), make_ray({2.01, 0, 5}, {0, 0, -1}),
                                    make_ray({0, 2.99, -5}, {0, 0, 1}), make_ray({0, 3.01, -5}, {0, 0, 1}),
                                    make_ray({0, 0, 5}, {0, 0, -1}), make_ray({-5, 0, 0}, {1, 0, 0})});
  const std::vector<float> expected{1, 0, 1, 0, 1, 0};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    INFO("ray " << i);
    CHECK(results[i].hit.w == expected[i]);
    if (expected[i] == 1) CHECK(results[i].geometric_normal.z == 1);
  }
  CHECK(results[4].uv.x == 0.5f);
  CHECK(results[4].uv.y == 0.5f);
}
