// Small scenes for the tests of the loader.
#pragma once

#include <filesystem>
#include <string>

#include "catch2.hpp"
#include "format/load_scene.hpp"
#include "scene/scene.hpp"
#include "temporary_folder.hpp"

namespace causticl {

inline const std::string target_camera = R"({"position": [1, 2, 3], "target": [1, 2, -1], "fov": 90})";
inline const std::string lamp =
    R"({"type": "sphere", "radius": 2, "material": {"type": "diffuse", "emission": [1, 2, 3]}})";

/// A folder with a few assets, and scenes written into it and loaded.
class SceneFolder {
 public:
  SceneFolder() {
    folder.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder.write("smooth.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\n");
    std::filesystem::copy(std::string(CAUSTICL_SOURCE_DIR) + "/tests/cli/bad/intact.png",
                          folder.path("5x4.png"));
  }
  Scene load(const std::string& text, const SceneOptions& options = {}) const {
    return load_scene(folder.write("scene.json", text), options);
  }
  /// A scene of these objects (and the text of more keys at the top).
  Scene objects(const std::string& list, const std::string& more = "") const {
    return load("{\"camera\": " + target_camera + more + ", \"objects\": [" + list + "]}");
  }
  Scene camera(const std::string& text) const {
    return load("{\"width\": 200, \"height\": 100, \"camera\": " + text + ", \"objects\": [" + lamp + "]}");
  }
  Transform transform(const std::string& steps) const {
    return objects(R"({"type": "rectangle", "material": {"type": "mirror"}, "transform": )" + steps + "}")
        .objects[0]
        .transform;
  }
  /// The material of one object with this shape and this key.
  MaterialSpec material(const std::string& key, const std::string& shape = R"("type": "sphere", "radius": 1)",
                        const std::string& more = "") const {
    const Scene scene = objects("{" + shape + ", " + key + "}", more);
    return scene.materials[static_cast<std::size_t>(scene.objects[0].material)];
  }

  TemporaryFolder folder;
};

inline void check_near(Vec3 a, Vec3 b) {
  CHECK(a.x == Approx(b.x).margin(1e-12));
  CHECK(a.y == Approx(b.y).margin(1e-12));
  CHECK(a.z == Approx(b.z).margin(1e-12));
}

/// The notices of a scene of SceneFolder, "LINE: POINTER: TEXT" each.
inline std::string notices_of(const Scene& scene) {
  std::string result;
  for (const std::string& notice : scene.notices)
    result += notice.substr(notice.find("scene.json") + 11) + "\n";
  return result;
}

}  // namespace causticl
