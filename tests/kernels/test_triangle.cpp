// The triangle test against double precision, closed meshes against escaping rays, and the surface at a hit.
#include <cstring>
#include <functional>

#include "device_fixture.hpp"
#include "kernels/traversal_kernels.hpp"
#include "selftest/meshes.hpp"
#include "selftest/triangle_pairs.hpp"

using namespace causticl;

namespace {

const char* const triangle_kernels = R"(
#include "shapes/triangle.cl"
// One ray a block: distances (INFINITY for a miss) and the weights of vertices 1 and 2 of its eight triangles.
kernel void intersect(global const TriangleBlock *blocks, global const float4 *rays, global float8 *out, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  Ray ray = {rays[2 * i].xyz, rays[2 * i + 1].xyz};
  real8 t = (real8)INFINITY, weight_1 = 0, weight_2 = 0;
  block_intersect(blocks + i, triangle_ray(ray), rays[2 * i].w, &t, &weight_1, &weight_2);
  out[3 * i] = t;
  out[3 * i + 1] = weight_1;
  out[3 * i + 2] = weight_2;
}
kernel void surface(global const TriangleBlock *blocks, global const TriangleAttributes *attributes,
                    global const float4 *weights, global float4 *out, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  Hit hit = {1, i, weights[i].x, weights[i].y};
  Surface s;
  triangle_surface(blocks, attributes, hit, &s);
  out[4 * i] = (float4)(s.position, s.error);
  out[4 * i + 1] = (float4)(s.geometric_normal, as_float(s.material));
  out[4 * i + 2] = (float4)(s.shading_normal, 0);
  out[4 * i + 3] = (float4)(s.uv, 0, 0);
}
)";

Vec3 random_point(RandomInputs& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

float4 to_float4(Vec3 v, double w) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), static_cast<float>(w)};
}
Vec3 to_vec(float4 v) { return {v.x, v.y, v.z}; }

std::vector<TriangleBlock> in_blocks(const TriangleMesh& mesh) {
  return blocks_in_order(mesh, TriangleTest::watertight);
}

}  // namespace

TEST_CASE("the triangle test agrees with double precision") {
  RandomInputs random(50);
  auto program = build_test_program(triangle_kernels);
  constexpr std::size_t count = 1 << 18;  // of blocks: 2 M pairs of ray and triangle
  TriangleMesh mesh;
  std::vector<float4> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 origin = to_vec(to_float4(random_point(random, 2), 0));
    const Vec3 target = random_point(random, 1);
    const Vec3 direction = to_vec(to_float4(normalize(target - origin), 0));
    rays.push_back(to_float4(origin, i % 4 ? INFINITY : random.uniform(0, 3)));
    rays.push_back(to_float4(direction, 0));
    for (int lane = 0; lane < 8; ++lane) {  // all sizes and shapes, near the ray
      const double size = std::pow(10, random.uniform(-4, 0));
      const Vec3 center = target + random_point(random, size);
      mesh.push_back(make_triangle(center + random_point(random, size), center + random_point(random, size),
                                   center + random_point(random, size)));
    }
  }
  auto& device = test_device();
  const auto blocks = device.upload(in_blocks(mesh), "blocks");
  const auto ray_buffer = device.upload(rays, "rays");
  const auto out = device.buffer(count * 24 * sizeof(float), "hits");
  run_kernel(program, "intersect", count, blocks, ray_buffer, out, cl_uint(count));
  const auto results = device.download<float>(out, count * 24);

  std::size_t hits = 0, wrong = 0, wrong_distance = 0, wrong_weights = 0, doubtful = 0;
  for (std::size_t i = 0; i < count * 8; ++i) {
    const std::size_t block = i / 8, lane = i % 8;
    const Vec3 origin = to_vec(rays[2 * block]), direction = to_vec(rays[2 * block + 1]);
    const float t_max = rays[2 * block].w;
    const ExactHit exact = exact_hit(mesh[i], origin, direction);
    const float t = results[block * 24 + lane];
    // The shear rounds each vertex by 4 units in its distance from the origin; here distances are below 8.
    const double error = 8 * 6e-8 * 8;
    const Vec3 a = triangle_vertex(mesh[i], 0), b = triangle_vertex(mesh[i], 1),
               c = triangle_vertex(mesh[i], 2);
    const double longest = std::max({length(b - a), length(c - b), length(a - c)});
    const double height = length(cross(b - a, c - a)) / longest * exact.cosine;  // as the ray sees it
    const double slack = error / std::max(height, 1e-30),
                 t_slack = 4 * error * longest / std::max(height, 1e-30);
    if (std::fabs(exact.margin) < slack || std::fabs(exact.t) < t_slack ||
        std::fabs(exact.t - t_max) < t_slack) {
      ++doubtful;
      continue;
    }
    const bool did_hit = exact.margin > 0 && exact.t > 0 && exact.t < t_max;
    wrong += did_hit != std::isfinite(t);
    if (!did_hit || !std::isfinite(t)) continue;
    ++hits;
    wrong_distance += std::fabs(t - exact.t) > t_slack;
    wrong_weights += std::fabs(results[block * 24 + 8 + lane] - exact.weight_1) > 4 * slack ||
                     std::fabs(results[block * 24 + 16 + lane] - exact.weight_2) > 4 * slack;
  }
  INFO(hits << " hits, " << doubtful << " within rounding of an edge");
  CHECK(hits > 50000);
  CHECK(doubtful < count * 8 / 10);
  CHECK(wrong == 0);
  CHECK(wrong_distance == 0);
  CHECK(wrong_weights == 0);
}

