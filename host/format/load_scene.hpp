// From a scene file to a Scene.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "image/image_limits.hpp"
#include "scene/scene.hpp"

namespace causticl {

/// A `-D key=value` of the command line: `key` is a path of JSON keys joined by dots ("renderer.radius",
/// "objects.3.radius"), `value` is JSON, or a string where it is not.
struct Override {
  std::string key, value;
};

struct SceneOptions {
  std::vector<Override> overrides;          // applied before anything is read
  std::optional<std::pair<int, int>> size;  // --size
  std::optional<Integrator> integrator;     // --integrator: refuses or allows what the file holds
  ImageLimits image_limits;                 // --max-image-memory, of all images together
};

/// Loads a scene file of any format (scene_formats.hpp) with everything that it names (meshes, images).
/// Throws UserError with the SourceLocation and what was expected.
Scene load_scene(const std::string& file, const SceneOptions& options = {});

}  // namespace causticl
