// Stochastic progressive photon mapping (Hachisuka & Jensen 2009) on the device.
#pragma once

#include <optional>

#include "film.hpp"
#include "integrator.hpp"
#include "kernels.hpp"
#include "photon_map.hpp"
#include "upload.hpp"

namespace causticl {

class Sppm : public PassIntegrator {
 public:
  Sppm(const Scene& scene, const DeviceScene& device_scene, Device& device, Film& film,
       const KernelOptions& kernels, std::uint32_t seed);

  void enqueue_pass(std::uint32_t pass) override;
  Totals finish() override;
  /// sppm.N, sppm.radius and sppm.photons: N and R of the paper, and the photons found.
  std::vector<Channel> channels() override;
  double bytes_per_pixel() const override;

  double first_radius() const { return first_radius_; }

 private:
  const RendererSpec spec_;
  Device& device_;
  Film& film_;
  Params params_;
  cl::Buffer counters_;
  PhotonMap photon_map_;
  cl::Program camera_program_, gather_program_;
  cl::Kernel trace_camera_, gather_photons_, count_around_, start_pixels_;
  cl_uint first_argument_;
  std::size_t visible_point_bytes_, chunk_pixels_;
  cl::Buffer visible_points_, pixels_;
  CounterTotals totals_;
  std::uint64_t emitted_ = 0;
  double first_radius_ = 0;
  double smallest_radius2_;      // below this a schedule shrinks no further
  double schedule_radius2_ = 0;  // of the next pass, by the schedule that depends on its number alone

  double choose_first_radius(double extent);
  void advance_schedule(std::uint32_t pass);
};

}  // namespace causticl