namespace {

// Rays from inside a closed mesh, half of them aimed at vertices and edges; counts those that get out.
std::size_t escapes(const TriangleMesh& mesh, RandomInputs& random, std::size_t count, bool tree,
                    const std::function<Vec3()>& inside) {
  auto& device = test_device();
  static auto program = build_test_program(std::string(sphere_stand_in) + traversal_kernels);
  const auto built = build_kdtree({mesh, {}}, 2);
  const auto nodes = device.upload(built.nodes, "nodes");
  const auto blocks = device.upload(tree ? built.blocks : in_blocks(mesh), "blocks");
  const auto none = device.buffer(0, "nothing");
  std::vector<float4> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const float4 origin = to_float4(inside(), INFINITY);
    Vec3 direction = random_point(random, 1);
    if (i % 2) {
      const auto& triangle =
          mesh[std::min(mesh.size() - 1, std::size_t(random.uniform() * double(mesh.size())))];
      const double s = i % 4 == 1 ? 0 : random.uniform();
      direction = triangle_vertex(triangle, 0) * (1 - s) + triangle_vertex(triangle, 1) * s - to_vec(origin);
    }
    rays.push_back(origin);
    rays.push_back(to_float4(normalize(direction), 0));
  }
  const auto ray_buffer = device.upload(rays, "rays");
  const auto hits = device.buffer(count * sizeof(float4), "hits");
  if (tree)
    run_kernel(program, "closest", count, nodes, blocks, none, ray_buffer, hits, cl_uint(count));
  else
    run_kernel(program, "brute_force", count, blocks, cl_uint((mesh.size() + 7) / 8), none, cl_uint(0),
               ray_buffer, hits, cl_uint(count));
  std::size_t out = 0;
  for (const auto& hit : device.download<float4>(hits, count)) out += !std::isfinite(hit.x);
  return out;
}

void check_watertight(unsigned seed, std::size_t brute_count, std::size_t tree_count) {
  RandomInputs random(seed);
  // A vertex at 1e3 away from the origin of coordinates rounds differently from one at 1.
  for (const double far : {0.0, 1e3}) {
    auto sphere = icosphere_mesh(2, 1);
    auto torus = torus_mesh(40, 20, 1, 0.4);
    for (auto* mesh : {&sphere, &torus})
      for (auto& triangle : *mesh)
        for (auto& position : triangle.position) position[0] = static_cast<float>(position[0] + far);
    const auto in_sphere = [&] { return random_point(random, 0.5) + Vec3{far, 0, 0}; };
    const auto in_torus = [&] {
      const double a = random.uniform(0, tau);
      return Vec3{std::cos(a) + far, std::sin(a), 0} + random_point(random, 0.15);
    };
    INFO("offset " << far);
    CHECK(escapes(sphere, random, brute_count, false, in_sphere) == 0);
    CHECK(escapes(torus, random, brute_count, false, in_torus) == 0);
    CHECK(escapes(sphere, random, tree_count, true, in_sphere) == 0);
    CHECK(escapes(torus, random, tree_count, true, in_torus) == 0);
  }
}

}  // namespace

TEST_CASE("no ray escapes from a closed mesh, through the tree or without it") {
  check_watertight(60, 50000, 300000);
}

