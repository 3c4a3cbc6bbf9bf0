#include "device_scene/channel_shifts.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace causticl {
namespace {

/// Photons resolve a channel this much weaker than the largest well: sixteen units of their records.
constexpr double least_ratio = 1.0 / 256;
/// Powers of two that a float holds beside the factors of a path.
constexpr int largest_shift = 100;

/// A light's channels over its largest.
struct LightChannels {
  std::string pointer;
  std::array<double, 3> ratios{};
};

void add_light(std::vector<LightChannels>& lights, const std::string& pointer, Vec3 radiance) {
  const double largest = max_component(radiance);
  if (largest > 0)
    lights.push_back({pointer, {radiance.x / largest, radiance.y / largest, radiance.z / largest}});
}

/// The largest ratio of each channel that any texel has: photons come from single texels.
void add_map(std::vector<LightChannels>& lights, const LightSpec& map) {
  LightChannels light{map.pointer, {}};
  const auto& texels = map.map.rgba;
  const auto is_rich = [&] {
    return std::all_of(light.ratios.begin(), light.ratios.end(), [](double s) { return s >= least_ratio; });
  };
  for (std::size_t i = 0; i + 3 < texels.size() && !is_rich(); i += 4) {
    const double largest = std::max({texels[i], texels[i + 1], texels[i + 2]});
    if (!(largest > 0)) continue;
    for (std::size_t c = 0; c < 3; ++c) light.ratios[c] = std::max(light.ratios[c], texels[i + c] / largest);
  }
  lights.push_back(light);
}

std::vector<LightChannels> lights_of(const Scene& scene) {
  std::vector<LightChannels> lights;
  for (const auto& object : scene.objects) {
    const MaterialSpec& material = scene.materials[static_cast<std::size_t>(object.material)];
    if (material.light < 0) add_light(lights, object.pointer, material.emission);
  }
  for (const auto& light : scene.lights) {
    if (light.map.rgba.empty())
      add_light(lights, light.pointer, light.intensity);
    else if (is_lit(light))
      add_map(lights, light);
  }
  return lights;
}

std::array<int, 3> shifts_of(const std::vector<LightChannels>& lights) {
  std::array<int, 3> shifts{};
  for (std::size_t c = 0; c < 3; ++c) {
    double ratio = 0;
    for (const auto& light : lights) ratio = std::max(ratio, light.ratios[c]);
    if (ratio > 0 && ratio < least_ratio)
      shifts[c] = std::min(static_cast<int>(std::floor(-std::log2(ratio))), largest_shift);
  }
  return shifts;
}

}  // namespace

uint channel_shifts(const Scene& scene) {
  const auto shifts = shifts_of(lights_of(scene));
  return static_cast<uint>(shifts[0]) | static_cast<uint>(shifts[1]) << 8 |
         static_cast<uint>(shifts[2]) << 16;
}

std::vector<std::string> coarse_channel_notices(const Scene& scene) {
  constexpr const char* names[] = {"red", "green", "blue"};
  const auto lights = lights_of(scene);
  const auto shifts = shifts_of(lights);
  std::vector<std::string> notices;
  for (const auto& light : lights)
    for (std::size_t c = 0; c < 3; ++c) {
      // A unit of the record is 1/4096: below a sixteenth of it, dithering adds more noise than sixteen times
      // as many photons take away.
      const double throughput = std::ldexp(light.ratios[c], shifts[c]);
      if (light.ratios[c] > 0 && throughput < 1.0 / 65536)
        notices.push_back(
            std::string("the ") + names[c] + " of " + light.pointer +
            " is so weak beside its other channels that photons show it as noise where no other "
            "lamp lights: render with --integrator pt where it matters");
    }
  return notices;
}

}  // namespace causticl
