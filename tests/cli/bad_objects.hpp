// Scenes that must be refused: vectors, transforms and shapes.
#pragma once

#include "bad_scene.hpp"

namespace causticl {

inline constexpr BadScene bad_objects[] = {
    {"vector of two", "[0, 1, 5]", "[0, 1]",
     "scene.json:4: /camera/position: expected a vector, got a list of 2; write [x, y, z] or {\"x\": x, "
     "\"y\": y, \"z\": z}"},
    {"vector as a number", "[0, 1, 5]", "5",
     "scene.json:4: /camera/position: expected a vector, got 5; write [x, y, z] or {\"x\": x, \"y\": y, "
     "\"z\": z}"},
    {"transform is an object", "\"type\": \"rectangle\"",
     "\"type\": \"rectangle\", \"transform\": {\"type\": \"shift\", \"x\": 1, \"y\": 0, \"z\": 0}",
     "scene.json:7: /objects/0/transform: expected a list of transforms, got an object"},
    {"unknown transform", "\"type\": \"rectangle\"",
     "\"type\": \"rectangle\", \"transform\": [{\"type\": \"translate\", \"x\": 1, \"y\": 0, \"z\": 0}]",
     "scene.json:7: /objects/0/transform/0/type: expected \"shift\", \"scale\", \"rotate\", \"rotateradian\" "
     "or \"matrix\", got \"translate\""},
    {"transform without type", "\"type\": \"rectangle\"",
     "\"type\": \"rectangle\", \"transform\": [{\"x\": 1, \"y\": 0, \"z\": 0}]",
     "scene.json:7: /objects/0/transform/0/type: expected \"shift\", \"scale\", \"rotate\", \"rotateradian\" "
     "or \"matrix\", got nothing; the key is required"},
    {"shift by a text", "\"type\": \"rectangle\"",
     "\"type\": \"rectangle\", \"transform\": [{\"type\": \"shift\", \"x\": 1, \"z\": \"far\"}]",
     "scene.json:7: /objects/0/transform/0/z: expected a number from -1e12 to 1e12, got \"far\""},
    {"scale of 0", "\"type\": \"rectangle\"",
     "\"type\": \"rectangle\", \"transform\": [{\"type\": \"scale\", \"x\": 1, \"y\": 0, \"z\": 1}]",
     "scene.json:7: /objects/0/transform/0/y: expected a factor other than 0, got 0; a flat object cannot be "
     "scaled back"},
    {"scales that multiply to too much", "\"type\": \"rectangle\"",
     "\"type\": \"rectangle\", \"transform\": [{\"type\": \"scale\", \"x\": 1e9, \"y\": 1, \"z\": 1},\n      "
     "{\"type\": \"scale\", \"x\": 1e9, \"y\": 1, \"z\": 1}]",
     "scene.json:8: /objects/0/transform/1: expected the steps up to here to scale and shift by less than "
     "1e12, got more"},
    {"unknown axis", "\"type\": \"rectangle\"",
     "\"type\": \"rectangle\", \"transform\": [{\"type\": \"rotate\", \"axis\": \"w\", \"degree\": 90}]",
     "scene.json:7: /objects/0/transform/0/axis: expected \"x\", \"y\" or \"z\", got \"w\""},
    {"rotation in the wrong unit", "\"type\": \"rectangle\"",
     "\"type\": \"rectangle\", \"transform\": [{\"type\": \"rotate\", \"axis\": \"x\", \"radian\": 1}]",
     "scene.json:7: /objects/0/transform/0/radian: unknown key \"radian\"; use one of \"type\", \"axis\" or "
     "\"degree\""},
    {"ellipsoid", "\"radius\": 1",
     "\"radius\": 1, \"transform\": [{\"type\": \"scale\", \"x\": 1, \"y\": 2, \"z\": 1}]",
     "scene.json:8: /objects/1/transform: expected one factor for x, y and z, got a scale that makes the "
     "sphere an ellipsoid"},
    {"negative radius", "\"radius\": 1", "\"radius\": -1",
     "scene.json:8: /objects/1/radius: expected a positive number from 1e-12 to 1e12, got -1"},
    {"zero radius", "\"radius\": 1", "\"radius\": 0",
     "scene.json:8: /objects/1/radius: expected a positive number from 1e-12 to 1e12, got 0"},
    {"flat box", "\"type\": \"rectangle\"", "\"type\": \"box\", \"size\": [1, 0, 1]",
     "scene.json:7: /objects/0/size/1: expected a positive number from 1e-12 to 1e12, got 0"},
    {"one control point", "\"type\": \"rectangle\"", "\"type\": \"bezier_rotate\", \"point\": [[1, 0]]",
     "scene.json:7: /objects/0/point: expected a list of 2 to 17 control points, got a list of 1"},
    {"18 control points", "\"type\": \"rectangle\"",
     "\"type\": \"bezier_rotate\", \"point\": [[1, 0], [1, 1], [1, 2], [1, 3], [1, 4], [1, 5], [1, 6], [1, "
     "7], [1, 8], [1, 9], [1, 10], [1, 11], [1, 12], [1, 13], [1, 14], [1, 15], [1, 16], [1, 17]]",
     "scene.json:7: /objects/0/point: expected a list of 2 to 17 control points, got a list of 18"},
    {"curve across the axis", "\"type\": \"rectangle\"",
     "\"type\": \"bezier_rotate\", \"point\": [[1, 0], [-4, 2], [1, 4]]",
     "scene.json:7: /objects/0/point: expected a curve whose radius is nowhere negative, got one that "
     "crosses the axis"},
    {"negative end of a curve", "\"type\": \"rectangle\"",
     "\"type\": \"bezier_rotate\", \"point\": [[1, 0], [-0.001, 2]]",
     "scene.json:7: /objects/0/point: expected a curve whose radius is nowhere negative, got one that "
     "crosses the axis"},
    {"control point in space", "\"type\": \"rectangle\"",
     "\"type\": \"bezier_rotate\", \"point\": [[1, 0], [1, 2, 3]]",
     "scene.json:7: /objects/0/point/1: expected a list of 2 numbers, radius and height, got a list of 3"},
    {"curve on the axis", "\"type\": \"rectangle\"",
     "\"type\": \"bezier_rotate\", \"point\": [[0, 0], [0, 2]]",
     "scene.json:7: /objects/0/point: expected a control point off the axis, got a curve of radius 0"},
    {"curve of one place", "\"type\": \"rectangle\"",
     "\"type\": \"bezier_rotate\", \"point\": [[1, 2], [1, 2]]",
     "scene.json:7: /objects/0/point: expected control points that differ, got one point"},
    {"motion as a vector", "\"type\": \"rectangle\"", "\"type\": \"rectangle\", \"motion\": [1, 0, 0]",
     "scene.json:7: /objects/0/motion: expected an object, got a list of 3"},
    {"motion without shift", "\"type\": \"rectangle\"", "\"type\": \"rectangle\", \"motion\": {}",
     "scene.json:7: /objects/0/motion/shift: expected a vector, got nothing; the key is required; write [x, "
     "y, z] or "
     "{\"x\": x, \"y\": y, \"z\": z}"},
    {"motion that turns", "\"type\": \"rectangle\"",
     "\"type\": \"rectangle\", \"motion\": {\"rotate\": [0, 1, 0]}",
     "scene.json:7: /objects/0/motion/rotate: unknown key \"rotate\"; use \"shift\""},
};

}  // namespace causticl
