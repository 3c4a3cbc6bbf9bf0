#include <cmath>

#include "mesh/mesh_formats.hpp"
#include "mesh/mesh_ply_records.hpp"
#include "mesh/mesh_polygon.hpp"

namespace causticl {
namespace {

using namespace ply;

class PlyReader {
 public:
  PlyReader(TextInput& input, Mesh& mesh)
      : mesh_(mesh), header_(read_header(input)), records_(input, header_.format) {}

  void read() {
    for (const Element& element : header_.elements) {
      records_.begin(element);
      if (element.name == "vertex") {
        vertices_ = element.count;
        read_vertices(element);
      } else if (element.name == "face") {
        read_faces(element);
      } else if (!element.properties.empty()) {
        while (records_.next()) {
          for (const Property& property : element.properties) records_.skip(property);
          records_.end_record();
        }
      }
    }
    for (const Face& face : forward_faces_) add_face(face);
    if (mesh_.uv_index.empty()) mesh_.uv_index = index_of_vertices(has_uvs_);
    mesh_.normal_index = index_of_vertices(!mesh_.normals.empty());
    add_notes();
  }

 private:
  struct Face {
    std::vector<std::uint32_t> corners;
    std::vector<double> uvs;  // two a corner, or none
    double texture = 0;       // which one, of those that the file's material has
  };

  Mesh& mesh_;
  const Header header_;
  Records records_;
  std::uint64_t vertices_ = 0;  // read so far
  bool has_uvs_ = false;        // the vertices
  std::vector<Face> forward_faces_;
  std::vector<std::array<double, 3>> polygon_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::size_t bad_uvs_ = 0, uneven_uvs_ = 0;
  double first_texture_ = 0;
  bool several_textures_ = false;

  /// A vertex carries its normal and (u, v) with it: the same indices as of positions.
  std::vector<std::array<std::uint32_t, 3>> index_of_vertices(bool exists) const {
    return exists
               ? mesh_.position_index
               : std::vector<std::array<std::uint32_t, 3>>(mesh_.triangles(), {no_index, no_index, no_index});
  }

  double coordinate(double value) const {
    if (!std::isfinite(static_cast<float>(value))) records_.fail("a coordinate is not a finite number");
    return value;
  }

  std::array<double, 2> uv_of(double u_value, double v_value) {
    if (std::isfinite(static_cast<float>(u_value)) && std::isfinite(static_cast<float>(v_value)))
      return {u_value, v_value};
    ++bad_uvs_;
    return {};
  }

  void read_vertices(const Element& element) {
    const bool normals = element.has(nx) && element.has(ny) && element.has(nz);
    has_uvs_ = element.has(u) && element.has(v);
    mesh_.positions.reserve(element.count);
    if (normals) mesh_.normals.reserve(element.count);
    if (has_uvs_) mesh_.uvs.reserve(element.count);
    std::array<double, roles> values{};
    while (records_.next()) {
      for (const Property& property : element.properties) {
        if (property.role < roles)
          values[property.role] = records_.value(property.type);
        else
          records_.skip(property);
      }
      records_.end_record();
      mesh_.positions.push_back({coordinate(values[x]), coordinate(values[y]), coordinate(values[z])});
      if (normals)
        mesh_.normals.push_back(
            {static_cast<float>(values[nx]), static_cast<float>(values[ny]), static_cast<float>(values[nz])});
      if (has_uvs_) mesh_.uvs.push_back(uv_of(values[u], values[v]));
    }
  }

  void read_faces(const Element& element) {
    mesh_.position_index.reserve(element.count);
    Face face;
    for (std::uint64_t count = 0; records_.next(); ++count) {
      face.uvs.clear();
      for (const Property& property : element.properties) {
        if (property.role == indices)
          read_corners(property, face.corners);
        else if (property.role == corner_uvs)
          read_uvs(property, face.uvs);
        else if (property.role == texture_number)
          face.texture = records_.value(property.type);
        else
          records_.skip(property);
      }
      records_.end_record();
      if (element.has(corner_uvs) && face.uvs.size() != 2 * face.corners.size()) {
        uneven_uvs_ += !face.uvs.empty();
        face.uvs.clear();
      }
      if (count == 0) first_texture_ = face.texture;
      several_textures_ = several_textures_ || face.texture != first_texture_;
      if (vertices_ > 0)
        add_face(face);
      else
        forward_faces_.push_back(face);
    }
  }

  void read_corners(const Property& property, std::vector<std::uint32_t>& corners) {
    const std::uint64_t count = records_.list_count(property);
    if (count < 3) records_.fail("has " + std::to_string(count) + " corners; expected at least 3");
    corners.clear();
    for (std::uint64_t i = 0; i < count; ++i) {
      const double index = records_.value(property.type);
      if (!(index >= 0 && index < static_cast<double>(header_.vertices)) || index != std::floor(index))
        records_.fail("vertex index " + shortest(index) + " is out of range; there are " +
                      std::to_string(header_.vertices) + " vertices");
      if (index >= no_index) records_.fail("vertex index " + shortest(index) + " does not fit 32 bits");
      corners.push_back(static_cast<std::uint32_t>(index));
    }
  }

  void read_uvs(const Property& property, std::vector<double>& uvs) {
    const std::uint64_t count = records_.list_count(property);
    for (std::uint64_t i = 0; i < count; ++i) uvs.push_back(records_.value(property.type));
  }

  void add_face(const Face& face) {
    polygon_.clear();
    for (const std::uint32_t index : face.corners) polygon_.push_back(mesh_.positions[index]);
    triangulate_polygon(polygon_, triangles_);
    for (const auto& [a, b, c] : triangles_)
      mesh_.position_index.push_back({face.corners[a], face.corners[b], face.corners[c]});
    if (!header_.has_corner_uvs) return;
    const auto first = static_cast<std::uint32_t>(mesh_.uvs.size());
    for (std::size_t i = 0; i < face.uvs.size(); i += 2)
      mesh_.uvs.push_back(uv_of(face.uvs[i], face.uvs[i + 1]));
    const auto uv_index = [&](std::uint32_t corner) {
      return !face.uvs.empty() ? first + corner : has_uvs_ ? face.corners[corner] : no_index;
    };
    for (const auto& [a, b, c] : triangles_)
      mesh_.uv_index.push_back({uv_index(a), uv_index(b), uv_index(c)});
  }

  void add_notes() {
    if (bad_uvs_ > 0)
      mesh_.notes.push_back(std::to_string(bad_uvs_) +
                            " of its texture coordinates are no numbers and taken as (0, 0)");
    if (uneven_uvs_ > 0)
      mesh_.notes.push_back(std::to_string(uneven_uvs_) +
                            " of its faces have texture coordinates that are not two a corner: passed over");
    if (several_textures_)
      mesh_.notes.push_back(
          "its faces name several textures (texnumber): the object's one is on all of them");
  }
};

}  // namespace

void read_ply(TextInput& input, Mesh& mesh) { PlyReader(input, mesh).read(); }

}  // namespace causticl
