// Objects whose own coordinates lie far from their origin.
#include <cmath>

#include "mesh_files.hpp"
#include "scene/object_triangles.hpp"
#include "scene_folder.hpp"
#include "world/flat_scene.hpp"

namespace causticl {
namespace {

constexpr Vec3 far{448262.125, 4517583.3, 87.2};  // a place in metres of a map projection

std::string digits(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.9f", value);
  return text;
}

std::string shift(Vec3 by) {
  return R"({"type": "shift", "x": )" + digits(by.x) + R"(, "y": )" + digits(by.y) + R"(, "z": )" +
         digits(by.z) + "}";
}

/// A ball of 16 by 8 quadrilaterals, with polygons at its poles.
std::vector<Vec3> ball() {
  std::vector<Vec3> points;
  for (int row = 1; row < 8; ++row)
    for (int column = 0; column < 16; ++column) {
      const double polar = M_PI * row / 8, turn = M_PI * column / 8;
      points.push_back(
          {std::sin(polar) * std::cos(turn), std::cos(polar), -std::sin(polar) * std::sin(turn)});
    }
  return points;
}

std::string obj_faces() {
  std::string text, top = "f", bottom = "f";
  const auto index = [](int row, int column) { return " " + std::to_string(16 * row + column % 16 + 1); };
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 16; ++column)
      text += "f" + index(row, column) + index(row + 1, column) + index(row + 1, column + 1) +
              index(row, column + 1) + "\n";
  for (int column = 0; column < 16; ++column) {
    top += index(0, column);
    bottom += index(6, 15 - column);
  }
  return text + top + "\n" + bottom + "\n";
}

std::string obj_ball(Vec3 at) {
  std::string text;
  for (const Vec3 p : ball())
    text += "v " + digits(at.x + p.x) + " " + digits(at.y + p.y) + " " + digits(at.z + p.z) + "\n";
  return text + obj_faces();
}

std::string ply_ball(Vec3 at) {
  std::string text =
      "ply\nformat binary_big_endian 1.0\nelement vertex 112\nproperty double x\nproperty double y\n"
      "property double z\nelement face 96\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vec3 p : ball())
    for (const double value : {at.x + p.x, at.y + p.y, at.z + p.z}) text += raw(value, true);
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 16; ++column) {
      text += '\4';
      for (const int index : {16 * row + column, 16 * row + 16 + column, 16 * row + 16 + (column + 1) % 16,
                              16 * row + (column + 1) % 16})
        text += raw(index, true);
    }
  return text;
}

/// The largest distance between corners of the triangles of two scenes.
double distance(const Scene& a, const Scene& b) {
  const FlatScene first = flatten_scene(a), second = flatten_scene(b);
  REQUIRE(first.tree.triangles.size() == second.tree.triangles.size());
  double largest = 0;
  for (std::size_t t = 0; t < first.tree.triangles.size(); ++t)
    for (int c = 0; c < 3; ++c)
      for (int axis = 0; axis < 3; ++axis)
        largest = std::max(largest, std::fabs(double(first.tree.triangles[t].position[c][axis]) -
                                              second.tree.triangles[t].position[c][axis]));
  return largest;
}

}  // namespace

TEST_CASE("meshes far from their own origin keep their digits until their transform has brought them near") {
  const SceneFolder folder;
  const auto scene = [&](const std::string& file, const std::string& transform,
                         const std::string& more = "") {
    return folder.objects(R"({"type": "mesh", "path": ")" + file +
                          R"(", "material": {"type": "diffuse"}, "transform": [)" + transform + "]" + more +
                          "}");
  };
  const std::string turn =
      R"({"type": "rotate", "axis": "x", "degree": 30}, {"type": "scale", "x": 2, "y": 2, "z": -2})";
  const auto back = [](Vec3 by) { return shift(-by); };
  for (const bool obj : {true, false}) {
    CAPTURE(obj);
    const std::string name = obj ? "a.obj" : "a.ply";
    folder.folder.write("near_" + name, obj ? obj_ball({}) : ply_ball({}));
    folder.folder.write("far_" + name, obj ? obj_ball(far) : ply_ball(far));
    const std::string near_file = "near_" + name, far_file = "far_" + name;
    for (const std::string more : {"", ", \"smooth\": true"}) {
      CHECK(distance(scene(far_file, back(far), more), scene(near_file, "", more)) < 1e-6);
      CHECK(distance(scene(far_file, back(far) + ", " + turn, more), scene(near_file, turn, more)) < 1e-6);
    }
    // In steps, far away between them.
    const Vec3 beyond{-3e6, 2e6, 5e6};
    CHECK(distance(scene(far_file, shift(beyond) + ", " + back(far + beyond)), scene(near_file, "")) < 1e-6);
    const Mesh near_mesh = read_mesh(folder.folder.path(near_file)),
               far_mesh = read_mesh(folder.folder.path(far_file));
    CHECK(near_mesh.position_index == far_mesh.position_index);  // polygons are cut alike
    Mesh near_smooth = near_mesh, far_smooth = far_mesh;
    add_missing_normals(near_smooth);
    add_missing_normals(far_smooth);
    for (std::size_t i = 0; i < near_smooth.normals.size(); ++i)
      CHECK(length(to_vec(near_smooth.normals[i]) - to_vec(far_smooth.normals[i])) < 1e-6);
  }
}

