// What aims photons at what focuses them, see cl/photons/projection_map.cl.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "opencl/device.hpp"
#include "shared/types.h"

namespace causticl {

/// The cells of one square of which the scouts that became parts of caustics left by `landed[cell]`: a cell
/// is drawn as often as a square without aim would, times 1 - share, plus `share` in proportion to what
/// landed in it and in the cells beside. Where nothing landed there is no aim.
std::vector<AimCell> aim_cells(std::span<const cl_uint> landed, double share);

class PhotonAim {
 public:
  /// For passes of `photons` photons, which are not aimed until learn(). Without `aimed` no scout is asked
  /// for; with no emitters, as for kernels that take no aim, there is nothing on the device either.
  PhotonAim(Device& device, std::uint32_t emitters, std::uint32_t photons, bool aimed);

  /// Photons to be traced before the first pass, in role PHOTONS_TO_AIM_BY.
  std::uint32_t scouts() const { return scouts_; }
  /// Aims by what they found.
  void learn();

  /// What trace_photons takes from argument `first` on.
  void add_arguments(cl::Kernel& trace_photons, cl_uint first) const;

 private:
  Device& device_;
  std::uint32_t squares_, scouts_;
  cl::Buffer cells_, landed_;
};

}  // namespace causticl
