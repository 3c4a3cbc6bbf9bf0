#include "device_scene/channel_shifts.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace causticl {
namespace {

/// Photons resolve a channel this much weaker than the largest well: sixteen units of their records.
constexpr double least_share = 1.0 / 256;
/// Powers of two that a float holds beside the factors of a path.
constexpr int largest_shift = 100;

/// A lamp's channels over its largest.
struct Lamp {
  std::string pointer;
  std::array<double, 3> shares{};
};

void add_lamp(std::vector<Lamp>& lamps, const std::string& pointer, Vec3 light) {
  const double largest = max_component(light);
  if (largest > 0) lamps.push_back({pointer, {light.x / largest, light.y / largest, light.z / largest}});
}

/// The largest share of each channel that any texel has: photons come from single texels.
void add_environment(std::vector<Lamp>& lamps, const Environment& environment) {
  Lamp lamp{environment.pointer, {}};
  const auto& texels = environment.map.rgba;
  const auto is_rich = [&] {
    return std::all_of(lamp.shares.begin(), lamp.shares.end(), [](double s) { return s >= least_share; });
  };
  for (std::size_t i = 0; i + 3 < texels.size() && !is_rich(); i += 4) {
    const double largest = std::max({texels[i], texels[i + 1], texels[i + 2]});
    if (!(largest > 0)) continue;
    for (std::size_t c = 0; c < 3; ++c) lamp.shares[c] = std::max(lamp.shares[c], texels[i + c] / largest);
  }
  lamps.push_back(lamp);
}

std::vector<Lamp> lamps_of(const Scene& scene) {
  std::vector<Lamp> lamps;
  for (const auto& object : scene.objects)
    add_lamp(lamps, object.pointer, scene.materials[static_cast<std::size_t>(object.material)].emission);
  for (const auto& light : scene.lights) add_lamp(lamps, light.pointer, light.intensity);
  if (scene.environment && is_lit(*scene.environment)) add_environment(lamps, *scene.environment);
  return lamps;
}

std::array<int, 3> shifts_of(const std::vector<Lamp>& lamps) {
  std::array<int, 3> shifts{};
  for (std::size_t c = 0; c < 3; ++c) {
    double share = 0;
    for (const auto& lamp : lamps) share = std::max(share, lamp.shares[c]);
    if (share > 0 && share < least_share)
      shifts[c] = std::min(static_cast<int>(std::floor(-std::log2(share))), largest_shift);
  }
  return shifts;
}

}  // namespace

uint channel_shifts(const Scene& scene) {
  const auto shifts = shifts_of(lamps_of(scene));
  return static_cast<uint>(shifts[0]) | static_cast<uint>(shifts[1]) << 8 |
         static_cast<uint>(shifts[2]) << 16;
}

std::vector<std::string> coarse_channel_notices(const Scene& scene) {
  constexpr const char* names[] = {"red", "green", "blue"};
  const auto lamps = lamps_of(scene);
  const auto shifts = shifts_of(lamps);
  std::vector<std::string> notices;
  for (const auto& lamp : lamps)
    for (std::size_t c = 0; c < 3; ++c) {
      // A unit of the record is 1/4096: below a sixteenth of it, dithering adds more noise than sixteen times
      // as many photons take away.
      const double throughput = std::ldexp(lamp.shares[c], shifts[c]);
      if (lamp.shares[c] > 0 && throughput < 1.0 / 65536)
        notices.push_back(
            std::string("the ") + names[c] + " of " + lamp.pointer +
            " is so weak beside its other channels that photons show it as noise where no other "
            "lamp lights: render with --integrator pt where it matters");
    }
  return notices;
}

}  // namespace causticl
