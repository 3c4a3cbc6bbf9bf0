// A scene that must be refused, with the one line that says why.
#pragma once

namespace causticl {

/// A scene that loads, and what turns it into a bad one.
struct BadScene {
  const char* name;
  const char* from;  // the part of good_scene to replace; empty: all of it; "FILE": `to` names a file of
                     // tests/cli/bad
  const char* to;
  const char* message;  // without the folder of the files
};

inline constexpr const char* good_scene = R"({ // a floor and a lamp
  "width": 64, "height": 48,
  "renderer": {"type": "sppm", "rounds": 2},
  "camera": {"position": [0, 1, 5], "target": [0, 0, 0], "fov": 40},
  "materials": {"white": {"type": "diffuse", "color": [0.8, 0.8, 0.8]}},
  "objects": [
    {"type": "rectangle", "material": "white"},
    {"type": "sphere", "radius": 1, "material": {"type": "diffuse", "emission": [1, 1, 1]}}
  ]
}
)";

}  // namespace causticl
