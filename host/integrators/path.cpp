#include "integrators/path.hpp"

#include <algorithm>

#include "device_scene/params.hpp"

namespace causticl {

PathTracer::PathTracer(const Scene& scene, DeviceScene& device_scene, Device& device, Film& film,
                       Programs& programs, std::uint32_t seed)
    : device_(device),
      film_(film),
      device_scene_(device_scene),
      motion_(scene, device, device_scene, seed),
      params_(scene_params(scene, device_scene, seed)),
      trace_paths_(programs.kernel("path", "trace_paths")),
      counters_(device.buffer(sizeof(Counters), "counters")),
      chunk_(std::min(launch_chunk(device), film.pixels())),
      primary_hit_bytes_(programs.options().camera_packets ? chunk_ * sizeof(PrimaryHit) : 0),
      primary_hit_buffer_(device.buffer(primary_hit_bytes_, "first hits")),
      primary_hits_(programs, "path", device_scene, counters_) {
  device_.clear(counters_, sizeof(Counters));
  first_argument_ = set_scene_arguments(trace_paths_, device_scene);
  trace_paths_.setArg(first_argument_, film_.buffer());
  trace_paths_.setArg(first_argument_ + 1, counters_);
  trace_paths_.setArg(first_argument_ + 3, primary_hit_buffer_);
}

void PathTracer::enqueue_pass(std::uint32_t pass) {
  if (pass == 0) began_ = Clock::now();
  begin_pass(params_, pass);
  motion_.begin_pass(pass);
  set_emission(params_, device_scene_);
  set_scene_arguments(trace_paths_, device_scene_);
  const std::size_t end = fraction_.end_of(film_.pixels());
  for (std::size_t first = fraction_.first_of(film_.pixels()); first < end; first += chunk_) {
    params_.first_pixel = static_cast<uint>(first);
    params_.pixel_count = static_cast<uint>(std::min(chunk_, end - first));
    primary_hits_.launch(device_, device_scene_, primary_hit_buffer_, params_, 1);
    trace_paths_.setArg(first_argument_ + 2, params_);
    device_.launch_pass(trace_paths_, params_.pixel_count);
  }
}

double PathTracer::bytes_per_pixel() const {
  return static_cast<double>(primary_hit_bytes_) / static_cast<double>(film_.pixels());
}

PassIntegrator::Totals PathTracer::finish() {
  totals_.update(device_.download<Counters>(counters_, 1)[0]);
  Totals result;
  result.rays = totals_.rays;
  result.diagnostics = totals_.diagnostics;
  return result;
}

}  // namespace causticl
