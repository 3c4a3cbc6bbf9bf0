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

std::array<double, 2> read_scale(const SceneObject& json) {
  const auto found = json.find("scale");
  if (!found) return {1, 1};
  if (found->is(JsonValue::Kind::number)) {
    const double factor = found->alternative(0).number();
    return {factor, factor};
  }
  const auto items = found->alternative(1).items();
  return {items[0].number(), items[1].number()};
}

// A texture object in the place of a colour. Images made for looking at are sRGB, hence that default; files
// of floats are linear whatever it says.
int read_color_texture(const SceneObject& json, SceneLoader& loader) {
  TextureSpec texture;
  texture.pointer = json.pointer();
  texture.kind = static_cast<TextureSpec::Kind>(json.type());
  if (texture.kind == TextureSpec::Kind::image) {
    texture.bilinear = json.word("filter") == "bilinear";
    texture.scale = read_scale(json);
    texture.image = loader.image(json.at("path"), json.word("color_space") == "srgb");
  } else {
    texture.a = json.color("a");
    texture.b = json.color("b");
    texture.scale = read_scale(json);
  }
  return add_texture(texture, loader);
}

// n = A + B / wavelength^2, with the wavelength in micrometres.
void read_cauchy(const SceneValue& json, MaterialSpec& material) {
  const auto items = json.items();
  material.ior = items[0].number();
  material.dispersion = items[1].number();
}

void read_color_key(const SceneObject& json, MaterialSpec& material, SceneLoader& loader) {
  const auto color = json.find("color");
  if (!color) return;
  const SceneValue texture = color->alternative(1);
  if (texture.mentions("type"))
    material.color_texture = read_color_texture(texture.object(), loader);
  else
    material.color = color->alternative(0).color();
}

int read_material(const SceneValue& value, SceneLoader& loader) {
  const SceneObject json = value.object();
  MaterialSpec material;
  material.pointer = json.pointer();
  material.kind = static_cast<MaterialSpec::Kind>(json.type());
  material.emission = json.color("emission");
  material.two_sided = json.boolean("two_sided");
  if (json.knows("color")) read_color_key(json, material, loader);
  if (json.knows("eta")) material.eta = json.color("eta");
  if (json.knows("k")) material.k = json.color("k");
  if (json.knows("absorption")) material.absorption = json.color("absorption");
  if (json.knows("priority")) material.priority = json.integer("priority");
  if (json.knows("roughness")) material.roughness = json.number("roughness");
  if (json.knows("diffuse_roughness")) material.diffuse_roughness = json.number("diffuse_roughness");
  material.ior = json.knows("ior") ? json.number("ior", loader.glass_ior) : loader.glass_ior;
  if (json.knows("cauchy"))
    if (const auto cauchy = json.find("cauchy")) read_cauchy(*cauchy, material);
  return add_material(material, loader);
}

// cg_tracing took any colour; above 1 a surface would reflect more than it receives.
Color read_base_color(const SceneValue& json, SceneLoader& loader) {
  const Color color = json.color();
  if (max_component(color) <= 1) return color;
  loader.notice(json, "reflectance above 1 is taken as 1");
  return {std::fmin(color.x, 1), std::fmin(color.y, 1), std::fmin(color.z, 1)};
}

}  // namespace

int read_base_texture(const SceneValue& value, Object::Shape shape, SceneLoader& loader) {
  const SceneObject json = value.object();
  MaterialSpec material;
  material.pointer = json.pointer();
  material.ior = loader.glass_ior;
  material.two_sided = true;
  material.kind = json.choice<MaterialSpec::Kind>("material");
  if (json.type() == 0) {  // "raw"
    material.color = read_base_color(json.at("color"), loader);
    material.emission = json.color("emission");
    return add_material(material, loader);
  }

  TextureSpec texture;
  const double width_ratio = json.number("width_ratio"), height_ratio = json.number("height_ratio");
  texture.image = loader.image(json.at("path"), json.word("color_space") == "srgb");
  if (shape == Object::Shape::plane) {
    const Image& image = loader.scene.images[static_cast<std::size_t>(texture.image)];
    texture.scale = {1 / (width_ratio * image.width), 1 / (height_ratio * image.height)};
  }
  material.alpha_diffuse = shape == Object::Shape::sphere || shape == Object::Shape::bezier;
  material.color_texture = add_texture(texture, loader);
  return add_material(material, loader);
}

void read_named_materials(const SceneValue& json, SceneLoader& loader) {
  for (const auto& [name, value] : json.members())
    loader.named_materials[name] = read_material(value, loader);
}

int read_material_of(const SceneValue& json, SceneLoader& loader) {
  if (json.is(JsonValue::Kind::object)) return read_material(json.alternative(1), loader);
  if (!json.is(JsonValue::Kind::string)) json.fail_expected("the name of a material, or an object");
  const std::string wanted = json.alternative(0).string();
  const auto found = loader.named_materials.find(wanted);
  if (found != loader.named_materials.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [name, index] : loader.named_materials)
    if (names.size() < 100) names.push_back(name);
  json.fail_expected("the name of a material",
                     names.empty() ? "the scene has no \"materials\"" : suggestion(wanted, names));
}

}  // namespace causticl
