// One render of a study, measured as it goes.
#pragma once

#include <functional>
#include <string>
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
  /// Renders as the request has it; `words` of the command line go with every render.
  StudyRenderer(const StudyRequest& request, KernelCache& kernels, std::vector<std::string> words);

  /// Renders a setting until `stop` says so, as `causticl render` would with these words, and compares it
  /// with `reference` (if not null) after passes 1, 2, 3, 4, 6, 8, ... and at the end. The kernels of a
  /// setting that comes up first are warmed up by a pass that does not count.
  MeasuredRender render(const StudySetting& setting, std::uint32_t seed, const Picture* reference,
                        const StopAsked& stop);

  /// What `causticl render` renders with these words besides.
  RenderSetup setup_of(const std::vector<std::string>& words) const;

 private:
  const StudyRequest& request_;
  KernelCache& kernels_;
  std::vector<std::string> words_;
  std::vector<std::string> warm_;  // kernels that have run
};

}  // namespace causticl
