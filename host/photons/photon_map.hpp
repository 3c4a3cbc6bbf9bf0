// The photons of a pass: traced, then counting-sorted into a grid.
#pragma once

#include <span>

#include "device_scene/device_scene.hpp"
#include "opencl/programs.hpp"
#include "photons/emission_map.hpp"
#include "photons/metropolis_photons.hpp"
#include "photons/metropolis_statistics.hpp"
#include "photons/projection_map.hpp"

namespace causticl {

class PhotonMap {
 public:
  PhotonMap(const DeviceScene& scene, Device& device, Programs& programs, const cl::Buffer& counters,
            MetropolisPhotons& guide, ProjectionMap& aim);

  /// Waits until the kernel that traces photons is built, by `programs` from now on.
  void prepare(Programs& programs);

  /// Only after prepare(), before the first pass: traces the pilot paths that photons are aimed by.
  void learn_projection_map(Params params);

  /// Scouts that land, not as direct light, in cells of `cells` that `marks` marks: the numbers by which they
  /// started. `pass` tells their random numbers from those of other pilot paths. Only after prepare() with
  /// kernels of EFFECT_GUIDED_PHOTONS.
  struct Marked {
    const cl::Buffer& visibility;
    Grid cells;
  };
  std::vector<StartNumbers> useful_pilot_paths(Params params, std::uint32_t pilot_paths, std::uint32_t pass,
                                               const Marked& visible);

  /// Only after prepare(). Traces params.photon_count photons of pass params.pass, and where these are pilot
  /// paths (params.photon_role) what follows from them. Waits for the device, since only it knows how many
  /// were stored; where the buffer was too small, it grows and the pass is traced again, to the same photons.
  /// Where the device has no room for that, the photons beyond are dropped and counted. Returns the counters
  /// as they were left.
  Counters trace(Params params);

  /// The records of the photons that trace() stored.
  std::vector<std::byte> records();
  /// Puts these in their place. Where the device has no room for them, those beyond are dropped and counted.
  void set_records(const std::vector<std::vector<std::byte>>& parts);

  /// Enqueues the sort for gathering within `radius`, and `indirect_radius` where photons are indirect. Where
  /// the two are equal all share one grid.
  void sort(double radius, double indirect_radius);

  std::uint32_t stored() const { return stored_; }
  /// Photons of all passes that found no room.
  std::uint64_t dropped() const { return dropped_; }
  void forget_dropped() { dropped_ = 0; }
  const PhotonGrids& grids() const { return grids_; }
  const cl::Buffer& starts() const { return starts_; }
  const cl::Buffer& sorted() const { return sorted_; }
  const cl::Buffer& records_buffer() const { return photons_; }
  /// The memory of the photons as traced, of so many bytes. Between sort() and the next trace() it is free.
  const cl::Buffer& traced() const { return photons_; }
  std::size_t traced_bytes() const { return capacity_ * photon_bytes_; }

 private:
  const DeviceScene& scene_;
  Device& device_;
  Programs& programs_;
  Programs* photon_programs_;  // that trace
  MetropolisPhotons& guide_;
  ProjectionMap& aim_;
  cl::Kernel trace_photons_, count_photons_, sum_segments_, scan_sums_, scan_segments_, move_photons_;
  cl_uint first_argument_ = 0;
  std::size_t photon_bytes_;  // of one record as traced; a sorted one takes no more
  cl::Buffer counters_, photons_, sorted_, ranks_, counts_, sums_, starts_;
  std::uint32_t capacity_ = 0, stored_ = 0, indirect_ = 0;  // indirect: those of the stored
  std::uint64_t dropped_ = 0;
  bool full_ = false;  // the device has no room for a larger buffer
  std::size_t sorted_capacity_ = 0, bucket_capacity_ = 0;
  PhotonGrids grids_{};

  std::uint32_t count_indirect(std::span<const std::byte> records) const;
  void set_trace_arguments();
  void launch(const Params& params);
  void launch_all(Params params);
  void reserve_buckets(std::size_t buckets);
  bool reserve_photons(std::uint64_t wanted);
};

}  // namespace causticl
