#include "render/convergence.hpp"

#include "integrators/integrators.hpp"

namespace causticl {
namespace {

constexpr std::size_t look_pixels = 2048;     // a fraction of so many is right to two thirds of a percent
constexpr std::size_t measure_pixels = 4096;  // and of so many to half of one

}  // namespace

ConvergenceCheck::ConvergenceCheck(Film& film, const RendererSpec& renderer, double confidence,
                                   std::optional<double> wanted)
    : film_(film), confidence_(confidence), trend_(expected_rates(renderer), confidence), wanted_(wanted) {}

void ConvergenceCheck::update(std::uint64_t passes) {
  if (passes < next_) return;
  next_ = passes + std::max<std::uint64_t>(1, passes / 5);
  trend_.add(passes, film_.look(look_pixels));
  if (!last()) return;
  if (std::isfinite(last()->error)) until_half_ = trend_.passes_until(last()->error / 2);
  if (wanted_) until_wanted_ = trend_.passes_until(*wanted_);
}

void ConvergenceCheck::skip(std::uint64_t passes) {
  while (next_ <= passes) next_ += std::max<std::uint64_t>(1, next_ / 5);
}

std::optional<PictureError> ConvergenceCheck::measure(std::uint64_t passes) const {
  if (passes < 2) return {};
  return picture_error(film_.look(measure_pixels), confidence_);
}

}  // namespace causticl
