#include "photons/photon_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/error.hpp"
#include "device_scene/space_grid.hpp"

namespace causticl {
namespace {

constexpr std::size_t scan_segment = 256;           // SCAN_SEGMENT of cl/passes/pass_grid.cl
constexpr std::size_t photon_bytes_in_double = 40;  // CHECK_SIZE of cl/shared/photon_records.h

std::size_t segments_of(std::size_t buckets) { return (buckets + scan_segment - 1) / scan_segment; }

/// Buckets of a table for so many photons: about two for each, since a larger one costs more to clear and sum
/// than its collisions cost to skip.
double affordable_buckets(std::uint32_t photons) {
  return std::min(2.8 * std::max<std::uint32_t>(photons, 2048), std::pow(512.0, 3));
}

}  // namespace

PhotonMap::PhotonMap(const DeviceScene& scene, Device& device, Programs& programs, const cl::Buffer& counters,
                     MetropolisPhotons& guide, ProjectionMap& aim)
    : scene_(scene),
      device_(device),
      programs_(programs),
      photon_programs_(&programs),
      guide_(guide),
      aim_(aim),
      photon_bytes_(programs.options().precision == Precision::float64 ? photon_bytes_in_double
                                                                       : sizeof(Photon)),
      counters_(counters),
      photons_(device.buffer(0, "photons")) {
  reserve_buckets(1);
  sorted_ = device_.buffer(0, "sorted photons");
}

void PhotonMap::prepare(Programs& programs) {
  photon_programs_ = &programs;
  trace_photons_ = programs.kernel("photon", "trace_photons");
  first_argument_ = set_scene_arguments(trace_photons_, scene_);
}

/// All but Params.
void PhotonMap::set_trace_arguments() {
  set_scene_arguments(trace_photons_, scene_);
  trace_photons_.setArg(first_argument_, photons_);
  trace_photons_.setArg(first_argument_ + 1, counters_);
  guide_.add_arguments(trace_photons_, first_argument_ + 3);
  aim_.add_arguments(trace_photons_, first_argument_ + 3 + guide_arguments);
}

/// Traces params.photon_count photons in the role that `params` tells.
void PhotonMap::launch(const Params& params) {
  trace_photons_.setArg(first_argument_ + 2, params);
  device_.launch_pass(trace_photons_, params.photon_count);
}

/// Traces a pass's photons: plain ones, or pilot paths and the copies of those that became seeds.
void PhotonMap::launch_all(Params params) {
  launch(params);
  if (params.photon_role == PHOTONS_PLAIN) return;
  const uint seeds = device_.download<Counters>(counters_, 1)[0].seeds;
  guide_.found(seeds, params.photon_count, params.pass);
  if (seeds == 0) return;
  params.photon_mutations = guide_.copies(seeds);
  params.first_photon = 0;
  if (params.photon_mutations > 0) {
    guide_.clear_accepted(seeds);
    params.photon_role = PHOTONS_MUTATED_PATHS;
    params.photon_count = seeds * params.photon_mutations;
    launch(params);
  }
  params.photon_role = PHOTONS_CURRENT_PATHS;
  params.photon_count = seeds;
  launch(params);
}

void PhotonMap::learn_projection_map(Params params) {
  constexpr uint beyond_passes = 0xffffffff;  // numbers of their own
  params.pass = beyond_passes;
  params.photon_role = PHOTONS_FOR_PROJECTION_MAP;
  params.first_photon = 0;
  params.photon_count = aim_.pilot_paths();
  set_trace_arguments();
  launch(params);
  aim_.learn();
}

std::vector<StartNumbers> PhotonMap::useful_pilot_paths(Params params, std::uint32_t pilot_paths,
                                                        std::uint32_t pass, const Marked& visible) {
  const cl::Buffer seeds = device_.buffer(pilot_paths * sizeof(cl_uint2), "seeds of photons");
  params.pass = pass;
  params.photon_role = PHOTONS_TO_LEARN_BY;
  params.first_photon = 0;
  params.photon_count = pilot_paths;
  device_.clear(counters_, offsetof(Counters, rays));
  set_trace_arguments();
  trace_photons_.setArg(first_argument_ + 3, seeds);
  trace_photons_.setArg(first_argument_ + 5, visible.visibility);
  trace_photons_.setArg(first_argument_ + 6, visible.cells);
  launch(params);
  const auto count = std::min(device_.download<Counters>(counters_, 1)[0].seeds, pilot_paths);
  if (count == 0) return {};
  const cl::Buffer numbers = device_.buffer(count * sizeof(StartNumbers), "seeds of photons");
  cl::Kernel seed_numbers = photon_programs_->kernel("photon", "seed_numbers");
  set_arguments(seed_numbers, seeds, guide_.emission_cells(), guide_.emission_count(), numbers,
                static_cast<cl_uint>(params.seed), static_cast<cl_uint>(pass), static_cast<cl_uint>(count));
  device_.launch_pass(seed_numbers, count);
  return device_.download<StartNumbers>(numbers, count);
}

Counters PhotonMap::trace(Params params) {
  stored_ = indirect_ = 0;
  if (params.photon_count == 0) return device_.download<Counters>(counters_, 1)[0];
  // Two stored photons for each emitted one are usual; a closed white room wants more, and gets it below.
  if (!reserve_photons(2ull * params.photon_count))
    throw UserError(std::to_string(params.photon_count) +
                    " photons a pass are more than this device can store; use fewer a pass and more passes");
  for (;;) {
    params.photon_capacity = capacity_;
    device_.clear(counters_, offsetof(Counters, rays));  // what follows counts on
    set_trace_arguments();
    launch_all(params);
    const Counters counters = device_.download<Counters>(counters_, 1)[0];
    stored_ = std::min(counters.photons, capacity_);
    indirect_ = std::min(counters.indirect, stored_);
    if (counters.photons <= capacity_) return counters;
    if (full_ || !reserve_photons(counters.photons + counters.photons / 8ull)) {
      full_ = true;
      dropped_ += counters.photons - capacity_;
      indirect_ = count_indirect(records());  // of all that wanted room, not of those that found it
      return counters;
    }
  }
}

/// How many of these records are of indirect photons.
std::uint32_t PhotonMap::count_indirect(std::span<const std::byte> records) const {
  const std::size_t normal = 3 * (photon_bytes_ == photon_bytes_in_double ? sizeof(double) : sizeof(float));
  std::uint32_t count = 0;
  for (std::size_t at = normal; at < records.size(); at += photon_bytes_) {
    uint word;
    std::memcpy(&word, records.data() + at, sizeof word);
    count += !(word & IN_MEDIUM) && (word & INDIRECT_PHOTON);
  }
  return count;
}

std::vector<std::byte> PhotonMap::records() {
  return device_.download<std::byte>(photons_, stored_ * photon_bytes_);
}

void PhotonMap::set_records(const std::vector<std::vector<std::byte>>& parts) {
  std::uint64_t wanted = 0;
  for (const auto& part : parts) wanted += part.size() / photon_bytes_;
  if (wanted > capacity_ && (full_ || !reserve_photons(wanted + wanted / 8))) full_ = true;
  stored_ = static_cast<std::uint32_t>(std::min<std::uint64_t>(wanted, capacity_));
  indirect_ = 0;
  dropped_ += wanted - stored_;
  std::size_t at = 0;
  const std::size_t end = stored_ * photon_bytes_;
  for (const auto& part : parts) {
    const std::size_t bytes = std::min(part.size(), end - at);
    if (bytes > 0) indirect_ += count_indirect({part.data(), bytes});
    if (bytes > 0) device_.queue().enqueueWriteBuffer(photons_, CL_TRUE, at, bytes, part.data());
    at += bytes;
  }
}

/// Makes room for `wanted` photons. False, and all as it was, where the device has not that much.
bool PhotonMap::reserve_photons(std::uint64_t wanted) {
  if (wanted <= capacity_) return true;
  if (wanted >= 0x80000000u)
    return false;  // beyond LIST_LIMIT of cl/core/work_group.cl they are not told apart
  photons_ = {};   // first, so that the device need not hold both
  try {
    photons_ = device_.buffer(wanted * photon_bytes_, "photons");
  } catch (const DeviceError&) {
    if (capacity_ > 0) photons_ = device_.buffer(capacity_ * photon_bytes_, "photons");
    return false;
  }
  capacity_ = static_cast<std::uint32_t>(wanted);
  return true;
}

void PhotonMap::reserve_buckets(std::size_t buckets) {
  if (buckets <= bucket_capacity_) return;
  counts_ = device_.buffer(buckets * sizeof(cl_uint), "photon grid");
  starts_ = device_.buffer((buckets + 1) * sizeof(cl_uint), "photon grid");
  sums_ = device_.buffer(segments_of(buckets) * sizeof(cl_uint), "photon grid");
  bucket_capacity_ = buckets;
}

void PhotonMap::sort(double radius, double indirect_radius) {
  const std::uint32_t focused = stored_ - indirect_;
  grids_ = {};
  grids_.photon_count = stored_;
  grids_.separate = indirect_radius != radius && indirect_ > 0;
  grids_.present[FOCUSED_PHOTONS] = grids_.separate ? focused > 0 : stored_ > 0;
  grids_.present[INDIRECT_PHOTONS] = grids_.separate;
  grids_.grid[FOCUSED_PHOTONS] =
      grid_of(scene_, 2 * radius, affordable_buckets(grids_.separate ? focused : stored_));
  std::size_t buckets = buckets_of(grids_.grid[FOCUSED_PHOTONS]);
  if (grids_.separate) {
    // A larger radius holds more photons, and smaller cubes fewer in vain: of cubes of two radii a fifth lies
    // within the radius, of one a third.
    grids_.grid[INDIRECT_PHOTONS] = grid_of(scene_, indirect_radius, affordable_buckets(indirect_), buckets);
    buckets += buckets_of(grids_.grid[INDIRECT_PHOTONS]);
  }
  if (stored_ == 0) return;

  if (!count_photons_()) {
    count_photons_ = programs_.kernel("grid", "count_photons");
    sum_segments_ = programs_.kernel("grid", "sum_segments");
    scan_sums_ = programs_.kernel("grid", "scan_sums");
    scan_segments_ = programs_.kernel("grid", "scan_segments");
    move_photons_ = programs_.kernel("grid", "move_photons");
  }
  reserve_buckets(buckets);
  const std::size_t in_blocks = (static_cast<std::size_t>(stored_) + 7) / 8 * 8;
  if (in_blocks > sorted_capacity_) {
    sorted_ = {};
    sorted_ = device_.buffer(in_blocks * photon_bytes_, "sorted photons");
    ranks_ = {};
    ranks_ = device_.buffer(in_blocks * sizeof(cl_uint), "photon grid");
    sorted_capacity_ = in_blocks;
  }
  device_.clear(counts_, buckets * sizeof(cl_uint));
  set_arguments(count_photons_, photons_, counts_, ranks_, grids_);
  device_.launch_pass(count_photons_, stored_);
  set_arguments(sum_segments_, counts_, sums_, static_cast<cl_uint>(buckets));
  device_.launch_pass(sum_segments_, segments_of(buckets));
  set_arguments(scan_sums_, sums_, static_cast<cl_uint>(segments_of(buckets)));
  device_.launch_pass(scan_sums_, 1);
  set_arguments(scan_segments_, counts_, sums_, starts_, static_cast<cl_uint>(buckets));
  device_.launch_pass(scan_segments_, segments_of(buckets));
  set_arguments(move_photons_, photons_, ranks_, starts_, sorted_, grids_);
  device_.launch_pass(move_photons_, in_blocks);
}

}  // namespace causticl
