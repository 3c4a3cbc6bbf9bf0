// `causticl study`: what accuracy costs in time on one scene, for every parameter that trades one for the
// other.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "format/load_scene.hpp"
#include "render/render.hpp"

namespace causticl {

class KernelCache;

/// A render as data.
struct RenderSetup {
  Scene scene;
  RenderOptions options;
};

/// What `study` is told besides the scene and the device.
struct StudyOptions {
  std::vector<std::string> parameters;  // names; empty: all
  double budget = 300;                  // seconds in all
  int seeds = 3;                        // renders of a setting, as far as the budget allows
  std::string folder;                   // -o; empty: the scene's name with -study in the working directory
  std::string reference;                // a picture to measure errors against; empty: the study makes its own
  bool restart = false;                 // throw away what the folder holds
};

/// A study as the command line describes it.
struct StudyRequest {
  std::string scene;  // file
  SceneOptions scene_options;
  StudyOptions study;
  RenderOptions render;  // of every render; its seed is that of the first of each setting
  std::string device;    // as find_device takes it
};

struct StudyOutcome {
  std::string summary;  // lines for the user
  bool interrupted = false;
};

/// Measures, writing study.json and study.csv into the folder after every render, and study.html at the end
/// or when interrupted() says so. A study that the folder holds already is continued. `say` gets each line
/// that tells how it goes. Throws UserError, also for a folder that holds another study.
StudyOutcome run_study(const StudyRequest& request, KernelCache& kernels,
                       const std::function<void(const std::string&)>& say,
                       const std::function<bool()>& interrupted);

}  // namespace causticl
