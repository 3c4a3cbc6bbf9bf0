// Wavefront OBJ.
#include "catch2.hpp"

#include "mesh_files.hpp"

namespace causticl {

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
  CHECK(mesh.positions[2] == std::array<double, 3>{1, 1, 0});
  CHECK(mesh.uvs[1] == std::array<double, 2>{1, 0.25});
  CHECK(mesh.uvs[2] == std::array<double, 2>{1, 0});
  CHECK(mesh.normals[0] == std::array<float, 3>{0, 0, 1});
  CHECK(mesh.normals[1] == std::array<float, 3>{0, 0.6f, 0.8f});
  CHECK(mesh.position_index == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}, {0, 1, 2}, {1, 2, 3}});
  const std::uint32_t no = no_index;
  CHECK(mesh.uv_index ==
        std::vector<Triangle>{{0, 1, 2}, {no, no, no}, {no, no, no}, {no, no, 1}, {0, 1, 2}});
  CHECK(mesh.normal_index ==
        std::vector<Triangle>{{0, 0, 1}, {0, 0, 1}, {no, no, no}, {no, no, no}, {no, no, no}});
}

TEST_CASE("OBJ: numbers too small for a double are zero, and so a file has no normals whose all are zero") {
  const Mesh mesh = read_text("a.obj", "v 1e-400 0.0 1e-60\nv 1 0 0\nv 0 1 0\nvn 0 0 0\nf 1//1 2//1 3//1\n");
  CHECK(mesh.positions[0] == std::array<double, 3>{0, 0, 1e-60});
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
  CHECK(fault("v 0 1,5 0\n") ==
        "a.obj:1: '1,5' is not a number; write a decimal point in place of the comma");
  CHECK(fault(square + "f 1 2 5\n") == "a.obj:5: vertex index 5 is out of range; 4 are defined in the file");
  CHECK(fault(square + "f 1 2 -5\n") == "a.obj:5: vertex index -5 is out of range; 4 are defined up to here");
  CHECK(fault(square + "f 0 1 2\n") == "a.obj:5: vertex index 0 is out of range; 4 are defined up to here");
  CHECK(fault(square + "f 1/1 2/1 3/1\n") ==
        "a.obj:5: texture coordinate index 1 is out of range; 0 are defined in the file");
  CHECK(fault(square + "f 1//1 2//1 3//1\n") ==
        "a.obj:5: normal index 1 is out of range; 0 are defined in the file");
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

}  // namespace causticl
