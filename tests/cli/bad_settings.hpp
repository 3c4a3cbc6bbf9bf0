// Scenes that must be refused: picture, renderer and camera.
#pragma once

#include "bad_scene.hpp"

namespace causticl {

inline constexpr BadScene bad_settings[] = {
    {"zero width", "\"width\": 64", "\"width\": 0",
     "scene.json:2: /width: expected an integer from 1 to 268435456, got 0"},
    {"negative height", "\"height\": 48", "\"height\": -48",
     "scene.json:2: /height: expected an integer from 1 to 268435456, got -48"},
    {"fraction of a pixel", "\"width\": 64", "\"width\": 64.5",
     "scene.json:2: /width: expected an integer from 1 to 268435456, got 64.5"},
    {"width as a string", "\"width\": 64", "\"width\": \"64\"",
     "scene.json:2: /width: expected an integer from 1 to 268435456, got \"64\""},
    {"too many pixels", "\"width\": 64, \"height\": 48", "\"width\": 100000, \"height\": 100000",
     "scene.json:2: /height: expected at most 2^28 pixels, got 100000x100000"},
    {"integer beyond 64 bits", "\"width\": 64", "\"width\": 123456789012345678901234567890",
     "scene.json:2: /width: expected an integer from 1 to 268435456, got 123456789012345678901234567890"},
    {"zero depth", "\"width\": 64", "\"max_depth\": 0",
     "scene.json:2: /max_depth: expected an integer from 1 to 100000, got 0"},
    {"Na of zero", "\"width\": 64", "\"Na\": 0",
     "scene.json:2: /Na: expected a refractive index from 0.01 to 100, got 0"},
    {"thread_num as a string", "\"width\": 64", "\"thread_num\": \"all\"",
     "scene.json:2: /thread_num: expected an integer from 0 to 9007199254740992, got \"all\""},
    {"output is a number", "\"width\": 64", "\"path\": 1", "scene.json:2: /path: expected a string, got 1"},
    {"sample beside renderer", "\"width\": 64", "\"sample\": 64",
     "scene.json:2: /sample: expected \"sample\" inside \"renderer\", got it beside"},
    {"renderer is a string", "{\"type\": \"sppm\", \"rounds\": 2}", "\"sppm\"",
     "scene.json:3: /renderer: expected an object, got \"sppm\""},
    {"unknown integrator", "\"sppm\"", "\"bdpt\"",
     "scene.json:3: /renderer/type: expected \"sppm\" or \"pt\", got \"bdpt\""},
    {"alpha of 1", "\"rounds\": 2", "\"alpha\": 1",
     "scene.json:3: /renderer/alpha: expected a number between 0 and 1, both excluded, got 1"},
    {"negative alpha", "\"rounds\": 2", "\"alpha\": -0.7",
     "scene.json:3: /renderer/alpha: expected a number between 0 and 1, both excluded, got -0.7"},
    {"negative radius of search", "\"rounds\": 2", "\"radius\": -1",
     "scene.json:3: /renderer/radius: expected a positive number from 1e-12 to 1e12, got -1"},
    {"radius of indirect light below that of the rest", "\"rounds\": 2", "\"indirect_radius\": 0.5",
     "scene.json:3: /renderer/indirect_radius: expected a number from 1 to 100, got 0.5"},
    {"radius_decay above 1", "\"rounds\": 2", "\"radius_decay\": 1.5",
     "scene.json:3: /renderer/radius_decay: expected a number from 1e-6 to 1, got 1.5"},
    {"no photons", "\"rounds\": 2", "\"photon_sample\": 0",
     "scene.json:3: /renderer/photon_sample: expected an integer from 1 to 1073741824, got 0"},
    {"too many photons", "\"rounds\": 2", "\"photon_sample\": 1e15",
     "scene.json:3: /renderer/photon_sample: expected an integer from 1 to 1073741824, got 1e15"},
    {"unknown schedule", "\"rounds\": 2", "\"schedule\": \"pixels\"",
     "scene.json:3: /renderer/schedule: expected \"pixel\", \"global\" or \"geometric\", got \"pixels\"; did "
     "you mean \"pixel\"?"},
    {"unknown direct light", "\"rounds\": 2", "\"direct_light\": true",
     "scene.json:3: /renderer/direct_light: expected \"shadow_rays\" or \"photons\", got true"},
    {"too many visible points",
     "\"width\": 64, \"height\": 48,\n  \"renderer\": {\"type\": \"sppm\", \"rounds\": 2}",
     "\"width\": 16384, \"height\": 16384,\n  \"renderer\": {\"view_point_sample\": 64}",
     "scene.json:3: /renderer: expected at most 2^31 visible points in a pass, got 16384x16384 pixels with "
     "64"},
    {"disc light without radius", "\"rounds\": 2", "\"light_pos\": [0, 5, 0]",
     "scene.json:3: /renderer/light_r: expected a value, got nothing; the key is required; a disc light "
     "needs \"light_pos\" and \"light_r\""},
    {"disc light of radius 0", "\"rounds\": 2", "\"light_pos\": [0, 5, 0], \"light_r\": 0",
     "scene.json:3: /renderer/light_r: expected a positive number from 1e-12 to 1e12, got 0"},
    {"negative light", "\"rounds\": 2",
     "\"light_pos\": [0, 5, 0], \"light_r\": 1, \"light_radiance\": [1, -1, 1]",
     "scene.json:3: /renderer/light_radiance/1: expected a number from 0 to 1e12, got -1"},
    {"camera is null", "{\"position\": [0, 1, 5], \"target\": [0, 0, 0], \"fov\": 40}", "null",
     "scene.json:4: /camera: expected an object, got null"},
    {"camera without a form", "{\"position\": [0, 1, 5], \"target\": [0, 0, 0], \"fov\": 40}",
     "{\"fov\": 40}",
     "scene.json:4: /camera: expected \"position\", \"target\" and \"fov\", or \"origin\", \"direct\" and "
     "\"view_angle_scale\", got neither"},
    {"both camera forms", "\"fov\": 40", "\"fov\": 40, \"plane_distance\": 1",
     "scene.json:4: /camera/plane_distance: key \"plane_distance\" does not belong to a camera with "
     "\"position\" and \"target\"; use the keys of one form only"},
    {"camera without fov", ", \"fov\": 40", "",
     "scene.json:4: /camera/fov: expected degrees from 0.001 to 179.9, got nothing; the key is required"},
    {"fov of 180", "\"fov\": 40", "\"fov\": 180",
     "scene.json:4: /camera/fov: expected degrees from 0.001 to 179.9, got 180"},
    {"negative aperture", "\"fov\": 40", "\"fov\": 40, \"aperture\": -1",
     "scene.json:4: /camera/aperture: expected a number from 0 to 1e12, got -1"},
    {"focus at the lens", "\"fov\": 40", "\"fov\": 40, \"focus_distance\": 0",
     "scene.json:4: /camera/focus_distance: expected a positive number from 1e-12 to 1e12, got 0"},
    {"target at position", "[0, 0, 0]", "[0, 1, 5]",
     "scene.json:4: /camera/target: expected a point other than `position`, got the same"},
    {"up along the view", "\"fov\": 40", "\"fov\": 40, \"up\": [0, -2, -10]",
     "scene.json:4: /camera/up: expected a direction off the line of sight, got one along it or of length 0"},
    {"default up along the view", "[0, 1, 5]", "[0, 1, 0]",
     "scene.json:4: /camera/up: expected a direction off the line of sight, got one along it or of length 0; "
     "the default is [0, 1, 0]"},
    {"up of length 0", "\"fov\": 40", "\"fov\": 40, \"up\": [0, 0, 0]",
     "scene.json:4: /camera/up: expected a direction off the line of sight, got one along it or of length 0"},
    {"shutter that closes first", "\"fov\": 40", "\"fov\": 40, \"shutter\": [1, 0.5]",
     "scene.json:4: /camera/shutter/1: expected the shutter to close no earlier than it opens, got an "
     "earlier time"},
    {"shutter of one time", "\"fov\": 40", "\"fov\": 40, \"shutter\": [1]",
     "scene.json:4: /camera/shutter: expected a list of 2 times, at which the shutter opens and closes, got "
     "a list of 1"},
    {"direct of length 0", "{\"position\": [0, 1, 5], \"target\": [0, 0, 0], \"fov\": 40}",
     "{\"origin\": [0, 0, 5], \"direct\": [0, 0, 0], \"view_angle_scale\": 0.5}",
     "scene.json:4: /camera/direct: expected a direction, got a vector of length 0"},
    {"direct along x", "{\"position\": [0, 1, 5], \"target\": [0, 0, 0], \"fov\": 40}",
     "{\"origin\": [0, 0, 5], \"direct\": [2, 0, 0], \"view_angle_scale\": 0.5}",
     "scene.json:4: /camera/direct: expected a direction off the x axis, which is the film's horizontal, got "
     "one along it"},
    {"direct without scale", "{\"position\": [0, 1, 5], \"target\": [0, 0, 0], \"fov\": 40}",
     "{\"origin\": [0, 0, 5], \"direct\": [0, 0, -1]}",
     "scene.json:4: /camera/view_angle_scale: expected a positive number from 1e-5 to 1e4, got nothing; the "
     "key is required"},
    {"aperture without focus", "{\"position\": [0, 1, 5], \"target\": [0, 0, 0], \"fov\": 40}",
     "{\"origin\": [0, 0, 5], \"direct\": [0, 0, -1], \"view_angle_scale\": 0.5, \"focal_distance\": 0, "
     "\"aperture\": 1}",
     "scene.json:4: /camera/focal_distance: expected a positive number, got 0; a lens with an aperture needs "
     "a focus"},
    {"position too far", "[0, 1, 5]", "[0, 1, 1e30]",
     "scene.json:4: /camera/position/2: expected a number from -1e12 to 1e12, got 1e30"},
};

}  // namespace causticl
