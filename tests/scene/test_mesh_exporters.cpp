// OBJ and PLY as exporters and other tools write them.
#include "catch2.hpp"

#include "mesh_files.hpp"

namespace causticl {
namespace {

const std::string two_faces = "f 1 2 3\nf 1 3 4\n";
const std::vector<Triangle> two_triangles{{0, 1, 2}, {0, 2, 3}};
const std::vector<Triangle> cut_square{{0, 1, 2}, {2, 3, 0}};  // of one face

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (auto at = text.find(from); at != text.npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

std::string notes_of(const Mesh& mesh) {
  std::string result;
  for (const std::string& note : mesh.notes) result += note + "\n";
  return result;
}

/// A PLY file of a square, its elements in this order.
std::string ply_square(const std::string& vertex_header, const std::string& vertices,
                       const std::string& face_header, const std::string& faces, bool faces_first = false) {
  const std::string head = "ply\nformat ascii 1.0\ncomment made by a test\n";
  return faces_first ? head + face_header + vertex_header + "end_header\n" + faces + vertices
                     : head + vertex_header + face_header + "end_header\n" + vertices + faces;
}

const std::string xyz = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string corners = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
const std::string face_list = "element face 1\nproperty list uchar int vertex_indices\n";
const std::string plain_ply = ply_square(xyz, corners, face_list, "4 0 1 2 3\n");

}  // namespace

TEST_CASE("OBJ: text of every kind is the same square") {
  const std::string plain = square + two_faces;
  for (const std::string& text : {
           plain,
           "\xEF\xBB\xBF" + plain,
           replaced(plain, "\n", "\r\n"),
           replaced(plain, "\n", "\r"),
           replaced(plain, "\n", "\r\r\n"),
           plain + "\x1a",
           plain + "\x1a\r\n\x1a",
           plain.substr(0, plain.size() - 1) + "\x1a",
           plain.substr(0, plain.size() - 1),
           two_faces + square,
           "f 1 2 3\n" + square + "f 1 3 4\n",
           replaced(plain, "f 1 2 3", "f 1 \\\n2 \\\n3"),
           replaced(plain, "f 1 2 3", "f 1 2 \\ \t\n3"),
           replaced(plain, "f 1 2 3", "f 1 2 \\\r\n3"),
           replaced(plain, "f 1 2 3", "# in C:\\tools\\\nf 1 2 3"),
           replaced(plain, "f 1 2 3", "# in C:\\tools\\ \nf 1 2 3"),
           replaced(plain, "v 1 0 0", "#\\\nv 1 0 0"),
           replaced(plain, "f 1 2 3", "f 1 2 3 # in C:\\tools\\"),
           replaced(plain, "f 1 2 3", "o C:\\tools\\\nf 1 2 3"),
           replaced(plain, "f 1 2 3", "g C:\\tools\\\nusemtl a\\\nf 1 2 3"),
           replaced(replaced(plain, "v ", "V  "), "f ", " \tF\t"),
           replaced(plain, "v 1 1 0", "v 1.0E+000 +1.00e+0 0.E-003 1 # weight"),
           replaced(plain, "v 1 1 0", "v 1 1 0 0.5 0.25 1.0"),
           replaced(plain, "f 1 3 4", "l 1 2\np 3\ns 1\ng\nf -4 -2 -1"),
       }) {
    CAPTURE(text);
    Mesh mesh = read_text("a.obj", text);
    CHECK(mesh.positions == std::vector<std::array<double, 3>>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    std::sort(mesh.position_index.begin(), mesh.position_index.end());
    CHECK(mesh.position_index == two_triangles);
    CHECK(notes_of(mesh) == "");
  }
}

TEST_CASE("OBJ: faces that stand before their vertices take normals and (u, v) too, and name a missing one") {
  const Mesh mesh = read_text("a.obj", "f 1/1/1 2/1/1 3/1/1 4/1/1\n" + square + "vt 0.5 0.25\nvn 0 0 1\n");
  CHECK(mesh.position_index == cut_square);
  CHECK(mesh.normal_index == std::vector<Triangle>(2, {0, 0, 0}));
  CHECK(mesh.uv_index == std::vector<Triangle>(2, {0, 0, 0}));
  CHECK(message_for("a.obj", "\nf 1 2 9\n" + square) ==
        "a.obj:2: vertex index 9 is out of range; 4 are defined in the file");
  CHECK(message_for("a.obj", "f 1//1 2//1 3//1\n" + square) ==
        "a.obj:1: normal index 1 is out of range; 0 are defined in the file");
  CHECK(message_for("a.obj", "f -1 -2 -3\n" + square) ==
        "a.obj:1: vertex index -1 is out of range; 0 are defined up to here");
}

TEST_CASE("normals that are no numbers, or have no direction beside others, come from the faces around") {
  const std::string roof =
      "v 0 0 0\nv 1 0 0\nv 1 1 1\nv 0 1 1\nv 1 2 0\nv 0 2 0\n"
      "f 1//1 2//1 3//2\nf 1//1 3//2 4//2\nf 4//2 3//2 5//3\nf 4//2 5//3 6//3\n";
  for (const std::string lost : {"nan nan nan", "-1.#IND -1.#IND -1.#IND", "1.#QNAN 0 1.#INF00", "0 0 0",
                                 "-nan(ind) -nan(ind) -nan(ind)", "NaN NaN NaN", "inf 0 0"}) {
    CAPTURE(lost);
    const Mesh mesh = read_text("a.obj", roof + "vn 0 -1 1\nvn " + lost + "\nvn 0 1 1\n");
    CHECK(notes_of(mesh) ==
          "1 of its normals are 0 or no numbers: they are computed from the faces around\n");
    CHECK(mesh.has_normals);
    for (std::size_t t = 0; t < mesh.triangles(); ++t)
      for (int c = 0; c < 3; ++c) {
        const Vec3 normal = to_vec(mesh.normals.at(mesh.normal_index[t][c]));
        const double y = mesh.positions[mesh.position_index[t][c]][1];
        const Vec3 expected = y == 1 ? Vec3{0, 0, 1} : normalize(Vec3{0, y - 1, 1});
        CHECK(length(normal - expected) < 1e-2);
      }
  }
  // Where all are lost, all are computed; where all are 0, there are none.
  const std::string flat = "f 1//1 2//1 3//1 4//1\n" + square;
  CHECK(read_text("a.obj", flat + "vn -1.#IND -1.#IND -1.#IND\n").normals.back() ==
        std::array<float, 3>{0, 0, 1});
  const Mesh none = read_text("a.obj", flat + "vn 0 0 0\n");
  CHECK(none.normal_index[0] == Triangle{no_index, no_index, no_index});
  CHECK(notes_of(none) == "");

  for (const std::string lost : {"nan nan nan", "0 0 0", "-1.#IND -1.#IND -1.#IND"}) {
    const Mesh ply =
        read_text("a.ply", ply_square(xyz + "property float nx\nproperty float ny\nproperty float nz\n",
                                      "0 0 0 " + lost + "\n1 0 0 0 0 2\n1 1 0 0 0 1\n0 1 0 0 0 1\n",
                                      face_list, "4 0 1 2 3\n"));
    for (const auto& triangle : ply.normal_index)
      for (const auto index : triangle) CHECK(ply.normals.at(index) == std::array<float, 3>{0, 0, 1});
    CHECK(ply.notes.size() == 1);
  }
}

TEST_CASE("OBJ: what is passed over has one note") {
  const auto notes = [](const std::string& text) { return notes_of(read_text("a.obj", text)); };
  CHECK(notes(square + "usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\nusemtl a\nf 1 2 4\n") ==
        "its 2 materials (usemtl) are not read: the object's own material is on all of its faces\n");
  CHECK(notes("mtllib C:\\a b\\\n" + square + "usemtl a\nf 1 2 3\nusemtl a\nf 1 3 4\n") ==
        "its material library (mtllib) is not read: the object's own material is used\n");
  CHECK(notes(square + "usemtl a\nf 1 2 3\n") == "");
  const Mesh mesh = read_text("a.obj", square + "vt nan 0\nvt 0 1\nvt -1.#IND 2\nf 1/1 2/2 3/3\n");
  CHECK(notes_of(mesh) == "2 of its texture coordinates are no numbers and taken as (0, 0)\n");
  CHECK(mesh.uvs == std::vector<std::array<double, 2>>{{0, 0}, {0, 1}, {0, 0}});
}

TEST_CASE("text in UTF-16 and UTF-32 is named, in both formats") {
  for (const std::string name : {"a.obj", "a.ply"}) {
    const std::string text = name == "a.obj" ? square + two_faces : plain_ply;
    for (const bool big : {false, true})
      for (const bool mark : {false, true})
        for (const std::size_t zeros : {1, 3}) {
          if (zeros == 3 && !mark) continue;
          CAPTURE(name, big, mark, zeros);
          std::string wide;
          const auto add = [&](unsigned char low, unsigned char high) {
            std::string unit{static_cast<char>(low), static_cast<char>(high)};
            unit.resize(zeros + 1, '\0');
            if (big) std::reverse(unit.begin(), unit.end());
            wide += unit;
          };
          if (mark) add(0xff, 0xfe);
          for (const char c : text) add(static_cast<unsigned char>(c), 0);
          CHECK(message_for(name, wide) ==
                name + ": is text in UTF-16 or UTF-32; expected UTF-8 or ASCII: save it so");
        }
  }
}

TEST_CASE("PLY: text of every kind is the same square") {
  for (const std::string& text : {
           plain_ply,
           "\xEF\xBB\xBF" + plain_ply,
           replaced(plain_ply, "\n", "\r\n"),
           replaced(plain_ply, "\n", "\r"),
           plain_ply + "\x1a",
           plain_ply.substr(0, plain_ply.size() - 1) + "\x1a",
           replaced(plain_ply, "vertex_indices", "vertex_index"),
           replaced(plain_ply, "vertex_indices", "vertex_inds"),
           replaced(plain_ply, "vertex_indices", "corners"),
           replaced(plain_ply, "list uchar int", "list int32 uint"),
           replaced(plain_ply, "float x\nproperty float y", "double X\nproperty float64 Y"),
           replaced(plain_ply, "element face", "obj_info x\ncomment\n\nelement face"),
           ply_square(xyz, corners, face_list, "4 0 1 2 3\n", true),
           ply_square(xyz, corners,
                      "element face 1\nproperty list uchar int other\nproperty uchar red\n"
                      "property list uchar int my_vertices\n",
                      "1 7 255 4 0 1 2 3\n"),
           ply_square(xyz, corners,
                      "element face 1\nproperty list uchar int v\nproperty list uchar float weights\n"
                      "property list uchar int texnumbers\n",
                      "4 0 1 2 3 2 0.5 0.5 1 3\n"),
       }) {
    CAPTURE(text);
    const Mesh mesh = read_text("a.ply", text);
    CHECK(mesh.positions == std::vector<std::array<double, 3>>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    CHECK(mesh.position_index == cut_square);
    CHECK(mesh.uv_index == std::vector<Triangle>(2, {no_index, no_index, no_index}));
    CHECK(notes_of(mesh) == "");
  }
  CHECK(message_for("a.ply", ply_square(xyz, corners, face_list, "4 0 1 2 4\n", true)) ==
        "a.ply:11: face 0: vertex index 4 is out of range; there are 4 vertices");
}

TEST_CASE("PLY: binary values follow a header of any line end") {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    // The first byte of the first coordinate is that of a line feed.
    const float tricky = [] {
      float value = 0;
      const unsigned char bytes[] = {'\n', 0, 0, 0x3f};
      std::memcpy(&value, bytes, 4);
      return value;
    }();
    std::string text = replaced(
        replaced(plain_ply.substr(0, plain_ply.find("end_header") + 11), "ascii", "binary_little_endian"),
        "\n", end);
    for (const float value : {tricky, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, 1.f, 0.f})
      text += raw(value, false);
    text += '\4';
    for (const int index : {0, 1, 2, 3}) text += raw(index, false);
    CAPTURE(end);
    const Mesh mesh = read_text("a.ply", text);
    CHECK(mesh.positions[0] == std::array<double, 3>{tricky, 0, 0});
    CHECK(mesh.position_index.size() == 2);
  }
}

TEST_CASE("PLY: (u, v) of the corners of faces") {
  const std::string header = "element face 2\nproperty list uchar int vertex_indices\n";
  const std::string list = "property list uchar float texcoord\n";
  const std::vector<std::array<double, 2>> uvs{{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 0.5}};
  const auto uv_of_corners = [](const Mesh& mesh) {
    std::vector<std::array<double, 2>> result;
    for (const auto& triangle : mesh.uv_index)
      for (const auto index : triangle) result.push_back(mesh.uvs.at(index));
    return result;
  };
  for (const bool faces_first : {false, true}) {
    const Mesh mesh =
        read_text("a.ply", ply_square(xyz, corners, header + list,
                                      "3 0 1 2 6 0 0 1 0 1 1\n3 0 2 3 6 0 0 1 1 0 0.5\n", faces_first));
    CHECK(mesh.position_index == two_triangles);
    CHECK(uv_of_corners(mesh) == uvs);
    CHECK(notes_of(mesh) == "");
  }
  // Before the indices, with numbers of textures, and where the vertices have some too: the faces' own count.
  const Mesh mesh =
      read_text("a.ply", ply_square(xyz + "property float s\nproperty float t\n",
                                    "0 0 0 9 9\n1 0 0 9 9\n1 1 0 9 9\n0 1 0 0 0.5\n",
                                    "element face 2\n" + list +
                                        "property int texnumber\nproperty list uchar int vertex_indices\n",
                                    "6 0 0 1 0 1 1 0 3 0 1 2\n0 1 3 0 2 3\n"));
  CHECK(uv_of_corners(mesh) ==
        std::vector<std::array<double, 2>>{{0, 0}, {1, 0}, {1, 1}, {9, 9}, {9, 9}, {0, 0.5}});
  CHECK(notes_of(mesh) ==
        "its faces name several textures (texnumber): the object's one is on all of them\n");
  // A quadrilateral, cut as its corners are; and a list of another length.
  const std::string quad = "element face 1\nproperty list uchar int vertex_indices\n";
  const Mesh cut =
      read_text("a.ply", ply_square(xyz, corners, quad + list, "4 0 1 2 3 8 0 0 1 0 1 1 0 0.5\n"));
  CHECK(uv_of_corners(cut) ==
        std::vector<std::array<double, 2>>{{0, 0}, {1, 0}, {1, 1}, {1, 1}, {0, 0.5}, {0, 0}});
  const Mesh odd = read_text("a.ply", ply_square(xyz, corners, quad + list, "4 0 1 2 3 3 0 0 1\n"));
  CHECK(odd.uv_index[0] == Triangle{no_index, no_index, no_index});
  CHECK(notes_of(odd) == "1 of its faces have texture coordinates that are not two a corner: passed over\n");
}

}  // namespace causticl
