#include "scene/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace causticl {
namespace {

constexpr double first_wavelength = 380, last_wavelength = 720;
constexpr int steps = 3400;

/// A Gaussian with a width on either side.
double lobe(double x, double mean, double below, double above) {
  const double t = (x - mean) / (x < mean ? below : above);
  return std::exp(-0.5 * t * t);
}

/// table[channel][i] = fraction of the channel's density below first_wavelength + i steps.
using CdfTable = std::array<std::vector<double>, 3>;

CdfTable make_cdfs() {
  CdfTable cdfs;
  for (int channel = 0; channel < 3; ++channel) {
    std::vector<double>& table = cdfs[static_cast<std::size_t>(channel)];
    table.assign(steps + 1, 0);
    for (int i = 0; i < steps; ++i)
      table[i + 1] =
          table[i] + channel_response(channel, first_wavelength +
                                                   (last_wavelength - first_wavelength) * (i + 0.5) / steps);
    for (double& value : table) value /= table[steps];
  }
  return cdfs;
}

}  // namespace

double channel_response(int channel, double wavelength) {
  const double x = 1.056 * lobe(wavelength, 599.8, 37.9, 31.0) + 0.362 * lobe(wavelength, 442.0, 16.0, 26.7) -
                   0.065 * lobe(wavelength, 501.1, 20.4, 26.2);
  const double y = 0.821 * lobe(wavelength, 568.8, 46.9, 40.5) + 0.286 * lobe(wavelength, 530.9, 16.3, 31.1);
  const double z = 1.217 * lobe(wavelength, 437.0, 11.8, 36.0) + 0.681 * lobe(wavelength, 459.0, 26.0, 13.8);
  // From XYZ to linear sRGB (IEC 61966-2-1).
  constexpr double matrix[3][3] = {
      {3.2406, -1.5372, -0.4986}, {-0.9689, 1.8758, 0.0415}, {0.0557, -0.2040, 1.0570}};
  return std::max(0.0, matrix[channel][0] * x + matrix[channel][1] * y + matrix[channel][2] * z);
}

std::array<double, 3> channel_wavelengths(double u) {
  static const CdfTable cdfs = make_cdfs();
  std::array<double, 3> wavelengths{};
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const auto& table = cdfs[channel];
    const auto above = std::upper_bound(table.begin() + 1, table.end() - 1, u);
    // No wavelengths of no density lie at either end: there any is right.
    const double low = *(above - 1), width = *above - low;
    const double fraction = width > 0 ? std::clamp((u - low) / width, 0.0, 1.0) : 0;
    const double step = static_cast<double>(above - 1 - table.begin()) + fraction;
    wavelengths[channel] = first_wavelength + (last_wavelength - first_wavelength) * step / steps;
  }
  return wavelengths;
}

std::array<double, 3> pass_wavelengths(std::uint32_t seed, std::uint32_t pass) {
  const double u = seed * std::numbers::phi + pass * (std::numbers::sqrt2 - 1);
  return channel_wavelengths(u - std::floor(u));
}

}  // namespace causticl
