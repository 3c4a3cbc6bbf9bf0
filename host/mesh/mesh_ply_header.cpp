#include "mesh/mesh_ply_header.hpp"

#include <cctype>

namespace causticl::ply {
namespace {

std::optional<Type> parse_type(std::string_view word) {
  constexpr std::pair<std::string_view, Type> names[] = {
      {"char", Type::int8},      {"int8", Type::int8},       {"uchar", Type::uint8},
      {"uint8", Type::uint8},    {"short", Type::int16},     {"int16", Type::int16},
      {"ushort", Type::uint16},  {"uint16", Type::uint16},   {"int", Type::int32},
      {"int32", Type::int32},    {"uint", Type::uint32},     {"uint32", Type::uint32},
      {"float", Type::float32},  {"float32", Type::float32}, {"double", Type::float64},
      {"float64", Type::float64}};
  for (const auto& [name, type] : names)
    if (word == name) return type;
  return {};
}

Role vertex_role(std::string name) {
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  constexpr std::string_view names[roles] = {"x", "y", "z", "nx", "ny", "nz", "u", "v"};
  for (int role = 0; role < roles; ++role)
    if (name == names[role]) return Role(role);
  if (name == "s" || name == "texture_u" || name == "texture_s") return u;
  if (name == "t" || name == "texture_v" || name == "texture_t") return v;
  return unused;
}

bool is_integer(Type type) { return type != Type::float32 && type != Type::float64; }

Role face_role(const Property& property) {
  const bool is_list = property.count_type.has_value();
  if (is_list && (property.name == "vertex_indices" || property.name == "vertex_index")) return indices;
  if (is_list && (property.name == "texcoord" || property.name == "texcoords")) return corner_uvs;
  if (!is_list && property.name == "texnumber") return texture_number;
  return unused;
}

/// Where no list of the faces has the usual name, finds the one that holds their vertices: the only one of
/// integers, or the only one of these whose name speaks of vertices or indices.
void find_indices(Element& face) {
  std::vector<Property*> lists, named;
  for (Property& property : face.properties) {
    if (property.role != unused || !property.count_type || !is_integer(property.type)) continue;
    if (property.name.starts_with("tex")) continue;  // numbers of textures
    lists.push_back(&property);
    if (property.name.find("vert") != std::string::npos || property.name.find("ind") != std::string::npos)
      named.push_back(&property);
  }
  const auto& found = lists.size() == 1 ? lists : named;
  if (found.size() == 1) found[0]->role = indices;
}

class HeaderReader {
 public:
  explicit HeaderReader(TextInput& input) : input_(input) {}

  Header read() {
    std::string_view text;
    if (!input_.line(text) || next_word(text) != "ply")
      input_.fail("expected 'ply' on the first line; is this a PLY file?");
    bool has_format = false;
    while (true) {
      if (!input_.line(text)) input_.fail("the file ends within its header; expected end_header");
      const std::string_view keyword = next_word(text);
      if (keyword == "end_header") break;
      if (keyword == "format") {
        read_format(text);
        has_format = true;
      } else if (keyword == "element") {
        read_element(text);
      } else if (keyword == "property") {
        read_property(text);
      }
    }
    if (!has_format) input_.fail("the header names no format");
    check();
    return std::move(header_);
  }

 private:
  TextInput& input_;
  Header header_;

  void read_format(std::string_view text) {
    const std::string_view name = next_word(text);
    if (name == "ascii") {
      header_.format = Format::ascii;
    } else if (name == "binary_little_endian") {
      header_.format = Format::little_endian;
    } else if (name == "binary_big_endian") {
      header_.format = Format::big_endian;
    } else {
      input_.fail("unknown format " + quoted(name) +
                  "; expected ascii, binary_little_endian or binary_big_endian");
    }
  }

  void read_element(std::string_view text) {
    Element& element = header_.elements.emplace_back();
    element.name = next_word(text);
    const std::string_view word = next_word(text);
    std::int64_t count = -1;
    if (element.name.empty() || !parse_integer(word, count) || count < 0)
      input_.fail(quoted(word) + " is not the count of element " + quoted(element.name) +
                  "; expected an integer from 0");
    element.count = static_cast<std::uint64_t>(count);
    for (std::size_t i = 0; i + 1 < header_.elements.size(); ++i)
      if (header_.elements[i].name == element.name)
        input_.fail("element " + quoted(element.name) + " stands twice");
    if (element.name == "tristrips")
      input_.fail("triangle strips (element tristrips) are not supported; save the mesh with faces");
  }

  void read_property(std::string_view text) {
    if (header_.elements.empty()) input_.fail("a property stands before the first element");
    const auto type_of = [&](std::string_view word) {
      const auto type = parse_type(word);
      if (!type) input_.fail("unknown type " + quoted(word) + " of a property; expected char to double");
      return *type;
    };
    Property property;
    std::string_view word = next_word(text);
    if (word == "list") {
      property.count_type = type_of(next_word(text));
      word = next_word(text);
    }
    property.type = type_of(word);
    property.name = next_word(text);
    if (property.name.empty()) input_.fail("the property has no name");
    const std::string& element = header_.elements.back().name;
    if (element == "vertex" && !property.count_type) property.role = vertex_role(property.name);
    if (element == "face") property.role = face_role(property);
    header_.elements.back().properties.push_back(std::move(property));
  }

  void check() {
    bool vertices = false;
    for (Element& element : header_.elements) {
      if (element.name == "vertex") {
        vertices = true;
        header_.vertices = element.count;
        if (!element.has(x) || !element.has(y) || !element.has(z))
          input_.fail("element vertex lacks x, y or z");
      } else if (element.name == "face") {
        if (!element.has(indices)) find_indices(element);
        if (!element.has(indices) && element.count > 0)
          input_.fail("element face has no list of vertices; expected a list vertex_indices");
        header_.has_corner_uvs = element.has(corner_uvs);
      }
    }
    if (!vertices) input_.fail("the header has no element vertex");
  }
};

}  // namespace

std::size_t size_of(Type type) {
  constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<int>(type)];
}

Header read_header(TextInput& input) { return HeaderReader(input).read(); }

}  // namespace causticl::ply
