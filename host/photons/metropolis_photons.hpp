// What guides photons to where the camera sees, see cl/photons/metropolis_photons.cl: the cells of the
// visibility grid, and how many of a pass's photons are pilot paths.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "device_scene/device_scene.hpp"
#include "opencl/programs.hpp"
#include "photons/metropolis_statistics.hpp"
#include "shared/types.h"

namespace causticl {

constexpr cl_uint guide_arguments = 6;

class MetropolisPhotons {
 public:
  /// For passes of `photons` photons, which are all plain where they are not `guided`, and start everywhere.
  MetropolisPhotons(const DeviceScene& scene, Device& device, Programs& programs, std::uint32_t photons,
                    bool guided);

  /// Photons of pass `pass` that are emitted at random: all of them, in role PHOTONS_PLAIN, or pilot paths.
  struct Emission {
    std::uint32_t photons;
    uint role;
  };
  Emission emission(std::uint32_t pass) const;

  /// Takes note of how many of pass `pass`'s `pilot paths` became seeds.
  void found(std::uint32_t seeds, std::uint32_t pilot_paths, std::uint32_t pass);
  /// Copies of each of so many seeds.
  std::uint32_t copies(std::uint32_t seeds) const;
  void clear_accepted(std::uint32_t seeds) { device_.clear(accepted_, seeds * sizeof(cl_uint)); }

  /// As last found.
  std::optional<MetropolisStatistics> seeds() const { return current_paths_found_; }

  /// Whether they are, in some passes.
  bool is_guided() const { return pilot_paths_ > 0; }
  /// What passes have learned, for later ones.
  void save(std::map<std::string, std::vector<std::byte>>& state) const;
  void restore(const std::map<std::string, std::vector<std::byte>>& state);

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
  std::uint32_t photons_, pilot_paths_;  // of a pass; no pilot paths where photons are not guided
  cl::Buffer seeds_, accepted_, visibility_, emission_;
  cl_uint emission_count_ = 0;
  Grid cells_{};
  float reach_ = 0;
  cl::Kernel mark_visible_points_;
  std::uint32_t next_guided_ = 1;  // pass
  std::optional<MetropolisStatistics> current_paths_found_;
};

}  // namespace causticl
