// Closed meshes that are wound inwards.
#include "mesh/mesh_orientation.hpp"
#include "mesh_files.hpp"
#include "scene_folder.hpp"

namespace causticl {
namespace {

/// An OBJ file of cubes, each (centre x, half edge), wound outwards or inwards.
struct Cube {
  double x, half;
  bool inwards;
};

std::string cubes(const std::vector<Cube>& list, bool shared_corners = true, bool open = false) {
  const int faces[6][4] = {{4, 3, 2, 1}, {5, 6, 7, 8}, {1, 2, 6, 5},
                           {3, 4, 8, 7}, {2, 3, 7, 6}, {4, 1, 5, 8}};
  const double signs[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                              {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  std::string text;
  int vertices = 0;
  const auto vertex = [&](const Cube& cube, int corner) {
    text += "v";
    for (int axis = 0; axis < 3; ++axis)
      text += " " + std::to_string((axis == 0 ? cube.x : 0) + cube.half * signs[corner][axis]);
    text += "\n";
    ++vertices;
  };
  for (const Cube& cube : list) {
    const int first = vertices;
    if (shared_corners)
      for (int corner = 0; corner < 8; ++corner) vertex(cube, corner);
    for (int face = 0; face < (open ? 5 : 6); ++face) {
      int index[4];
      for (int i = 0; i < 4; ++i) {
        const int corner = faces[face][cube.inwards ? 3 - i : i];
        if (!shared_corners) vertex(cube, corner - 1);
        index[i] = shared_corners ? first + corner : vertices;
      }
      text += "f";
      for (const int i : index) text += " " + std::to_string(i);
      text += "\n";
    }
  }
  return text;
}

double volume(const Mesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.position_index)
    sum += dot(to_vec(mesh.positions[a]), cross(to_vec(mesh.positions[b]), to_vec(mesh.positions[c]))) / 6;
  return sum;
}

/// The volume of the mesh as it is turned, and whether it was.
std::pair<double, bool> turned_volume(const std::string& text) {
  const Mesh mesh = read_text("a.obj", text);
  const auto turned = turned_outwards(mesh);
  return {volume(turned ? *turned : mesh), turned.has_value()};
}

}  // namespace

TEST_CASE("closed parts that are wound inwards are turned, cavities with the wall around them") {
  using Outcome = std::pair<double, bool>;
  for (const bool shared : {true, false}) {
    const auto outcome = [&](const std::vector<Cube>& list) {
      auto result = turned_volume(cubes(list, shared));
      result.first = std::round(result.first * 1e4) / 1e4;
      return result;
    };
    CHECK(outcome({{0, 1, false}}) == Outcome{8, false});
    CHECK(outcome({{0, 1, true}}) == Outcome{8, true});
    CHECK(outcome({{1e5, 1, true}}) == Outcome{8, true});
    CHECK(outcome({{0, 1, false}, {0, 0.5, true}}) == Outcome{7, false});  // a cavity
    CHECK(outcome({{0, 1, true}, {0, 0.5, false}}) == Outcome{7, true});
    CHECK(outcome({{0, 1, false}, {5, 0.5, true}}) == Outcome{9, true});  // two bodies
    CHECK(outcome({{5, 0.5, true}, {0, 1, false}, {0, 0.5, true}}) == Outcome{8, true});
    CHECK(turned_volume(cubes({{0, 1, true}}, shared, true)).second == false);  // open
  }
  // Two sides of a sheet have no inside.
  CHECK(turned_volume(square + "f 1 2 3\nf 1 3 4\nf 1 3 2\nf 1 4 3\n").second == false);
  // Very many parts count as one mesh.
  std::vector<Cube> many;
  for (int i = 0; i < 5000; ++i) many.push_back({3.0 * i, 1, true});
  const auto [total, is_turned] = turned_volume(cubes(many));
  CHECK(is_turned);
  CHECK(total == Approx(40000));
}

TEST_CASE("glass alone is turned, in a mesh of its own, with a note") {
  const SceneFolder folder;
  folder.folder.write("in.obj", cubes({{0, 1, true}}));
  const auto object = [](const std::string& type, const std::string& more = "") {
    return R"({"type": "mesh", "path": "in.obj", "material": {"type": ")" + type + "\"}" + more + "}";
  };
  const Scene scene =
      folder.objects(object("mirror") + ", " + object("glass") + ", " + object("glass") + ", " + lamp);
  REQUIRE(scene.meshes.size() == 2);
  CHECK(volume(scene.meshes[static_cast<std::size_t>(scene.objects[0].mesh)]) == -8);
  CHECK(volume(scene.meshes[static_cast<std::size_t>(scene.objects[1].mesh)]) == 8);
  CHECK(scene.objects[1].mesh == scene.objects[2].mesh);
  REQUIRE(scene.notices.size() == 1);
  CHECK(scene.notices[0].find("/objects/1: ") != std::string::npos);
  CHECK(scene.notices[0].ends_with(
      "in.obj: closed parts of it are wound inwards; as glass they are turned outwards"));
  const Scene smooth = folder.objects(object("glass", ", \"smooth\": true") + ", " + lamp);
  CHECK(smooth.meshes[static_cast<std::size_t>(smooth.objects[0].mesh)].normals.size() == 8);
}

}  // namespace causticl
