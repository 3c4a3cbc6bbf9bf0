// The command line: what the user asked for, checked, and what it changes in a scene.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "format/load_scene.hpp"
#include "opencl/device.hpp"
#include "render/render.hpp"
#include "scene/scene.hpp"
#include "selftest/selftest.hpp"
#include "study/study.hpp"

namespace CLI {
class App;
}

namespace causticl {

/// An option that replaces what the scene's renderer says.
struct RendererOption {
  std::string name;                      // "--passes"
  std::vector<std::string> integrators;  // that have a use for it
  std::function<void(RendererSpec&)> apply;
};

/// What --crop was given: pixels, or where there is a decimal point fractions of the picture.
struct CropText {
  std::array<double, 4> edge;  // left, top, right, bottom
  bool is_fraction;
};

/// What the user asked for. Values that others use stand where they take them from.
struct Options {
  enum class Command { render, merge, compare, devices, explain, info, schema, study, selftest, print };
  Command command = Command::print;
  std::string text;  // Command::print: the help or version that was asked for

  std::string scene;  // file; render, explain, info and study
  SceneOptions scene_options;
  std::vector<RendererOption> renderer_options;

  RenderOptions render;                       // without outputs where the scene says them
  std::string checkpoint, film;               // files; empty: none
  std::optional<double> checkpoint_interval;  // seconds
  std::optional<CropText> crop;
  std::string device;        // as find_device takes it
  bool keep_kernels = true;  // from one run to the next
  bool quiet = false, stats = false;
  std::string stats_json;  // file; empty: none

  std::vector<std::string> films;  // files; merge

  std::string picture, reference;  // files; compare
  std::string error_map;           // file; empty: none

  StudyOptions study;
  SelftestOptions selftest;
  bool measure = false;  // explain
  std::string json;      // file for what explain, selftest or compare found; empty: none
};

/// The commands and their options, bound to `options`, which must outlive it.
std::unique_ptr<CLI::App> command_line(Options& options);

/// Reads the command line. Throws UserError, of one line, for whatever is not understood.
Options parse_options(int argc, const char* const* argv);

}  // namespace causticl
