// Which wavelengths the colour channels stand for.
#pragma once

#include <array>
#include <cstdint>

namespace causticl {

/// Relative density of the wavelengths (in nm, 380 to 720) that a linear sRGB channel (0 to 2) stands for:
/// its colour matching function, where that is positive, by the fit of Wyman, Sloan & Shirley, "Simple
/// Analytic Approximations to the CIE XYZ Color Matching Functions", JCGT 2013. Light of one wavelength then
/// has the nearest colour that needs no negative light, and even light of all wavelengths is white.
double channel_response(int channel, double wavelength);

/// The wavelength in nm of each channel below which a fraction u in [0, 1] of its density lies.
std::array<double, 3> channel_wavelengths(double u);

/// The wavelengths of pass number `pass`: those of u = k (sqrt(2) - 1) + a start of the seed's own, modulo 1,
/// which fills [0, 1] evenly in any range of passes.
std::array<double, 3> pass_wavelengths(std::uint32_t seed, std::uint32_t pass);

}  // namespace causticl
