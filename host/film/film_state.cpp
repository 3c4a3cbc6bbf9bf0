#include "film/film_state.hpp"

#include <algorithm>
#include <iterator>

namespace causticl {

PixelRect with_margin(const PixelRect& crop, int width, int height) {
  constexpr int margin = 4;  // ERROR_REACH of cl/passes/pass_film.cl
  return {std::max(crop.x0 - margin, 0), std::max(crop.y0 - margin, 0), std::min(crop.x1 + margin, width),
          std::min(crop.y1 + margin, height)};
}

std::string text_of(const PixelRect& rect) {
  return std::to_string(rect.x0) + "," + std::to_string(rect.y0) + "," + std::to_string(rect.x1) + "," +
         std::to_string(rect.y1);
}

bool sums_fit(const FilmState& film) {
  // A number adds at most half a bin to either integer of a sum.
  const std::uint64_t passes = film.passes.count();
  const auto most = static_cast<std::int64_t>(passes << (EXACT_SUM_BITS - 1));
  const auto fits = [most](const ExactSum& sum) {
    const std::int64_t low = exact_sum_low(sum);
    return -most <= sum.high && sum.high <= most && -most <= low && low <= most;
  };
  const auto all_fit = [&fits](const auto& sums) {
    return std::all_of(std::begin(sums), std::end(sums), fits);
  };
  for (const FilmPixel& pixel : film.pixels)
    if (!all_fit(pixel.radiance) || !all_fit(pixel.luminance) || !fits(pixel.luminance2) ||
        !all_fit(pixel.kernel_bias) || std::uint64_t{pixel.left_out[0]} + pixel.left_out[1] > passes)
      return false;
  for (const FilmLightPasses& pixel : film.layers)
    for (const auto& layer : pixel.radiance)
      if (!all_fit(layer)) return false;
  return true;
}

std::string difference_of(const RenderIdentity& theirs, const std::string& name, const RenderIdentity& ours,
                          const std::string& our_name) {
  const auto value_in = [](const RenderIdentity& identity, const std::string& key) {
    for (const auto& [own, value] : identity)
      if (own == key) return value;
    return std::string("none");
  };
  std::vector<std::string> keys;
  for (const auto* identity : {&ours, &theirs})
    for (const auto& [key, value] : *identity)
      if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
  for (const auto& key : keys) {
    const std::string a = value_in(theirs, key), b = value_in(ours, key);
    if (a != b) return key + ": " + a + " in " + name + ", " + b + " " + our_name;
  }
  return "";
}

}  // namespace causticl
