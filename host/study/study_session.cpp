#include "study/study_session.hpp"

#include <cctype>
#include <cmath>
#include <ctime>
#include <filesystem>

#include "base/error.hpp"
#include "base/output_file.hpp"
#include "format/load_scene.hpp"
#include "study/study_inputs.hpp"

namespace causticl {
namespace {

namespace fs = std::filesystem;

std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[16];
  std::strftime(text, sizeof text, "%Y-%m-%d", &parts);
  return text;
}

/// At most this many pixels where no --size is given: errors relative to brightness hardly depend on the
/// size, and time does.
constexpr double default_pixels = 160 * 160;

std::pair<int, int> default_size(const Scene& scene) {
  const double scale =
      std::min(1.0, std::sqrt(default_pixels / (static_cast<double>(scene.width) * scene.height)));
  const auto scaled = [&](int extent) { return std::max(1, static_cast<int>(std::lround(extent * scale))); };
  return {scaled(scene.width), scaled(scene.height)};
}

/// What a study of these options is, before anything is measured.
Study new_study(const StudyRequest& request) {
  wanted_parameters(
      request.study.parameters);  // a mistyped name should not take the seconds that scenes can take
  const Scene scene = load_scene(request.scene, request.scene_options);
  const DeviceInfo device = find_device(request.device);
  Study study;
  study.scene = request.scene;
  study.scene_hash = scene_hash_of(scene);
  study.version = CAUSTICL_VERSION;
  study.device = device.name + " (" + device.platform_name + ", " + device.driver + ")";
  std::tie(study.width, study.height) =
      request.scene_options.size ? *request.scene_options.size : default_size(scene);
  study.words = {"--size", std::to_string(study.width) + "x" + std::to_string(study.height)};
  for (const auto& [key, value] : request.scene_options.overrides) {
    study.words.push_back("-D");
    study.words.push_back(key + "=" + value);
  }
  study.options = deciding_options(request);
  study.seed = request.render.seed;
  study.threads = request.render.threads;
  const std::string& reference = request.study.reference;
  if (!reference.empty()) study.given_reference = reference + " " + file_hash(reference);
  study.date = today();
  return study;
}

/// Takes the lock of the folder. The study in the folder where it is of the same things as `wanted`, else
/// `wanted` itself.
Study open_study(const StudyRequest& request, const std::string& folder, FolderLock& folder_lock,
                 const std::function<void(const std::string&)>& say) {
  Study wanted = new_study(request);
  std::error_code error;
  fs::create_directories(fs::path(folder) / "pictures", error);
  if (error) throw UserError("-o " + folder + ": cannot be made a folder: " + error.message());
  if (!folder_lock.lock(folder))
    throw UserError(folder +
                    ": another study is at work in this folder; wait until it has ended, or choose another "
                    "folder with -o");
  for (const fs::path& part : {fs::path(folder), fs::path(folder) / "pictures"})
    remove_left_half_written(part);
  auto found = request.study.restart ? std::nullopt : read_study(folder);
  if (found) {
    const std::string difference = difference_of(*found, wanted);
    if (!difference.empty())
      throw UserError(folder + " holds a study of something else: " + difference +
                      " differs; choose another folder with -o, or throw it away with --restart");
    say("continues the study in " + folder + ", which has " + std::to_string(found->runs.size()) +
        " renders");
    return std::move(*found);
  }
  write_study(folder, wanted);  // fails now where it cannot be written
  fs::remove(fs::path(folder) / "reference.exr", error);
  fs::remove(fs::path(folder) / "study.html", error);
  return wanted;
}

}  // namespace

StudySession::StudySession(const StudyRequest& given, KernelCache& kernels,
                           std::function<void(const std::string&)> say_line,
                           std::function<bool()> is_interrupted)
    : request(given),
      say(std::move(say_line)),
      interrupted(std::move(is_interrupted)),
      folder(given.study.folder.empty() ? fs::path(given.scene).stem().string() + "-study"
                                        : given.study.folder),
      budget{given.study.budget, given.study.reference.empty()},
      study(open_study(given, folder, lock, say)),
      renderer(given, kernels, {study.width, study.height}),
      spent_before_(study.spent_seconds) {
  if (request.scene_options.integrator) own_change = integrator_change(*request.scene_options.integrator);
}

double StudySession::spent() const {
  return spent_before_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

std::string StudySession::path(const std::string& name) const { return (fs::path(folder) / name).string(); }

void StudySession::save() {
  study.spent_seconds = spent();
  write_study(folder, study);
}

std::string picture_name(const StudySetting& setting) {
  std::string name = setting.id();
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '_' && c != '=') c = '_';
  return "pictures/" + name.substr(0, 100) + ".exr";
}

}  // namespace causticl
