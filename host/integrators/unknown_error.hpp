// Pixels whose error cannot be told, see cl/photons/unknown_error.cl.
#pragma once

#include "opencl/device.hpp"
#include "opencl/programs.hpp"
#include "photons/pilot.hpp"
#include "shared/types.h"

namespace causticl {

class UnknownError {
 public:
  UnknownError(Device& device, Programs& programs) : device_(device), programs_(programs) {}

  /// Cuts the space that the camera sees into cells.
  void set_view(const Surroundings& around);

  /// Whether pass `pass` looks: the passes 1, 3, 7, 15, ..., counted from 0.
  bool due(std::uint32_t pass) const { return pass > 0 && (pass & (pass + 1)) == 0 && cells_.nx > 0; }

  /// Adds up the flux of the `count` photons of a pass. Before these make room for visible points.
  void begin(const cl::Buffer& photons, std::uint32_t count);
  /// Looks at the pixels of a chunk after their gathering.
  void find(const cl::Buffer& points, const cl::Buffer& film, const Params& params);

 private:
  Device& device_;
  Programs& programs_;
  Grid cells_{};
  cl::Buffer sums_;
  cl::Kernel add_flux_, find_unknown_;
};

}  // namespace causticl
