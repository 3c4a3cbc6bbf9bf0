#include "render/several_devices.hpp"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <future>

namespace causticl {
namespace {

/// Calls `work` for each device, all at the same time. Throws what the first that failed threw.
void for_each(const std::vector<RenderDevice*>& devices, const std::function<void(RenderDevice&)>& work) {
  std::vector<std::future<void>> running;
  running.reserve(devices.size());
  for (RenderDevice* device : devices)
    running.push_back(std::async(std::launch::async, [&work, device] { work(*device); }));
  for (auto& one : running) one.wait();
  for (auto& one : running) one.get();
}

KernelOptions with_rays(KernelOptions kernels, RayChoice wanted, const Scene& scene, const Device& device) {
  kernels.camera_packets = packets_chosen(wanted.camera, device, kernels);
  kernels.brute_force = brute_force_chosen(wanted.photon, scene, device, kernels);
  return kernels;
}

/// Whether a pixel's estimates are more even than independent ones, and owe nothing to what pixels share in a
/// pass: photons, its time, its wavelengths.
bool low_discrepancy_and_negatively_correlated(const Scene& scene, const std::vector<std::string>& passes) {
  return scene.renderer.sampler == Sampler::sobol && !has_motion(scene) &&
         std::none_of(passes.begin(), passes.end(), [](const auto& pass) { return pass == "photon"; }) &&
         std::none_of(scene.materials.begin(), scene.materials.end(),
                      [](const MaterialSpec& material) { return material.dispersion > 0; });
}

}  // namespace

RenderDevice::RenderDevice(Device& on, const Scene& what, const PixelRect& crop, const KernelOptions& kernels,
                           RayChoice rays, const std::vector<std::string>& passes, unsigned threads)
    : device(on),
      times_before(on.kernel_times()),
      kept_before(on.cached_programs()),
      programs(on, with_rays(kernels, rays, what, on), passes),
      scene(update_device_scene(what, on, threads, kernels.triangle_test)),
      film(on, programs, what.width, what.height, crop,
           low_discrepancy_and_negatively_correlated(what, passes)) {}

std::map<std::string, KernelTime> RenderDevice::kernel_times() const {
  auto times = device.kernel_times();
  for (const auto& [name, time] : times_before) {
    times[name].milliseconds -= time.milliseconds;
    times[name].launches -= time.launches;
  }
  std::erase_if(times, [](const auto& entry) { return entry.second.launches == 0; });
  return times;
}

SeveralDevices::SeveralDevices(const std::vector<std::unique_ptr<RenderDevice>>& devices)
    : fractions_(devices.size()) {
  for (const auto& device : devices) devices_.push_back(device.get());
  began_ = devices_[0]->integrator->began();
  early_seconds_ = devices_[0]->integrator->early_seconds();
  devices_[0]->film.complete_by([this] { complete_film(); });
}

void SeveralDevices::enqueue_pass(std::uint32_t pass) {
  if (!shared_) {
    for_each(devices_, [pass](RenderDevice& d) {
      d.integrator->enqueue_pass(pass);
      d.device.queue().finish();
    });
    assign_fractions();
    shared_ = true;
    return;
  }
  for_each(devices_, [pass](RenderDevice& d) { d.integrator->trace_own_photons(pass); });
  std::vector<std::vector<std::byte>> photons;
  for (RenderDevice* d : devices_) photons.push_back(d->integrator->photons());
  for_each(devices_, [&](RenderDevice& d) {
    d.integrator->set_photons(photons);
    d.integrator->enqueue_pass(pass);
    d.device.queue().flush();
  });
}

/// In proportion to the speed with which each device did the first pass.
void SeveralDevices::assign_fractions() {
  std::vector<double> speeds;
  double all = 0;
  for (const RenderDevice* d : devices_) {
    double milliseconds = 0;
    for (const auto& [name, time] : d->kernel_times()) milliseconds += time.milliseconds;
    speeds.push_back(1 / std::max(milliseconds, 1e-6));
    all += speeds.back();
  }
  double begin = 0, sum = 0;
  for (std::size_t i = 0; i < devices_.size(); ++i) {
    sum += speeds[i];
    const double end = i + 1 == devices_.size() ? 1 : sum / all;
    fractions_[i] = {begin, end};
    devices_[i]->integrator->set_fraction(fractions_[i]);
    begin = end;
  }
}

std::string SeveralDevices::fractions_text() const {
  std::string text = "each pass is shared:";
  for (std::size_t i = 0; i < devices_.size(); ++i) {
    char percent[32];
    std::snprintf(percent, sizeof percent, "%s %.0f%% on ", i ? "," : "",
                  100 * (fractions_[i].end - fractions_[i].begin));
    text += percent + devices_[i]->device.info().name;
  }
  return text;
}

PassIntegrator::Totals SeveralDevices::finish() {
  Totals totals = devices_[0]->integrator->finish();
  for (std::size_t i = 1; i < devices_.size(); ++i) {
    const Totals more = devices_[i]->integrator->finish();
    totals.rays += more.rays;
    for (const auto& kind : diagnostic_kinds) totals.diagnostics.*kind.count += more.diagnostics.*kind.count;
  }
  return totals;
}

/// Each device has the statistics of its own pixels.
std::vector<Channel> SeveralDevices::channels() {
  auto channels = devices_[0]->integrator->channels();
  for (std::size_t i = 1; i < devices_.size(); ++i) {
    const auto its = devices_[i]->integrator->channels();
    for (std::size_t c = 0; c < channels.size(); ++c) {
      auto& values = channels[c].values;
      const auto first = static_cast<std::ptrdiff_t>(fractions_[i].first_of(values.size()));
      const auto end = static_cast<std::ptrdiff_t>(fractions_[i].end_of(values.size()));
      std::copy(its[c].values.begin() + first, its[c].values.begin() + end, values.begin() + first);
    }
  }
  return channels;
}

IntegratorState SeveralDevices::state() {
  IntegratorState whole = devices_[0]->integrator->state();
  const std::size_t pixels = devices_[0]->film.pixels();
  for (std::size_t i = 1; i < devices_.size(); ++i)
    for (const auto& [name, own] : devices_[i]->integrator->state()) {
      if (!name.ends_with(".pixels")) continue;
      const std::size_t record = own.size() / pixels;
      const auto first = static_cast<std::ptrdiff_t>(fractions_[i].first_of(pixels) * record);
      const auto end = static_cast<std::ptrdiff_t>(fractions_[i].end_of(pixels) * record);
      std::copy(own.begin() + first, own.begin() + end, whole[name].begin() + first);
    }
  return whole;
}

void SeveralDevices::go_on(const IntegratorState& state, std::uint32_t next_pass) {
  for (RenderDevice* device : devices_) device->integrator->go_on(state, next_pass);
}

void SeveralDevices::complete_film() {
  Film& whole = devices_[0]->film;
  for (std::size_t i = 1; i < devices_.size(); ++i)
    whole.take_pixels(devices_[i]->film, fractions_[i].first_of(whole.pixels()),
                      fractions_[i].count_of(whole.pixels()));
}

}  // namespace causticl
