// The wavelengths that colour channels stand for.
#include <algorithm>
#include <cmath>
#include <vector>

#include "catch2.hpp"
#include "scene/spectrum.hpp"

using namespace causticl;

namespace {

/// The fraction of a channel's density below a wavelength, by Simpson's rule.
double fraction_below(int channel, double wavelength) {
  const auto integral = [&](double to) {
    constexpr int steps = 20000;
    double sum = 0;
    for (int i = 0; i <= steps; ++i)
      sum += channel_response(channel, 380 + (to - 380) * i / steps) * (i % steps == 0 ? 1 : i % 2 ? 4 : 2);
    return sum * (to - 380) / (3 * steps);
  };
  return integral(wavelength) / integral(720);
}

}  // namespace

TEST_CASE("channels stand for wavelengths in proportion to their responses") {
  for (const double u : {0.0, 1e-6, 0.01, 0.2, 0.5, 0.77, 0.999, 1.0}) {
    const auto wavelengths = channel_wavelengths(u);
    for (int channel = 0; channel < 3; ++channel) {
      CAPTURE(u, channel, wavelengths[channel]);
      CHECK(wavelengths[channel] >= 380);
      CHECK(wavelengths[channel] <= 720);
      CHECK(fraction_below(channel, wavelengths[channel]) == Approx(u).margin(1e-5));
    }
  }
  const auto median = channel_wavelengths(0.5);
  CHECK(median[0] == Approx(605).margin(15));
  CHECK(median[1] == Approx(542).margin(10));
  CHECK(median[2] == Approx(452).margin(10));
}

TEST_CASE("the wavelengths of any range of passes fill the spectrum evenly") {
  for (const std::uint32_t seed : {1u, 77u, 4000000000u})
    for (const std::uint32_t first : {0u, 1000u, 3999999000u}) {
      std::vector<double> green;
      for (std::uint32_t pass = 0; pass < 256; ++pass)
        green.push_back(pass_wavelengths(seed, first + pass)[1]);
      std::sort(green.begin(), green.end());
      double worst = 0;
      for (std::size_t i = 0; i < green.size(); ++i)
        worst =
            std::max(worst, std::fabs(fraction_below(1, green[i]) - (static_cast<double>(i) + 0.5) / 256));
      CAPTURE(seed, first);
      CHECK(worst < 0.015);
    }
}
