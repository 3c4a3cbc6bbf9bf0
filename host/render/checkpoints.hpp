// When outputs are rewritten while passes go on.
#pragma once

#include <cstdint>

#include "scene/scene.hpp"

namespace causticl {

/// SPPM: at passes 1, 2, 4, ... 64, and then every 64 or every 30 seconds, whichever is later. Path tracing:
/// every 30 seconds.
class Checkpoints {
 public:
  explicit Checkpoints(Integrator integrator) : integrator_(integrator) {}

  /// Asked after each pass, `seconds` after the first began. The early ones are left out where writing, which
  /// takes `write_seconds`, would be over a tenth of the time since the last.
  bool due(std::uint64_t pass, double seconds, double write_seconds) {
    const bool sppm = integrator_ == Integrator::sppm;
    const double since = seconds - last_seconds_;
    const bool early = sppm && pass <= 64 && (pass & (pass - 1)) == 0 && since >= 10 * write_seconds;
    const bool regular = (!sppm || pass - last_pass_ >= 64) && since >= 30;
    if (!early && !regular) return false;
    last_seconds_ = seconds;
    last_pass_ = pass;
    return true;
  }

 private:
  Integrator integrator_;
  double last_seconds_ = 0;
  std::uint64_t last_pass_ = 0;
};

}  // namespace causticl
