// The lists of walls near visible points against all surfaces of a scene.
#include <algorithm>
#include <cstring>

#include "device_scene/wall_primitives.hpp"
#include "device_scene/walls.hpp"
#include "format/load_scene.hpp"
#include "render/render_fixture.hpp"
#include "scene/lit_sides.hpp"
#include "temporary_folder.hpp"
#include "vector_inputs.hpp"

using namespace causticl;

namespace {

const char* const source = R"(
#include "photons/walls.cl"
kernel void part(global const float4 *points, global const float4 *photons, global const float4 *normals,
                 global const WallGrid *grid, global uint *out, uint count, float radius) {
  uint i = get_global_id(0);
  if (i >= count) return;
  NearWalls near;
  real3 normal = convert_real3(normals[2 * i].xyz);
  bool any = walls_near(grid, convert_real3(points[i].xyz), normal, radius, &near);
  out[i] = any && walls_between(&near, convert_real3(photons[i].xyz), convert_real3(normals[2 * i + 1].xyz));
}
)";

// Rooms parted by a wall of no thickness, one of a thousandth, a leaning one and a plane; a block, a ball and
// a turned profile on the floor; and a second storey.
const char* const rooms = R"({
  "camera": {"position": [0, 1, 6], "target": [0, 0, 0], "fov": 60},
  "materials": {"grey": {"type": "diffuse", "color": [0.5, 0.5, 0.5]}},
  "objects": [
    {"type": "plane", "material": "grey", "transform": [{"type": "rotate", "axis": "x", "degree": -90}]},
    {"type": "plane", "material": "grey", "transform": [{"type": "rotate", "axis": "y", "degree": 90},
      {"type": "shift", "x": 3, "y": 0, "z": 0}]},
    {"type": "rectangle", "material": "grey", "transform": [{"type": "scale", "x": 8, "y": 8, "z": 1},
      {"type": "rotate", "axis": "x", "degree": 90}, {"type": "shift", "x": 0, "y": 2, "z": 0}]},
    {"type": "rectangle", "material": "grey", "transform": [{"type": "scale", "x": 6, "y": 6, "z": 1},
      {"type": "rotate", "axis": "y", "degree": 90}]},
    {"type": "box", "material": "grey", "size": [0.001, 4, 6], "transform": [{"type": "shift", "x": 1, "y": 2, "z": 0}]},
    {"type": "rectangle", "material": "grey", "transform": [{"type": "scale", "x": 6, "y": 6, "z": 1},
      {"type": "rotate", "axis": "y", "degree": 90}, {"type": "rotate", "axis": "z", "degree": 40},
      {"type": "shift", "x": 2, "y": 0, "z": 0}]},
    {"type": "box", "material": "grey", "size": [0.4, 0.8, 0.5], "transform": [
      {"type": "rotate", "axis": "y", "degree": 20}, {"type": "shift", "x": 0.5, "y": 0.4, "z": 0.5}]},
    {"type": "sphere", "material": "grey", "radius": 0.4, "transform": [{"type": "shift", "x": -0.7, "y": 0.3, "z": 0}]},
    {"type": "bezier_rotate", "material": "grey", "point": [[0.3, 0], [0.5, 0.3], [0.2, 0.8]],
      "transform": [{"type": "shift", "x": -1.6, "y": -0.05, "z": 0.6}]}]
})";

/// A grid that lists all walls for every point.
std::vector<std::byte> all_walls(const std::vector<WallPrimitive>& primitives) {
  std::vector<Wall> walls;
  for (const auto& primitive : primitives)
    if (primitive.blocks) walls.push_back(primitive.wall);
  const auto count = static_cast<uint>(walls.size());
  std::vector<uint> words{0, count + 2, count, 0};
  for (uint i = 0; i < walls.size(); ++i) words.push_back(i);
  while (words.size() % 4) words.push_back(0);
  WallGrid grid{};
  grid.first_wall = static_cast<uint>((sizeof grid + 4 * words.size()) / 16);
  std::vector<std::byte> bytes(sizeof grid + 4 * words.size() + sizeof(Wall) * walls.size());
  std::memcpy(bytes.data(), &grid, sizeof grid);
  std::memcpy(bytes.data() + sizeof grid, words.data(), 4 * words.size());
  std::memcpy(bytes.data() + std::size_t{16} * grid.first_wall, walls.data(), sizeof(Wall) * walls.size());
  return bytes;
}

