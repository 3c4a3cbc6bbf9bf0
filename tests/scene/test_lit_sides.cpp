// Which sides of surfaces may be lit, and which surfaces are walls for that.
#include <algorithm>

#include "catch2.hpp"
#include "device_scene/walls.hpp"
#include "format/load_scene.hpp"
#include "render/render_fixture.hpp"
#include "scene/lit_sides.hpp"
#include "temporary_folder.hpp"

using namespace causticl;

namespace {

/// A scene of one mesh of the material with a camera at z = 6 and more objects.
Scene mesh_scene(const TemporaryFolder& folder, const std::string& mesh, const std::string& material,
                 const std::string& more = "") {
  folder.write("mesh.obj", mesh);
  return load_scene(folder.write("scene.json", R"({
    "camera": {"position": [0, 0, 6], "target": [0, 0, 0], "fov": 60},
    "objects": [{"type": "mesh", "path": "mesh.obj", "material": {"type": ")" +
                                                   material + "\"}}" + more + "]}"));
}

const std::string tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
const std::string inwards = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n";

/// A sheet of `cells` squared squares from (-1, -1, z) to (1, 1, z), wound upwards or downwards, its corners
/// from number `first` on.
std::string sheet(int cells, double z, bool upwards, int first = 1) {
  std::string text;
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i)
      text += "v " + std::to_string(2.0 * i / cells - 1) + " " + std::to_string(2.0 * j / cells - 1) + " " +
              std::to_string(z) + "\n";
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const int a = first + j * (cells + 1) + i, b = a + 1, c = b + cells + 1, d = c - 1;
      const auto face = [&](int p, int q, int r) {
        text += "f " + std::to_string(p) + " " + std::to_string(upwards ? q : r) + " " +
                std::to_string(upwards ? r : q) + "\n";
      };
      face(a, b, c);
      face(a, c, d);
    }
  return text;
}

bool has_walls(const Scene& scene, double radius) {
  return wall_grid(scene, flatten_scene(scene), lit_sides(scene), 0, radius).size() > no_walls().size();
}

}  // namespace

TEST_CASE("the inner sides of what is closed and opaque are dark") {
  const TemporaryFolder folder;
  const auto sides_of = [&](const std::string& mesh, const std::string& material,
                            const std::string& more = "") {
    return lit_sides(mesh_scene(folder, mesh, material, more)).triangles;
  };
  using Sides = std::vector<int>;
  CHECK(sides_of(tetrahedron, "diffuse") == Sides{1, 1, 1, 1});
  CHECK(sides_of(inwards, "diffuse") == Sides{-1, -1, -1, -1});
  CHECK(sides_of(tetrahedron, "glass") == Sides{0, 0, 0, 0});
  CHECK(sides_of(tetrahedron.substr(0, tetrahedron.rfind("f ")), "diffuse") == Sides{0, 0, 0});
  // A lamp within its bounds, one beside it, and the two sides of a lamp.
  const auto lamp = [](const std::string& x) {
    return R"(, {"type": "sphere", "radius": 0.1, "material": {"type": "diffuse", "emission": [1, 1, 1]},
      "transform": [{"type": "shift", "x": )" +
           x + "}]}";
  };
  CHECK(sides_of(tetrahedron, "diffuse", lamp("0.5")) == Sides{0, 0, 0, 0});
  CHECK(sides_of(tetrahedron, "diffuse", lamp("-0.5")) == Sides{1, 1, 1, 1});
  // The camera in a box, and beside one.
  const auto box = [](const std::string& z) {
    return R"(, {"type": "box", "size": [1, 1, 1], "material": {"type": "diffuse"},
      "transform": [{"type": "shift", "z": )" +
           z + "}]}";
  };
  Sides boxed = sides_of(tetrahedron, "diffuse", box("6"));
  CHECK(boxed.size() == 16);
  CHECK(std::count(boxed.begin(), boxed.end(), 1) == 4);
  boxed = sides_of(tetrahedron, "diffuse", box("3"));
  CHECK(std::count(boxed.begin(), boxed.end(), 1) == 16);
}

TEST_CASE("parts of a mesh are joined by edges; of too many none is told") {
  const TemporaryFolder folder;
  // A tetrahedron, and one that is wound inwards and shares its last corner.
  const LitSides two = lit_sides(mesh_scene(
      folder, tetrahedron + "v 0 0 2\nv 1 0 2\nv 0 1 2\nf 5 7 6\nf 5 6 4\nf 5 4 7\nf 6 7 4\n", "diffuse"));
  CHECK(two.parts == std::vector<std::int32_t>{0, 0, 0, 0, 1, 1, 1, 1});
  CHECK(two.triangles == std::vector<int>{1, 1, 1, 1, -1, -1, -1, -1});
  std::string soup;
  constexpr int most = 4096;
  for (int i = 0; i <= most; ++i) {
    const std::string x = std::to_string(2 * i);
    soup += "v " + x + " 0 0\nv " + x + ".5 0 0\nv " + x + " 0.5 0\nf -3 -2 -1\n";
  }
  const LitSides many = lit_sides(mesh_scene(folder, soup, "diffuse"));
  CHECK(many.parts == std::vector<std::int32_t>(most + 1, -1));
}

TEST_CASE("dense sheets are walls of each other, not of themselves") {
  const TemporaryFolder folder;
  constexpr int cells = 40;  // smaller than a quarter of the radius
  constexpr int second = (cells + 1) * (cells + 1) + 1;
  const auto walled = [&](const std::string& mesh) {
    return has_walls(mesh_scene(folder, mesh, "diffuse"), 0.3);
  };
  CHECK_FALSE(walled(sheet(cells, 0, true)));
  CHECK(walled(sheet(cells, 0, true) + sheet(cells, 0.01, true, second)));
  // Open, so that light may be between them.
  CHECK(walled(sheet(cells, 0, true) + sheet(cells, 0.01, false, second)));
}

TEST_CASE("the two sides of a thin body need no wall, those of two bodies do") {
  const TemporaryFolder folder;
  // A plate of 0.01 as one box, and two of them.
  const auto plates = [&](const std::string& more) {
    return scene_from_text(R"({"camera": {"position": [0, 0, 6], "target": [0, 0, 0], "fov": 60},
      "materials": {"grey": {"type": "diffuse", "color": [0.5, 0.5, 0.5]}},
      "objects": [{"type": "box", "size": [2, 2, 0.01], "material": "grey"})" +
                           more + "]}");
  };
  CHECK_FALSE(has_walls(plates(""), 0.3));
  CHECK(has_walls(plates(R"(, {"type": "box", "size": [2, 2, 0.01], "material": "grey",
    "transform": [{"type": "shift", "z": 0.1}]})"),
                  0.3));
}

TEST_CASE("a sheet over a floor is a wall, a floor with nothing below is none") {
  const auto sheets = [](const std::string& more) {
    return scene_from_text(R"({"camera": {"position": [0, 0, 6], "target": [0, 0, 0], "fov": 60},
      "lights": [{"type": "point", "position": [0, 0, 5], "intensity": [1, 1, 1]}],
      "materials": {"grey": {"type": "diffuse", "color": [0.5, 0.5, 0.5]}},
      "objects": [{"type": "rectangle", "material": "grey",
        "transform": [{"type": "scale", "x": 2, "y": 2, "z": 1}]})" +
                           more + "]}");
  };
  const std::string above =
      R"(, {"type": "rectangle", "material": "grey", "transform": [{"type": "shift", "z": 0.1}]})";
  const std::string ball = R"(, {"type": "sphere", "radius": 0.2, "material": "grey",
    "transform": [{"type": "shift", "z": 0.2}]})";
  using Sides = std::vector<int>;
  CHECK(lit_sides(sheets("")).triangles == Sides{1, 1});
  CHECK(lit_sides(sheets(above)).triangles == Sides{1, 1, 0, 0});
  CHECK(lit_sides(sheets(ball)).triangles == Sides{1, 1});
  CHECK_FALSE(has_walls(sheets(""), 0.3));
  CHECK(has_walls(sheets(above), 0.3));
  CHECK_FALSE(has_walls(sheets(above), 0.05));
  CHECK_FALSE(has_walls(sheets(ball), 0.3));
}

TEST_CASE("a low wall that is much longer than the surfaces beside it is one") {
  // A far box makes the cells larger than all of it.
  const auto tile = [](const std::string& x) {
    return R"({"type": "rectangle", "material": {"type": "diffuse"}, "transform": [
      {"type": "rotate", "axis": "x", "degree": -90}, {"type": "scale", "x": 0.24, "y": 1, "z": 0.24},
      {"type": "shift", "x": )" +
           x + R"(, "z": 0.225}]})";
  };
  const Scene scene = scene_from_text(R"({"camera": {"position": [0, 1, 6], "target": [0, 0, 0], "fov": 60},
    "objects": [)" + tile("0.12") + "," +
                                      tile("-0.12") + R"(,
      {"type": "rectangle", "material": {"type": "diffuse", "color": [0, 0, 0]}, "transform": [
        {"type": "rotate", "axis": "y", "degree": 90}, {"type": "scale", "x": 1, "y": 0.04, "z": 0.9}]},
      {"type": "box", "size": [0.1, 0.1, 0.1], "material": {"type": "diffuse"},
        "transform": [{"type": "shift", "x": 60}]}]})");
  CHECK(has_walls(scene, 0.05));
}