TEST_CASE("shapes that are shifted far away and back are where they were") {
  const SceneFolder folder;
  const Vec3 beyond{5e6, -5e6, 5e6};
  for (const std::string shape : {R"("type": "sphere", "radius": 0.5)", R"("type": "disk", "radius": 0.5)",
                                  R"("type": "rectangle")", R"("type": "box", "size": [1, 2, 3])",
                                  R"("type": "bezier_rotate", "point": [[0, 0], [1, 0.5], [0, 1]])"}) {
    CAPTURE(shape);
    const auto scene = [&](const std::string& steps) {
      return folder.objects("{" + shape +
                            R"(, "material": {"type": "diffuse", "emission": [1, 1, 1]}, "transform": [)" +
                            steps + "]}");
    };
    const std::string half = shift({0.1, 0.2, 0.3});
    const Scene there_and_back = scene(half + ", " + shift(beyond) + ", " + shift(-beyond)),
                here = scene(half);
    CHECK(distance(there_and_back, here) < 1e-7);
    const FlatScene a = flatten_scene(there_and_back), b = flatten_scene(here);
    REQUIRE(a.shapes.size() == b.shapes.size());
    for (std::size_t i = 0; i < a.shapes.size(); ++i)
      for (int row = 0; row < 3; ++row)
        CHECK(std::fabs(a.shapes[i].to_world[row].w - b.shapes[i].to_world[row].w) < 1e-7);
    CHECK(a.emitters[0].radiance.w == Approx(b.emitters[0].radiance.w));
  }
}

TEST_CASE("a revolved curve far along its own axis, and shifted back, is the one near its origin") {
  const SceneFolder folder;
  const auto world = [&](double height) {
    const std::string points =
        "[[0, " + digits(height) + "], [1, " + digits(height + 0.5) + "], [0, " + digits(height + 1) + "]]";
    return flatten_scene(
        folder.objects(R"({"type": "bezier_rotate", "point": )" + points +
                       R"(, "material": {"type": "diffuse", "emission": [1, 1, 1]}, "transform": [)" +
                       shift({0, -height, 0}) + "]}"));
  };
  const FlatScene here = world(0), away = world(4517583.3);
  // Where the point at the same place on both curves is: the middle of the data's bounds by the map to world.
  const auto& a = here.tree.shapes[0].bounds;
  const auto& b = away.tree.shapes[0].bounds;
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(std::fabs(a.low[axis] - b.low[axis]) < 1e-6);
    CHECK(std::fabs(a.high[axis] - b.high[axis]) < 1e-6);
  }
  CHECK(std::fabs(away.shapes[0].to_world[1].w) < 1);
  CHECK(away.shapes[0].area == Approx(here.shapes[0].area).epsilon(1e-6));
}

TEST_CASE("(u, v) far from 0 keep the place within the repeat, for every scale of a texture") {
  const SceneFolder folder;
  for (const std::string texture :
       {R"({"type": "image", "path": "5x4.png")", R"({"type": "checker", "a": [0, 0, 0], "b": [1, 1, 1])"}) {
    for (const std::string scale : {"[1, 1]", "[0.3, -7]"}) {
      CAPTURE(texture, scale);
      const auto uvs = [&](double away) {
        std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
        for (const auto& [u, v] : {std::pair{0.125, 0.25}, {0.5, 0.25}, {0.125, 0.75}})
          text += "vt " + digits(u + away) + " " + digits(v - away) + "\n";
        folder.folder.write("uv.obj", text + "f 1/1 2/2 3/3\n");
        const Scene scene =
            folder.objects(R"({"type": "mesh", "path": "uv.obj", "material": {"type": "diffuse", "color": )" +
                           texture + ", \"scale\": " + scale + "}}}");
        const auto factors = scene.textures[0].scale;
        std::vector<double> places;  // within two repeats
        const FlatScene world = flatten_scene(scene);
        for (const auto& uv : world.attributes[0].uv)
          for (const double value : {uv.x * factors[0], uv.y * factors[1]})
            places.push_back(value - 2 * std::floor(value / 2));
        return places;
      };
      const double away = scale == "[1, 1]" ? 4517582 : 4517600;  // whole pairs of repeats of either scale
      const auto here = uvs(0), there = uvs(away);
      for (std::size_t i = 0; i < here.size(); ++i) CHECK(there[i] == Approx(here[i]).margin(1e-5));
    }
  }
}

}  // namespace causticl
