// The tables of textures: those that stand for a colour, and those of the base format.
#include "format/scene_keys.hpp"
#include "scene/scene.hpp"

namespace causticl {
namespace {

using namespace types;

constexpr NumberRange texture_factor{any_number.low, any_number.high, any_number.expected, false,
                                     "a number other than 0"};

SceneKey color_space_key(const char* absent) {
  return {"color_space", choice({"srgb", "linear"}), absent, "how integers are decoded"};
}

SceneKey scale_key(const char* description) {
  return {"scale",
          either({number(texture_factor),
                  tuple("numbers, of u and of v", {number(texture_factor), number(texture_factor)})}),
          1, description};
}

const SceneTable& image_keys() {
  static const SceneTable table{
      "texture_image",
      "image",
      "image in the place of a colour",
      {{"path", file(), required, "a PNG, JPEG, BMP, TGA, HDR, PFM or EXR file"},
       color_space_key("srgb"),
       scale_key("multiplies (u, v): 2 shows the image twice"),
       {"filter", choice({"nearest", "bilinear"}), "nearest", "lookup between texels"}}};
  return table;
}

const SceneTable& checker_keys() {
  static const SceneTable table{"texture_checker",
                                "checker",
                                "checkerboard in the place of a colour",
                                {{"a", color(unit_number), required, "one colour"},
                                 {"b", color(unit_number), required, "the other colour"},
                                 scale_key("squares a unit of (u, v)")}};
  return table;
}

SceneKey base_material_key() {
  return {"material", choice({"diffuse", "specular", "refractive"}), required,
          "Lambert, mirror, or glass of index \"Ng\""};
}

const SceneTable& base_raw_keys() {
  static const SceneTable table{
      "base_texture_raw",
      "raw",
      "base format: one colour; emits on both sides",
      {{"emission", color(non_negative_number), 0, "emitted radiance"},
       {"color", color(non_negative_number), required, "reflectance; above 1 counts as 1"},
       base_material_key()}};
  return table;
}

const SceneTable& base_image_keys() {
  static const SceneTable table{
      "base_texture_image",
      "image",
      "base format: an image",
      {{"path", file(), required, "a PNG, JPEG, BMP, TGA, HDR, PFM or EXR file"},
       base_material_key(),
       {"width_ratio", number(positive_number), 1, "on a plane: width of a pixel", "scene units"},
       {"height_ratio", number(positive_number), 1, "on a plane: height of a pixel", "scene units"},
       color_space_key("linear")}};
  return table;
}

}  // namespace

ValueType color_texture_type() { return object("texture", {&image_keys, &checker_keys}); }

ValueType base_texture_type() { return object("base_texture", {&base_raw_keys, &base_image_keys}); }

}  // namespace causticl
