// Scenes that must be refused: lights.
#pragma once

#include "bad_scene.hpp"

namespace causticl {

inline constexpr BadScene bad_lights[] = {
    {"lights as an object", "\"width\": 64", "\"lights\": {}",
     "scene.json:2: /lights: expected a list of lights, got an object"},
    {"light as a number", "\"width\": 64", "\"lights\": [1]",
     "scene.json:2: /lights/0: expected an object, got 1"},
    {"unknown light", "\"width\": 64", "\"lights\": [{\"type\": \"sun\"}]",
     "scene.json:2: /lights/0/type: expected \"point\", \"spot\", \"directional\", \"disk\", "
     "\"rectangle\" or \"environment\", got \"sun\""},
    {"point light with radiance", "\"width\": 64",
     "\"lights\": [{\"type\": \"point\", \"position\": [0, 1, 0], \"radiance\": [1, 1, 1]}]",
     "scene.json:2: /lights/0/radiance: unknown key \"radiance\"; use one of \"type\", \"position\" or "
     "\"intensity\""},
    {"point light without intensity", "\"width\": 64",
     "\"lights\": [{\"type\": \"point\", \"position\": [0, 1, 0]}]",
     "scene.json:2: /lights/0/intensity: expected a colour, got nothing; the key is required; write [r, g, "
     "b], {\"x\": r, \"y\": g, \"z\": b}, or one number for grey"},
    {"negative intensity", "\"width\": 64",
     "\"lights\": [{\"type\": \"point\", \"position\": [0, 1, 0], \"intensity\": [1, -1, 1]}]",
     "scene.json:2: /lights/0/intensity/1: expected a number from 0 to 1e12, got -1"},
    {"spot at its target", "\"width\": 64",
     "\"lights\": [{\"type\": \"spot\", \"position\": [0, 1, 0], \"target\": [0, 1, 0], \"angle\": 30, "
     "\"intensity\": [1, 1, 1]}]",
     "scene.json:2: /lights/0/target: expected a point other than `position`, got the same"},
    {"spot wider than a half space", "\"width\": 64",
     "\"lights\": [{\"type\": \"spot\", \"position\": [0, 1, 0], \"target\": [0, 0, 0], \"angle\": 200, "
     "\"intensity\": [1, 1, 1]}]",
     "scene.json:2: /lights/0/angle: expected degrees from 0.01 to 180, of the whole cone, got 200"},
    {"spot without angle", "\"width\": 64",
     "\"lights\": [{\"type\": \"spot\", \"position\": [0, 1, 0], \"target\": [0, 0, 0], \"intensity\": [1, "
     "1, 1]}]",
     "scene.json:2: /lights/0/angle: expected degrees from 0.01 to 180, of the whole cone, got nothing; the "
     "key is required"},
    {"blend above 1", "\"width\": 64",
     "\"lights\": [{\"type\": \"spot\", \"position\": [0, 1, 0], \"target\": [0, 0, 0], \"angle\": 20, "
     "\"blend\": 2, "
     "\"intensity\": [1, 1, 1]}]",
     "scene.json:2: /lights/0/blend: expected a number from 0 to 1, got 2; 2% is written 0.02"},
    {"directional light without direction", "\"width\": 64",
     "\"lights\": [{\"type\": \"directional\", \"direction\": [0, 0, 0], \"irradiance\": [1, 1, 1]}]",
     "scene.json:2: /lights/0/direction: expected a direction, got a vector of length 0"},
    {"disk light without normal", "\"width\": 64",
     "\"lights\": [{\"type\": \"disk\", \"position\": [0, 1, 0], \"radius\": 1, \"radiance\": [1, 1, 1]}]",
     "scene.json:2: /lights/0/normal: expected a vector, got nothing; the key is required; write [x, y, z] "
     "or "
     "{\"x\": x, \"y\": y, \"z\": z}"},
    {"rectangle light of two numbers that are no size", "\"width\": 64",
     "\"lights\": [{\"type\": \"rectangle\", \"position\": [0, 1, 0], \"normal\": [0, -1, 0], \"size\": [1, "
     "0], "
     "\"radiance\": 1}]",
     "scene.json:2: /lights/0/size/1: expected a positive number from 1e-12 to 1e12, got 0"},
    {"rectangle light whose up is its normal", "\"width\": 64",
     "\"lights\": [{\"type\": \"rectangle\", \"position\": [0, 1, 0], \"normal\": [0, -1, 0], \"up\": [0, 2, "
     "0], "
     "\"size\": [1, 1], \"radiance\": 1}]",
     "scene.json:2: /lights/0/up: expected a direction across `normal`, got one along it"},
    {"environment of nothing", "\"width\": 64", "\"lights\": [{\"type\": \"environment\"}]",
     "scene.json:2: /lights/0: expected \"path\" or \"radiance\", got neither"},
    {"environment of both", "\"width\": 64",
     "\"lights\": [{\"type\": \"environment\", \"path\": \"intact.png\", \"radiance\": [1, 1, 1]}]",
     "scene.json:2: /lights/0: expected \"path\" or \"radiance\", got both"},
    {"two environments", "\"width\": 64",
     "\"lights\": [{\"type\": \"environment\", \"path\": \"intact.png\"}, {\"type\": \"environment\", "
     "\"radiance\": [1, 1, 1]}]",
     "scene.json:2: /lights/1: expected one environment, got a second beside /lights/0"},
    {"environment that does not exist", "\"width\": 64",
     "\"lights\": [{\"type\": \"environment\", \"path\": \"sky.exr\"}]",
     "scene.json:2: /lights/0/path: expected a file that exists, got \"sky.exr\"; relative paths are looked "
     "up beside "
     "the scene file, then in the working directory"},
    {"environment that is cut short", "\"width\": 64",
     "\"lights\": [{\"type\": \"environment\", \"path\": \"cut.exr\"}]",
     "scene.json:2: /lights/0/path: cut.exr: cannot be decoded: the file ends early; is it truncated?"},
};

}  // namespace causticl
