// What aims photons at what focuses them, see cl/photons/projection_map.cl.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "opencl/device.hpp"
#include "shared/types.h"

namespace causticl {

/// The cells of one square of which the pilot paths that became parts of caustics left by `landed[cell]`: a
/// cell is drawn as often as a square without aim would, times 1 - fraction, plus `fraction` in proportion to
/// what landed in it and in the cells beside. Where nothing landed there is no aim.
std::vector<ProjectionCell> projection_cells(std::span<const cl_uint> deposited, double fraction);

class ProjectionMap {
 public:
  /// For passes of `photons` photons, which are not aimed until learn(). Without `aimed` no pilot path is
  /// asked for; with no emitters, as for kernels that take no aim, there is nothing on the device either.
  ProjectionMap(Device& device, std::uint32_t emitters, std::uint32_t photons, bool aimed);

  /// Photons to be traced before the first pass, in role PHOTONS_FOR_PROJECTION_MAP.
  std::uint32_t pilot_paths() const { return pilot_paths_; }
  /// Aims by what they found.
  void learn();

  /// What trace_photons takes from argument `first` on.
  void add_arguments(cl::Kernel& trace_photons, cl_uint first) const;

 private:
  Device& device_;
  std::uint32_t squares_, pilot_paths_;
  cl::Buffer cells_, deposited_;
};

}  // namespace causticl
