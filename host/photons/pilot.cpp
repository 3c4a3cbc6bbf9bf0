#include "photons/pilot.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace causticl {
namespace {

template <typename... Arguments>
std::string formatted(const char* format, Arguments... arguments) {
  std::string text(static_cast<std::size_t>(std::snprintf(nullptr, 0, format, arguments...)), '\0');
  std::snprintf(text.data(), text.size() + 1, format, arguments...);
  return text;
}

/// The number below which a fraction of `values` lies.
template <typename T>
double quantile(std::vector<T> values, double fraction) {
  const auto rank =
      std::min(static_cast<std::size_t>(fraction * static_cast<double>(values.size())), values.size() - 1);
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace

Surroundings surroundings_of(std::span<const Vec3> points, std::span<const float> distances) {
  Surroundings result;
  if (points.empty()) return result;
  result.sees_surface = true;
  double sides[3];
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const Vec3& point : points) values.push_back(point[axis]);
    result.low[axis] = quantile(values, 0.05);
    result.high[axis] = quantile(values, 0.95);
    sides[axis] = result.high[axis] - result.low[axis];
  }
  std::sort(std::begin(sides), std::end(sides));
  // Of a floor that fills the picture the smallest side is nothing.
  result.room = quantile(std::vector<float>(distances.begin(), distances.end()), 0.5);
  if (!std::isfinite(result.room) || !(result.room > 0)) result.room = sides[1];
  // A single point, or all on a line: what is left is how far things are.
  if (!(result.room > 0)) result.room = sides[2];
  return result;
}

std::vector<std::string> pilot_lines(const Pilot& pilot, const RendererSpec& renderer) {
  std::vector<std::string> lines;
  if (!pilot.around.sees_surface) {
    lines.push_back("the pilot found nothing in view that photons could light");
    return lines;
  }
  if (!renderer.radius) {
    std::string why = "within which the median point in view finds a dozen photons";
    if (!pilot.photons_found)
      why = formatted("%g of the room of %.3g: no photon of the pilot landed near what the camera sees",
                      largest_radius_fraction, pilot.around.room);
    else if (pilot.radius_at_limit)
      why = formatted(
          "%g of the room of %.3g: few photons land in view, and a larger one would blur more than it finds",
          largest_radius_fraction, pilot.around.room);
    lines.push_back(formatted("first radius %.4g, chosen from the scene: %s (renderer.radius sets it)",
                              pilot.first_radius, why.c_str()));
  }
  if (!pilot.emission.empty())
    lines.push_back(
        formatted("emission map: photons start where they reach what the camera sees (%.2g%% of them do "
                  "without the map, "
                  "%.2g%% with it; renderer.guided_photons sets it)",
                  100 * pilot.useful, 100 * pilot.useful_by_map));
  if (pilot.copies)
    lines.push_back(
        "Metropolis photons: paths that reach what the camera sees are mutated (renderer.guided_photons sets "
        "it)");
  return lines;
}

}  // namespace causticl