TEST_CASE("no ray of ten million escapes from a closed mesh", "[long]") {
  check_watertight(61, 500000, 3000000);
}

TEST_CASE("the surface of a triangle: position within its error bound, normals, uv, material") {
  RandomInputs random(70);
  auto program = build_test_program(triangle_kernels);
  constexpr std::size_t count = 1 << 16;
  TriangleMesh mesh;
  std::vector<TriangleAttributes> attributes;
  std::vector<float4> weights;
  std::vector<std::array<Vec3, 3>> normals;
  for (std::size_t i = 0; i < count; ++i) {
    const double scale = std::pow(10, random.uniform(-8, 8));
    const Vec3 a = random_point(random, scale);
    mesh.push_back(make_triangle(a, a + random_point(random, scale), a + random_point(random, scale)));
    float corner[3][3], uv[3][2];
    const Vec3 mean = normalize(random_point(random, 1));
    normals.push_back({});
    for (int v = 0; v < 3; ++v) {
      const Vec3 n = normalize(mean + random_point(random, 0.3));
      normals.back()[v] = n;
      for (int k = 0; k < 3; ++k) corner[v][k] = static_cast<float>(n[k]);
      for (int k = 0; k < 2; ++k) uv[v][k] = static_cast<float>(random.uniform(-2, 2));
    }
    attributes.push_back(triangle_attributes(static_cast<uint>(i), i % 2 ? corner : nullptr, uv));
    double u = random.uniform(), v = random.uniform();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    weights.push_back({static_cast<float>(u), static_cast<float>(v), 0, 0});
  }
  auto& device = test_device();
  const auto blocks = device.upload(in_blocks(mesh), "blocks");
  const auto attribute_buffer = device.upload(attributes, "attributes");
  const auto weight_buffer = device.upload(weights, "weights");
  const auto out = device.buffer(count * 4 * sizeof(float4), "surfaces");
  run_kernel(program, "surface", count, blocks, attribute_buffer, weight_buffer, out, cl_uint(count));
  const auto surfaces = device.download<float4>(out, count * 4);
  double worst_position = 0, worst_normal = 0, worst_shading = 0, worst_uv = 0;
  std::size_t wrong_material = 0, below = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 a = triangle_vertex(mesh[i], 0), b = triangle_vertex(mesh[i], 1),
               c = triangle_vertex(mesh[i], 2);
    const double u = weights[i].x, v = weights[i].y, w = 1 - u - v;
    const Vec3 off = to_vec(surfaces[4 * i]) - (a * w + b * u + c * v);
    const double error = surfaces[4 * i].w;
    worst_position = std::max(
        {worst_position, std::fabs(off.x) / error, std::fabs(off.y) / error, std::fabs(off.z) / error});
    const Vec3 n = normalize(cross(b - a, c - a)), ng = to_vec(surfaces[4 * i + 1]),
               ns = to_vec(surfaces[4 * i + 2]);
    const double sine = length(n) > 0 ? length(cross(normalize(b - a), normalize(c - a))) : 1;
    worst_normal = std::max(worst_normal, length(ng - n) * sine);
    Vec3 shading = n;
    if (i % 2) {
      shading = normalize(normals[i][0] * w + normals[i][1] * u + normals[i][2] * v);
      if (dot(shading, n) < 0) shading = -shading;
    }
    // A shading normal at right angles to the surface may be turned either way.
    if (std::fabs(dot(shading, n)) > 1e-3 && sine > 1e-2)
      worst_shading = std::max(worst_shading, length(ns - shading));
    below += dot(ns, ng) < 0;
    const auto& at = attributes[i].uv;
    worst_uv =
        std::max({worst_uv, std::fabs(surfaces[4 * i + 3].x - (at[0].x * w + at[1].x * u + at[2].x * v)),
                  std::fabs(surfaces[4 * i + 3].y - (at[0].y * w + at[1].y * u + at[2].y * v))});
    uint material;
    std::memcpy(&material, &surfaces[4 * i + 1].w, sizeof material);
    wrong_material += material != i;
  }
  CHECK(worst_position <= 1);
  CHECK(worst_normal < 2e-6);   // a few roundings, over the sine of the corner
  CHECK(worst_shading < 1e-4);  // 16 bits each way: 4e-5
  CHECK(worst_uv < 2e-6);
  CHECK(wrong_material == 0);
  CHECK(below == 0);
}
