// Path tracing on the device: one sample a pixel a pass.
#pragma once

#include "device_scene/device_scene.hpp"
#include "device_scene/motion.hpp"
#include "integrators/film.hpp"
#include "integrators/integrator.hpp"
#include "integrators/primary_hits.hpp"
#include "opencl/programs.hpp"

namespace causticl {

class PathTracer : public PassIntegrator {
 public:
  PathTracer(const Scene& scene, DeviceScene& device_scene, Device& device, Film& film, Programs& programs,
             std::uint32_t seed);

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

}  // namespace causticl
