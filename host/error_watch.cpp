#include "error_watch.hpp"

#include <algorithm>

namespace causticl {
namespace {

constexpr std::size_t sample_pixels = 4096;  // a share of so many is right to half a percent

ErrorRates expected_rates(const RendererSpec& renderer) {
  return renderer.integrator == Integrator::sppm ? sppm_rates(renderer.alpha) : path_tracing_rates;
}

}  // namespace

ErrorWatch::ErrorWatch(Film& film, const RendererSpec& renderer, double confidence)
    : film_(film), confidence_(confidence), trend_(expected_rates(renderer), confidence) {}

void ErrorWatch::update(std::uint64_t passes) {
  if (passes < next_) return;
  next_ = passes + std::max<std::uint64_t>(1, passes / 5);
  trend_.add(passes, film_.errors(passes, sample_pixels));
}

double ErrorWatch::passes_until(double wanted, std::uint64_t passes) const {
  return std::max(0.0, trend_.passes_until(wanted) - static_cast<double>(passes));
}

std::optional<PictureError> ErrorWatch::measure(std::uint64_t passes) const {
  if (passes < 2) return {};
  return picture_error(film_.errors(passes, sample_pixels), confidence_);
}

}  // namespace causticl
