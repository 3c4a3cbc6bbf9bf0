// The formats of scene files: a row each, by which load_scene() finds the reader of a file.
#pragma once

#include <string>
#include <vector>

#include "format/load_scene.hpp"

namespace causticl {

struct SceneFormat {
  const char* name;                                 // "CaustiCL JSON"
  std::vector<std::string> extensions;              // ".json", in lower case
  bool (*begins_so)(const std::string& beginning);  // whether a file that begins so may be one
  /// The scene with everything that it names, ended by SceneBuilder::finish(). Throws UserError with the
  /// SourceLocation of what is at fault.
  Scene (*load)(const std::string& file, const SceneOptions& options);
};

/// All formats, the native one first.
const std::vector<SceneFormat>& scene_formats();

/// That of a file: by its extension; where that tells none, or more than one, by how the file begins. What is
/// no regular file can be read once only, and is of the first format. Throws UserError that names the formats
/// where none fits.
const SceneFormat& scene_format_of(const std::string& file,
                                   const std::vector<SceneFormat>& formats = scene_formats());

// What the rows are made of, one reader a format.
bool is_json_scene(const std::string& beginning);
Scene load_json_scene(const std::string& file, const SceneOptions& options);

}  // namespace causticl
