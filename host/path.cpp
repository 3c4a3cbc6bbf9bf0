#include "path.hpp"

#include <algorithm>

#include "params.hpp"

namespace causticl {

PathTracer::PathTracer(const Scene& scene, DeviceScene& device_scene, Device& device, Film& film,
                       Programs& programs, std::uint32_t seed)
    : device_(device),
      film_(film),
      device_scene_(device_scene),
      motion_(scene, device, device_scene, seed),
      params_(scene_params(scene, device_scene, seed)),
      trace_paths_(programs.kernel("path", "trace_paths")),
      counters_(device.buffer(sizeof(Counters), "counters")) {
  device_.clear(counters_, sizeof(Counters));
  first_argument_ = set_scene_arguments(trace_paths_, device_scene);
  trace_paths_.setArg(first_argument_, film_.buffer());
  trace_paths_.setArg(first_argument_ + 1, counters_);
}

void PathTracer::enqueue_pass(std::uint32_t pass) {
  if (pass == 0) began_ = Clock::now();
  begin_pass(params_, pass);
  motion_.begin_pass(pass);
  set_emission(params_, device_scene_);
  set_scene_arguments(trace_paths_, device_scene_);
  const std::size_t end = share_.end_of(film_.pixels()), chunk = launch_chunk(device_);
  for (std::size_t first = share_.first_of(film_.pixels()); first < end; first += chunk) {
    params_.first_pixel = static_cast<uint>(first);
    params_.pixel_count = static_cast<uint>(std::min(chunk, end - first));
    trace_paths_.setArg(first_argument_ + 2, params_);
    device_.launch_pass(trace_paths_, params_.pixel_count);
  }
}

PassIntegrator::Totals PathTracer::finish() {
  totals_.update(device_.download<Counters>(counters_, 1)[0]);
  Totals result;
  result.rays = totals_.rays;
  result.faults = totals_.faults;
  return result;
}

}  // namespace causticl
