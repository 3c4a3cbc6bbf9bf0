// Path tracing on the device: one sample a pixel a pass.
#include <algorithm>

#include "base/spelling.hpp"
#include "device_scene/motion.hpp"
#include "device_scene/params.hpp"
#include "integrators/integrators.hpp"
#include "integrators/primary_hits.hpp"

namespace causticl {
namespace {

class PathTracer : public PassIntegrator {
 public:
  explicit PathTracer(const IntegratorInputs& in);

  void enqueue_pass(std::uint32_t pass) override;
  Totals finish() override;
  double bytes_per_pixel() const override;

 private:
  Device& device_;
  Film& film_;
  const DeviceScene& device_scene_;
  Motion motion_;
  Params params_{};
  cl::Kernel trace_paths_;
  cl_uint first_argument_;
  cl::Buffer counters_;
  std::size_t chunk_;
  std::size_t primary_hit_bytes_;
  cl::Buffer primary_hit_buffer_;
  PrimaryHits primary_hits_;
  CounterTotals totals_;
};

PathTracer::PathTracer(const IntegratorInputs& in)
    : device_(in.device),
      film_(in.film),
      device_scene_(in.device_scene),
      motion_(in.scene, in.device, in.device_scene, in.seed),
      params_(scene_params(in.scene, in.device_scene, in.seed)),
      trace_paths_(in.programs.kernel("path", "trace_paths")),
      counters_(in.device.buffer(sizeof(Counters), "counters")),
      chunk_(std::min(launch_chunk(in.device), in.film.pixels())),
      primary_hit_bytes_(in.programs.options().camera_packets ? chunk_ * sizeof(PrimaryHit) : 0),
      primary_hit_buffer_(in.device.buffer(primary_hit_bytes_, "first hits")),
      primary_hits_(in.programs, "path", in.device_scene, counters_) {
  device_.clear(counters_, sizeof(Counters));
  film_.set_pixels(params_);
  first_argument_ = set_scene_arguments(trace_paths_, in.device_scene);
  trace_paths_.setArg(first_argument_, film_.buffer());
  trace_paths_.setArg(first_argument_ + 1, counters_);
  trace_paths_.setArg(first_argument_ + 3, primary_hit_buffer_);
}

void PathTracer::enqueue_pass(std::uint32_t pass) {
  if (began_ == Clock::time_point{}) began_ = Clock::now();
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

}  // namespace

std::unique_ptr<PassIntegrator> make_pt(const IntegratorInputs& in) {
  return std::make_unique<PathTracer>(in);
}

ErrorRates rates_of_pt(const RendererSpec&) { return path_tracing_rates; }

std::string text_of_pt(const RendererSpec& renderer) {
  return counted(static_cast<std::size_t>(renderer.samples), "sample") + " a pixel";
}

}  // namespace causticl
