// When outputs are rewritten while passes go on.
#pragma once

#include <cstdint>

#include "scene/integrators.hpp"

namespace causticl {

/// At passes 1, 2, 4, ... 64, and then every 64 or every 30 seconds, whichever is later. Where passes are
/// samples: every 30 seconds.
class Checkpoints {
 public:
  explicit Checkpoints(Integrator integrator) : quick_passes_(passes_are_samples(integrator)) {}

  /// Asked after each pass, `seconds` after the first began. The early ones are left out where writing, which
  /// takes `write_seconds`, would be over a tenth of the time since the last.
  bool due(std::uint64_t pass, double seconds, double write_seconds) {
    const double since = seconds - last_seconds_;
    const bool early =
        !quick_passes_ && pass <= 64 && (pass & (pass - 1)) == 0 && since >= 10 * write_seconds;
    const bool regular = (quick_passes_ || pass - last_pass_ >= 64) && since >= 30;
    if (!early && !regular) return false;
    last_seconds_ = seconds;
    last_pass_ = pass;
    return true;
  }

 private:
  bool quick_passes_;
  double last_seconds_ = 0;
  std::uint64_t last_pass_ = 0;
};

}  // namespace causticl
