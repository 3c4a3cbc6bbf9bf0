#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <ctime>
#include <iostream>

#include "mesh.hpp"
#include "mesh_polygon.hpp"
#include "temporary_folder.hpp"
#include "vec.hpp"

namespace causticl {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

Mesh read_text(const std::string& name, const std::string& text) {
  const TemporaryFolder folder;
  return read_mesh(folder.write(name, text));
}

std::string message_for(const std::string& name, const std::string& bytes) {
  const TemporaryFolder folder;
  const std::string file = folder.write(name, bytes);
  return user_error_of([&] { read_mesh(file); }, file);
}

Vec3 to_vec(const std::array<float, 3>& p) { return {p[0], p[1], p[2]}; }

/// The sum of the triangles' vector areas, and the sum of their areas.
std::pair<Vec3, double> areas(const Mesh& mesh) {
  Vec3 sum;
  double total = 0;
  for (const auto& [a, b, c] : mesh.position_index) {
    const Vec3 p = to_vec(mesh.positions[a]);
    const Vec3 area = cross(to_vec(mesh.positions[b]) - p, to_vec(mesh.positions[c]) - p) * 0.5;
    sum = sum + area;
    total += length(area);
  }
  return {sum, total};
}

template <typename T>
std::string raw(T value, bool big_endian) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  if (big_endian) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

}  // namespace

TEST_CASE("OBJ: corners of every form, negative indices, comments, continuations, CRLF") {
  const Mesh mesh =
      read_text("a.obj",
                "\xEF\xBB\xBF# a comment \\\r\n still the comment\r\nmtllib x.mtl\r\no thing\r\n"
                "v 0 0 0 # origin\r\nv 1 0 0 1.0\r\nv +1 1e0 0 0.5 0.5 0.5\r\n  v\t0 1 -.0\r\n"
                "vt 0 0\r\nvt 1 0.25 9\r\nvt 1\r\nvn 0 0 2\r\nvn 0 3 4\r\n\r\n"
                "g a b\r\ns off\r\nusemtl m\r\nf 1/1/1 2/2/1 \\\r\n  3/3/2\r\n"
                "f -4//-2 -2//1 -1//2\r\nf 1 2 3\r\nf 1/ 2/ 3/2 # end\r\nl 1 2\r\np 1\r\nf 2/1 3/2 4/-1");
  REQUIRE(mesh.triangles() == 5);
  REQUIRE(mesh.positions.size() == 4);
  CHECK(mesh.positions[2] == std::array<float, 3>{1, 1, 0});
  CHECK(mesh.uvs[1] == std::array<float, 2>{1, 0.25});
  CHECK(mesh.uvs[2] == std::array<float, 2>{1, 0});
  CHECK(mesh.normals[0] == std::array<float, 3>{0, 0, 1});
  CHECK(mesh.normals[1] == std::array<float, 3>{0, 0.6f, 0.8f});
  CHECK(mesh.position_index == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}, {0, 1, 2}, {1, 2, 3}});
  const std::uint32_t no = no_index;
  CHECK(mesh.uv_index ==
        std::vector<Triangle>{{0, 1, 2}, {no, no, no}, {no, no, no}, {no, no, 1}, {0, 1, 2}});
  CHECK(mesh.normal_index ==
        std::vector<Triangle>{{0, 0, 1}, {0, 0, 1}, {no, no, no}, {no, no, no}, {no, no, no}});
}

TEST_CASE("OBJ: tiny numbers are zero, normals without direction are dropped") {
  const Mesh mesh = read_text("a.obj", "v 1e-400 0.0 1e-60\nv 1 0 0\nv 0 1 0\nvn 0 0 0\nf 1//1 2//1 3//1\n");
  CHECK(mesh.positions[0] == std::array<float, 3>{0, 0, 0});
  CHECK(mesh.normal_index[0] == Triangle{no_index, no_index, no_index});
}

