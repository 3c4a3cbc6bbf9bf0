#include "integrators/primary_hits.hpp"

#include "shared/effects.h"

namespace causticl {
namespace {

/// Rays of a packet: PACKET_RAYS of cl/traversal/triangle_packet.cl.
constexpr uint packet_rays = 16;

/// Packets of a chunk, as cl/traversal/primary_hits.cl counts them.
uint packet_count(const Params& params, uint samples) {
  const uint width = samples <= 2   ? 4
                     : samples <= 8 ? 2
                                    : 1,
             height = samples <= 1   ? 4
                      : samples <= 4 ? 2
                                     : 1;
  const uint parts = (samples + packet_rays - 1) / packet_rays;
  const uint row = params.crop_width != 0 ? params.crop_width : params.width;
  const uint first_row = params.first_pixel / row / height;
  const uint last_row = (params.first_pixel + params.pixel_count - 1) / row / height;
  return (row + width - 1) / width * (last_row - first_row + 1) * parts;
}

}  // namespace

bool packets_chosen(CameraRays wanted, const Device& device, const KernelOptions& options) {
  const bool possible = (options.effects & EFFECT_TRIANGLES) && options.precision == Precision::float32 &&
                        options.triangle_test == TriangleTest::watertight;
  // The items of a GPU that run as one are a packet by themselves.
  return possible &&
         (wanted == CameraRays::packets || (wanted == CameraRays::automatic && device.info().type == "cpu"));
}

std::string camera_rays_text(const KernelOptions& options) {
  return options.camera_packets ? "in packets of " + std::to_string(packet_rays) : "one at a time";
}

PrimaryHits::PrimaryHits(Programs& programs, const std::string& pass, const DeviceScene& device_scene,
                         const cl::Buffer& counters)
    : by_packets_(programs.options().camera_packets) {
  if (!by_packets_) return;
  kernel_ = programs.kernel(pass, "primary_hits");
  first_argument_ = set_scene_arguments(kernel_, device_scene);
  kernel_.setArg(first_argument_ + 1, counters);
}

void PrimaryHits::launch(Device& device, const DeviceScene& device_scene, const cl::Buffer& hits,
                         const Params& params, uint samples) {
  if (!by_packets_ || params.pixel_count == 0) return;
  set_scene_arguments(kernel_, device_scene);  // its buffers may be new where things move
  const uint packets = packet_count(params, samples);
  kernel_.setArg(first_argument_, hits);
  kernel_.setArg(first_argument_ + 2, params);
  kernel_.setArg(first_argument_ + 3, packets);
  device.launch_pass(kernel_, static_cast<std::size_t>(packets) * packet_rays);
}

}  // namespace causticl
