// Renders of a fraction of a second, and what the tests of the binary ask of a finished run.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "catch2.hpp"
#include "process.hpp"
#include "temporary_folder.hpp"

namespace causticl {

using Words = std::vector<std::string>;
namespace fs = std::filesystem;

inline const std::string cornell_box = CAUSTICL_SOURCE_DIR "/scenes/cornell_box.json";
// An ICD loader that looks here finds no platform: what succeeds then, or fails otherwise, asked for no
// device.
inline const std::vector<std::pair<std::string, std::string>> no_device{{"OCL_ICD_VENDORS", "/nonexistent"}};

inline Words operator+(Words a, const Words& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// A render of a fraction of a second on the device that the tests run on.
inline Words small_render(const Words& more = {}, const std::string& scene = cornell_box,
                          int photons = 2000) {
  Words words{"render", scene, "--size", "16x12", "--photons", std::to_string(photons)};
  if (const char* device = std::getenv("CAUSTICL_DEVICE")) words = words + Words{"--device", device};
  return words + more;
}

// Far more passes than any test waits for.
inline const Words endless{"--passes", "1000000"};

inline std::vector<std::string> names_in(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// One line of error, and nothing else.
inline void check_one_error(const Finished& run, int exit_code, const std::string& part) {
  CAPTURE(run.errors);
  CHECK(run.exit_code == exit_code);
  CHECK(run.output.empty());
  CHECK_THAT(run.errors,
             Catch::StartsWith("causticl: error: ") && Catch::Contains(part) && Catch::EndsWith("\n"));
  CHECK(std::count(run.errors.begin(), run.errors.end(), '\n') == 1);
}

inline void check_success(const Finished& run) {
  CAPTURE(run.errors);
  REQUIRE(run.exit_code == 0);
}

}  // namespace causticl
