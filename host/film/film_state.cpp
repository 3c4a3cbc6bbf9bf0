#include "film/film_state.hpp"

#include <algorithm>

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
