// One render of a study, measured as it goes.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "image/image.hpp"
#include "study/study.hpp"
#include "study/study_store.hpp"

namespace causticl {

/// Where a render of a study stands after a pass.
struct RenderState {
  double seconds, last_pass;  // of all passes so far, and of the last
  const StudyRun& run;        // what has been measured
};

/// Asked after each pass: whether to stop.
using StopAsked = std::function<bool(const RenderState&)>;

struct MeasuredRender {
  StudyRun run;
  Picture picture;
  double first_radius = 0;  // sppm
  double pass_seconds = 0;
  std::uint64_t passes = 0;
  double seconds = 0;  // in all
};

class StudyRenderer {
 public:
  /// Renders as the request has it, in pictures of this size.
  StudyRenderer(const StudyRequest& request, KernelCache& kernels, std::pair<int, int> size);

  /// Renders a setting until `stop` says so, as `causticl render` would with its words, and compares it
  /// with `reference` (if not null) after passes 1, 2, 3, 4, 6, 8, ... and at the end. The kernels of a
  /// setting that comes up first are warmed up by a pass that does not count.
  MeasuredRender render(const StudySetting& setting, std::uint32_t seed, const Picture* reference,
                        const StopAsked& stop);

  /// What is rendered with these changes. Throws UserError for a scene that the integrator cannot render.
  RenderSetup setup_of(const RenderChange& change);

 private:
  const StudyRequest& request_;
  KernelCache& kernels_;
  SceneOptions scene_options_;
  std::map<std::optional<Integrator>, Scene> scenes_;  // as read for each integrator
  std::vector<std::string> warm_;                      // kernels that have run
};

}  // namespace causticl
