#include "study/study_inputs.hpp"

#include <xxhash.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/error.hpp"
#include "opencl/kernel_sources.hpp"
#include "scene/integrators.hpp"

namespace causticl {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const std::string& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) throw UserError(file + ": cannot be read: no regular file");
  std::ifstream in(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in) throw UserError(file + ": cannot be read");
  return bytes;
}

std::string hash_of(const std::map<std::string, std::string>& sources) {
  std::string hash;
  for (const auto& [name, text] : sources) hash = content_hash(text, content_hash(name, hash));
  return hash;
}

}  // namespace

std::string content_hash(const std::string& bytes, const std::string& before) {
  // The length before the rest keeps "ab" after "c" apart from "b" after "ca".
  const std::string all = std::to_string(before.size()) + ":" + before + bytes;
  const XXH128_hash_t hash = XXH3_128bits(all.data(), all.size());
  char text[33];
  std::snprintf(text, sizeof text, "%016llx%016llx", static_cast<unsigned long long>(hash.high64),
                static_cast<unsigned long long>(hash.low64));
  return text;
}

std::string file_hash(const std::string& file) { return content_hash(bytes_of(file)); }

std::string scene_hash_of(const Scene& scene) {
  std::string hash = file_hash(scene.file);
  for (const auto& file : scene.assets) hash = content_hash(bytes_of(file), content_hash(file, hash));
  return hash;
}

std::string kernels_hash(const std::string& kernel_dir) {
  std::map<std::string, std::string> sources;
  if (kernel_dir.empty()) return hash_of(embedded_kernel_sources());
  std::error_code error;
  for (const auto& entry : fs::recursive_directory_iterator(kernel_dir, error)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".cl" || extension == ".h")
      sources[fs::relative(entry.path(), kernel_dir).string()] = bytes_of(entry.path().string());
  }
  return hash_of(sources);
}

std::vector<std::string> deciding_options(const StudyRequest& request) {
  std::vector<std::string> words;
  if (request.scene_options.integrator) {
    words.push_back("--integrator");
    words.push_back(name_of(*request.scene_options.integrator));
  }
  std::vector<std::string> parameters = request.study.parameters;
  std::sort(parameters.begin(), parameters.end());
  for (const auto& parameter : parameters) {
    words.push_back("--knobs");
    words.push_back(parameter);
  }
  words.push_back("--seeds");
  words.push_back(std::to_string(request.study.seeds));
  if (!request.render.kernel_dir.empty()) {
    words.push_back("--kernel-dir");
    words.push_back(request.render.kernel_dir);
  }
  words.push_back("kernels:" + kernels_hash(request.render.kernel_dir));
  return words;
}

}  // namespace causticl
