// Stochastic progressive photon mapping (Hachisuka & Jensen 2009) on the device.
#pragma once

#include <memory>
#include <optional>

#include "device_scene/device_scene.hpp"
#include "device_scene/motion.hpp"
#include "film/film.hpp"
#include "integrators/integrator.hpp"
#include "integrators/integrators.hpp"
#include "integrators/primary_hits.hpp"
#include "integrators/unknown_error.hpp"
#include "photons/photon_map.hpp"
#include "photons/pilot.hpp"
#include "scene/lit_sides.hpp"

namespace causticl {

class Sppm : public PassIntegrator {
 public:
  explicit Sppm(const IntegratorInputs& in);

  void enqueue_pass(std::uint32_t pass) override;
  void trace_own_photons(std::uint32_t pass) override { start_pass(pass); }
  std::vector<std::byte> photons() override { return photon_map_.records(); }
  void set_photons(const std::vector<std::vector<std::byte>>& photons) override {
    photon_map_.set_records(photons);
  }
  Totals finish() override;
  IntegratorState state() override;
  void go_on(const IntegratorState& state, std::uint32_t next_pass) override;
  std::vector<std::string> depends_on_history() const override;
  std::string depends_on_other_pixels() const override;
  /// sppm.N, sppm.radius and sppm.photons: N and R of the paper, and the photons found.
  std::vector<Channel> channels() override;
  double bytes_per_pixel() const override;

  const Pilot* pilot() const override { return &pilot_; }

 private:
  const Scene& scene_;
  const RendererSpec spec_;
  Device& device_;
  Film& film_;
  DeviceScene& device_scene_;
  Programs& programs_;
  std::unique_ptr<Programs> guided_programs_;  // that trace photons by a map which the pilot asked for
  Motion motion_;
  Params params_;
  cl::Buffer counters_;
  MetropolisPhotons guide_;
  ProjectionMap aim_;
  PhotonMap photon_map_;
  bool with_photons_;
  bool walled_;                                // whether the scene calls for walls
  std::optional<std::uint32_t> started_pass_;  // whose photons are in the map
  cl::Kernel trace_camera_, gather_photons_;
  cl_uint first_argument_ = 0;
  cl::Buffer walls_;  // a WallGrid
  LitSides lit_sides_;
  bool walls_placed_ = false;
  std::size_t visible_point_bytes_, chunk_pixels_;
  cl::Buffer own_visible_points_, pixels_;
  PrimaryHits primary_hits_;
  CounterTotals totals_;
  std::uint64_t emitted_ = 0;
  Pilot pilot_;
  UnknownError unknown_;
  double smallest_radius2_;      // below this a schedule shrinks no further
  double schedule_radius2_ = 0;  // of the next pass, by the schedule that depends on its number alone

  void start_pass(std::uint32_t pass);
  const cl::Buffer& visible_points();
  void trace_visible_points(const cl::Buffer& points, const Params& params);
  void place_walls(std::uint32_t pass);
  void trace_photons(std::uint32_t pass);
  float segment(double radius) const;

  // The pilot, in sppm_pilot.cpp: `points` are those of its coarse picture.
  Pilot run_pilot();
  void adopt(const Pilot& pilot);
  Params pilot_params() const;
  Surroundings look_around(const cl::Buffer& points, const Params& params);
  void choose_first_radius(const cl::Buffer& points, Params params, Pilot& pilot);
  void learn_emission(const cl::Buffer& points, const Params& params, Pilot& pilot);
  void start_by(const std::vector<EmissionCell>& emission);
  void advance_schedule(std::uint32_t pass);
};

}  // namespace causticl
