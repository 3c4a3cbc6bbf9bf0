// Files that a scene names: found beside it, read once.
#include <algorithm>
#include <filesystem>

#include "base/error.hpp"
#include "format/json_reader.hpp"
#include "format/scene_builder.hpp"
#include "mesh/mesh_orientation.hpp"

namespace causticl {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const SourceLocation& where, const std::string& message) {
  throw UserError(one_line(where.text() + ": " + message));
}

[[noreturn]] void fail_expected(const AssetName& asset, const std::string& expected,
                                const std::string& hint = "") {
  fail(asset.where,
       "expected " + expected + ", got " + json_quote(asset.name) + (hint.empty() ? "" : "; " + hint));
}

// Beside the scene file first, so that a scene moves with its assets; then in the working directory.
std::string find_asset(const AssetName& asset, const std::string& scene_file) {
  const std::string& path = asset.name;
  if (path.empty() || path.find('\0') != std::string::npos) fail_expected(asset, "the path of a file");
  std::error_code status;
  const fs::path beside = fs::path(scene_file).parent_path() / path;
  for (const fs::path& candidate : {beside, fs::path(path)}) {
    if (!fs::exists(candidate, status)) continue;
    if (const std::string fault = asset_fault(candidate); !fault.empty())
      fail_expected(asset, "a file", fault);
    return candidate.lexically_normal().string();
  }
  const bool absolute = fs::path(path).is_absolute();
  fail_expected(
      asset, "a file that exists",
      absolute ? "" : "relative paths are looked up beside the scene file, then in the working directory");
}

// The same, noted in the scene.
std::string resolve(const AssetName& asset, Scene& scene) {
  std::string file = find_asset(asset, scene.file);
  if (std::find(scene.assets.begin(), scene.assets.end(), file) == scene.assets.end())
    scene.assets.push_back(file);
  return file;
}

// The index of `file` in `list`, read by `read` at the first mention; its error gets the place of the
// mention.
template <typename Key, typename Item, typename Read>
int load_once(std::map<Key, int>& known, const Key& key, std::vector<Item>& list, const SourceLocation& where,
              Read read) {
  const auto [entry, is_new] = known.try_emplace(key, static_cast<int>(list.size()));
  if (!is_new) return entry->second;
  try {
    list.push_back(read());
  } catch (const UserError& error) {
    fail(where, error.what());
  }
  return entry->second;
}

}  // namespace

int SceneBuilder::image(const AssetName& asset, bool srgb) {
  const std::string file = resolve(asset, scene);
  return load_once(images, {file, srgb}, scene.images, asset.where, [&] {
    Image image = read_image(file, srgb, image_limits);
    image_limits = image_limits.after(image.rgba.size() / 4);
    file_notes(asset.where, file, image.notes);
    // Textures are reflectances, also where their format holds brighter values.
    bool outside = false;
    for (float& value : image.rgba) {
      outside = outside || !(value >= 0 && value <= 1);
      value = value >= 0 ? std::min(value, 1.0f) : 0.0f;
    }
    if (outside) notice(asset.where, "texels below 0 or above 1 are taken as 0 and 1");
    return image;
  });
}

Image SceneBuilder::radiance_map(const AssetName& asset) {
  const std::string file = resolve(asset, scene);
  Image image;
  try {
    image = read_image(file, true, image_limits);
    image_limits = image_limits.after(image.rgba.size() / 4);
  } catch (const UserError& error) {
    fail(asset.where, error.what());
  }
  file_notes(asset.where, file, image.notes);
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
    notice(asset.where, std::to_string(bad) + (bad == 1 ? " texel that is" : " texels that are") +
                            " not from 0 to 1e12, or no number, " + (bad == 1 ? "is" : "are") +
                            " taken as black");
  return image;
}

int SceneBuilder::mesh(const AssetName& asset) {
  const std::string file = resolve(asset, scene);
  return load_once(meshes, file, scene.meshes, asset.where, [&] {
    Mesh mesh = read_mesh(file);
    file_notes(asset.where, file, mesh.notes);
    return mesh;
  });
}

int SceneBuilder::mesh_of_glass(const SourceLocation& object, int mesh) {
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

void SceneBuilder::file_notes(const SourceLocation& where, const std::string& file,
                              const std::vector<std::string>& notes) {
  for (const std::string& note : notes) notice(where, file + ": " + note);
}

void SceneBuilder::notice(const SourceLocation& where, const std::string& text) {
  if (said.insert(text).second) scene.notices.push_back(one_line(where.text() + ": " + text));
}

}  // namespace causticl
