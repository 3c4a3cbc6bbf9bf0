// Ray and cylinder: hits, surfaces, spawned rays and points on it, against double precision.
#include "shape_fixture.hpp"

using namespace causticl;

namespace {

/// `capped` and the fraction of the area that the wall has, as cl/shapes/primitives/cylinder.cl reads them.
Shape make_cylinder(const Transform& to_world, bool capped, double wall_fraction = 0, double area = 0) {
  Shape shape = make_shape(SHAPE_CYLINDER, to_world);
  shape.own[0] = capped ? 1 : 0;
  shape.own[1] = static_cast<float>(wall_fraction);
  shape.area = static_cast<float>(area);
  return shape;
}

Transform random_placement(RandomInputs& random, double scale) {
  return Transform::scale({scale * random.uniform(0.3, 3), scale * random.uniform(0.3, 3),
                           (random.uniform(0, 1) < 0.5 ? -1 : 1) * scale * random.uniform(0.3, 3)})
      .followed_by(Transform::rotate(0, random.uniform(0, 6.28)))
      .followed_by(Transform::rotate(2, random.uniform(0, 6.28)))
      .followed_by(Transform::shift(random_direction(random) * (scale * random.uniform(0, 10))));
}

/// The nearest hit in local space, and by how little it is one, or is none.
struct ExactHit {
  double t = INFINITY;
  bool on_cap = false;
  double clearance = INFINITY;  // the least distance of what decides to its threshold
  double grazing = 1;           // what an error across the ray moves the hit by
};

ExactHit exact_hit(Vec3 o, Vec3 d, bool capped) {
  ExactHit hit;
  const auto decide = [&](double value) { hit.clearance = std::min(hit.clearance, std::abs(value)); };
  const auto offer = [&](double t, bool on_cap, double grazing) {
    decide(t);
    if (t > 0 && t < hit.t) {
      hit.t = t;
      hit.on_cap = on_cap;
      hit.grazing = grazing;
    }
  };
  const double a = d.x * d.x + d.z * d.z, b = o.x * d.x + o.z * d.z;
  // The squared distance of the ray from the axis, without what cancels.
  const double across = (o.x * d.z - o.z * d.x) * (o.x * d.z - o.z * d.x) / a;
  decide(1 - across);
  if (across < 1) {
    const double root = std::sqrt(a * (1 - across));
    for (const double t : {(-b - root) / a, (-b + root) / a}) {
      const double y = o.y + t * d.y;
      decide(std::abs(y) - 1);
      if (std::abs(y) <= 1) offer(t, false, 1 + length(d) / root);
    }
  }
  if (capped)
    for (const double side : {-1.0, 1.0}) {
      const double t = (side - o.y) / d.y, x = o.x + t * d.x, z = o.z + t * d.z;
      decide(std::hypot(x, z) - 1);
      if (std::hypot(x, z) <= 1) offer(t, true, 1 + length(d) / std::abs(d.y));
    }
  return hit;
}

const char* const points_source = R"(
#include "shapes/shape.cl"
kernel void draw(global const Shape *shapes, global const float4 *uniform, global float4 *results, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  global const Shape *shape = shapes + (uint)uniform[i].z;
  real3 normal;
  real pdf;
  real3 p = shape_draw_point(shape, 0, uniform[i].x, uniform[i].y, &normal, &pdf);
  results[3 * i] = (float4)(p, pdf);
  // The same point as a hit, by a ray that comes straight from outside.
  real reach = (real)0.01 * sqrt(shape->area);
  Ray ray = {p + reach * normal, -normal};
  Hit hit = hit_none(2 * reach);
  bool found = shape_closest(shape, (uint)uniform[i].z, 0, ray, &hit);
  Surface surface;
  if (found) shape_surface(shape, 0, ray, hit, &surface);
  results[3 * i + 1] = (float4)(normal, found ? shape_unevenness(shape, 0, hit, &surface) : (real)-1);
  results[3 * i + 2] = (float4)(found ? surface.position : p, 0);
}
)";

}  // namespace

