#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>

#include "mesh/mesh_formats.hpp"
#include "mesh/mesh_polygon.hpp"

namespace causticl {
namespace {

std::string_view without_comment(std::string_view text) {
  // Only at the start of a word: Windows programs write -1.#IND for what is no number.
  for (auto at = text.find('#'); at != text.npos; at = text.find('#', at + 1))
    if (at == 0 || text[at - 1] == ' ' || text[at - 1] == '\t') return text.substr(0, at);
  return text;
}

/// Whether the statement takes names, which may end in a backslash (a folder of Windows): that continues
/// none.
bool takes_names(std::string_view text) {
  const std::string_view keyword = next_word(text);
  return keyword == "o" || keyword == "g" || keyword == "usemtl" || keyword == "mtllib" ||
         keyword == "usemap" || keyword == "maplib";
}

/// Takes the backslash that continues a line off its end, and blanks behind it.
bool take_continuation(std::string_view& text) {
  std::string_view line = text;
  while (!line.empty() && std::isspace(static_cast<unsigned char>(line.back()))) line.remove_suffix(1);
  if (line.empty() || line.back() != '\\' || takes_names(line)) return false;
  line.remove_suffix(1);
  text = line;
  return true;
}

class ObjReader {
 public:
  ObjReader(TextInput& input, Mesh& mesh) : input_(input), mesh_(mesh) {}

  void read() {
    std::string keyword;
    for (std::string_view text; next_line(text);) {
      keyword = next_word(text);
      if (keyword.empty()) continue;
      if (!std::isalpha(static_cast<unsigned char>(keyword[0])))
        input_.fail(quoted(keyword) + " is not an OBJ statement; is this a text file in OBJ format?");
      for (char& c : keyword) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      read_statement(keyword, text);
    }
    for (const ForwardFace& face : forward_faces_) add_forward_face(face);
    add_notes();
  }

 private:
  using Corner = std::array<std::uint32_t, 3>;  // index of its position, (u, v) and normal

  // A face that uses what is defined below it.
  struct ForwardFace {
    std::uint64_t line;
    std::size_t first, count;  // of its corners, in forward_corners_
  };

  TextInput& input_;
  Mesh& mesh_;
  std::string joined_;  // a line with its continuations
  std::vector<Corner> face_;
  bool is_forward_ = false;  // the face being read
  std::vector<ForwardFace> forward_faces_;
  std::vector<Corner> forward_corners_;
  std::vector<std::array<double, 3>> polygon_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::size_t bad_uvs_ = 0;
  bool has_library_ = false;
  std::set<std::string> materials_;

  /// The next line without its comment, joined with those that follow where it ends in a backslash.
  bool next_line(std::string_view& text) {
    if (!input_.line(text)) return false;
    text = without_comment(text);
    if (!take_continuation(text)) return true;
    joined_ = text;
    for (bool continues = true; continues;) {
      if (joined_.size() > (64u << 20)) input_.fail("the continued line is longer than 64 MiB");
      if (!input_.line(text)) break;
      text = without_comment(text);
      continues = take_continuation(text);
      joined_.append(1, ' ').append(text);
    }
    text = joined_;
    return true;
  }

  void read_statement(const std::string& keyword, std::string_view text) {
    if (keyword == "v") {
      read_numbers(text, "v", 3, mesh_.positions.emplace_back());
      for (const double value : mesh_.positions.back())
        if (!std::isfinite(static_cast<float>(value))) fail_infinite(text);
    } else if (keyword == "vt") {
      auto& uv = mesh_.uvs.emplace_back();
      read_numbers(text, "vt", 1, uv);
      if (!std::isfinite(static_cast<float>(uv[0])) || !std::isfinite(static_cast<float>(uv[1]))) {
        uv = {};
        ++bad_uvs_;
      }
    } else if (keyword == "vn") {
      std::array<double, 3> normal;
      read_numbers(text, "vn", 3, normal);
      mesh_.normals.push_back(
          {static_cast<float>(normal[0]), static_cast<float>(normal[1]), static_cast<float>(normal[2])});
    } else if (keyword == "f" || keyword == "fo") {  // fo: the same in old files
      read_face(text);
    } else if (keyword == "usemtl") {
      materials_.emplace(next_word(text));
    } else if (keyword == "mtllib") {
      has_library_ = true;
    }
  }

