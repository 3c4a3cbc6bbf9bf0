// The primary hits of camera paths, found by packets of neighbouring rays before the paths go on one at a
// time.
#pragma once

#include <string>

#include "device_scene/device_scene.hpp"
#include "opencl/kernels.hpp"
#include "opencl/programs.hpp"

namespace causticl {

/// How camera rays find what they meet first; the picture is the same. `automatic`: packets on CPUs, where
/// they pay even for a dozen triangles.
enum class CameraRays { automatic, single, packets };

/// Whether the programs of a device are to trace camera rays by packets. Never where there is no triangle, in
/// double precision and by the precomputed test.
bool packets_chosen(CameraRays wanted, const Device& device, const KernelOptions& options);

/// What --stats says of it: "in packets of 16", "one at a time".
std::string camera_rays_text(const KernelOptions& options);

/// Does nothing where the programs are built for single rays.
class PrimaryHits {
 public:
  PrimaryHits() = default;
  /// The kernel of `pass`. Diagnostics go to `counters`.
  PrimaryHits(Programs& programs, const std::string& pass, const DeviceScene& device_scene,
              const cl::Buffer& counters);

  /// Finds those of the chunk that `params` tells, which has `samples` paths a pixel, and puts them into
  /// `hits`.
  void launch(Device& device, const DeviceScene& device_scene, const cl::Buffer& hits, const Params& params,
              uint samples);

 private:
  bool by_packets_ = false;
  cl::Kernel kernel_;
  cl_uint first_argument_ = 0;
};

}  // namespace causticl
