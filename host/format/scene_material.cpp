// Textures and materials: the base format's `texture`, and `materials` with colours that may be textures.
#include "format/scene_loader.hpp"

namespace causticl {
namespace {

int add_texture(const TextureSpec& texture, SceneLoader& loader) {
  loader.scene.textures.push_back(texture);
  return static_cast<int>(loader.scene.textures.size()) - 1;
}

int add_material(const MaterialSpec& material, SceneLoader& loader) {
  loader.scene.materials.push_back(material);
  return static_cast<int>(loader.scene.materials.size()) - 1;
}

std::array<double, 2> read_scale(const JsonReader& json) {
  const auto found = json.find("scale");
  if (!found) return {1, 1};
  if (found->value().kind == JsonValue::Kind::number) {
    const double factor = found->number();
    if (factor == 0) found->fail_expected("a number other than 0");
    return {factor, factor};
  }
  const auto items = found->items(2, 2, "numbers, of u and of v");
  std::array<double, 2> scale;
  for (int i = 0; i < 2; ++i) {
    scale[i] = items[i].number();
    if (scale[i] == 0) items[i].fail_expected("a number other than 0");
  }
  return scale;
}

// A texture object in the place of a colour. Images made for looking at are sRGB, hence that default; files
// of floats are linear whatever it says.
int read_color_texture(const JsonReader& json, SceneLoader& loader) {
  TextureSpec texture;
  if (json.at("type").choice({"image", "checker"}) == 0) {
    json.check_keys({"type", "path", "color_space", "scale", "filter"});
    texture.kind = TextureSpec::Kind::image;
    const auto color_space = json.find("color_space");
    const bool srgb = !color_space || color_space->choice({"srgb", "linear"}) == 0;
    if (const auto filter = json.find("filter"))
      texture.bilinear = filter->choice({"nearest", "bilinear"}) == 1;
    texture.scale = read_scale(json);
    texture.image = loader.image(json.at("path"), srgb);
  } else {
    json.check_keys({"type", "a", "b", "scale"});
    texture.kind = TextureSpec::Kind::checker;
    texture.a = read_color(json.at("a"), unit_number);
    texture.b = read_color(json.at("b"), unit_number);
    texture.scale = read_scale(json);
  }
  return add_texture(texture, loader);
}

// n = A + B / wavelength^2, with the wavelength in micrometres.
void read_cauchy(const JsonReader& json, const JsonReader& material_json, MaterialSpec& material) {
  if (material_json.has("ior")) json.fail("expected \"ior\" or \"cauchy\", got both");
  const auto items = json.items(2, 2, "numbers, A and B of the index A + B / wavelength^2");
  material.ior = items[0].number({1, 100, "an index A from 1 to 100"});
  material.dispersion = items[1].number({0, 1, "B from 0 to 1 square micrometre"});
}

int read_material(const JsonReader& json, SceneLoader& loader) {
  if (json.value().kind != JsonValue::Kind::object) json.fail_expected("an object");
  using Kind = MaterialSpec::Kind;
  MaterialSpec material;
  material.pointer = json.pointer();
  material.kind =
      static_cast<Kind>(json.at("type").choice({"diffuse", "mirror", "glass", "conductor", "plastic"}));
  if (material.kind == Kind::conductor) {
    json.check_keys({"type", "eta", "k", "emission", "two_sided", "roughness"});
    material.eta = read_color(json.at("eta"), refractive_index);
    material.k = read_color(json.at("k"), extinction_coefficient);
  } else if (material.kind == Kind::glass) {
    json.check_keys(
        {"type", "color", "emission", "two_sided", "ior", "cauchy", "absorption", "roughness", "priority"});
    material.priority = static_cast<int>(json.integer("priority", 0, -1000000, 1000000));
    material.absorption = read_color(json, "absorption", {}, non_negative_number);
  } else if (material.kind == Kind::plastic) {
    json.check_keys({"type", "color", "emission", "two_sided", "ior", "roughness"});
  } else {
    json.check_keys({"type", "color", "emission", "two_sided"});
  }
  if (const auto color = json.find("color")) {
    if (color->has("type"))
      material.color_texture = read_color_texture(*color, loader);
    else
      material.color = read_color(*color, unit_number);
  }
  material.emission = read_color(json, "emission", {}, non_negative_number);
  material.two_sided = json.boolean("two_sided", false);
  material.ior = json.number("ior", loader.glass_ior, refractive_index);
  if (const auto cauchy = json.find("cauchy")) read_cauchy(*cauchy, json, material);
  material.roughness = json.number("roughness", 0, unit_number);
  return add_material(material, loader);
}

MaterialSpec::Kind read_base_kind(const JsonReader& json) {
  return static_cast<MaterialSpec::Kind>(json.at("material").choice({"diffuse", "specular", "refractive"}));
}

// cg_tracing took any colour; above 1 a surface would reflect more than it receives.
Color read_base_color(const JsonReader& json, SceneLoader& loader) {
  const Color color = read_color(json, non_negative_number);
  if (max_component(color) <= 1) return color;
  loader.notice(json, "reflectance above 1 is taken as 1");
  return {std::fmin(color.x, 1), std::fmin(color.y, 1), std::fmin(color.z, 1)};
}

}  // namespace

int read_base_texture(const JsonReader& json, Object::Shape shape, SceneLoader& loader) {
  if (json.value().kind != JsonValue::Kind::object) json.fail_expected("an object");
  MaterialSpec material;
  material.pointer = json.pointer();
  material.ior = loader.glass_ior;
  material.two_sided = true;
  if (json.at("type").choice({"raw", "image"}) == 0) {
    json.check_keys({"type", "emission", "color", "material"});
    material.kind = read_base_kind(json);
    material.color = read_base_color(json.at("color"), loader);
    material.emission = read_color(json, "emission", {}, non_negative_number);
    return add_material(material, loader);
  }

  json.check_keys({"type", "path", "material", "width_ratio", "height_ratio", "color_space"});
  material.kind = read_base_kind(json);
  TextureSpec texture;
  const auto color_space = json.find("color_space");
  const bool srgb = color_space && color_space->choice({"linear", "srgb"}) == 1;
  const double width_ratio = json.number("width_ratio", 1, positive_number);
  const double height_ratio = json.number("height_ratio", 1, positive_number);
  texture.image = loader.image(json.at("path"), srgb);
  if (shape == Object::Shape::plane) {
    const Image& image = loader.scene.images[static_cast<std::size_t>(texture.image)];
    texture.scale = {1 / (width_ratio * image.width), 1 / (height_ratio * image.height)};
  }
  material.alpha_diffuse = shape == Object::Shape::sphere || shape == Object::Shape::bezier;
  material.color_texture = add_texture(texture, loader);
  return add_material(material, loader);
}

void read_named_materials(const JsonReader& json, SceneLoader& loader) {
  for (const auto& [name, value] : json.members())
    loader.named_materials[name] = read_material(value, loader);
}

int read_material_of(const JsonReader& json, SceneLoader& loader) {
  if (json.value().kind == JsonValue::Kind::object) return read_material(json, loader);
  if (json.value().kind != JsonValue::Kind::string)
    json.fail_expected("the name of a material, or an object");
  const auto found = loader.named_materials.find(json.string());
  if (found != loader.named_materials.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [name, index] : loader.named_materials)
    if (names.size() < 100) names.push_back(name);
  json.fail_expected("the name of a material",
                     names.empty() ? "the scene has no \"materials\"" : suggestion(json.string(), names));
}

}  // namespace causticl
