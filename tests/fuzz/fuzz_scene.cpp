#include <sstream>

#include "accel/kdtree.hpp"
#include "app/report.hpp"
#include "base/printable.hpp"
#include "format/load_scene.hpp"
#include "fuzz_input.hpp"
#include "scene/scene.hpp"
#include "world/flat_scene.hpp"

namespace causticl {
namespace {

/// What scenes of the corpus may name: a mesh and a picture.
const std::string& assets_folder() {
  static const std::string path = [] {
    const TemporaryFolder& folder = fuzz_folder();
    folder.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\n");
    folder.write("image.pfm", std::string("PF\n1 1\n-1.0\n") + std::string("\0\0\x80\x3f", 4) +
                                  std::string("\0\0\x00\x3f", 4) + std::string("\0\0\x80\x3e", 4));
    return folder.path("");
  }();
  return path;
}

/// What every command does with a scene before it needs a device, and what `causticl info` prints.
void load(const std::string& text, const SceneOptions& options) {
  assets_folder();
  const std::string file = fuzz_folder().write("scene.json", text);
  read_or_refuse([&] {
    const Scene scene = load_scene(file, options);
    for (const std::string& notice : scene.notices) promise_one_line(notice);
    promise(scene.width > 0 && scene.height > 0, "a scene has pixels");
    for (const Object& object : scene.objects) {
      promise(static_cast<std::size_t>(object.material) < scene.materials.size(), "an object has a material");
      promise(
          object.shape != Object::Shape::mesh || static_cast<std::size_t>(object.mesh) < scene.meshes.size(),
          "a mesh object has a mesh");
    }
    std::istringstream summary(printable(scene_summary(scene)));
    for (std::string line; std::getline(summary, line);) promise_for_terminal(line);
    const FlatScene world = flatten_scene(scene);
    build_kdtree(world.tree, 1);
  });
}

constexpr const char* base_scene = R"({
  "width": 64, "height": 48, "max_depth": 5, "Na": 1, "Ng": 1.5,
  "renderer": {"type": "sppm", "rounds": 2, "radius": 1, "alpha": 0.7},
  "camera": {"position": [0, 1, 5], "target": [0, 0, 0], "fov": 40},
  "materials": {"glass": {"type": "glass", "ior": 1.33}},
  "objects": [
    {"type": "plane", "transform": [{"type": "rotate", "axis": "x", "degree": 90}],
     "material": {"type": "diffuse", "color": [0.5, 0.5, 0.5]}},
    {"type": "sphere", "radius": 2, "material": "glass"},
    {"type": "bezier_rotate", "point": [[0, 0], [3, 1], [1, 2]], "material": {"type": "mirror"}},
    {"type": "box", "size": [1, 2, 3], "material": {"type": "diffuse", "emission": [1, 1, 1]}}
  ],
  "lights": [{"type": "point", "position": [0, 5, 0], "intensity": [1, 1, 1]}]
})";

}  // namespace

void fuzz_scene(const std::string& bytes) { load(bytes, {}); }

// "key=value" up to a NUL, any number of times, as words of a command line end.
void fuzz_override(const std::string& bytes) {
  SceneOptions options;
  for (std::size_t begin = 0; begin < bytes.size();) {
    const std::size_t end = std::min(bytes.find('\0', begin), bytes.size());
    const std::string word = bytes.substr(begin, end - begin);
    const std::size_t equals = word.find('=');
    if (equals != 0 && equals != std::string::npos)
      options.overrides.push_back({word.substr(0, equals), word.substr(equals + 1)});
    begin = end + 1;
  }
  load(base_scene, options);
}

}  // namespace causticl