  [[noreturn]] void fail_infinite(std::string_view text) const {
    double value = 0;
    std::string_view word = next_word(text);
    while (parse_number(word, value) && std::isfinite(static_cast<float>(value))) word = next_word(text);
    input_.fail(quoted(word) + " is not a finite number");
  }

  /// Reads up to N numbers, of which the first `needed` must be there (the others are then 0). More are
  /// passed over: a weight, or a colour of the vertex.
  template <std::size_t N>
  void read_numbers(std::string_view text, const char* keyword, std::size_t needed,
                    std::array<double, N>& values) const {
    values = {};
    for (std::size_t i = 0; i < N; ++i) {
      const std::string_view word = next_word(text);
      if (word.empty()) {
        if (i < needed)
          input_.fail("'" + std::string(keyword) + "' has " + std::to_string(i) + " numbers; expected " +
                      std::to_string(needed));
        return;
      }
      if (!parse_number(word, values[i])) input_.fail(no_number(word));
    }
  }

  [[noreturn]] void fail_range(std::uint64_t line, const char* what, std::int64_t index, std::size_t count,
                               const char* where) const {
    input_.fail_at(line, std::string(what) + " index " + std::to_string(index) + " is out of range; " +
                             std::to_string(count) + " are defined " + where);
  }

  /// Brings an index of the file (from 1, or negative from the end of what is defined so far) to one from 0.
  std::uint32_t resolve(std::string_view word, std::size_t count, const char* what) {
    std::int64_t index = 0;
    if (!parse_integer(word, index))
      input_.fail(quoted(word) + " is not the index of a " + what + "; expected an integer");
    const auto signed_count = static_cast<std::int64_t>(count);
    const std::int64_t result = index < 0 ? signed_count + index : index - 1;
    if (index == 0 || result < 0) fail_range(input_.line_number(), what, index, count, "up to here");
    if (result >= no_index) fail_range(input_.line_number(), what, index, count, "up to here");
    is_forward_ = is_forward_ || result >= signed_count;
    return static_cast<std::uint32_t>(result);
  }

  /// A corner: v, v/vt, v//vn or v/vt/vn.
  Corner read_corner(std::string_view word) {
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
    is_forward_ = false;
    for (auto word = next_word(text); !word.empty(); word = next_word(text))
      face_.push_back(read_corner(word));
    if (face_.size() < 3)
      input_.fail("the face has " + std::to_string(face_.size()) + " corners; expected at least 3");
    if (!is_forward_) return add_face();
    forward_faces_.push_back({input_.line_number(), forward_corners_.size(), face_.size()});
    forward_corners_.insert(forward_corners_.end(), face_.begin(), face_.end());
  }

  void add_forward_face(const ForwardFace& face) {
    const auto begin = forward_corners_.begin() + static_cast<std::ptrdiff_t>(face.first);
    face_.assign(begin, begin + static_cast<std::ptrdiff_t>(face.count));
    const std::size_t counts[] = {mesh_.positions.size(), mesh_.uvs.size(), mesh_.normals.size()};
    const char* const names[] = {"vertex", "texture coordinate", "normal"};
    for (const Corner& corner : face_)
      for (std::size_t i = 0; i < 3; ++i)
        if (corner[i] != no_index && corner[i] >= counts[i])
          fail_range(face.line, names[i], std::int64_t{corner[i]} + 1, counts[i], "in the file");
    add_face();
  }

  void add_face() {
    polygon_.clear();
    for (const auto& corner : face_) polygon_.push_back(mesh_.positions[corner[0]]);
    triangulate_polygon(polygon_, triangles_);
    for (const auto& [a, b, c] : triangles_) {
      mesh_.position_index.push_back({face_[a][0], face_[b][0], face_[c][0]});
      mesh_.uv_index.push_back({face_[a][1], face_[b][1], face_[c][1]});
      mesh_.normal_index.push_back({face_[a][2], face_[b][2], face_[c][2]});
    }
  }

  void add_notes() {
    if (bad_uvs_ > 0)
      mesh_.notes.push_back(std::to_string(bad_uvs_) +
                            " of its texture coordinates are no numbers and taken as (0, 0)");
    if (materials_.size() > 1)
      mesh_.notes.push_back(
          "its " + std::to_string(materials_.size()) +
          " materials (usemtl) are not read: the object's own material is on all of its faces");
    else if (has_library_)
      mesh_.notes.push_back("its material library (mtllib) is not read: the object's own material is used");
  }
};

}  // namespace

void read_obj(TextInput& input, Mesh& mesh) { ObjReader(input, mesh).read(); }

}  // namespace causticl
