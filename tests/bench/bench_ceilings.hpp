// What a device can do at best: bytes copied and single-precision operations a second.
#pragma once

#include <string>

#include "opencl/device.hpp"

namespace causticl {

struct Ceilings {
  double copied = 0;      // bytes a second, read and written both counted
  double operations = 0;  // a second; a fused multiply-add counts as two
};

/// The best of several runs each: a copy of float4 between two buffers too large for caches, and independent
/// chains of fused multiply-adds in registers.
Ceilings bench_ceilings(Device& device);

std::string ceilings_text(const Ceilings& ceilings);

}  // namespace causticl