/// Whether the point lies on a surface.
bool on_surface(Vec3 point, const std::vector<WallPrimitive>& primitives) {
  constexpr double tolerance = 1e-5;
  return std::any_of(primitives.begin(), primitives.end(), [&](const WallPrimitive& primitive) {
    const Wall& wall = primitive.wall;
    const Vec3 from = point - to_vec3(wall.origin);
    if (wall.origin.w == WALL_SPHERE) return std::fabs(length(from) - wall.normal.w) < tolerance;
    if (!(std::fabs(dot(from, to_vec3(wall.normal))) < tolerance)) return false;
    if (wall.origin.w == WALL_PLANE) return true;
    if (wall.origin.w == WALL_PARALLELOGRAM)
      return std::all_of(wall.edge, wall.edge + 2,
                         [&](const float4& edge) { return std::fabs(dot(to_vec3(edge), from)) < edge.w; });
    return std::all_of(std::begin(wall.edge), std::end(wall.edge),
                       [&](const float4& edge) { return dot(to_vec3(edge), from) > edge.w; });
  });
}

struct Place {
  Vec3 point, normal;
};

/// A point of a random surface, often of the floor where a wall stands on it, and the normal on a side that
/// may be lit.
Place random_place(RandomInputs& random, const std::vector<WallPrimitive>& primitives, double radius) {
  if (random.uniform() < 0.5) {
    const double wall = std::floor(random.uniform(0, 4));
    return {{wall + random.uniform(-radius, radius), 0, random.uniform(-2.5, 2.5)}, {0, 1, 0}};
  }
  // The profile's triangles come last, and are many.
  constexpr double most = 18;
  const double end = random.uniform() < 0.8 ? most : static_cast<double>(primitives.size());
  const auto& p = primitives[static_cast<std::size_t>(random.uniform(0, 0.9999999) * end)];
  const Vec3 origin = to_vec3(p.wall.origin);
  Vec3 n = to_vec3(p.wall.normal), point;
  if (p.wall.origin.w == WALL_SPHERE) {
    n = random_direction(random);
    point = origin + p.wall.normal.w * n;
  } else if (p.wall.origin.w == WALL_TRIANGLE) {
    const double a = std::sqrt(random.uniform()), b = random.uniform();
    point = (1 - a) * p.corners[0] + a * (1 - b) * p.corners[1] + a * b * p.corners[2];
  } else if (p.wall.origin.w == WALL_PARALLELOGRAM) {
    const double a = random.uniform(), b = random.uniform();
    point = p.corners[0] + a * (p.corners[1] - p.corners[0]) + b * (p.corners[3] - p.corners[0]);
  } else {
    const Vec3 u{random.uniform(-4, 4), random.uniform(0, 3), random.uniform(-3, 3)};
    point = u - dot(n, u - origin) * n;
  }
  const double side = p.lit_side ? p.lit_side : random.uniform() < 0.5 ? 1 : -1;
  return {point, side * n};
}

}  // namespace

