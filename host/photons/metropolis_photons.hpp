// What guides photons to where the camera sees, see cl/photons/metropolis_photons.cl: the marked cells, and
// how many of a pass's photons are scouts.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "device_scene/device_scene.hpp"
#include "opencl/programs.hpp"
#include "photons/seed_statistics.hpp"
#include "shared/types.h"

namespace causticl {

constexpr cl_uint guide_arguments = 6;

class PhotonGuide {
 public:
  /// For passes of `photons` photons, which are all plain where they are not `guided`, and start everywhere.
  PhotonGuide(const DeviceScene& scene, Device& device, Programs& programs, std::uint32_t photons,
              bool guided);

  /// Photons of pass `pass` that are emitted at random: all of them, in role PHOTONS_PLAIN, or scouts.
  struct Emission {
    std::uint32_t photons;
    uint role;
  };
  Emission emission(std::uint32_t pass) const;

  /// Takes note of how many of pass `pass`'s `scouts` became seeds.
  void found(std::uint32_t seeds, std::uint32_t scouts, std::uint32_t pass);
  /// Copies of each of so many seeds.
  std::uint32_t copies(std::uint32_t seeds) const;
  void clear_accepted(std::uint32_t seeds) { device_.clear(accepted_, seeds * sizeof(cl_uint)); }

  /// As last found.
  std::optional<SeedStatistics> seeds() const { return seeds_found_; }

  /// From now on photons are guided. With kernels of EFFECT_GUIDED_PHOTONS.
  void guide();

  /// From now on photons start by this map (emission_map.hpp); where it is empty, everywhere.
  void set_emission(const std::vector<EmissionCell>& cells);
  const cl::Buffer& emission_cells() const { return emission_; }
  cl_uint emission_count() const { return emission_count_; }

  /// What trace_photons takes from argument `first` on: guide_arguments of them.
  void add_arguments(cl::Kernel& trace_photons, cl_uint first) const;

  /// The first radius within which photons are gathered: cells are as large.
  void set_radius(double radius);
  /// Marks cells around `count` visible points of pass `pass`, on which later passes count.
  void mark(const cl::Buffer& visible_points, std::size_t count, std::uint32_t pass);

 private:
  const DeviceScene& scene_;
  Device& device_;
  Programs& programs_;
  std::uint32_t photons_, scouts_;  // of a pass; no scouts where photons are not guided
  cl::Buffer seeds_, accepted_, marks_, emission_;
  cl_uint emission_count_ = 0;
  Grid cells_{};
  float reach_ = 0;
  cl::Kernel mark_visible_points_;
  std::uint32_t next_guided_ = 1;  // pass
  std::optional<SeedStatistics> seeds_found_;
};

}  // namespace causticl
