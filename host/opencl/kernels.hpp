// From effects to programs: one small program per pass, compiled for the effects that it reads.
#pragma once

#include <string>

#include "accel/triangle_transforms.hpp"
#include "effects/effects.hpp"
#include "opencl/device.hpp"

namespace causticl {

/// The type of the kernels' arithmetic, `real` of cl/core/prelude.cl.
enum class Precision { float32, float64 };

/// "float" or "double", as --precision takes it.
const char* name_of(Precision precision);

/// How many times the bytes that types.h gives them on the host the records that passes hand on (Photon,
/// VisiblePoint) take at most.
constexpr std::size_t record_scale(Precision precision) { return precision == Precision::float64 ? 2 : 1; }

/// Where kernel sources come from and where a copy of what was built goes.
struct KernelOptions {
  unsigned effects = 0;  // EFFECT_* bits of the scene, and OUTPUT_LIGHT_PASSES where those are wanted
  Precision precision = Precision::float32;
  TriangleTest triangle_test = TriangleTest::watertight;
  std::string kernel_dir;       // read cl/ live from here; empty: the embedded sources
  std::string dump_kernels;     // write each flattened source here; empty: do not
  bool camera_packets = false;  // "camera" and "path" have a kernel primary_hits, and need what it finds
  bool brute_force = false;     // "photon" and "camera" meet every primitive: see photon_rays.hpp
};

/// The EFFECT_* bits that the kernels of a pass ask for; the others change nothing in its program.
unsigned effects_of_pass(const std::string& pass);

/// Builds the program of `pass` ("photon" for cl/passes/pass_photon.cl), masked to the effects that this pass
/// reads, so that passes which read none are the same for every scene. Throws DeviceError where the device
/// has no arithmetic of the precision asked for.
cl::Program build_pass(Device& device, const std::string& pass, const KernelOptions& options);

}  // namespace causticl
