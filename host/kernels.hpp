// From effects to programs: one small program per pass, compiled for the effects that it reads.
#pragma once

#include <string>

#include "device.hpp"
#include "effects.hpp"

namespace causticl {

/// Where kernel sources come from and where a copy of what was built goes.
struct KernelOptions {
  unsigned effects = 0;      // EFFECT_* bits of the scene
  std::string kernel_dir;    // read cl/ live from here; empty: the embedded sources
  std::string dump_kernels;  // write each flattened source here; empty: do not
};

/// Builds the program of `pass` ("photon" for cl/pass_photon.cl), masked to the effects that this pass reads,
/// so that passes which read none are the same for every scene.
cl::Program build_pass(Device& device, const std::string& pass, const KernelOptions& options);

}  // namespace causticl
