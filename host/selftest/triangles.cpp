// Hard cases 3 and 4: rays that pass between triangles, by the watertight test and by precomputed transforms.
#include "selftest/stability_checks.hpp"
#include "selftest/triangle_pairs.hpp"

namespace causticl {
namespace {

/// A closed mesh, points that are inside for sure, and whether a point is.
struct ClosedMesh {
  TriangleMesh mesh;
  Vec3 (*inside)(InputRandom&);
  bool (*contains)(Vec3);
};

Vec3 in_ball(InputRandom& random, double radius) {
  return random.direction() * (radius * std::cbrt(random.uniform()));
}

constexpr Vec3 far_off{1000, -500, 2000};
constexpr Vec3 spindle{1e-3, 1, 1e-3};
Vec3 scaled(Vec3 p, Vec3 by) { return {p.x * by.x, p.y * by.y, p.z * by.z}; }

std::vector<ClosedMesh> closed_meshes() {
  const auto in_sphere = [](InputRandom& random) { return in_ball(random, 0.9); };
  const auto sphere_contains = [](Vec3 p) { return length(p) < 0.9; };
  const auto sphere = icosphere_mesh(3, 1);
  return {{sphere, in_sphere, sphere_contains},
          // Far from the origin vertices and origins of rays have fewer digits for the same shape.
          {mapped_mesh(sphere, [](Vec3 p) { return p + far_off; }),
           [](InputRandom& random) { return in_ball(random, 0.9) + far_off; },
           [](Vec3 p) { return length(p - far_off) < 0.9; }},
          // Needles of 1 : 1000.
          {mapped_mesh(sphere, [](Vec3 p) { return scaled(p, spindle); }),
           [](InputRandom& random) { return scaled(in_ball(random, 0.9), spindle); },
           [](Vec3 p) {
             return length(scaled(p, {1 / spindle.x, 1 / spindle.y, 1 / spindle.z})) < 0.9;
           }},
          {torus_mesh(40, 20, 1, 0.4),
           [](InputRandom& random) {
             const double a = random.uniform(0, tau);
             return Vec3{std::cos(a), std::sin(a), 0} + in_ball(random, 0.35);
           },
           [](Vec3 p) { return std::hypot(std::hypot(p.x, p.y) - 1, p.z) < 0.35; }},
          {torus_knot_mesh(4000),
           [](InputRandom& random) { return torus_knot_point(random.uniform()) + in_ball(random, 0.25); },
           [](Vec3) { return false; }},
          // Its edges are parallel to the axes and its diagonals to what halves them.
          {box_mesh({-1, -1, -1}, {1, 1, 1}),
           [](InputRandom& random) {
             return Vec3{random.uniform(-0.9, 0.9), random.uniform(-0.9, 0.9), random.uniform(-0.9, 0.9)};
           },
           [](Vec3 p) {
             return max_component({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}) < 0.9;
           }}};
}

std::vector<TriangleMesh> meshes_of(const std::vector<ClosedMesh>& closed) {
  std::vector<TriangleMesh> meshes;
  for (const auto& one : closed) meshes.push_back(one.mesh);
  return meshes;
}

/// A ray through the vertex exactly: along an axis or between two or three of them, where neither origin nor
/// direction is rounded off the line.
bool exact_ray(const ClosedMesh& closed, InputRandom& random, Vec3 vertex, MeshRay& ray) {
  int step[3], sum = 0;
  for (int& s : step) sum += std::abs(s = static_cast<int>(random.below(3)) - 1);
  if (sum == 0) return false;
  const double distance = std::ldexp(1 + random.below(64), -6);
  Vec3 origin = vertex;
  for (int k = 0; k < 3; ++k) {
    const double moved = vertex[k] - step[k] * distance;
    origin[k] = static_cast<double>(static_cast<float>(moved));
    if (origin[k] != moved && sum > 1) return false;
  }
  if (!closed.contains(origin)) return false;
  const Vec3 direction = normalize({double(step[0]), double(step[1]), double(step[2])});
  for (int k = 0; k < 3; ++k) {
    ray.origin[k] = static_cast<float>(origin[k]);
    ray.direction[k] = static_cast<float>(direction[k]);
  }
  return true;
}

/// From inside a mesh, half of the rays to a vertex or to a point of an edge, exactly, or one number beside
/// it.
MeshRay ray_from_inside(const std::vector<ClosedMesh>& all, InputRandom& random) {
  const std::size_t index = random.below(static_cast<std::uint32_t>(all.size()));
  const ClosedMesh& closed = all[index];
  const Vec3 origin = closed.inside(random);
  const std::uint32_t kind = random.below(8);
  if (kind < 4) return make_mesh_ray(origin, origin + random.direction(), index);
  const auto& triangle = closed.mesh[random.below(static_cast<std::uint32_t>(closed.mesh.size()))];
  const Vec3 a = triangle_vertex(triangle, 0), b = triangle_vertex(triangle, 1);
  const double fraction = kind == 4 ? random.uniform() : kind == 5 ? 0.5 : 0;
  Vec3 target = a * (1 - fraction) + b * fraction;
  for (int k = 0; k < 3; ++k)
    target[k] = next_float(static_cast<float>(target[k]), static_cast<int>(random.below(3)) - 1);
  MeshRay ray = make_mesh_ray(origin, target, index);
  if (kind == 7) exact_ray(closed, random, a, ray);
  return ray;
}

/// From inside a closed mesh every ray meets it, at whatever distance.
CheckResult no_escape(CheckContext& context) {
  const auto closed = closed_meshes();
  MeshSet meshes(context, meshes_of(closed));
  return run_random_check(
      context, 0, "", [&](InputRandom& random, std::uint64_t) { return ray_from_inside(closed, random); },
      [&](const auto& rays) { return meshes.closest(rays); },
      [](const MeshRay&, const MeshHit& hit) { return hit.t > 0 && std::isfinite(hit.t) ? 0.0 : 1.0; });
}

CheckResult no_shadow_ray_escapes(CheckContext& context) {
  const auto closed = closed_meshes();
  MeshSet meshes(context, meshes_of(closed));
  return run_random_check(
      context, 0, "", [&](InputRandom& random, std::uint64_t) { return ray_from_inside(closed, random); },
      [&](const auto& rays) { return meshes.occluded(rays); },
      [](const MeshRay&, std::uint32_t did_hit) { return did_hit == 1 ? 0.0 : 1.0; });
}

/// How many rays get out of closed meshes by each of the two tests, and their times, taken in turn.
std::string leaks_and_speed(CheckContext& context) {
  const auto closed = closed_meshes();
  MeshSet watertight(context, meshes_of(closed)),
      precomputed(context, meshes_of(closed), TriangleTest::precomputed);
  std::vector<MeshRay> rays(std::min<std::uint64_t>(context.inputs, 1 << 20));
  for (std::size_t i = 0; i < rays.size(); ++i) {
    InputRandom random(context.seed, i);
    rays[i] = ray_from_inside(closed, random);
  }
  std::size_t leaks[2] = {};
  std::vector<double> ratios;
  for (int repetition = 0; repetition < 4; ++repetition) {
    double milliseconds[2];
    for (const int test : {0, 1}) {
      const auto kernel_time = [&] { return context.device.kernel_times().at("mesh_closest").milliseconds; };
      const double before = repetition ? kernel_time() : 0;
      const auto hits = (test ? precomputed : watertight).closest(rays);
      milliseconds[test] = kernel_time() - before;
      leaks[test] = 0;
      for (const auto& hit : hits) leaks[test] += !std::isfinite(hit.t);
    }
    if (repetition > 0) ratios.push_back(milliseconds[1] / milliseconds[0]);  // the first one compiles
  }
  std::sort(ratios.begin(), ratios.end());
  char text[160];
  std::snprintf(
      text, sizeof text,
      "from closed meshes %zu of %zu rays leak, %zu by the watertight test; it takes %.2f of its time",
      leaks[1], rays.size(), leaks[0], ratios[ratios.size() / 2]);
  return text;
}

Vec3 to_vec3(const float (&p)[3]) { return {p[0], p[1], p[2]}; }

/// A triangle of any shape and size, and a ray that passes near it, one of four almost in its plane.
TrianglePair any_pair(InputRandom& random, std::uint64_t index) {
  const auto point = [&](Vec3 center, double reach) {
    return center +
           Vec3{random.uniform(-reach, reach), random.uniform(-reach, reach), random.uniform(-reach, reach)};
  };
  const double size = random.scale(-3, 1);
  const Vec3 center = point({}, 1), a = point(center, size), b = point(center, size), c = point(center, size);
  Vec3 target = point(center, size), origin = point(center, random.scale(-1, 1));
  if (index % 4 == 0) {
    const Vec3 normal = normalize(cross(b - a, c - a));
    target = a + (b - a) * random.uniform() + (c - a) * random.uniform();
    const Vec3 back = origin - target;
    origin = target + back - normal * (dot(back, normal) - length(back) * random.scale(-6, 0));
  }
  const MeshRay ray = make_mesh_ray(origin, target, 0);
  TrianglePair pair{{}, {}, make_triangle(a, b, c)};
  std::copy_n(ray.origin, 3, pair.origin);
  std::copy_n(ray.direction, 3, pair.direction);
  return pair;
}

/// Twelve products and sums lead from the coordinates to a weight, each rounded by 2^-24 of the largest
/// coordinate, which the smallest height of the triangle, as the ray sees it, turns into weights. The error
/// is in such roundings: of the weight, where the verdict is wrong, or of the distance, where it is right.
constexpr double precomputed_tolerance = 12;

double precomputed_error(const TrianglePair& pair, const PairHit& hit) {
  const Vec3 origin = to_vec3(pair.origin), direction = to_vec3(pair.direction);
  const ExactHit exact = exact_hit(pair.triangle, origin, direction);
  const Vec3 a = triangle_vertex(pair.triangle, 0), b = triangle_vertex(pair.triangle, 1),
             c = triangle_vertex(pair.triangle, 2);
  const double area = length(cross(b - a, c - a));
  if (area == 0 || exact.cosine < 1e-6) return 0;  // seen edge-on: there is no verdict to be right about
  const double longest = std::max({length(b - a), length(c - b), length(a - c)});
  const double largest = max_component({std::fabs(origin.x), std::fabs(origin.y), std::fabs(origin.z)}) +
                         max_component({std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)}) + longest;
  const double rounding = 0x1p-24 * largest / exact.cosine, weight_rounding = rounding * longest / area;
  if (std::isnan(hit.t)) return NAN;
  if (std::isfinite(hit.t) != (exact.margin > 0 && exact.t > 0))
    return std::min(std::fabs(exact.margin) / weight_rounding,
                    exact.margin > 0 ? std::fabs(exact.t) / rounding : INFINITY);
  if (!std::isfinite(hit.t)) return 0;
  return std::max({std::fabs(hit.t - exact.t) / rounding,
                   std::fabs(hit.weight_1 - exact.weight_1) / weight_rounding,
                   std::fabs(hit.weight_2 - exact.weight_2) / weight_rounding});
}

CheckResult precomputed_agrees(CheckContext& context) {
  TrianglePairs pairs(context, TriangleTest::precomputed);
  CheckResult result = run_random_check(
      context, precomputed_tolerance, "roundings", any_pair,
      [&](const auto& inputs) { return pairs.run(inputs); }, precomputed_error);
  if (!context.replay) result.note = leaks_and_speed(context);
  return result;
}

}  // namespace

std::vector<Check> triangle_checks() {
  return {{3, "no ray escapes from a closed mesh", 1, no_escape},
          {3, "no shadow ray escapes from a closed mesh", 1, no_shadow_ray_escapes},
          {4, "precomputed triangles are right away from edges", 2, precomputed_agrees}};
}

}  // namespace causticl
