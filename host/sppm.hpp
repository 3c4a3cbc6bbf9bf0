// Stochastic progressive photon mapping (Hachisuka & Jensen 2009) on the device.
#pragma once

#include <optional>

#include "film.hpp"
#include "first_hits.hpp"
#include "integrator.hpp"
#include "motion.hpp"
#include "photon_map.hpp"
#include "upload.hpp"

namespace causticl {

class Sppm : public PassIntegrator {
 public:
  /// Without `with_photons` none are traced: the plan of passes.hpp says when that changes no picture. The
  /// first radius is chosen where none is given.
  Sppm(const Scene& scene, DeviceScene& device_scene, Device& device, Film& film, Programs& programs,
       std::uint32_t seed, bool with_photons, std::optional<double> first_radius);

  void enqueue_pass(std::uint32_t pass) override;
  void trace_share(std::uint32_t pass) override { start_pass(pass); }
  std::vector<std::byte> photons() override { return photon_map_.records(); }
  void set_photons(const std::vector<std::vector<std::byte>>& photons) override {
    photon_map_.set_records(photons);
  }
  Totals finish() override;
  /// sppm.N, sppm.radius and sppm.photons: N and R of the paper, and the photons found.
  std::vector<Channel> channels() override;
  double bytes_per_pixel() const override;

  double first_radius() const { return first_radius_; }

 private:
  const Scene& scene_;
  const RendererSpec spec_;
  Device& device_;
  Film& film_;
  const DeviceScene& device_scene_;
  Motion motion_;
  Params params_;
  cl::Buffer counters_;
  PhotonGuide guide_;
  PhotonAim aim_;
  PhotonMap photon_map_;
  bool with_photons_;
  bool walled_;       // whether the scene calls for walls
  std::optional<std::uint32_t> started_pass_;  // whose photons are in the map
  cl::Kernel trace_camera_, gather_photons_;
  cl_uint first_argument_ = 0;
  cl::Buffer walls_;  // a WallGrid
  bool walls_placed_ = false;
  std::size_t visible_point_bytes_, chunk_pixels_;
  cl::Buffer own_visible_points_, pixels_;
  FirstHits first_hits_;
  CounterTotals totals_;
  std::uint64_t emitted_ = 0;
  double first_radius_ = 0;
  double smallest_radius2_;      // below this a schedule shrinks no further
  double schedule_radius2_ = 0;  // of the next pass, by the schedule that depends on its number alone

  void start_pass(std::uint32_t pass);
  const cl::Buffer& visible_points();
  void trace_visible_points(const cl::Buffer& points, const Params& params);
  double choose_first_radius(Programs& programs, double extent);
  void place_walls(std::uint32_t pass);
  void advance_schedule(std::uint32_t pass);
};

}  // namespace causticl
