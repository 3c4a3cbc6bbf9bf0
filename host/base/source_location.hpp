// A place in a file that a user wrote, for messages about it.
#pragma once

#include <cstdint>
#include <string>

namespace causticl {

/// "scene.json:12: /objects/3", "mesh.obj:7", "-D renderer.radius=2: /renderer/radius".
struct SourceLocation {
  std::string file;        // or what else it was said by: an option of the command line
  std::uint64_t line = 0;  // from 1; 0: none
  std::string what;        // that stands there: a JSON pointer, the name of a node; empty: not told

  std::string text() const;
  /// Throws UserError "PLACE: MESSAGE".
  [[noreturn]] void fail(const std::string& message) const;
};

}  // namespace causticl
