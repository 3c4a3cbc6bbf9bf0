// What all kinds of meshes share: polygons, normals, size, and real files.
#include <ctime>
#include <iostream>

#include "catch2.hpp"
#include "mesh/mesh_polygon.hpp"
#include "mesh_files.hpp"

namespace causticl {

TEST_CASE("A mesh must be a file of a known kind") {
  const TemporaryFolder folder;
  const auto fault = [&](const std::string& name) {
    return user_error_of([&] { read_mesh(folder.path(name)); }, folder.path(name));
  };
  CHECK(fault("none.obj") == "none.obj: no such file");
  std::filesystem::create_directory(folder.path("folder.ply"));
  CHECK(fault("folder.ply") == "folder.ply: is a folder; expected a mesh");
  folder.write("a.stl", "solid");
  CHECK(fault("a.stl") == "a.stl: is no mesh by its name; expected the extension .obj or .ply");
  CHECK(user_error_of([] { read_mesh("/dev/null"); }) == "/dev/null: is not a regular file; expected a mesh");
  folder.write("UPPER.OBJ", square + "f 1 2 3 4");
  CHECK(fault("UPPER.OBJ") == "");
}

TEST_CASE("Polygons are cut inside their outline, with their winding") {
  // Concave outlines of known area, each tilted into space, from every first corner.
  struct Outline {
    std::vector<std::array<double, 2>> corners;
    double area;
  };
  const std::vector<Outline> outlines{
      {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 1},
      {{{0, 0}, {2, 0}, {0.5, 0.5}, {0, 2}}, 1},                              // an arrowhead
      {{{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}}, 7},  // a U
      {{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}, 4},  // corners on its edges
      {{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}},
       12},                                                                      // a hole, bridged
      {{{0, 0}, {5, 1}, {0.2, 1.2}, {5, 2}, {0.2, 2.2}, {5, 3}, {0, 4}}, 10.2},  // a comb
  };
  const Transform tilt = Transform::rotate(0, 1.1).followed_by(Transform::rotate(1, -2.3));
  for (std::size_t o = 0; o < outlines.size(); ++o) {
    const std::size_t count = outlines[o].corners.size();
    for (std::size_t first = 0; first < count; ++first) {
      CAPTURE(o, first);
      std::vector<std::array<double, 3>> corners;
      for (std::size_t i = 0; i < count; ++i) {
        const auto& [x, y] = outlines[o].corners[(first + i) % count];
        const Vec3 p = tilt.point({x, y, 0}) + Vec3{10, 20, 30};
        corners.push_back({p.x, p.y, p.z});
      }
      std::vector<Triangle> triangles;
      triangulate_polygon(corners, triangles);
      CHECK(triangles.size() == count - 2);
      const Vec3 normal = tilt.vector({0, 0, 1});
      double total = 0;
      for (const auto& [a, b, c] : triangles) {
        const Vec3 p = to_vec(corners[a]);
        const double area = 0.5 * dot(normal, cross(to_vec(corners[b]) - p, to_vec(corners[c]) - p));
        CHECK(area > -1e-5);
        total += std::fabs(area);
      }
      CHECK(total == Approx(outlines[o].area).epsilon(1e-5));
    }
  }
}

TEST_CASE("Polygons without a proper inside end, and keep their number of triangles") {
  std::vector<Triangle> triangles;
  triangulate_polygon({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}, triangles);  // a bow tie
  CHECK(triangles.size() == 2);
  triangulate_polygon(std::vector<std::array<double, 3>>(7, {1, 2, 3}), triangles);  // one point
  CHECK(triangles.size() == 5);
  triangulate_polygon({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {1.5, 0, 0}}, triangles);  // a line
  CHECK(triangles.size() == 3);
  std::vector<std::array<double, 3>> circle;
  for (int i = 0; i < 100000; ++i)
    circle.push_back({std::cos(i * 6.2831853e-5), std::sin(i * 6.2831853e-5), 0});
  triangulate_polygon(circle, triangles);
  CHECK(triangles.size() == 99998);
}

TEST_CASE("Missing normals are angle-weighted averages") {
  // Around each corner of a cube the angles of the faces are equal, however the faces are cut: (±1,±1,±1)/√3.
  Mesh cube = read_text("cube.obj",
                        "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
                        "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 4 1 5 8\n");
  add_missing_normals(cube);
  for (std::size_t t = 0; t < cube.triangles(); ++t) {
    for (int c = 0; c < 3; ++c) {
      const Vec3 normal = to_vec(cube.normals.at(cube.normal_index[t][c]));
      CHECK(length(normal - to_vec(cube.positions[cube.position_index[t][c]]) / std::sqrt(3.0)) < 1e-6);
    }
  }
  // A normal of the file stays; two sides of a sheet keep their own; a triangle without area gets some.
  Mesh sheet = read_text("sheet.obj", square + "vn 1 0 0\nf 1//1 2//1 3//1\nf 1 2 4\nf 1 4 2\nf 1 1 1\n");
  add_missing_normals(sheet);
  CHECK(sheet.normals[sheet.normal_index[0][0]] == std::array<float, 3>{1, 0, 0});
  for (const auto& triangle : sheet.normal_index)
    for (const auto index : triangle) CHECK(length(to_vec(sheet.normals.at(index))) == Approx(1));
  CHECK(sheet.normals[sheet.normal_index[1][2]][2] == 1);
  CHECK(sheet.normals[sheet.normal_index[2][1]][2] == -1);
}

