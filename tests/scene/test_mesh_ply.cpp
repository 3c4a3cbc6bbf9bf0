// PLY, ASCII and binary.
#include "catch2.hpp"

#include "mesh_files.hpp"

namespace causticl {

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
          std::vector<std::array<double, 3>>{{0, 0, -3}, {1, 0, -3}, {1, 2, -3}, {0, 2, -3}});
    CHECK(mesh.normals == std::vector<std::array<float, 3>>(4, {0, 0, 1}));
    CHECK(mesh.uvs == std::vector<std::array<double, 2>>{{0, 0}, {1, 0}, {1, 1}, {0, 1}});
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
              xyz + "end_header\n3 0 1 2\n" + corners) == "");
  for (const std::string lists :
       {"property list uchar float corners\n", "property list uchar int a\nproperty list uchar int b\n"})
    CHECK(fault("ply\nformat ascii 1.0\nelement vertex 3\n" + xyz + "element face 1\n" + lists +
                "end_header\n" + corners + "3 0 1 2 0\n")
              .find("element face has no list of vertices; expected a list vertex_indices") !=
          std::string::npos);
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

}  // namespace causticl
