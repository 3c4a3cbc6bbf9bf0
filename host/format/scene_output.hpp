// Where the picture goes that a scene names: a file that was downloaded must not choose what it overwrites.
#pragma once

#include <string>

#include "scene/scene.hpp"

namespace causticl {

class SceneValue;

/// The key `path`. Throws UserError, with its place, for control characters in it, and where it names no
/// file.
std::string read_output(const SceneValue& path);

struct SceneOutput {
  std::string file;    // within the working directory
  std::string notice;  // why it is not what the scene says; empty where it is
};

/// The scene's `path`, of which only the last name counts where it leads out of the working directory;
/// without one the name of the scene's file with .png.
SceneOutput scene_output(const Scene& scene);

/// Makes the folder of such a file. Throws UserError where the file exists and is no picture, or is a link
/// that leads out of the working directory.
void prepare_scene_output(const std::string& file);

}  // namespace causticl
