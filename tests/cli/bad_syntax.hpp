// Scenes that must be refused: texts that are no JSON, and keys that are missing, unknown or of the wrong
// type.
#pragma once

#include "bad_scene.hpp"

namespace causticl {

inline constexpr BadScene bad_syntax[] = {
    {"trailing comma", "\"fov\": 40}", "\"fov\": 40,}",
     "scene.json:4: expected a key in double quotes, got '}'; remove the comma before it"},
    {"trailing comma of a list", "[0, 1, 5]", "[0, 1, 5,]",
     "scene.json:4: expected a value, got ']'; remove the comma before it"},
    {"missing comma", "64, \"height\"", "64 \"height\"", "scene.json:2: expected ',' or '}', got string"},
    {"missing colon", "\"width\": 64", "\"width\" 64",
     "scene.json:2: expected ':' after the key, got number"},
    {"key without quotes", "\"width\"", "width",
     "scene.json:2: expected a key in double quotes, got \"width\""},
    {"single quotes", "\"white\"", "'white'", "scene.json:5: expected a key in double quotes, got \"'\""},
    {"string not closed", "\"white\": {", "\"white: {",
     "scene.json:5: expected ':' after the key, got \"type\""},
    {"line break in a string", "\"rectangle\"", "\"rect\nangle\"",
     "scene.json:7: expected the string's closing quote before the end of the line"},
    {"NaN", "\"radius\": 1", "\"radius\": NaN", "scene.json:8: expected a value, got \"NaN\""},
    {"infinity", "\"radius\": 1", "\"radius\": -Infinity",
     "scene.json:8: expected a value, got \"-Infinity\""},
    {"beyond double precision", "\"radius\": 1", "\"radius\": 1e999",
     "scene.json:8: expected a number that double precision can hold, got 1e999"},
    {"leading zero", "\"width\": 64", "\"width\": 064", "scene.json:2: expected ',' or '}', got number"},
    {"half a comment", "// a floor", "/ a floor",
     "scene.json:1: malformed comment; expecting '/' or '*' after '/'"},
    {"open block comment", "// a floor", "/* a floor",
     "scene.json:10: malformed comment; missing closing '*/'"},
    {"text after the end", "", "{}\n{}", "scene.json:2: expected nothing after the outermost value, got '{'"},
    {"duplicate key", "\"rounds\": 2", "\"rounds\": 2, \"rounds\": 3",
     "scene.json:3: duplicate key \"rounds\", first given in line 3"},
    {"duplicate material", "\"materials\": {", "\"materials\": {\"white\": {\"type\": \"mirror\"},\n   ",
     "scene.json:6: duplicate key \"white\", first given in line 5"},
    {"empty object", "", "{}", "scene.json:1: /camera: expected an object, got nothing; the key is required"},
    {"no camera", "\"camera\": {\"position\": [0, 1, 5], \"target\": [0, 0, 0], \"fov\": 40},", "",
     "scene.json:1: /camera: expected an object, got nothing; the key is required"},
    {"no objects", "", "{\"camera\": {\"position\": [0, 1, 5], \"target\": [0, 0, 0], \"fov\": 40}}",
     "scene.json:1: /objects: expected a list of at least 1 object, got nothing; the key is required"},
    {"empty list of objects", "",
     "{\"camera\": {\"position\": [0, 1, 5], \"target\": [0, 0, 0], \"fov\": 40}, \"objects\": []}",
     "scene.json:1: /objects: expected a list of at least 1 object, got a list of 0"},
    {"objects is an object", "",
     "{\"camera\": {\"position\": [0, 1, 5], \"target\": [0, 0, 0], \"fov\": 40}, \"objects\": {}}",
     "scene.json:1: /objects: expected a list of at least 1 object, got an object"},
    {"object is a number", "{\"type\": \"rectangle\", \"material\": \"white\"}", "7",
     "scene.json:7: /objects/0: expected an object, got 7"},
    {"misspelt key", "\"radius\"", "\"raduis\"",
     "scene.json:8: /objects/1/raduis: unknown key \"raduis\"; did you mean \"radius\"?"},
    {"unknown key at the top", "\"width\"", "\"colour_depth\"",
     "scene.json:2: /colour_depth: unknown key \"colour_depth\"; use one of \"path\", \"width\", \"height\", "
     "\"sample\", \"max_depth\", \"Na\", \"Ng\", \"thread_num\", \"stack_size\", \"camera\", \"renderer\", "
     "\"materials\", \"objects\", \"lights\" or \"medium\""},
    {"unknown key with odd characters", "\"radius\": 1", "\"ra/di~us\\n\": 1",
     "scene.json:8: /objects/1/ra~1di~0us?: unknown key \"ra/di~us\\n\"; did you mean \"radius\"?"},
    {"unknown key in a vector", "[0, 0, 0]", "{\"x\": 0, \"y\": 0, \"z\": 0, \"w\": 0}",
     "scene.json:4: /camera/target/w: unknown key \"w\"; use one of \"x\", \"y\" or \"z\""},
    {"component missing", "[0, 0, 0]", "{\"x\": 0, \"y\": 0}",
     "scene.json:4: /camera/target/z: expected a number from -1e12 to 1e12, got nothing; the key is "
     "required"},
    {"missing radius", "\"radius\": 1, ", "",
     "scene.json:8: /objects/1/radius: expected a positive number from 1e-12 to 1e12, got nothing; the key "
     "is required"},
    {"missing object type", "\"type\": \"rectangle\", ", "",
     "scene.json:7: /objects/0/type: expected \"sphere\", \"plane\", \"disk\", \"bezier_rotate\", "
     "\"cylinder\", \"rectangle\", \"box\" or \"mesh\", got nothing; the key is required"},
    {"unknown object type", "\"rectangle\"", "\"rectangel\"",
     "scene.json:7: /objects/0/type: expected \"sphere\", \"plane\", \"disk\", \"bezier_rotate\", "
     "\"cylinder\", \"rectangle\", \"box\" or \"mesh\", got \"rectangel\"; did you mean \"rectangle\"?"},
    {"object type of another program", "\"rectangle\"", "\"torus\"",
     "scene.json:7: /objects/0/type: expected \"sphere\", \"plane\", \"disk\", \"bezier_rotate\", "
     "\"cylinder\", \"rectangle\", \"box\" or \"mesh\", got \"torus\""},
    {"key of another object", "\"type\": \"rectangle\"", "\"type\": \"rectangle\", \"radius\": 1",
     "scene.json:7: /objects/0/radius: unknown key \"radius\"; use one of \"type\", \"transform\", "
     "\"motion\", \"texture\" or \"material\""},
};

}  // namespace causticl