TEST_CASE("OBJ: every fault has its line") {
  const auto fault = [](const std::string& text) { return message_for("a.obj", text); };
  CHECK(fault("") == "a.obj: is empty; expected a mesh");
  CHECK(fault("# nothing\n") == "a.obj: has no faces (0 vertices); expected a mesh");
  CHECK(fault(square) == "a.obj: has no faces (4 vertices); expected a mesh");
  CHECK(fault("v 0 0\n") == "a.obj:1: 'v' has 2 numbers; expected 3");
  CHECK(fault("\n\nv 0 zero 0\n") == "a.obj:3: 'zero' is not a number");
  CHECK(fault("v 0 nan 0\n") == "a.obj:1: 'nan' is not a finite number");
  CHECK(fault("v 0 -inf 0\n") == "a.obj:1: '-inf' is not a finite number");
  CHECK(fault("v 0 1e39 0\n") == "a.obj:1: '1e39' is not a finite number");
  CHECK(fault("v 0 1e999 0\n") == "a.obj:1: '1e999' is not a finite number");
  CHECK(fault("vt nan 0\n") == "a.obj:1: 'nan' is not a finite number");
  CHECK(fault(square + "f 1 2 5\n") == "a.obj:5: vertex index 5 is out of range; 4 are defined up to here");
  CHECK(fault(square + "f 1 2 -5\n") == "a.obj:5: vertex index -5 is out of range; 4 are defined up to here");
  CHECK(fault(square + "f 0 1 2\n") == "a.obj:5: vertex index 0 is out of range; 4 are defined up to here");
  CHECK(fault(square + "f 1/1 2/1 3/1\n") ==
        "a.obj:5: texture coordinate index 1 is out of range; 0 are defined up to here");
  CHECK(fault(square + "f 1//1 2//1 3//1\n") ==
        "a.obj:5: normal index 1 is out of range; 0 are defined up to here");
  CHECK(fault(square + "f 1 2 99999999999999999999\n") ==
        "a.obj:5: '99999999999999999999' is not the index of a vertex; expected an integer");
  CHECK(fault(square + "f 1 2 3.5\n") == "a.obj:5: '3.5' is not the index of a vertex; expected an integer");
  CHECK(fault(square + "f 1/1/1/1 2 3\n") ==
        "a.obj:5: '1/1/1/1' is not a corner; expected v, v/vt, v//vn or v/vt/vn");
  CHECK(fault(square + "f 1 2\n") == "a.obj:5: the face has 2 corners; expected at least 3");
  CHECK(fault(square + "f\n") == "a.obj:5: the face has 0 corners; expected at least 3");
  CHECK(fault("{\"objects\":[]}") ==
        "a.obj:1: '{\"objects\":[]}' is not an OBJ statement; is this a text file in OBJ format?");
  CHECK(fault(std::string("\x89PNG\r\n\x1a\n\0\0", 10)) ==
        "a.obj:1: '?PNG' is not an OBJ statement; is this a text file in OBJ format?");
}

TEST_CASE("A mesh must be a file of a known kind") {
  const TemporaryFolder folder;
  const auto fault = [&](const std::string& name) {
    return user_error_of([&] { read_mesh(folder.path(name)); }, folder.path(name));
  };
  CHECK(fault("none.obj") == "none.obj: no such file");
  std::filesystem::create_directory(folder.path("folder.ply"));
  CHECK(fault("folder.ply") == "folder.ply: is a folder; expected a mesh file");
  folder.write("a.stl", "solid");
  CHECK(fault("a.stl") == "a.stl: is no mesh by its name; expected the extension .obj or .ply");
  CHECK(user_error_of([] { read_mesh("/dev/null"); }) ==
        "/dev/null: is not a regular file; expected a mesh file");
  folder.write("UPPER.OBJ", square + "f 1 2 3 4");
  CHECK(fault("UPPER.OBJ") == "");
}