TEST_CASE("the walls that a cell lists part what all surfaces part") {
  const Scene scene = scene_from_text(rooms);
  const FlatScene world = flatten_scene(scene);
  const auto primitives = wall_primitives(scene, world, lit_sides(scene), 0);
  for (const double radius : {0.02, 0.15, 0.6}) {
    INFO("radius " << radius);
    RandomInputs random(771);
    std::vector<float4> points, photons, normals;
    while (points.size() < 40000) {
      const Place a = random_place(random, primitives, radius);
      // A place nearby on a surface: one of many tries.
      for (int tries = 0; tries < 40; ++tries) {
        Place b = random_place(random, primitives, radius);
        if (tries < 20) b = {a.point + random.uniform(0, radius) * random_direction(random), a.normal};
        if (length(b.point - a.point) > radius || dot(a.normal, b.normal) < 0.5) continue;
        if (tries < 20) b.point = b.point - dot(a.normal, b.point - a.point) * a.normal;
        if (!on_surface(b.point, primitives)) continue;
        points.push_back(to_float4(a.point));
        photons.push_back(to_float4(b.point));
        normals.push_back(to_float4(a.normal));
        normals.push_back(to_float4(b.normal));
        break;
      }
    }
    auto program = build_test_program(source);
    const auto count = points.size();
    const auto in = test_device().upload(points, "points"), ends = test_device().upload(photons, "photons"),
               sides = test_device().upload(normals, "normals"),
               out = test_device().buffer(count * sizeof(cl_uint), "verdicts");
    const auto verdicts = [&](const std::vector<std::byte>& bytes) {
      const auto grid = test_device().upload(bytes, "walls");
      run_kernel(program, "part", count, in, ends, sides, grid, out, static_cast<cl_uint>(count),
                 static_cast<float>(radius));
      return test_device().download<cl_uint>(out, count);
    };
    const auto expected = verdicts(all_walls(primitives)),
               found = verdicts(wall_grid(scene, world, lit_sides(scene), 0, radius));
    std::size_t parted = 0, missed = 0, invented = 0;
    for (std::size_t i = 0; i < count; ++i) {
      parted += expected[i];
      missed += expected[i] && !found[i];
      invented += !expected[i] && found[i];
    }
    CHECK(parted > count / 100);
    CHECK(invented == 0);
    CHECK(missed <= parted / 300);  // surface that ends less than a thousandth of the radius behind another
  }
}

TEST_CASE("the halves of a parallelogram are one wall, other pairs of triangles two") {
  const auto walls_of = [](const char* points) {
    const TemporaryFolder folder;
    folder.write("mesh.obj", std::string(points) + "f 1 2 3\nf 1 3 4\n");
    const Scene scene = load_scene(folder.write("scene.json", R"({
      "camera": {"position": [0, 1, 6], "target": [0, 0, 0], "fov": 60},
      "objects": [{"type": "mesh", "path": "mesh.obj", "material": {"type": "diffuse"}}]})"));
    return wall_primitives(scene, flatten_scene(scene), lit_sides(scene), 0);
  };
  const auto leaning = walls_of("v 0 0 0\nv 2 0 1\nv 3 1 1\nv 1 1 0\n");
  REQUIRE(leaning.size() == 1);
  CHECK(leaning[0].wall.origin.w == WALL_PARALLELOGRAM);
  CHECK(to_vec3(leaning[0].wall.origin) == Vec3{1.5, 0.5, 0.5});
  // The points within by its edges are those within by its corners.
  RandomInputs random(773);
  const Vec3 u{2, 0, 1}, v{1, 1, 0};
  for (int i = 0; i < 1000; ++i) {
    const double a = random.uniform(-0.5, 1.5), b = random.uniform(-0.5, 1.5);
    const Vec3 from = a * u + b * v - to_vec3(leaning[0].wall.origin);
    CHECK(std::fabs(dot(from, to_vec3(leaning[0].wall.normal))) < 1e-6);
    const bool within = std::all_of(leaning[0].wall.edge, leaning[0].wall.edge + 2, [&](const float4& edge) {
      return std::fabs(dot(to_vec3(edge), from)) < edge.w;
    });
    CHECK(within == (a > 0 && a < 1 && b > 0 && b < 1));
  }
  CHECK(walls_of("v 0 0 0\nv 2 0 1\nv 3 1 1\nv 1 1 0.001\n").size() == 2);  // folded
  CHECK(walls_of("v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0.001 1 0\n").size() == 2);  // a trapezoid
}

TEST_CASE("what has surface on one side alone is no wall") {
  const Scene scene = scene_from_text(R"({
    "camera": {"position": [0, 1, 6], "target": [0, 0, 0], "fov": 60},
    "objects": [{"type": "box", "size": [2, 2, 2], "material": {"type": "diffuse"}}]})");
  CHECK(wall_grid(scene, flatten_scene(scene), lit_sides(scene), 0, 0.1).size() == no_walls().size());
}
