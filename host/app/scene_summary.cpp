// What a scene holds, in words and numbers.
#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>

#include "app/report.hpp"
#include "base/printable.hpp"
#include "base/spelling.hpp"
#include "format/scene_output.hpp"
#include "integrators/integrators.hpp"
#include "scene/dielectrics.hpp"
#include "scene/integrators.hpp"
#include "scene/light_kind.hpp"
#include "scene/material_kind.hpp"
#include "scene/object_bounds.hpp"
#include "scene/shape_kind.hpp"
#include "world/view_check.hpp"

namespace causticl {
namespace {

constexpr std::size_t longest_list = 10;  // lines that one part may take

std::string triple(Vec3 v) {
  std::ostringstream text;
  text << "(" << v.x << ", " << v.y << ", " << v.z << ")";
  return text.str();
}

void print_image(std::ostream& text, const Scene& scene) {
  text << "image       " << scene.width << " x " << scene.height << " pixels";
  if (!scene.output.empty()) text << ", to " << scene_output(scene).file;
  text << "\n";
}

void print_integrator(std::ostream& text, const Scene& scene) {
  text << "integrator  " << name_of(scene.renderer.integrator) << ": " << integrator_text(scene.renderer);
  if (scene.renderer.sampler == Sampler::independent) text << ", independent numbers";
  text << "; at most " << counted(static_cast<std::size_t>(scene.max_depth), "surface hit") << " a path\n";
}

void print_camera(std::ostream& text, const CameraSpec& camera) {
  constexpr double degrees = 57.29577951308232;
  text << "camera      at " << triple(camera.origin) << " toward " << triple(camera.axis)
       << ", vertical field of view " << 2 * std::atan(length(camera.up) / 2) * degrees << " degrees";
  if (camera.plane_distance != 0) text << ", rays start " << camera.plane_distance << " ahead";
  if (camera.aperture > 0)
    text << ", lens radius " << camera.aperture << ", sharp at " << camera.focal_distance;
  text << "\n";
}

void print_objects(std::ostream& text, const Scene& scene) {
  std::map<std::string, std::size_t> shapes;
  for (const auto& object : scene.objects) ++shapes[name_of(object.shape)];
  text << "objects     " << scene.objects.size();
  const char* separator = ": ";
  for (const auto& [shape, number] : shapes) {
    text << separator << counted(number, shape);
    separator = ", ";
  }
  text << "\n";

  std::size_t triangles = 0;
  std::map<int, std::size_t> uses;  // of each mesh
  for (const auto& object : scene.objects) {
    if (object.mesh < 0) continue;
    ++uses[object.mesh];
    triangles += scene.meshes[static_cast<std::size_t>(object.mesh)].triangles();
  }
  for (const auto& [index, number] : uses) {
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(index)];
    text << "  mesh      " << printable_line(mesh.file) << ": " << counted(mesh.triangles(), "triangle");
    if (number > 1) text << ", used " << number << " times";
    text << "\n";
  }
  if (uses.size() > 1) text << "  in all    " << counted(triangles, "triangle") << "\n";
}

void print_motion(std::ostream& text, const Scene& scene) {
  if (!has_motion(scene)) return;
  const auto moving = std::count_if(scene.objects.begin(), scene.objects.end(),
                                    [](const Object& object) { return length(object.motion) > 0; });
  text << "  moving    " << moving << ", shutter from " << scene.camera.shutter[0] << " to "
       << scene.camera.shutter[1] << "\n";
}

void print_medium(std::ostream& text, const MediumSpec& medium) {
  if (!(max_component(medium.absorption + medium.scattering) > 0)) return;
  text << "medium      absorption " << triple(medium.absorption) << ", scattering "
       << triple(medium.scattering) << " per unit length, g " << medium.g << "\n";
}

void print_materials(std::ostream& text, const Scene& scene) {
  std::map<std::string, std::size_t> kinds;
  for (const auto& material : scene.materials) ++kinds[name_of(material.kind)];
  text << "materials   " << scene.materials.size();
  const char* separator = ": ";
  for (const auto& [kind, number] : kinds) {
    text << separator << number << " " << kind;
    separator = ", ";
  }
  text << "\ntextures    " << scene.textures.size() << "\n";
  for (const auto& texture : scene.textures) {
    if (texture.kind == TextureSpec::Kind::checker) {
      text << "  checker   of " << triple(texture.a) << " and " << triple(texture.b) << "\n";
      continue;
    }
    const Image& image = scene.images[static_cast<std::size_t>(texture.image)];
    text << "  image     " << printable_line(image.file) << ": " << image.width << " x " << image.height
         << (texture.bilinear ? ", bilinear" : ", nearest") << "\n";
  }
}

std::string light_line(const LightSpec& light) {
  const LightRow& row = row_of(light.kind);
  std::ostringstream text;
  text << light.pointer << ": " << row.text;
  if ((row.keys & CONE_KEY) != 0) text << " of " << light.angle << " degrees";
  if ((row.keys & DIRECTION_KEY) != 0) text << " toward " << triple(light.direction);
  if ((row.keys & POSITION_KEY) != 0) text << " at " << triple(light.position);
  if ((row.keys & INTENSITY_KEY) != 0) text << ", intensity " << triple(light.intensity);
  if ((row.keys & IRRADIANCE_KEY) != 0) text << ", irradiance " << triple(light.intensity);
  if (light.map.rgba.empty()) return text.str();
  if (light.object >= 0) text << ",";
  if (!light.map.file.empty()) text << " " << printable_line(light.map.file) << ",";
  text << " " << light.map.width << " x " << light.map.height << " texels";
  return text.str();
}

void print_emitters(std::ostream& text, const Scene& scene) {
  std::vector<std::string> lines;
  for (const auto& object : scene.objects) {
    const MaterialSpec& material = scene.materials[static_cast<std::size_t>(object.material)];
    if (!is_lit(scene, object) || material.light >= 0) continue;
    lines.push_back(object.pointer + ": " + (object.is_disc_light ? "disc light" : name_of(object.shape)) +
                    ", radiance " + triple(material.emission) + (material.two_sided ? ", both sides" : ""));
  }
  for (const LightSpec& light : scene.lights)
    if (is_lit(light)) lines.push_back(light_line(light));
  text << "emitters    " << lines.size() << "\n";
  for (std::size_t i = 0; i < std::min(lines.size(), longest_list); ++i) text << "  " << lines[i] << "\n";
  if (lines.size() > longest_list) text << "  and " << lines.size() - longest_list << " more\n";
}

void print_bounds(std::ostream& text, const Scene& scene) {
  BoundingBox bounds;
  for (const auto& object : scene.objects) bounds.add(object_bounds(scene, object));
  text << "bounds      ";
  if (bounds.empty())
    text << "none: every object is infinite\n";
  else
    text << triple(bounds.low) << " to " << triple(bounds.high) << ", infinite planes apart\n";
}

}  // namespace

std::string scene_summary(const Scene& scene) {
  std::ostringstream text;
  text << "scene       " << printable_line(scene.file) << "\n";
  print_image(text, scene);
  print_integrator(text, scene);
  print_camera(text, scene.camera);
  print_objects(text, scene);
  print_motion(text, scene);
  print_materials(text, scene);
  print_medium(text, scene.medium);
  print_emitters(text, scene);
  print_bounds(text, scene);
  for (const auto& line : find_dielectrics(scene).lines)
    text << "dielectrics " << printable_line(line) << "\n";
  for (const auto& notice : scene.notices) text << "note        " << printable_line(notice) << "\n";
  const std::string empty_view = empty_view_notice(scene);
  if (!empty_view.empty()) text << "note        " << empty_view << "\n";
  return text.str();
}

}  // namespace causticl
