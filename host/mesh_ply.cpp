#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "mesh_formats.hpp"
#include "mesh_ply_header.hpp"
#include "mesh_polygon.hpp"

namespace causticl {
namespace {

using namespace ply;

template <typename T>
double decode(const unsigned char* bytes, bool swap) {
  unsigned char raw[sizeof(T)];
  for (std::size_t i = 0; i < sizeof(T); ++i) raw[i] = bytes[swap ? sizeof(T) - 1 - i : i];
  T value;
  std::memcpy(&value, raw, sizeof(T));
  return static_cast<double>(value);
}

std::string shortest(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.12g", number);
  return text;
}

class PlyReader {
 public:
  PlyReader(MeshInput& input, Mesh& mesh) : input_(input), mesh_(mesh) {}

  void read() {
    const Header header = read_header(input_);
    format_ = header.format;
    swap_ = (format_ == Format::big_endian) != (std::endian::native == std::endian::big);
    for (const Element& element : header.elements) {
      element_ = &element;
      check_count();
      if (element.name == "vertex") {
        read_vertices();
      } else if (element.name == "face") {
        read_faces();
      } else if (!element.properties.empty()) {
        for (index_ = 0; index_ < element.count; ++index_) {
          begin_record();
          for (const Property& property : element.properties) skip(property);
          end_record();
        }
      }
    }
  }

 private:
  MeshInput& input_;
  Mesh& mesh_;
  Format format_ = Format::ascii;
  bool swap_ = false;
  const Element* element_ = nullptr;  // the one being read
  std::uint64_t index_ = 0;           // which of them
  std::string_view line_;             // what is left of its line (ASCII)

  [[noreturn]] void fail(const std::string& fault) const {
    const std::string message = element_->name + " " + std::to_string(index_) + ": " + fault;
    format_ == Format::ascii ? input_.fail(message) : input_.fail_file(message);
  }

  /// Refuses a count that the rest of the file cannot hold, before memory is asked for.
  void check_count() const {
    if ((element_->name == "vertex" || element_->name == "face") && element_->count >= no_index)
      input_.fail_file("the header declares " + std::to_string(element_->count) + " of element " +
                       quoted(element_->name) + "; expected at most 4294967294");
    std::uint64_t smallest = 0;  // bytes of a record
    for (const Property& property : element_->properties)
      smallest += format_ == Format::ascii ? 2 : size_of(property.count_type.value_or(property.type));
    // The last line may lack its end.
    const std::uint64_t room = input_.remaining() + (format_ == Format::ascii ? 1 : 0);
    if (smallest > 0 && element_->count > room / smallest)
      input_.fail_file("the header declares " + std::to_string(element_->count) + " of element " +
                       quoted(element_->name) + ", but only " + std::to_string(input_.remaining()) +
                       " bytes follow; is the file truncated?");
  }

  void begin_record() {
    if (format_ != Format::ascii) return;
    do {
      if (!input_.line(line_)) fail("the file ends before it; is it truncated?");
      while (!line_.empty() && (line_.front() == ' ' || line_.front() == '\t')) line_.remove_prefix(1);
    } while (line_.empty());
  }

  void end_record() {
    if (format_ != Format::ascii) return;
    if (const auto word = next_word(line_); !word.empty())
      fail(quoted(word) + " is more than the header declares for it");
  }

  double value(Type type) {
    if (format_ == Format::ascii) {
      const std::string_view word = next_word(line_);
      double result = 0;
      if (word.empty()) fail("has fewer values than the header declares");
      if (!parse_number(word, result)) fail(quoted(word) + " is not a number");
      return result;
    }
    const unsigned char* bytes = input_.bytes(size_of(type));
    if (!bytes) fail("the file ends within it; is it truncated?");
    switch (type) {
      case Type::int8:
        return decode<std::int8_t>(bytes, swap_);
      case Type::uint8:
        return decode<std::uint8_t>(bytes, swap_);
      case Type::int16:
        return decode<std::int16_t>(bytes, swap_);
      case Type::uint16:
        return decode<std::uint16_t>(bytes, swap_);
      case Type::int32:
        return decode<std::int32_t>(bytes, swap_);
      case Type::uint32:
        return decode<std::uint32_t>(bytes, swap_);
      case Type::float32:
        return decode<float>(bytes, swap_);
      case Type::float64:
        return decode<double>(bytes, swap_);
    }
    return 0;
  }

