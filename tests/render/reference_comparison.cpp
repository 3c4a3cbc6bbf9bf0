#include "reference_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

namespace causticl {
namespace {

struct Rows {
  int top, bottom, left, right;
};

/// Pixels that count: not the lamp, its mirror image and the glints, where both references are noisiest.
std::vector<bool> counted_pixels(const Picture& reference) {
  const int w = reference.width, h = reference.height;
  const auto blurred_bright = [&](int x, int y) {
    for (int c = 0; c < 3; ++c) {
      double sum = 0;
      int count = 0;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const int px = x + dx, py = y + dy;
          if (px < 0 || py < 0 || px >= w || py >= h) continue;
          sum += reference.rgb[3 * (py * w + px) + c];
          ++count;
        }
      if (sum / count > 25) return true;
    }
    return false;
  };
  std::vector<bool> counted(static_cast<std::size_t>(w) * h, true);
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x)
      if (blurred_bright(x, y))
        for (int py = std::max(0, y - 3); py <= std::min(h - 1, y + 3); ++py)
          for (int px = std::max(0, x - 3); px <= std::min(w - 1, x + 3); ++px) counted[py * w + px] = false;
  for (const Rows box :
       {Rows{300, 324, 296, 324}, {330, 356, 250, 276}, {428, 446, 330, 356}, {348, 372, 204, 228}})
    for (int y = box.top; y <= box.bottom; ++y)
      for (int x = box.left; x <= box.right; ++x) counted[y * w + x] = false;
  return counted;
}

}  // namespace

std::string reference_folder() {
  const std::string folder = std::string(CAUSTICL_SOURCE_DIR) + "/../shared/references/";
  return std::filesystem::exists(folder + "cornell_spheres.json") ? folder : "";
}

ReferenceComparison compare_with_references(const Picture& picture) {
  const Picture r1 = read_picture(reference_folder() + "cornell_spheres_vcm.pfm");
  const Picture r2 = read_picture(reference_folder() + "cornell_spheres_sppm.pfm");
  const auto counted = counted_pixels(r1);
  double product = 0, sum = 0, reference_sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < counted.size(); ++i) {
    if (!counted[i]) continue;
    for (int c = 0; c < 3; ++c) {
      const double t = picture.rgb[3 * i + c], a = r1.rgb[3 * i + c], b = r2.rgb[3 * i + c];
      product += (t - a) * (t - b);
      sum += t;
      reference_sum += 0.5 * (a + b);
      ++count;
    }
  }
  const double mean = reference_sum / static_cast<double>(count);
  return {std::sqrt(std::max(0.0, product / static_cast<double>(count))) / mean,
          sum / static_cast<double>(count), mean};
}

}  // namespace causticl
