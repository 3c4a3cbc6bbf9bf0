// Files that a scene names: found beside it, read once.
#include <algorithm>
#include <filesystem>

#include "base/error.hpp"
#include "format/asset_file.hpp"
#include "format/scene_loader.hpp"
#include "mesh/mesh_orientation.hpp"

namespace causticl {
namespace {

namespace fs = std::filesystem;

// Beside the scene file first, so that a scene moves with its assets; then in the working directory.
std::string find_asset(const SceneValue& json, const std::string& scene_file) {
  const std::string path = json.string();
  if (path.empty() || path.find('\0') != std::string::npos) json.fail_expected("the path of a file");
  std::error_code status;
  const fs::path beside = fs::path(scene_file).parent_path() / path;
  for (const fs::path& candidate : {beside, fs::path(path)}) {
    if (!fs::exists(candidate, status)) continue;
    if (const std::string fault = asset_fault(candidate); !fault.empty()) json.fail_expected("a file", fault);
    return candidate.lexically_normal().string();
  }
  const bool absolute = fs::path(path).is_absolute();
  json.fail_expected(
      "a file that exists",
      absolute ? "" : "relative paths are looked up beside the scene file, then in the working directory");
}

// The same, noted in the scene.
std::string resolve(const SceneValue& json, Scene& scene) {
  std::string file = find_asset(json, scene.file);
  if (std::find(scene.assets.begin(), scene.assets.end(), file) == scene.assets.end())
    scene.assets.push_back(file);
  return file;
}

// The index of `file` in `list`, read by `read` at the first mention; its error gets the place of the
// mention.
template <typename Key, typename Item, typename Read>
int load_once(std::map<Key, int>& known, const Key& key, std::vector<Item>& list, const SceneNode& json,
              Read read) {
  const auto [entry, is_new] = known.try_emplace(key, static_cast<int>(list.size()));
  if (!is_new) return entry->second;
  try {
    list.push_back(read());
  } catch (const UserError& error) {
    json.fail(error.what());
  }
  return entry->second;
}

}  // namespace

int SceneLoader::image(const SceneValue& json, bool srgb) {
  const std::string file = resolve(json, scene);
  return load_once(images, {file, srgb}, scene.images, json, [&] {
    Image image = read_image(file, srgb, image_limits);
    image_limits = image_limits.after(image.rgba.size() / 4);
    file_notes(json, file, image.notes);
    // Textures are reflectances, also where their format holds brighter values.
    bool outside = false;
    for (float& value : image.rgba) {
      outside = outside || !(value >= 0 && value <= 1);
      value = value >= 0 ? std::min(value, 1.0f) : 0.0f;
    }
    if (outside) notice(json, "texels below 0 or above 1 are taken as 0 and 1");
    return image;
  });
}

Image SceneLoader::radiance_map(const SceneValue& json) {
  const std::string file = resolve(json, scene);
  Image image;
  try {
    image = read_image(file, true, image_limits);
    image_limits = image_limits.after(image.rgba.size() / 4);
  } catch (const UserError& error) {
    json.fail(error.what());
  }
  file_notes(json, file, image.notes);
  std::size_t bad = 0;
  for (std::size_t texel = 0; texel < image.rgba.size(); texel += 4) {
    const auto rgb = image.rgba.begin() + static_cast<std::ptrdiff_t>(texel);
    const bool good = std::all_of(rgb, rgb + 3, [](float value) {
      return value >= 0 && static_cast<double>(value) <= non_negative_number.high;
    });
    if (good) continue;
    std::fill_n(rgb, 3, 0.0f);
    ++bad;
  }
  if (bad > 0)
    notice(json, std::to_string(bad) + (bad == 1 ? " texel that is" : " texels that are") +
                     " not from 0 to 1e12, or no number, " + (bad == 1 ? "is" : "are") + " taken as black");
  return image;
}

int SceneLoader::mesh(const SceneValue& json) {
  const std::string file = resolve(json, scene);
  return load_once(meshes, file, scene.meshes, json, [&] {
    Mesh mesh = read_mesh(file);
    file_notes(json, file, mesh.notes);
    return mesh;
  });
}

int SceneLoader::mesh_of_glass(const SceneNode& object, int mesh) {
  const auto [entry, is_new] = turned_meshes.try_emplace(mesh, mesh);
  if (!is_new) return entry->second;
  auto turned = turned_outwards(scene.meshes[static_cast<std::size_t>(mesh)]);
  if (!turned) return mesh;
  file_notes(object, turned->file,
             {"closed parts of it are wound inwards; as glass they are turned outwards"});
  entry->second = static_cast<int>(scene.meshes.size());
  scene.meshes.push_back(std::move(*turned));
  return entry->second;
}

void SceneLoader::file_notes(const SceneNode& where, const std::string& file,
                             const std::vector<std::string>& notes) {
  for (const std::string& note : notes) notice(where, file + ": " + note);
}

void SceneLoader::notice(const SceneNode& where, const std::string& text) {
  if (said.insert(text).second) scene.notices.push_back(one_line(where.place() + ": " + text));
}

}  // namespace causticl
