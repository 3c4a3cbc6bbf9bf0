#include "format/scene_output.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "base/error.hpp"
#include "base/output_file.hpp"
#include "base/printable.hpp"
#include "format/scene_value.hpp"
#include "image/image_formats.hpp"

namespace causticl {
namespace {

namespace fs = std::filesystem;

bool is_within(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

/// Whether `folder`, as far as it exists, is a folder below the working directory also when links are
/// followed.
bool stays_within(const fs::path& folder) {
  std::error_code error;
  const fs::path base = fs::canonical(".", error);
  fs::path reached = base;
  for (const auto& part : folder) {
    reached /= part;
    const auto status = fs::symlink_status(reached, error);
    if (!fs::exists(status)) return true;  // the rest is new
    reached = fs::canonical(reached, error);
    if (error || !is_within(reached, base)) return false;
  }
  return true;
}

bool leads_out(const fs::path& path) {
  return path.is_absolute() || std::find(path.begin(), path.end(), "..") != path.end() ||
         !stays_within(path.parent_path());
}

[[noreturn]] void refuse(const std::string& file, const std::string& fault) {
  throw UserError(file + ": " + fault + "; choose where the picture goes with -o, as in -o " + file);
}

/// By its first bytes. A file without any is somebody's reserved name.
bool is_picture(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string bytes(16, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
  if (bytes.empty() && in.eof()) return true;
  const bool png = bytes.starts_with("\x89PNG\r\n\x1a\n"), jpeg = bytes.starts_with("\xff\xd8\xff");
  return png || jpeg || is_exr(bytes) || is_pfm(bytes) || bytes.starts_with("#?RADIANCE");
}

}  // namespace

std::string read_output(const SceneValue& json) {
  std::string path = json.string();
  if (path.empty()) return path;
  if (has_control_characters(path)) json.fail_expected("the name of a picture without control characters");
  const std::string name = fs::path(path).filename().string();
  if (name.empty() || name == "." || name == "..")
    json.fail_expected("the name of a picture, as in \"picture.png\"");
  return path;
}

SceneOutput scene_output(const Scene& scene) {
  if (scene.output.empty()) return {fs::path(scene.file).stem().string() + ".png", ""};
  const fs::path path = scene.output;
  if (!leads_out(path)) return {path.lexically_normal().string(), ""};
  const std::string name = path.filename().string();
  return {name, "/path: " + json_quote(scene.output, 200) +
                    " leads out of the working directory; the picture goes to " + name +
                    " in it (-o chooses another place)"};
}

void prepare_scene_output(const std::string& file) {
  const fs::path target = link_target(file);
  std::error_code error;
  if (fs::is_symlink(fs::symlink_status(file, error))) {
    const fs::path folder =
        target.is_absolute() ? target.parent_path() : fs::current_path() / target.parent_path();
    if (!is_within(fs::weakly_canonical(folder, error), fs::canonical(".", error)))
      refuse(file, "is a link that leads out of the working directory");
  }
  const auto status = fs::status(target, error);
  if (fs::exists(status) && !fs::is_directory(status)) {
    if (!fs::is_regular_file(status)) refuse(file, "is no regular file, and a scene may not write to it");
    if (!is_picture(target)) refuse(file, "exists and is no picture, so that a scene may not overwrite it");
  }
  if (!target.has_parent_path() || target.is_absolute()) return;
  fs::create_directories(target.parent_path(), error);
  if (error) throw UserError(file + ": its folder cannot be made: " + error.message());
}

}  // namespace causticl