TEST_CASE("PLY: ASCII and binary of either byte order hold the same mesh") {
  for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    CAPTURE(format);
    const bool ascii = format == "ascii", big = format == "binary_big_endian";
    std::string text = "ply\r\nformat " + format +
                       " 1.0\r\ncomment made by a test\r\nobj_info none\r\nelement camera 1\r\n"
                       "property list uchar short what\r\nproperty double ever\r\nelement vertex 4\r\n"
                       "property double x\r\nproperty uchar red\r\nproperty float32 y\r\n"
                       "property list ushort int16 bones\r\nproperty short z\r\nproperty float nx\r\n"
                       "property float ny\r\nproperty float nz\r\nproperty float s\r\nproperty float t\r\n"
                       "element face 2\r\nproperty uchar flags\r\nproperty list uint8 uint vertex_indices\r\n"
                       "property list char float texcoord\r\nend_header\r\n";
    if (ascii) {
      text +=
          "2 7 8 1.5\r\n"
          "0 255 0 0 -3 0 0 1 0 0\r\n1 255 0 1 9 -3 0 0 1 1 0\r\n\r\n1 255 2 0 -3 0 0 1 1 1\r\n"
          "0 255 2 0 -3 0 0 1 0 1\r\n0 3 0 1 2 0\r\n0 3 0 2 3 2 0.5 0.5";
    } else {
      text +=
          raw<std::uint8_t>(2, big) + raw<std::int16_t>(7, big) + raw<std::int16_t>(8, big) + raw(1.5, big);
      for (int i = 0; i < 4; ++i) {
        const float u = i == 1 || i == 2, v = i >= 2;
        text += raw<double>(u, big) + raw<std::uint8_t>(255, big) + raw(2 * v, big);
        text += i == 1 ? raw<std::uint16_t>(1, big) + raw<std::int16_t>(9, big) : raw<std::uint16_t>(0, big);
        text += raw<std::int16_t>(-3, big) + raw(0.0f, big) + raw(0.0f, big) + raw(1.0f, big);
        text += raw(u, big) + raw(v, big);
      }
      for (std::uint32_t i = 1; i < 3; ++i) {
        text += raw<std::uint8_t>(0, big) + raw<std::uint8_t>(3, big) + raw<std::uint32_t>(0, big) +
                raw(i, big) + raw(i + 1, big) + raw<std::int8_t>(0, big);
      }
    }
    const Mesh mesh = read_text("a.ply", text);
    CHECK(mesh.positions ==
          std::vector<std::array<float, 3>>{{0, 0, -3}, {1, 0, -3}, {1, 2, -3}, {0, 2, -3}});
    CHECK(mesh.normals == std::vector<std::array<float, 3>>(4, {0, 0, 1}));
    CHECK(mesh.uvs == std::vector<std::array<float, 2>>{{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    CHECK(mesh.position_index == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
    CHECK(mesh.normal_index == mesh.position_index);
    CHECK(mesh.uv_index == mesh.position_index);
  }
}

TEST_CASE("PLY: every fault has its line or element") {
  const auto fault = [](const std::string& text) { return message_for("a.ply", text); };
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  const std::string faces = "property list uchar int vertex_indices\nend_header\n";
  const auto header = [&](const std::string& format, const std::string& vertices, const std::string& count) {
    return "ply\nformat " + format + " 1.0\nelement vertex " + vertices + "\n" + xyz + "element face " +
           count + "\n" + faces;
  };
  const std::string ascii = header("ascii", "3", "1"), corners = "0 0 0\n1 0 0\n0 1 0\n";
  CHECK(fault(ascii + corners + "3 0 1 2\n") == "");
  CHECK(fault(ascii + corners + "3 0 1 2") == "");
  CHECK(fault("") == "a.ply: is empty; expected a mesh");
  CHECK(fault("solid\n") == "a.ply:1: expected 'ply' on the first line; is this a PLY file?");
  CHECK(fault("ply\nformat ascii 1.0\n") == "a.ply:2: the file ends within its header; expected end_header");
  CHECK(fault("ply\nformat text 1.0\n") ==
        "a.ply:2: unknown format 'text'; expected ascii, binary_little_endian or binary_big_endian");
  CHECK(fault("ply\nend_header\n") == "a.ply:2: the header names no format");
  CHECK(fault("ply\nformat ascii 1.0\nend_header\n") == "a.ply:3: the header has no element vertex");
  CHECK(fault("ply\nproperty float x\n") == "a.ply:2: a property stands before the first element");
  CHECK(fault("ply\nelement vertex many\n") ==
        "a.ply:2: 'many' is not the count of element 'vertex'; expected an integer from 0");
  CHECK(fault("ply\nelement vertex -1\n") ==
        "a.ply:2: '-1' is not the count of element 'vertex'; expected an integer from 0");
  CHECK(fault("ply\nelement vertex 1\nelement vertex 1\n") == "a.ply:3: element 'vertex' stands twice");
  CHECK(fault("ply\nelement vertex 1\nproperty quad x\n") ==
        "a.ply:3: unknown type 'quad' of a property; expected char to double");
  CHECK(fault("ply\nelement vertex 1\nproperty float\n") == "a.ply:3: the property has no name");
  CHECK(fault("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n") ==
        "a.ply:5: element vertex lacks x, y or z");
  CHECK(fault("ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\n"
              "element vertex 3\n" +
              xyz + "end_header\n3 0 1 2\n" + corners) ==
        "a.ply:9: element face stands before element vertex; expected vertices first");
  CHECK(fault("ply\nformat ascii 1.0\nelement vertex 3\n" + xyz +
              "element face 1\nproperty list uchar int corners\nend_header\n" + corners + "3 0 1 2\n") ==
        "a.ply:9: element face has no list vertex_indices");
  CHECK(fault("ply\nformat ascii 1.0\nelement vertex 3\n" + xyz + "end_header\n" + corners) ==
        "a.ply: has no faces (3 vertices); expected a mesh");
  CHECK(fault("ply\nelement tristrips 1\n") ==
        "a.ply:2: triangle strips (element tristrips) are not supported; save the mesh with faces");

  CHECK(fault(ascii + "0 0 0\n1 0\n0 1 0\n3 0 1 2\n") ==
        "a.ply:11: vertex 1: has fewer values than the header declares");
  CHECK(fault(ascii + "0 0 0\n1 0 0 7\n0 1 0\n3 0 1 2\n") ==
        "a.ply:11: vertex 1: '7' is more than the header declares for it");
  CHECK(fault(ascii + "0 0 0\n1 0 oh\n0 1 0\n3 0 1 2\n") == "a.ply:11: vertex 1: 'oh' is not a number");
  CHECK(fault(ascii + "0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n") ==
        "a.ply:11: vertex 1: a coordinate is not a finite number");
  CHECK(fault(ascii + corners + "3 0 1 3\n") ==
        "a.ply:13: face 0: vertex index 3 is out of range; there are 3 vertices");
  CHECK(fault(ascii + corners + "3 0 1 -1\n") ==
        "a.ply:13: face 0: vertex index -1 is out of range; there are 3 vertices");
  CHECK(fault(ascii + corners + "2 0 1\n") == "a.ply:13: face 0: has 2 corners; expected at least 3");
  CHECK(fault(ascii + corners + "-3 0 1 2\n") == "a.ply:13: face 0: list 'vertex_indices' has -3 entries");
  CHECK(
      fault(ascii + corners + "4000000000 0 1 2\n") ==
      "a.ply:13: face 0: list 'vertex_indices' has 4000000000 entries, more than the rest of the file holds");
  CHECK(fault(ascii + "0 0 0\n1 0 0\n") ==
        "a.ply: the header declares 3 of element 'vertex', but only 12 bytes "
        "follow; is the file truncated?");
  CHECK(fault(ascii + "0.00 0.00 0.00\n1 0 0\n") ==
        "a.ply:11: vertex 2: the file ends before it; is it truncated?");

  // A header may claim anything: nothing is allocated for it.
  for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    for (const std::string many : {"1000000000000", "9223372036854775807"}) {
      CHECK(fault(header(format, many, "1") + std::string(1000, '0')) ==
            "a.ply: the header declares " + many +
                " of element 'vertex', but only 1000 bytes follow; is the file truncated?");
    }
  }

  const std::string binary = header("binary_little_endian", "3", "1");
  std::string vertices, triangle = raw<std::uint8_t>(3, false);
  for (const float value : {0, 0, 0, 1, 0, 0, 0, 1, 0}) vertices += raw(value, false);
  for (const int value : {0, 1, 2}) triangle += raw(value, false);
  CHECK(fault(binary + vertices + triangle) == "");
  CHECK(fault(binary + vertices.substr(0, 30)) ==
        "a.ply: the header declares 3 of element 'vertex', but only 30 bytes follow; is the file truncated?");
  CHECK(fault(binary + vertices + triangle.substr(0, 9)) ==
        "a.ply: face 0: list 'vertex_indices' has 3 entries, more than the rest of the file holds");
  CHECK(fault(binary + vertices + raw<std::uint8_t>(3, false) + raw(0, false) + raw(1, false) +
              raw(3, false)) == "a.ply: face 0: vertex index 3 is out of range; there are 3 vertices");
  CHECK(fault(binary + vertices + raw<std::uint8_t>(0, false) + triangle) ==
        "a.ply: face 0: has 0 corners; expected at least 3");
  CHECK(fault(binary + raw(std::nanf(""), false) + vertices.substr(4) + triangle) ==
        "a.ply: vertex 0: a coordinate is not a finite number");
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
      std::vector<std::array<float, 3>> corners;
      for (std::size_t i = 0; i < count; ++i) {
        const auto& [x, y] = outlines[o].corners[(first + i) % count];
        const Vec3 p = tilt.point({x, y, 0}) + Vec3{10, 20, 30};
        corners.push_back({float(p.x), float(p.y), float(p.z)});
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
  triangulate_polygon(std::vector<std::array<float, 3>>(7, {1, 2, 3}), triangles);  // one point
  CHECK(triangles.size() == 5);
  triangulate_polygon({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {1.5, 0, 0}}, triangles);  // a line
  CHECK(triangles.size() == 3);
  std::vector<std::array<float, 3>> circle;
  for (int i = 0; i < 100000; ++i)
    circle.push_back({float(std::cos(i * 6.2831853e-5)), float(std::sin(i * 6.2831853e-5)), 0});
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
