#include "photons/metropolis_photons.hpp"

#include <algorithm>

#include "device_scene/space_grid.hpp"

namespace causticl {
namespace {

constexpr double scout_share = 0.75;  // of a pass's photons
constexpr double most_buckets = 1 << 22;
constexpr std::uint32_t most_copies = 255;
// Where more of the scouts than this land where the camera sees, photons are as without until twice as many
// passes are done.
constexpr double worth_guiding = 1.0 / 16;

std::size_t mark_bytes(const Grid& cells) { return (buckets_of(cells) + 3) / 4 * sizeof(cl_uint); }

}  // namespace

PhotonGuide::PhotonGuide(const DeviceScene& scene, Device& device, Programs& programs, std::uint32_t photons,
                         bool guided)
    : scene_(scene),
      device_(device),
      programs_(programs),
      photons_(photons),
      scouts_(0),
      seeds_(device.buffer(0, "seeds of photons")),
      accepted_(device.buffer(0, "seeds of photons")),
      marks_(device.buffer(0, "marked cells")),
      emission_(device.buffer(0, "emission map")) {
  if (guided) guide();
}

void PhotonGuide::guide() {
  scouts_ = static_cast<std::uint32_t>(scout_share * photons_);
  seeds_ = device_.buffer(scouts_ * sizeof(cl_uint2), "seeds of photons");
  accepted_ = device_.buffer(scouts_ * sizeof(cl_uint), "seeds of photons");
}

PhotonGuide::Emission PhotonGuide::emission(std::uint32_t pass) const {
  if (pass < next_guided_ || scouts_ == 0) return {photons_, PHOTONS_PLAIN};
  return {scouts_, PHOTONS_SCOUTS};
}

std::uint32_t PhotonGuide::copies(std::uint32_t seeds) const {
  const std::uint32_t each = (photons_ - scouts_) / std::max(seeds, 1u);
  return std::min(each > 0 ? each - 1 : 0, most_copies);
}

void PhotonGuide::found(std::uint32_t seeds, std::uint32_t scouts, std::uint32_t pass) {
  const bool worth = seeds <= worth_guiding * scouts;
  seeds_found_ = {static_cast<double>(seeds) / scouts, worth && seeds > 0 ? copies(seeds) : 0};
  if (!worth) next_guided_ = 2 * (pass + 1);
}

void PhotonGuide::add_arguments(cl::Kernel& trace_photons, cl_uint first) const {
  trace_photons.setArg(first, seeds_);
  trace_photons.setArg(first + 1, accepted_);
  trace_photons.setArg(first + 2, marks_);
  trace_photons.setArg(first + 3, cells_);
  trace_photons.setArg(first + 4, emission_);
  trace_photons.setArg(first + 5, emission_count_);
}

void PhotonGuide::set_emission(const std::vector<EmissionCell>& cells) {
  emission_ = device_.upload(cells, "emission map");
  emission_count_ = static_cast<cl_uint>(cells.size());
}

void PhotonGuide::set_radius(double radius) {
  if (scouts_ == 0) return;
  reach_ = static_cast<float>(0.49 * radius);
  cells_ = grid_of(scene_, radius, most_buckets);
  marks_ = device_.buffer(mark_bytes(cells_), "marked cells");
  device_.clear(marks_, mark_bytes(cells_));
}

void PhotonGuide::mark(const cl::Buffer& visible_points, std::size_t count, std::uint32_t pass) {
  // Later passes see little that is new, and what they see is lit by scouts.
  if (scouts_ == 0 || (pass & (pass + 1)) != 0) return;
  if (!mark_visible_points_()) mark_visible_points_ = programs_.kernel("gather", "mark_visible_points");
  set_arguments(mark_visible_points_, visible_points, marks_, cells_, reach_, static_cast<cl_uint>(count));
  device_.launch_pass(mark_visible_points_, count);
}

}  // namespace causticl
