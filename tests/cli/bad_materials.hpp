// Scenes that must be refused: materials and textures.
#pragma once

#include "bad_scene.hpp"

namespace causticl {

inline constexpr BadScene bad_materials[] = {
    {"missing material", "\"material\": \"white\"", "\"material\": \"whit\"",
     "scene.json:7: /objects/0/material: expected the name of a material, got \"whit\"; did you mean "
     "\"white\"?"},
    {"no table of materials",
     "\"materials\": {\"white\": {\"type\": \"diffuse\", \"color\": [0.8, 0.8, 0.8]}},\n", "\n",
     "scene.json:7: /objects/0/material: expected the name of a material, got \"white\"; the scene has no "
     "\"materials\""},
    {"material that names itself",
     "\"materials\": {\"white\": {\"type\": \"diffuse\", \"color\": [0.8, 0.8, 0.8]}}",
     "\"materials\": {\"white\": \"white\"}",
     "scene.json:5: /materials/white: expected an object, got \"white\""},
    {"materials that name each other", "\"materials\": {",
     "\"materials\": {\"grey\": \"gray\", \"gray\": \"grey\",\n   ",
     "scene.json:5: /materials/grey: expected an object, got \"gray\""},
    {"material and texture", "\"material\": \"white\"",
     "\"material\": \"white\", \"texture\": {\"type\": \"raw\", \"color\": [1, 1, 1], \"material\": "
     "\"diffuse\"}",
     "scene.json:7: /objects/0/material: expected \"material\" or \"texture\", got both"},
    {"neither material nor texture", ", \"material\": \"white\"", "",
     "scene.json:7: /objects/0: expected \"material\" or \"texture\", got neither"},
    {"material is a number", "\"material\": \"white\"", "\"material\": 0",
     "scene.json:7: /objects/0/material: expected the name of a material, or an object, got 0"},
    {"unknown material type", "\"diffuse\", \"color\"", "\"difuse\", \"color\"",
     "scene.json:5: /materials/white/type: expected \"diffuse\", \"mirror\", \"glass\", \"conductor\", "
     "\"plastic\", \"thin_glass\" or \"oren_nayar\", got \"difuse\"; did you mean \"diffuse\"?"},
    {"conductor with a colour", "\"diffuse\", \"color\"",
     "\"conductor\", \"eta\": [1, 1, 1], \"k\": [3, 3, 3], \"color\"",
     "scene.json:5: /materials/white/color: unknown key \"color\"; use one of \"type\", \"eta\", \"k\", "
     "\"emission\", \"two_sided\" or \"roughness\""},
    {"conductor without k", "\"diffuse\", \"color\"", "\"conductor\", \"eta\"",
     "scene.json:5: /materials/white/k: expected a colour, got nothing; the key is required; write [r, g, "
     "b], {\"x\": r, \"y\": g, \"z\": b}, or one number for grey"},
    {"negative k", "\"diffuse\", \"color\"", "\"conductor\", \"k\": [1, -1, 1], \"eta\"",
     "scene.json:5: /materials/white/k/1: expected an extinction coefficient from 0 to 100, got -1"},
    {"roughness above 1", "\"diffuse\", \"color\"", "\"plastic\", \"roughness\": 1.5, \"color\"",
     "scene.json:5: /materials/white/roughness: expected a number from 0 to 1, got 1.5"},
    {"roughness of a mirror", "\"diffuse\", \"color\"", "\"mirror\", \"roughness\": 0.1, \"color\"",
     "scene.json:5: /materials/white/roughness: unknown key \"roughness\"; use one of \"type\", \"color\", "
     "\"emission\" or \"two_sided\""},
    {"ior of a mirror", "\"diffuse\", \"color\"", "\"mirror\", \"ior\": 1.5, \"color\"",
     "scene.json:5: /materials/white/ior: unknown key \"ior\"; use one of \"type\", \"color\", \"emission\" "
     "or \"two_sided\""},
    {"negative ior", "\"diffuse\", \"color\"", "\"glass\", \"ior\": -1.5, \"color\"",
     "scene.json:5: /materials/white/ior: expected a refractive index from 0.01 to 100, got -1.5"},
    {"colour above 1", "[0.8, 0.8, 0.8]", "[0.8, 1.2, 0.8]",
     "scene.json:5: /materials/white/color/1: expected a number from 0 to 1, got 1.2"},
    {"negative colour", "[0.8, 0.8, 0.8]", "[0.8, -0.1, 0.8]",
     "scene.json:5: /materials/white/color/1: expected a number from 0 to 1, got -0.1"},
    {"colour by name", "[0.8, 0.8, 0.8]", "\"white\"",
     "scene.json:5: /materials/white/color: expected a colour, got \"white\"; write [r, g, b], {\"x\": r, "
     "\"y\": g, \"z\": b}, or one number for grey"},
    {"negative emission", "\"emission\": [1, 1, 1]", "\"emission\": [1, 1, -1]",
     "scene.json:8: /objects/1/material/emission/2: expected a number from 0 to 1e12, got -1"},
    {"two_sided as a number", "\"emission\": [1, 1, 1]", "\"emission\": [1, 1, 1], \"two_sided\": 1",
     "scene.json:8: /objects/1/material/two_sided: expected true or false, got 1"},
    {"infinite light in sppm", "\"type\": \"sphere\", \"radius\": 1", "\"type\": \"plane\"",
     "scene.json:8: /objects/1: an infinite light has no power to emit; use a rectangle or the integrator "
     "\"pt\""},
    {"negative scattering", "\"width\": 64", "\"medium\": {\"scattering\": [0.1, -0.1, 0.1]}, \"width\": 64",
     "scene.json:2: /medium/scattering/1: expected a number from 0 to 1e12, got -0.1"},
    {"medium with g of 1", "\"width\": 64", "\"medium\": {\"g\": 1}, \"width\": 64",
     "scene.json:2: /medium/g: expected a mean cosine from -0.99 to 0.99, got 1"},
    {"medium with an unknown key", "\"width\": 64", "\"medium\": {\"density\": 1}, \"width\": 64",
     "scene.json:2: /medium/density: unknown key \"density\"; use one of \"absorption\", \"scattering\" or "
     "\"g\""},
    {"medium as a number", "\"width\": 64", "\"medium\": 0.1, \"width\": 64",
     "scene.json:2: /medium: expected an object, got 0.1"},
    {"medium under a sky", "\"width\": 64",
     "\"medium\": {\"absorption\": [1, 1, 1]}, \"lights\": [{\"type\": \"environment\", \"radiance\": [1, 1, "
     "1]}], "
     "\"width\": 64",
     "scene.json:2: /medium: expected no environment and no directional light beside a medium, which "
     "swallows light "
     "from infinitely far, got one; use a large disk or a point light"},
    {"negative absorption", "\"diffuse\", \"color\"", "\"glass\", \"absorption\": [0, -1, 0], \"color\"",
     "scene.json:5: /materials/white/absorption/1: expected a number from 0 to 1e12, got -1"},
    {"absorption of a mirror", "\"diffuse\", \"color\"", "\"mirror\", \"absorption\": [0, 1, 0], \"color\"",
     "scene.json:5: /materials/white/absorption: unknown key \"absorption\"; use one of \"type\", \"color\", "
     "\"emission\" or \"two_sided\""},
    {"cauchy beside ior", "\"diffuse\", \"color\"",
     "\"glass\", \"ior\": 1.5, \"cauchy\": [1.5, 0.01], \"color\"",
     "scene.json:5: /materials/white/cauchy: expected \"ior\" or \"cauchy\", got both"},
    {"cauchy below 1", "\"diffuse\", \"color\"", "\"glass\", \"cauchy\": [0.9, 0.01], \"color\"",
     "scene.json:5: /materials/white/cauchy/0: expected an index A from 1 to 100, got 0.9"},
    {"cauchy in square nanometres", "\"diffuse\", \"color\"", "\"glass\", \"cauchy\": [1.5, 4200], \"color\"",
     "scene.json:5: /materials/white/cauchy/1: expected B from 0 to 1 square micrometre, got 4200"},
    {"cauchy of one number", "\"diffuse\", \"color\"", "\"glass\", \"cauchy\": [1.5], \"color\"",
     "scene.json:5: /materials/white/cauchy: expected a list of 2 numbers, A and B of the index A + B / "
     "wavelength^2, "
     "got a list of 1"},
    {"unknown texture type", "\"material\": \"white\"", "\"texture\": {\"type\": \"noise\"}",
     "scene.json:7: /objects/0/texture/type: expected \"raw\" or \"image\", got \"noise\""},
    {"unknown base material", "\"material\": \"white\"",
     "\"texture\": {\"type\": \"raw\", \"color\": [1, 1, 1], \"material\": \"glass\"}",
     "scene.json:7: /objects/0/texture/material: expected \"diffuse\", \"specular\" or \"refractive\", got "
     "\"glass\""},
    {"base texture without colour", "\"material\": \"white\"",
     "\"texture\": {\"type\": \"raw\", \"material\": \"diffuse\"}",
     "scene.json:7: /objects/0/texture/color: expected a colour, got nothing; the key is required; write [r, "
     "g, b], {\"x\": r, \"y\": g, \"z\": b}, or one number for grey"},
    {"zero width_ratio", "\"material\": \"white\"",
     "\"texture\": {\"type\": \"image\", \"path\": \"x.png\", \"material\": \"diffuse\", \"width_ratio\": 0}",
     "scene.json:7: /objects/0/texture/width_ratio: expected a positive number from 1e-12 to 1e12, got 0"},
    {"unknown filter", "[0.8, 0.8, 0.8]", "{\"type\": \"image\", \"path\": \"x.png\", \"filter\": \"cubic\"}",
     "scene.json:5: /materials/white/color/filter: expected \"nearest\" or \"bilinear\", got \"cubic\""},
    {"unknown color space", "[0.8, 0.8, 0.8]",
     "{\"type\": \"image\", \"path\": \"x.png\", \"color_space\": \"rgb\"}",
     "scene.json:5: /materials/white/color/color_space: expected \"srgb\" or \"linear\", got \"rgb\"; did "
     "you mean \"srgb\"?"},
    {"texture scale as a text", "[0.8, 0.8, 0.8]",
     "{\"type\": \"checker\", \"a\": [0, 0, 0], \"b\": [1, 1, 1], \"scale\": \"4\"}",
     "scene.json:5: /materials/white/color/scale: expected a list of 2 numbers, of u and of v, got \"4\""},
    {"texture scale of 0", "[0.8, 0.8, 0.8]",
     "{\"type\": \"checker\", \"a\": [0, 0, 0], \"b\": [1, 1, 1], \"scale\": [4, 0]}",
     "scene.json:5: /materials/white/color/scale/1: expected a number other than 0, got 0"},
    {"checker without b", "[0.8, 0.8, 0.8]", "{\"type\": \"checker\", \"a\": [0, 0, 0]}",
     "scene.json:5: /materials/white/color/b: expected a colour, got nothing; the key is required; write [r, "
     "g, b], {\"x\": r, \"y\": g, \"z\": b}, or one number for grey"},
};

}  // namespace causticl
