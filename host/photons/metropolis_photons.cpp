#include "photons/metropolis_photons.hpp"

#include <algorithm>
#include <cstring>

#include "base/error.hpp"
#include "device_scene/space_grid.hpp"

namespace causticl {
namespace {

// Blocks of a film file.
const char* const visibility_block = "guide.visibility";
const char* const next_block = "guide.next_pass";

constexpr double pilot_fraction = 0.75;  // of a pass's photons
constexpr double most_buckets = 1 << 22;
constexpr std::uint32_t most_mutations = 255;
// Where more of the pilot paths than this land where the camera sees, photons are as without until twice as
// many passes are done.
constexpr double worth_guiding = 1.0 / 16;

std::size_t visibility_bytes(const Grid& cells) { return (buckets_of(cells) + 3) / 4 * sizeof(cl_uint); }

}  // namespace

MetropolisPhotons::MetropolisPhotons(const DeviceScene& scene, Device& device, Programs& programs,
                                     std::uint32_t photons, bool guided)
    : scene_(scene),
      device_(device),
      programs_(programs),
      photons_(photons),
      pilot_paths_(0),
      seeds_(device.buffer(0, "seeds of photons")),
      accepted_(device.buffer(0, "seeds of photons")),
      visibility_(device.buffer(0, "visibility grid")),
      emission_(device.buffer(0, "emission map")) {
  if (guided) guide();
}

void MetropolisPhotons::guide() {
  pilot_paths_ = static_cast<std::uint32_t>(pilot_fraction * photons_);
  seeds_ = device_.buffer(pilot_paths_ * sizeof(cl_uint2), "seeds of photons");
  accepted_ = device_.buffer(pilot_paths_ * sizeof(cl_uint), "seeds of photons");
}

MetropolisPhotons::Emission MetropolisPhotons::emission(std::uint32_t pass) const {
  if (pass < next_guided_ || pilot_paths_ == 0) return {photons_, PHOTONS_PLAIN};
  return {pilot_paths_, PHOTONS_PILOT_PATHS};
}

std::uint32_t MetropolisPhotons::copies(std::uint32_t seeds) const {
  const std::uint32_t each = (photons_ - pilot_paths_) / std::max(seeds, 1u);
  return std::min(each > 0 ? each - 1 : 0, most_mutations);
}

void MetropolisPhotons::found(std::uint32_t seeds, std::uint32_t pilot_paths, std::uint32_t pass) {
  const bool worth = seeds <= worth_guiding * pilot_paths;
  current_paths_found_ = {static_cast<double>(seeds) / pilot_paths, worth && seeds > 0 ? copies(seeds) : 0};
  if (!worth) next_guided_ = 2 * (pass + 1);
}

void MetropolisPhotons::add_arguments(cl::Kernel& trace_photons, cl_uint first) const {
  trace_photons.setArg(first, seeds_);
  trace_photons.setArg(first + 1, accepted_);
  trace_photons.setArg(first + 2, visibility_);
  trace_photons.setArg(first + 3, cells_);
  trace_photons.setArg(first + 4, emission_);
  trace_photons.setArg(first + 5, emission_count_);
}

void MetropolisPhotons::set_emission(const std::vector<EmissionCell>& cells) {
  emission_ = device_.upload(cells, "emission map");
  emission_count_ = static_cast<cl_uint>(cells.size());
}

void MetropolisPhotons::save(std::map<std::string, std::vector<std::byte>>& state) const {
  if (!is_guided()) return;
  state[visibility_block] = device_.download<std::byte>(visibility_, visibility_bytes(cells_));
  std::vector<std::byte>& next = state[next_block];
  next.resize(sizeof next_guided_);
  std::memcpy(next.data(), &next_guided_, sizeof next_guided_);
}

void MetropolisPhotons::restore(const std::map<std::string, std::vector<std::byte>>& state) {
  const auto visibility = state.find(visibility_block), next = state.find(next_block);
  if (!is_guided() || visibility == state.end() || next == state.end()) return;
  if (visibility->second.size() != visibility_bytes(cells_) || next->second.size() != sizeof next_guided_)
    throw UserError("the film does not hold where photons are guided in this scene; render it again");
  device_.queue().enqueueWriteBuffer(visibility_, CL_TRUE, 0, visibility->second.size(),
                                     visibility->second.data());
  std::memcpy(&next_guided_, next->second.data(), sizeof next_guided_);
}

void MetropolisPhotons::set_radius(double radius) {
  if (pilot_paths_ == 0) return;
  reach_ = static_cast<float>(0.49 * radius);
  cells_ = grid_of(scene_, radius, most_buckets);
  visibility_ = device_.buffer(visibility_bytes(cells_), "visibility grid");
  device_.clear(visibility_, visibility_bytes(cells_));
}

void MetropolisPhotons::mark(const cl::Buffer& visible_points, std::size_t count, std::uint32_t pass) {
  // Later passes see little that is new, and what they see is lit by pilot paths.
  if (pilot_paths_ == 0 || (pass & (pass + 1)) != 0) return;
  if (!mark_visible_points_()) mark_visible_points_ = programs_.kernel("gather", "mark_visible_points");
  set_arguments(mark_visible_points_, visible_points, visibility_, cells_, reach_,
                static_cast<cl_uint>(count));
  device_.launch_pass(mark_visible_points_, count);
}

}  // namespace causticl