TEST_CASE("cylinder: hits, position, normal, uv and spawned rays against double precision") {
  RandomInputs random(821);
  ShapeScene scene;
  for (int i = 0; i < 1000; ++i)
    scene.shapes.push_back(make_cylinder(random_placement(random, random_scale(random, -8, 8)), i % 2 == 0));
  std::vector<ShapeRay> rays;
  std::vector<float4> spawned;
  for (std::size_t i = 0; i < 1000000; ++i) {
    const Transform to_world = rows_transform(scene.shapes[i % 1000].to_world);
    const Vec3 origin{random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3)};
    const Vec3 target{random.uniform(-1.2, 1.2), random.uniform(-1.2, 1.2), random.uniform(-1.2, 1.2)};
    // Every tenth along the axis or across it, as exactly as the placement allows.
    const Vec3 direction = i % 20 == 0 ? Vec3{0, 1, 0} : i % 20 == 10 ? Vec3{1, 0, 0} : target - origin;
    rays.push_back(make_ray(to_world.point(origin), to_world.vector(direction), i % 1000));
    spawned.push_back(to_float4(random_direction(random)));
  }
  const auto results = scene.trace(rays, spawned);
  std::size_t hits = 0, on_caps = 0, skipped = 0, wrong = 0, wrong_t = 0, wrong_surface = 0,
              wrong_occlusion = 0, again = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const bool capped = i % 2 == 0;
    const Transform to_local = rows_transform(scene.shapes[i % 1000].to_local);
    const Vec3 o = to_local.point(to_vec3(rays[i].origin)), d = to_local.vector(to_vec3(rays[i].direction));
    const ExactHit exact = exact_hit(o, normalize(d), capped);
    const bool found = results[i].hit.w == 1;
    wrong_occlusion += found != (results[i].uv.w == 1);
    // Local coordinates of a cylinder ten radii from the origin are known to about 1e-5 of a radius, and rays
    // that graze it move that much farther on it.
    constexpr double noise = 2e-5;
    if (exact.clearance < 50 * noise || exact.grazing > 50) {
      ++skipped;
      continue;
    }
    wrong += std::isfinite(exact.t) != found;
    if (!found || !std::isfinite(exact.t)) continue;
    ++hits;
    on_caps += exact.on_cap;
    wrong_t += !(std::abs(results[i].hit.x * length(d) - exact.t) <= noise * exact.grazing);
    const Vec3 at = o + normalize(d) * exact.t;
    const Vec3 local = to_local.point(to_vec3(results[i].position));
    const double rho = std::hypot(local.x, local.z);
    const Vec3 slope = exact.on_cap ? Vec3{0, at.y < 0 ? -1.0 : 1.0, 0} : Vec3{at.x, 0, at.z};
    const Vec3 gradient =
        to_local.rows[0] * slope.x + to_local.rows[1] * slope.y + to_local.rows[2] * slope.z;
    const double off = (exact.on_cap ? std::abs(local.y) - 1 : rho - 1) / length(gradient);
    const Vec3 n = to_vec3(results[i].geometric_normal);
    double u = std::atan2(at.z, at.x) / 6.283185307179586;
    u = u < 0 ? u + 1 : u;
    const double du = std::abs(results[i].uv.x - u);
    const bool right_uv = exact.on_cap
                              ? std::abs(results[i].uv.x - (at.x / 2 + 0.5)) <= noise * exact.grazing &&
                                    std::abs(results[i].uv.y - (at.z / 2 + 0.5)) <= noise * exact.grazing
                              : std::min(du, 1 - du) <= noise * exact.grazing &&
                                    std::abs(results[i].uv.y - (at.y / 2 + 0.5)) <= noise * exact.grazing;
    wrong_surface +=
        !(std::abs(off) <= results[i].position.w) || !right_uv ||
        !(length(n - normalize(gradient)) < 20 * noise * exact.grazing) ||
        !(results[i].position.w < 1e-4 * length(to_vec3(results[i].position)) + 1e-3 / length(gradient));
    // What leaves a convex body never meets it again, and what enters it does, farther away.
    if (!capped) continue;
    const double cosine = dot(n, to_vec3(spawned[i]));
    if (std::abs(cosine) < 1e-3) continue;
    again += cosine > 0 ? std::isfinite(results[i].again.x)
                        : !(results[i].again.x > 0 && std::isfinite(results[i].again.x));
  }
  std::printf("cylinder: seed 821, %zu hits, %zu on caps, %zu rays too near to an edge to tell\n", hits,
              on_caps, skipped);
  CHECK(hits > rays.size() / 4);
  CHECK(on_caps > rays.size() / 40);
  CHECK(skipped < rays.size() / 5);
  CHECK(wrong == 0);
  CHECK(wrong_t == 0);
  CHECK(wrong_surface == 0);
  CHECK(wrong_occlusion == 0);
  CHECK(again == 0);
}

TEST_CASE("cylinder: along and across the axis, from inside, open and capped, at the rim") {
  ShapeScene scene;
  scene.shapes = {make_cylinder(Transform{}, true), make_cylinder(Transform{}, false)};
  const auto results =
      scene.trace({make_ray({0, 5, 0}, {0, -1, 0}), make_ray({0.5, 0, 0}, {0, 1, 0}),
                   make_ray({5, 0, 0}, {-1, 0, 0}), make_ray({2, 0, 0}, {0, 1, 0}),
                   make_ray({0, 5, 0}, {0, -1, 0}, 1), make_ray({0.5, 0, 0}, {0, 1, 0}, 1),
                   make_ray({0, 0, 0}, {0, 0, 1}, 1), make_ray({5, 0.5, 0}, {-1, 0, 0}, 1),
                   make_ray({0, 2, 0}, {1, -1.5, 0}, 1), make_ray({0, 5, 0}, {0, -1, 0}, 0, 3.5)});
  const std::vector<float> expected{4, 1, 4, -1, -1, -1, 1, 4, float(std::sqrt(3.25)), -1};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    INFO("ray " << i);
    CHECK(results[i].hit.w == (expected[i] > 0 ? 1 : 0));
    if (expected[i] > 0) CHECK(results[i].hit.x == Approx(expected[i]).epsilon(1e-6));
  }
  CHECK(results[0].geometric_normal.y == 1);
  CHECK(results[1].geometric_normal.y == 1);  // outward, also seen from inside
  CHECK(results[2].geometric_normal.x == 1);
  CHECK(results[6].geometric_normal.z == 1);

  // Rays that come to a point of the rim from outside and go on inward: none slips through.
  RandomInputs random(822);
  std::vector<ShapeRay> rays;
  for (int i = 0; i < 200000; ++i) {
    const double angle = random.uniform(0, 6.283185307179586);
    const Vec3 rim{std::cos(angle), i % 2 ? 1.0 : -1.0, std::sin(angle)};
    const Vec3 inside{random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)};
    const Vec3 origin = rim + (rim - inside) * random.uniform(0.1, 5);
    rays.push_back(make_ray(origin, rim - origin));
  }
  std::size_t missed = 0;
  for (const auto& result : scene.trace(rays)) missed += result.hit.w != 1;
  CHECK(missed == 0);
}

