#include <cctype>
#include <cmath>
#include <cstring>

#include "mesh_formats.hpp"
#include "mesh_polygon.hpp"

namespace causticl {
namespace {

class ObjReader {
 public:
  ObjReader(MeshInput& input, Mesh& mesh) : input_(input), mesh_(mesh) {}

  void read() {
    for (std::string_view text; next_line(text);) {
      const std::string_view keyword = next_word(text);
      if (keyword.empty() || keyword[0] == '#') continue;
      if (keyword == "v") {
        read_floats(text, "v", 3, mesh_.positions.emplace_back());
      } else if (keyword == "vt") {
        read_floats(text, "vt", 1, mesh_.uvs.emplace_back());
      } else if (keyword == "vn") {
        read_floats(text, "vn", 3, mesh_.normals.emplace_back());
      } else if (keyword == "f" || keyword == "fo") {  // fo: the same in old files
        read_face(text);
      } else if (!std::isalpha(static_cast<unsigned char>(keyword[0]))) {
        input_.fail(quoted(keyword) + " is not an OBJ statement; is this a text file in OBJ format?");
      }
    }
  }

 private:
  MeshInput& input_;
  Mesh& mesh_;
  std::string joined_;  // a line with its continuations
  bool at_start_ = true;
  std::vector<std::array<std::uint32_t, 3>> face_;  // position, uv and normal index of each corner
  std::vector<std::array<float, 3>> polygon_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;

  /// The next line, joined with those that follow where it ends in a backslash.
  bool next_line(std::string_view& text) {
    if (!input_.line(text)) return false;
    if (at_start_ && text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);  // byte order mark of UTF-8
    at_start_ = false;
    if (text.empty() || text.back() != '\\') return true;
    joined_.clear();
    while (!text.empty() && text.back() == '\\') {
      joined_.append(text.substr(0, text.size() - 1)).push_back(' ');
      if (joined_.size() > (64u << 20)) input_.fail("the continued line is longer than 64 MiB");
      if (!input_.line(text)) text = {};
    }
    text = joined_.append(text);
    return true;
  }

  /// Reads up to N numbers, of which the first `needed` must be there (the others are then 0). More are
  /// passed over: a weight, or a colour of the vertex.
  template <std::size_t N>
  void read_floats(std::string_view text, const char* keyword, std::size_t needed,
                   std::array<float, N>& values) {
    values = {};
    for (std::size_t i = 0; i < N; ++i) {
      const std::string_view word = next_word(text);
      if (word.empty() || word[0] == '#') {
        if (i < needed)
          input_.fail("'" + std::string(keyword) + "' has " + std::to_string(i) + " numbers; expected " +
                      std::to_string(needed));
        return;
      }
      double value = 0;
      if (!parse_number(word, value)) input_.fail(quoted(word) + " is not a number");
      values[i] = static_cast<float>(value);
      if (!std::isfinite(values[i])) input_.fail(quoted(word) + " is not a finite number");
    }
  }

  /// Brings an index of the file (from 1, or negative from the end) to one from 0.
  std::uint32_t resolve(std::string_view word, std::size_t count, const char* what) {
    std::int64_t index = 0;
    if (!parse_integer(word, index))
      input_.fail(quoted(word) + " is not the index of a " + what + "; expected an integer");
    const auto signed_count = static_cast<std::int64_t>(count);
    const std::int64_t result = index < 0 ? signed_count + index : index - 1;
    if (index == 0 || result < 0 || result >= signed_count)
      input_.fail(std::string(what) + " index " + std::to_string(index) + " is out of range; " +
                  std::to_string(count) + " are defined up to here");
    return static_cast<std::uint32_t>(result);
  }

  /// A corner: v, v/vt, v//vn or v/vt/vn.
  std::array<std::uint32_t, 3> read_corner(std::string_view word) {
    std::array<std::string_view, 3> parts;
    std::string_view rest = word;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto slash = rest.find('/');
      parts[i] = rest.substr(0, slash);
      rest = slash == rest.npos ? std::string_view{} : rest.substr(slash + 1);
    }
    if (!rest.empty()) input_.fail(quoted(word) + " is not a corner; expected v, v/vt, v//vn or v/vt/vn");
    return {resolve(parts[0], mesh_.positions.size(), "vertex"),
            parts[1].empty() ? no_index : resolve(parts[1], mesh_.uvs.size(), "texture coordinate"),
            parts[2].empty() ? no_index : resolve(parts[2], mesh_.normals.size(), "normal")};
  }

  void read_face(std::string_view text) {
    face_.clear();
    for (auto word = next_word(text); !word.empty() && word[0] != '#'; word = next_word(text))
      face_.push_back(read_corner(word));
    if (face_.size() < 3)
      input_.fail("the face has " + std::to_string(face_.size()) + " corners; expected at least 3");
    polygon_.clear();
    for (const auto& corner : face_) polygon_.push_back(mesh_.positions[corner[0]]);
    triangulate_polygon(polygon_, triangles_);
    for (const auto& [a, b, c] : triangles_) {
      mesh_.position_index.push_back({face_[a][0], face_[b][0], face_[c][0]});
      mesh_.uv_index.push_back({face_[a][1], face_[b][1], face_[c][1]});
      mesh_.normal_index.push_back({face_[a][2], face_[b][2], face_[c][2]});
    }
  }
};

}  // namespace

void read_obj(MeshInput& input, Mesh& mesh) { ObjReader(input, mesh).read(); }

}  // namespace causticl
