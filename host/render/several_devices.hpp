// Several devices at one render: what each keeps of it, and how they share its passes.
#pragma once

#include <memory>
#include <vector>

#include "device_scene/device_scene.hpp"
#include "film/film.hpp"
#include "integrators/integrator.hpp"
#include "integrators/primary_hits.hpp"
#include "opencl/programs.hpp"
#include "photons/photon_rays.hpp"

namespace causticl {

/// How rays of either end find what they meet.
struct RayChoice {
  CameraRays camera = CameraRays::automatic;
  PhotonRays photon = PhotonRays::automatic;
};

/// All that a render keeps on one device.
struct RenderDevice {
  /// Begins to build the programs of `passes` and uploads the scene; `threads` build its tree (0: all cores).
  RenderDevice(Device& on, const Scene& what, const PixelRect& crop, const KernelOptions& kernels,
               RayChoice rays, const std::vector<std::string>& passes, unsigned threads);

  Device& device;
  const std::map<std::string, KernelTime> times_before;  // of earlier renders
  const std::size_t kept_before;
  Programs programs;
  DeviceScene scene;
  Film film;
  std::unique_ptr<PassIntegrator> integrator;  // set by who knows which

  /// Of this render alone.
  std::map<std::string, KernelTime> kernel_times() const;
};

/// Passes shared by several devices: each holds the whole scene, and from the second pass on has pixels and
/// photons of its own, as many as its speed in the first, which all do whole. Photons are exchanged before
/// they are gathered, and their flux is added up in integers, so that the picture is that of one device to
/// the bit where the devices' arithmetic is the same.
class SeveralDevices : public PassIntegrator {
 public:
  /// The film of the first of `devices` becomes that of the whole picture. `integrator` is set in all.
  explicit SeveralDevices(const std::vector<std::unique_ptr<RenderDevice>>& devices);

  void enqueue_pass(std::uint32_t pass) override;
  Totals finish() override;
  std::vector<Channel> channels() override;
  IntegratorState state() override;
  void go_on(const IntegratorState& state, std::uint32_t next_pass) override;
  std::vector<std::string> depends_on_history() const override {
    return devices_[0]->integrator->depends_on_history();
  }
  std::string depends_on_other_pixels() const override {
    return devices_[0]->integrator->depends_on_other_pixels();
  }
  double bytes_per_pixel() const override { return devices_[0]->integrator->bytes_per_pixel(); }

  /// "each pass is shared: 52% on NAME, 48% on NAME"; after the first pass.
  std::string fractions_text() const;

 private:
  std::vector<RenderDevice*> devices_;
  std::vector<PassFraction> fractions_;
  bool shared_ = false;  // after the first pass

  void assign_fractions();
  void complete_film();
};

}  // namespace causticl
