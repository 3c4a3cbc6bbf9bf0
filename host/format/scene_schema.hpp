// The scene format as a JSON Schema, for editors and validators.
#pragma once

#include <string>

namespace causticl {

/// JSON Schema, draft 7, of a scene file, made from the tables that the reader uses. What it refuses,
/// load_scene() refuses; it does not know of files, of names of materials and of what several values have to
/// do with each other.
std::string scene_schema();

}  // namespace causticl
