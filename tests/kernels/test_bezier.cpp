#include <numbers>

#include "selftest/curve_inputs.hpp"
#include "selftest/curve_oracle.hpp"
#include "shape_fixture.hpp"

using namespace causticl;

// First hits, and photons inside closed surfaces: host/selftest/bezier.cpp.

namespace {

void add_curve(ShapeScene& scene, const CurvePoints& curve, const Transform& transform) {
  scene.shapes.push_back(make_shape(SHAPE_BEZIER, transform, static_cast<uint>(scene.curves.size())));
  const auto data = curve_data(curve);
  scene.curves.insert(scene.curves.end(), data.begin(), data.end());
}

}  // namespace

TEST_CASE("bezier: spawned rays do not meet their own surface, over scales 1e-8 to 1e8") {
  RandomInputs random(404);
  ShapeScene scene;
  const CurvePoints egg = closed_curves[0];  // convex: a ray that leaves it never returns
  std::vector<ShapeRay> rays;
  std::vector<float4> spawned;
  for (int i = 0; i < 100; ++i) {
    const double scale = random_scale(random, -8, 8);
    const Transform map = Transform::scale({scale, scale, scale})
                              .followed_by(Transform::rotate(0, random.uniform(0, 6)))
                              .followed_by(Transform::shift(random_direction(random) * (scale * 10)));
    add_curve(scene, egg, map);
    for (int k = 0; k < 1000; ++k) {
      const Vec3 target = map.point(Vec3{0, random.uniform(-0.5, 0.5), 0} + random_direction(random) * 0.3);
      const Vec3 away = random_direction(random);
      rays.push_back(make_ray(target + away * (scale * 5), away * -1, static_cast<std::size_t>(i)));
      spawned.push_back(to_float4(random_direction(random)));
    }
  }
  const auto results = scene.trace(rays, spawned);
  std::size_t missed = 0, again = 0, leaks = 0, inward_normals = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    missed += results[i].hit.w != 1;
    if (results[i].hit.w != 1) continue;
    const Vec3 n = to_vec3(results[i].geometric_normal);
    const double side = dot(n, to_vec3(spawned[i]));
    inward_normals += dot(n, to_vec3(rays[i].direction)) > 0;
    again += side > 1e-6 && std::isfinite(results[i].again.x);
    leaks += side < -1e-6 && !std::isfinite(results[i].again.x);
  }
  CHECK(missed == 0);
  CHECK(inward_normals == 0);
  CHECK(again == 0);
  CHECK(leaks == 0);
}

TEST_CASE("bezier: bezier_point lies on the surface, and its area element integrates to the area table's") {
  RandomInputs random(405);
  auto program = build_test_program(R"(
#include "shapes/shape.cl"
kernel void points(global const Shape *shapes, global const float *curves, global const float4 *uv,
                   global float4 *out, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  real3 position, normal;
  real area;
  bezier_point(shapes + (uint)uv[i].z, curves, uv[i].x, uv[i].y, &position, &normal, &area);
  out[2 * i] = (float4)(position, area);
  out[2 * i + 1] = (float4)(normal, 0);
}
)");
  ShapeScene scene;
  std::vector<CurvePoints> curves = closed_curves;
  curves.insert(curves.end(), special_curves.begin(), special_curves.end());
  for (const auto& curve : curves) add_curve(scene, curve, random_placement(scene.shapes.size()));
  std::vector<double> sizes;
  for (std::size_t c = 0; c < curves.size(); ++c)
    sizes.push_back(length(rows_transform(scene.shapes[c].to_world).vector(curve_bounds(curves[c]).high)));
  std::vector<float4> uv;
  const std::size_t grid = 64;
  for (std::size_t c = 0; c < curves.size(); ++c)
    for (std::size_t i = 0; i < grid * grid; ++i)
      uv.push_back({static_cast<float>((i % grid + random.uniform()) / grid),
                    static_cast<float>((i / grid + random.uniform()) / grid), static_cast<float>(c), 0});
  auto out = test_device().buffer(uv.size() * 2 * sizeof(float4), "points");
  run_kernel(program, "points", uv.size(), test_device().upload(scene.shapes, "shapes"),
             test_device().upload(scene.curves, "curves"), test_device().upload(uv, "uv"), out,
             cl_uint(uv.size()));
  const auto points = test_device().download<float4>(out, uv.size() * 2);
  std::size_t off = 0, wrong_area = 0, not_across = 0;
  for (std::size_t i = 0; i < uv.size(); ++i) {
    const auto c = static_cast<std::size_t>(uv[i].z);
    const Transform to_world = rows_transform(scene.shapes[c].to_world);
    const auto world = [&](double u, double v) {
      const auto p = CurveOracle::point(curves[c], v);
      const double angle = 2 * std::numbers::pi * u, x = std::abs(p[0]);
      return to_world.point({x * std::cos(angle), p[1], x * std::sin(angle)});
    };
    const double size = sizes[c];
    const double u = uv[i].x, v = uv[i].y, h = 1e-5;
    const Vec3 expected = world(u, v);
    off += !(length(to_vec3(points[2 * i]) - expected) <= 4e-6 * size + 3e-7 * length(expected));
    const Vec3 by_u = (world(u + h, v) - world(u - h, v)) / (2 * h);
    const Vec3 by_v = (world(u, v + h) - world(u, v - h)) / (2 * h);
    const double area = length(cross(by_u, by_v)), largest = size * size;
    wrong_area += !(std::abs(points[2 * i].w - area) <= 1e-3 * area + 2e-4 * largest);
    const Vec3 n = to_vec3(points[2 * i + 1]);
    not_across += !(std::abs(length(n) - 1) < 1e-6) ||
                  (area > 0.05 * largest && !(std::abs(dot(n, normalize(by_v))) < 2e-3));
  }
  CHECK(off == 0);
  CHECK(wrong_area <= uv.size() / 2000);  // differences across a cusp or the axis are not derivatives
  CHECK(not_across <= uv.size() / 2000);
}

TEST_CASE("bezier: the area table of a cone, a cylinder and a disc, and bounds") {
  const auto cone = curve_area_table({{0, 0}, {3, 4}}, 10);
  REQUIRE(cone.size() == 12);
  CHECK(cone[0] == 10);
  CHECK(cone[1] == Approx(std::numbers::pi * 3 * 5));
  CHECK(cone[2 + 4] == Approx(0.25));  // half way up
  CHECK(cone.back() == 1);
  CHECK(curve_area_table({{2, 0}, {2, 3}}, 8)[1] == Approx(2 * std::numbers::pi * 2 * 3));
  CHECK(curve_area_table({{0, 1}, {2, 1}}, 8)[1] == Approx(4 * std::numbers::pi));
  const CurveBounds egg = curve_bounds(closed_curves[0]);
  CHECK(egg.high.x == Approx(1.05).epsilon(1e-4));
  CHECK(egg.low.y == Approx(-1).epsilon(1e-4));
  CHECK(curve_data({{0, 0}, {0, 1}})[0] == 0);  // no surface
  CHECK(curve_data({{1, 1}, {1, 1}, {1, 1}})[0] == 0);
}
