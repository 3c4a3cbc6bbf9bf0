// What the pass loop asks of an integrator.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "device_scene/diagnostics.hpp"
#include "film/film_file.hpp"
#include "image/image.hpp"
#include "photons/metropolis_statistics.hpp"
#include "shared/types.h"

namespace causticl {

struct Pilot;

/// What one of several devices does of every pass: of n things those from first_of(n) up to end_of(n).
struct PassFraction {
  double begin = 0, end = 1;
  std::size_t first_of(std::size_t n) const { return part(begin, n); }
  std::size_t end_of(std::size_t n) const { return part(end, n); }
  std::size_t count_of(std::size_t n) const { return end_of(n) - first_of(n); }

 private:
  static std::size_t part(double fraction, std::size_t n) {
    return static_cast<std::size_t>(fraction * static_cast<double>(n));
  }
};

/// One progressive estimator: every pass adds one estimate of every pixel to the film.
class PassIntegrator {
 public:
  virtual ~PassIntegrator() = default;

  /// Enqueues pass number `pass` (from 0). Passes run in order, from 0 or from where go_on() said.
  virtual void enqueue_pass(std::uint32_t pass) = 0;

  /// What it keeps from pass to pass beside the film; of which each device has its own pixels, if there are
  /// several. Blocks whose name ends in ".pixels" hold as many bytes of each pixel. Waits for the queue.
  virtual IntegratorState state() { return {}; }
  /// The passes up to `next_pass` have been rendered elsewhere, and left this; empty where passes before are
  /// to have no part in what follows. Before the first enqueue_pass().
  virtual void go_on(const IntegratorState&, std::uint32_t next_pass) { (void)next_pass; }
  /// Why a pass depends on the passes before it: each reason with the option that turns it off.
  virtual std::vector<std::string> depends_on_history() const { return {}; }
  /// Why a pixel depends on the others, with the option that turns it off; empty where it does not.
  virtual std::string depends_on_other_pixels() const { return ""; }

  /// From now on, only this fraction of the pixels and photons of a pass.
  void set_fraction(PassFraction fraction) { fraction_ = fraction; }

  /// Where several devices share the passes, that part of a pass on which the others wait: tracing the
  /// own photons. Waits for the device.
  virtual void trace_own_photons(std::uint32_t) {}
  /// The records of these photons.
  virtual std::vector<std::byte> photons() { return {}; }
  /// Puts those of all devices in their place.
  virtual void set_photons(const std::vector<std::vector<std::byte>>&) {}

  /// Waits for all passes enqueued so far and returns the device's counters, each summed without wrapping.
  struct Totals {
    std::uint64_t photons_emitted = 0, photons_stored_last_pass = 0, rays = 0;
    Diagnostics diagnostics;
    std::optional<MetropolisStatistics> seeds;
  };
  virtual Totals finish() = 0;

  /// What the integrator knows of every pixel beside its colour. Waits for the queue.
  virtual std::vector<Channel> channels() { return {}; }

  /// What a pilot decided, where there is one.
  virtual const Pilot* pilot() const { return nullptr; }

  /// When the first pass began on the device, and how long it ran before enqueue_pass(0).
  std::chrono::steady_clock::time_point began() const { return began_; }
  double early_seconds() const { return early_seconds_; }

  /// Device memory that grows with the number of pixels, without the film.
  virtual double bytes_per_pixel() const = 0;

 protected:
  using Clock = std::chrono::steady_clock;
  PassFraction fraction_;
  Clock::time_point began_;
  double early_seconds_ = 0;
};

/// The counters of a device, which wrap at 2^32, as totals that do not.
class CounterTotals {
 public:
  /// Counts from this reading on.
  void start_from(const Counters& now) { last_ = now; }
  /// Takes a fresh reading; at most 2^32 - 1 events of a kind may have happened since the last, and of rays
  /// any number.
  void update(const Counters& now) {
    rays += rays_of(now) - rays_of(last_);
    diagnostics.non_finite += static_cast<uint>(now.non_finite - last_.non_finite);
    diagnostics.saturated += static_cast<uint>(now.saturated - last_.saturated);
    diagnostics.unresolved += static_cast<uint>(now.unresolved - last_.unresolved);
    diagnostics.traversal_bound += static_cast<uint>(now.traversal_bound - last_.traversal_bound);
    diagnostics.media_full += static_cast<uint>(now.media_full - last_.media_full);
    diagnostics.media_left += static_cast<uint>(now.media_left - last_.media_left);
    last_ = now;
  }
  std::uint64_t rays = 0;
  Diagnostics diagnostics;

 private:
  Counters last_{};

  static std::uint64_t rays_of(const Counters& counters) {
    return std::uint64_t{counters.rays_high} << 32 | counters.rays;
  }
};

}  // namespace causticl
