// What SPPM keeps from pass to pass, for film files.
#include "integrators/sppm.hpp"

#include "base/error.hpp"

namespace causticl {
namespace {

const char* const pixels_block = "sppm.pixels";
const std::string unguided = "; use -D renderer.guided_photons=false";

}  // namespace

IntegratorState Sppm::state() {
  IntegratorState state;
  state[pixels_block] = device_.download<std::byte>(pixels_, film_.pixels() * sizeof(SppmPixel));
  guide_.save(state);
  return state;
}

void Sppm::go_on(const IntegratorState& state, std::uint32_t next_pass) {
  if (const auto pixels = state.find(pixels_block); pixels != state.end()) {
    if (pixels->second.size() != film_.pixels() * sizeof(SppmPixel))
      throw UserError("--resume: the film does not hold the pixels of this picture; render it again");
    device_.queue().enqueueWriteBuffer(pixels_, CL_TRUE, 0, pixels->second.size(), pixels->second.data());
  }
  guide_.restore(state);
  for (std::uint32_t pass = 0; pass < next_pass; ++pass) advance_schedule(pass);
  // The photons of the first pass, by which the pilot decides, are no part of what follows.
  totals_ = {};
  totals_.start_from(device_.download<Counters>(counters_, 1)[0]);
  photon_map_.forget_dropped();
  early_seconds_ = 0;
}

std::vector<std::string> Sppm::depends_on_history() const {
  std::vector<std::string> reasons;
  if (!with_photons_) return reasons;
  if (spec_.schedule == Schedule::pixel)
    reasons.push_back(
        "/renderer/schedule: each pixel's radius follows from the photons of the passes before; use -D "
        "renderer.schedule=global");
  if (spec_.boundary_correction)
    reasons.push_back(
        "/renderer/boundary_correction: each pixel learns from the passes before how much of its kernel lies "
        "on "
        "surfaces; use -D renderer.boundary_correction=false");
  if (guide_.is_guided())
    reasons.push_back("/renderer/guided_photons: photons go where the passes before have seen something" +
                      unguided);
  return reasons;
}

std::string Sppm::depends_on_other_pixels() const {
  return guide_.is_guided()
             ? "/renderer/guided_photons: photons go where any of the pixels sees something" + unguided
             : "";
}

}  // namespace causticl
