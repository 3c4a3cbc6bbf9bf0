// The command line: what the user asked for, checked, and what it changes in a scene.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "format/load_scene.hpp"
#include "opencl/device.hpp"
#include "render/render.hpp"
#include "scene/scene.hpp"
#include "selftest/selftest.hpp"
#include "study/study.hpp"

namespace causticl {

struct Options {
  enum class Command { render, compare, devices, explain, info, schema, study, selftest, print };
  Command command = Command::print;
  std::string text;  // Command::print: the help or version that was asked for

  std::string scene;  // file; render, explain and info
  SceneOptions scene_options;

  std::vector<std::string> outputs;  // empty: the scene says
  std::optional<int> passes, samples;
  std::optional<std::int64_t> photons;
  std::optional<double> time_limit;    // seconds
  std::optional<double> wanted_error;  // a fraction
  double confidence = 0.9;
  bool layers = false;
  std::uint32_t seed = 1;
  Precision precision = Precision::float32;
  std::string device;    // as find_device takes it
  unsigned threads = 0;  // 0: all
  TriangleTest triangle_test = TriangleTest::watertight;
  std::string effects = "auto";  // render: what the kernels are compiled for
  std::string kernel_dir, dump_kernels;
  bool keep_kernels = true;  // from one run to the next
  bool quiet = false, stats = false;
  std::string stats_json;  // file; empty: none

  std::string picture, reference;  // files; compare
  std::string error_map;           // file; empty: none

  StudyOptions study;
  SelftestOptions selftest;
  bool measure = false;  // explain
  std::string json;      // file for what explain, selftest or compare found; empty: none
};

/// Reads the command line. Throws UserError, of one line, for whatever is not understood.
Options parse_options(int argc, const char* const* argv);

}  // namespace causticl
