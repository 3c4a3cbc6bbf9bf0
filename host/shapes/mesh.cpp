// Triangles of a file.
#include <algorithm>

#include "format/shape_keys.hpp"
#include "scene/shape_kind.hpp"

namespace causticl {
namespace {

const Mesh& mesh_of(const Scene& scene, const Object& object) {
  return scene.meshes[static_cast<std::size_t>(object.mesh)];
}

/// Corner `corner` of triangle `t` in the world, from those of the file by number. Clears `smooth` where it
/// has no normal.
TriangleCorner corner_of(const Mesh& mesh, const Transform& to_world, const Transform& to_local,
                         std::size_t t, int corner, bool& smooth) {
  TriangleCorner result;
  const auto& p = mesh.positions[mesh.position_index[t][corner]];
  result.position = to_world.point({p[0], p[1], p[2]});
  const std::uint32_t n = mesh.normal_index.empty() ? no_index : mesh.normal_index[t][corner];
  if (n == no_index) {
    smooth = false;
  } else {
    const auto& local = mesh.normals[n];
    // Normals transform by the inverse transpose.
    const Vec3 world =
        to_local.rows[0] * local[0] + to_local.rows[1] * local[1] + to_local.rows[2] * local[2];
    const double size = length(world);
    if (size > 0)
      result.normal = world / size;
    else
      smooth = false;
  }
  const std::uint32_t uv = mesh.uv_index.empty() ? no_index : mesh.uv_index[t][corner];
  if (uv != no_index) {
    result.u = mesh.uvs[uv][0];
    result.v = mesh.uvs[uv][1];
  }
  return result;
}

class MeshShape : public ShapeKind {
 public:
  std::array<Vec3, 2> local_box(const Scene& scene, const Object& object) const override {
    BoundingBox box;
    for (const auto& p : mesh_of(scene, object).positions) box.add(Vec3{p[0], p[1], p[2]});
    return {box.low, box.high};
  }

  BoundingBox bounds(const Scene& scene, const Object& object) const override {
    BoundingBox result;
    for (const auto& p : mesh_of(scene, object).positions)
      result.add(object.transform.point({p[0], p[1], p[2]}));
    return result;
  }

  std::size_t triangles(const Scene& scene, const Object& object) const override {
    return mesh_of(scene, object).triangles();
  }

  bool visit_triangles(const Scene& scene, const Object& object,
                       const TriangleVisitor& visit) const override {
    const Mesh& mesh = mesh_of(scene, object);
    const Transform to_local = object.transform.inverse();
    const bool mirrored = object.transform.determinant() < 0;
    for (std::size_t t = 0; t < mesh.triangles(); ++t) {
      bool smooth = object.smooth && !mesh.normal_index.empty();
      TriangleCorner corners[3];
      // A mirroring transform turns the winding around: two corners change places to keep outside outside.
      for (int c = 0; c < 3; ++c)
        corners[c] = corner_of(mesh, object.transform, to_local, t, mirrored && c > 0 ? 3 - c : c, smooth);
      if (!visit(corners, smooth)) return false;
    }
    return true;
  }
};

}  // namespace

const ShapeKind& mesh_shape() {
  static const MeshShape kind;
  return kind;
}

const SceneTable& mesh_keys() {
  using namespace types;
  static const SceneTable table =
      shape_table(Object::Shape::mesh, "triangles of a file",
                  {{"path", file(), required, "an .obj or a .ply file"},
                   {"tree_type", choice({"KDTree", "BSPTree", "MyTree"}), optional,
                    "base format; every mesh goes into the KD-tree"},
                   {"smooth", boolean(), Absent::Described{"true if the file has normals"},
                    "shading normals: those of the file, else averaged ones; false: flat faces"}});
  return table;
}

void read_mesh(const SceneObject& json, Object& object, SceneLoader& loader) {
  if (const auto tree = json.find("tree_type"))
    if (tree->choice() != 0)
      loader.notice(*tree, "every mesh is put into the KD-tree; \"tree_type\" is ignored");
  object.mesh = loader.mesh(json.at("path"));
  // A file without normals is drawn as the flat faces it has, unless smoothing is asked for.
  object.smooth = json.boolean("smooth", mesh_of(loader.scene, object).has_normals);
}

}  // namespace causticl