TEST_CASE("cylinder: points on it are drawn with the density that they are said to have") {
  RandomInputs random(823);
  std::vector<Shape> shapes;
  std::vector<double> areas, squares;
  for (int i = 0; i < 8; ++i) {
    const Transform to_world = random_placement(random, random_scale(random, -2, 2));
    const bool capped = i % 2 == 0;
    // In double precision: the area, and the integral of the squared distance from the image of the centre.
    double wall = 0, square = 0;
    constexpr int steps = 2000;
    const Vec3 along = to_world.vector({0, 1, 0});
    for (int k = 0; k < steps; ++k) {
      const double angle = 6.283185307179586 * (k + 0.5) / steps;
      const Vec3 radial = to_world.vector({std::cos(angle), 0, std::sin(angle)});
      const double element = 2 *
                             length(cross(to_world.vector({-std::sin(angle), 0, std::cos(angle)}), along)) *
                             6.283185307179586 / steps;
      wall += element;
      // The mean over the height of |radial + y along|^2.
      square += element * (dot(radial, radial) + dot(along, along) / 3);
    }
    const Vec3 x = to_world.vector({1, 0, 0}), z = to_world.vector({0, 0, 1});
    const double cap = M_PI * length(cross(x, z));
    if (capped) square += 2 * cap * (dot(along, along) + (dot(x, x) + dot(z, z)) / 4);
    const double area = wall + (capped ? 2 * cap : 0);
    shapes.push_back(make_cylinder(to_world, capped, wall / area, area));
    areas.push_back(area);
    squares.push_back(square);
  }
  constexpr std::size_t count = 1600000;
  std::vector<float4> uniform(count);
  for (std::size_t i = 0; i < count; ++i)
    uniform[i] = {static_cast<float>(random.uniform(0, 0.9999999)),
                  static_cast<float>(random.uniform(0, 0.9999999)), static_cast<float>(i % 8), 0};
  auto& device = test_device();
  cl::Program program = build_test_program(points_source);
  auto out = device.buffer(count * 3 * sizeof(float4), "results");
  run_kernel(program, "draw", count, device.upload(shapes, "shapes"), device.upload(uniform, "uniform"), out,
             cl_uint(count));
  const auto results = device.download<float4>(out, 3 * count);
  std::vector<double> area(8), square(8);
  std::size_t wrong = 0, unmet = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t k = i % 8;
    const Transform to_world = rows_transform(shapes[k].to_world),
                    to_local = rows_transform(shapes[k].to_local);
    const Vec3 p = to_vec3(results[3 * i]), from_centre = p - to_world.translation;
    const double pdf = results[3 * i].w, size = std::cbrt(std::abs(to_world.determinant()));
    area[k] += 8.0 / count / pdf;
    square[k] += 8.0 / count * dot(from_centre, from_centre) / pdf;
    const Vec3 local = to_local.point(p);
    const double off = std::max(std::hypot(local.x, local.z), std::abs(local.y)) - 1;
    wrong += !(std::abs(off) < 1e-4);
    // Met again from straight above; beside the rim of caps by the wall, whose density is another.
    const double unevenness = results[3 * i + 1].w;
    unmet += unevenness < 0;
    const bool at_rim = std::abs(std::hypot(local.x, local.z) - std::abs(local.y)) < 0.02;
    if (unevenness >= 0 && !at_rim) {
      wrong += !(std::abs(unevenness / (pdf * areas[k]) - 1) < 1e-3);
      wrong += !(length(to_vec3(results[3 * i + 2]) - p) < 1e-3 * size);
    }
  }
  CHECK(wrong == 0);
  CHECK(unmet < count / 1000);
  for (std::size_t k = 0; k < 8; ++k) {
    INFO("cylinder " << k);
    CHECK(area[k] == Approx(areas[k]).epsilon(0.004));
    CHECK(square[k] == Approx(squares[k]).epsilon(0.008));
  }
}