TEST_CASE("A million triangles are read in well under two seconds") {
  const int side = 708;  // 2 * 707 * 707 = 999,698 triangles
  std::string vertices, triangles, obj;
  const auto number = [](int value) { return std::to_string(value); };
  for (int i = 0; i < side * side; ++i) {
    const float x = float(i % side), y = float(i / side), height = 0.01f * float(i % 97);
    vertices += raw(x, false) + raw(y, false) + raw(height, false);
    obj += "v " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(height) + "\n";
  }
  for (int y = 0; y + 1 < side; ++y) {
    for (int x = 0; x + 1 < side; ++x) {
      const int a = y * side + x, b = a + 1, c = b + side, d = a + side;
      triangles += '\3' + raw(a, false) + raw(b, false) + raw(c, false);
      triangles += '\3' + raw(a, false) + raw(c, false) + raw(d, false);
      obj += "f " + number(a + 1) + " " + number(b + 1) + " " + number(c + 1) + "\n";
      obj += "f " + number(a + 1) + " " + number(c + 1) + " " + number(d + 1) + "\n";
    }
  }
  const std::string ply = "ply\nformat binary_little_endian 1.0\nelement vertex " + number(side * side) +
                          "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                          number(2 * (side - 1) * (side - 1)) +
                          "\nproperty list uchar int vertex_indices\nend_header\n" + vertices + triangles;
  const TemporaryFolder folder;
  std::vector<Mesh> meshes;
  for (const std::string& file : {folder.write("grid.ply", ply), folder.write("grid.obj", obj)}) {
    const std::clock_t start = std::clock();  // of the processor: others may be busy on the machine
    meshes.push_back(read_mesh(file));
    const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
    std::cout << std::filesystem::path(file).filename().string() << ": " << meshes.back().triangles()
              << " triangles in " << seconds << " s\n";
#if !defined(__SANITIZE_ADDRESS__)
    CHECK(seconds < 2);
#endif
  }
  CHECK(meshes[0].triangles() == 999698);
  CHECK(meshes[0].position_index == meshes[1].position_index);
}

TEST_CASE("Real meshes: the assets folder") {
  const std::filesystem::path folder = std::filesystem::path(CAUSTICL_SOURCE_DIR) / "../shared/assets";
  if (!std::filesystem::exists(folder)) {
    WARN("skipped: there is no folder " << folder.lexically_normal().string());
    return;
  }
  const std::vector<std::tuple<std::string, std::size_t, std::size_t>> files{
      {"bunny_4k.ply", 1839, 3674}, {"dragon_48k.ply", 22998, 47794}, {"dragon_200k.ply", 100250, 202520}};
  for (const auto& [name, positions, triangles] : files) {
    if (!std::filesystem::exists(folder / name)) {
      WARN("skipped: there is no " << name);
      continue;
    }
    CAPTURE(name);
    Mesh mesh = read_mesh((folder / name).string());
    CHECK(mesh.positions.size() == positions);
    CHECK(mesh.triangles() == triangles);
    // Nearly closed: the vector areas all but cancel.
    const auto [sum, total] = areas(mesh);
    CHECK(length(sum) < 0.05 * total);
    add_missing_normals(mesh);
    for (const auto& normal : mesh.normals) REQUIRE(length(to_vec(normal)) == Approx(1).epsilon(1e-5));
  }
}

TEST_CASE("Real meshes: the models of the package assimp-testmodels") {
  const std::filesystem::path folder = "/usr/share/assimp/models";
  if (!std::filesystem::exists(folder)) {
    WARN("skipped: the package assimp-testmodels is not installed");
    return;
  }
  const auto outcome = [&](const std::string& name) {
    const std::string file = (folder / name).string();
    std::size_t triangles = 0;
    const std::string message = user_error_of([&] { triangles = read_mesh(file).triangles(); }, file);
    return message.empty() ? std::to_string(triangles) : message;
  };
  CHECK(outcome("OBJ/box.obj") == "12");
  CHECK(outcome("OBJ/spider.obj") == "1368");
  CHECK(outcome("PLY/cube.ply") == "12");
  CHECK(outcome("PLY/cube_binary.ply") == "12");
  CHECK(outcome("PLY/cube_uv.ply") == "12");
}

}  // namespace causticl
