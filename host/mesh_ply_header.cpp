#include "mesh_ply_header.hpp"

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

Role vertex_role(std::string_view name) {
  constexpr std::string_view names[roles] = {"x", "y", "z", "nx", "ny", "nz", "u", "v"};
  for (int role = 0; role < roles; ++role)
    if (name == names[role]) return Role(role);
  if (name == "s" || name == "texture_u" || name == "texture_s") return u;
  if (name == "t" || name == "texture_v" || name == "texture_t") return v;
  return unused;
}

class HeaderReader {
 public:
  explicit HeaderReader(MeshInput& input) : input_(input) {}

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
  MeshInput& input_;
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
    if (element == "face" && property.count_type &&
        (property.name == "vertex_indices" || property.name == "vertex_index"))
      property.role = indices;
    header_.elements.back().properties.push_back(std::move(property));
  }

  void check() const {
    bool vertices = false;
    for (const Element& element : header_.elements) {
      if (element.name == "vertex") {
        vertices = true;
        if (!element.has(x) || !element.has(y) || !element.has(z))
          input_.fail("element vertex lacks x, y or z");
      } else if (element.name == "face" && element.count > 0) {
        if (!vertices) input_.fail("element face stands before element vertex; expected vertices first");
        if (!element.has(indices)) input_.fail("element face has no list vertex_indices");
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

Header read_header(MeshInput& input) { return HeaderReader(input).read(); }

}  // namespace causticl::ply