  std::uint64_t list_count(const Property& property) {
    const double count = value(*property.count_type);
    if (!(count >= 0) || count != std::floor(count))
      fail("list " + quoted(property.name) + " has " + shortest(count) + " entries");
    const std::size_t smallest = format_ == Format::ascii ? 1 : size_of(property.type);
    const std::uint64_t room = format_ == Format::ascii ? line_.size() : input_.remaining();
    const std::uint64_t most = room / smallest;
    if (count > static_cast<double>(most))
      fail("list " + quoted(property.name) + " has " + shortest(count) +
           " entries, more than the rest of the file holds");
    return static_cast<std::uint64_t>(count);
  }

  void skip(const Property& property) {
    const std::uint64_t count = property.count_type ? list_count(property) : 1;
    for (std::uint64_t i = 0; i < count; ++i) value(property.type);
  }

  float finite(const std::array<double, roles>& values, Role role) const {
    const auto result = static_cast<float>(values[role]);
    if (!std::isfinite(result)) fail("a coordinate is not a finite number");
    return result;
  }

  void read_vertices() {
    const bool normals = element_->has(nx) && element_->has(ny) && element_->has(nz);
    const bool uvs = element_->has(u) && element_->has(v);
    mesh_.positions.reserve(element_->count);
    if (normals) mesh_.normals.reserve(element_->count);
    if (uvs) mesh_.uvs.reserve(element_->count);
    std::array<double, roles> values{};
    for (index_ = 0; index_ < element_->count; ++index_) {
      begin_record();
      for (const Property& property : element_->properties) {
        if (property.role < roles)
          values[property.role] = value(property.type);
        else
          skip(property);
      }
      end_record();
      mesh_.positions.push_back({finite(values, x), finite(values, y), finite(values, z)});
      if (normals) mesh_.normals.push_back({finite(values, nx), finite(values, ny), finite(values, nz)});
      if (uvs) mesh_.uvs.push_back({finite(values, u), finite(values, v)});
    }
  }

  void read_faces() {
    mesh_.position_index.reserve(element_->count);
    std::vector<std::uint32_t> face;
    for (index_ = 0; index_ < element_->count; ++index_) {
      begin_record();
      for (const Property& property : element_->properties) {
        if (property.role == indices)
          read_indices(property, face);
        else
          skip(property);
      }
      end_record();
      add_face(face);
    }
    // A vertex carries its normal and (u, v) with it.
    const std::vector<std::array<std::uint32_t, 3>> none(mesh_.triangles(), {no_index, no_index, no_index});
    mesh_.normal_index = mesh_.normals.empty() ? none : mesh_.position_index;
    mesh_.uv_index = mesh_.uvs.empty() ? none : mesh_.position_index;
  }

  void read_indices(const Property& property, std::vector<std::uint32_t>& face) {
    const std::uint64_t count = list_count(property);
    if (count < 3) fail("has " + std::to_string(count) + " corners; expected at least 3");
    face.clear();
    for (std::uint64_t i = 0; i < count; ++i) {
      const double index = value(property.type);
      if (!(index >= 0 && index < static_cast<double>(mesh_.positions.size())) || index != std::floor(index))
        fail("vertex index " + shortest(index) + " is out of range; there are " +
             std::to_string(mesh_.positions.size()) + " vertices");
      face.push_back(static_cast<std::uint32_t>(index));
    }
  }

  std::vector<std::array<float, 3>> polygon_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;

  void add_face(const std::vector<std::uint32_t>& face) {
    if (face.size() == 3) {
      mesh_.position_index.push_back({face[0], face[1], face[2]});
      return;
    }
    polygon_.clear();
    for (const std::uint32_t index : face) polygon_.push_back(mesh_.positions[index]);
    triangulate_polygon(polygon_, triangles_);
    for (const auto& [a, b, c] : triangles_) mesh_.position_index.push_back({face[a], face[b], face[c]});
  }
};

}  // namespace

void read_ply(MeshInput& input, Mesh& mesh) { PlyReader(input, mesh).read(); }

}  // namespace causticl
