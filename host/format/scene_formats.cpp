#include "format/scene_formats.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "base/error.hpp"
#include "base/printable.hpp"
#include "base/spelling.hpp"

namespace causticl {
namespace {

namespace fs = std::filesystem;

bool has_extension(const SceneFormat& format, const std::string& extension) {
  return std::find(format.extensions.begin(), format.extensions.end(), extension) != format.extensions.end();
}

std::string beginning_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::string bytes(4096, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
  return bytes;
}

/// "CaustiCL JSON (.json) or glTF (.gltf, .glb)".
std::string known_formats(const std::vector<SceneFormat>& formats) {
  std::vector<std::string> names;
  for (const SceneFormat& format : formats)
    names.push_back(std::string(format.name) + " (" + joined(format.extensions, ", ") + ")");
  return listed(names);
}

}  // namespace

const std::vector<SceneFormat>& scene_formats() {
  static const std::vector<SceneFormat> formats{
      {"CaustiCL JSON", {".json"}, is_json_scene, load_json_scene},
  };
  return formats;
}

const SceneFormat& scene_format_of(const std::string& file, const std::vector<SceneFormat>& formats) {
  const std::string extension = lower(fs::path(file).extension().string());
  std::vector<const SceneFormat*> fitting;
  for (const SceneFormat& format : formats)
    if (has_extension(format, extension)) fitting.push_back(&format);
  if (fitting.size() == 1) return *fitting.front();
  std::error_code unreadable;
  if (!fs::is_regular_file(file, unreadable)) return fitting.empty() ? formats.front() : *fitting.front();
  const std::string beginning = beginning_of(file);
  if (fitting.empty())
    for (const SceneFormat& format : formats) fitting.push_back(&format);
  for (const SceneFormat* format : fitting)
    if (format->begins_so(beginning)) return *format;
  throw UserError(printable_line(file) + ": is no scene of a known format; expected " +
                  known_formats(formats));
}

Scene load_scene(const std::string& file, const SceneOptions& options) {
  return scene_format_of(file).load(file, options);
}

}  // namespace causticl
