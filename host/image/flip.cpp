#include "image/flip.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "base/task_pool.hpp"
#include "base/vec.hpp"

namespace causticl {
namespace {

// The names and numbers of the paper.
constexpr double pixels_per_degree = 0.7 * 3840 / 0.7 * std::numbers::pi / 180;
constexpr double q_color = 0.7, p_color = 0.4, p_threshold = 0.95;
constexpr double feature_width = 0.082, q_feature = 0.5;
constexpr Vec3 white{0.950428545, 1.0, 1.088900371};  // XYZ of D65

struct Field {  // three channels
  int width, height;
  std::vector<Vec3> pixels;
};

/// What a display shows for a linear value: clamped, encoded with power 1/2.2, decoded as sRGB.
double displayed(float value) {
  const double encoded = std::pow(value > 0 ? std::min(value, 1.0f) : 0.0f, 1 / 2.2);
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

/// XYZ over that of white.
Vec3 xyz_of(Vec3 rgb) {
  const Vec3 xyz{dot({10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794}, rgb),
                 dot({2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897}, rgb),
                 dot({1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}, rgb)};
  return {xyz.x / white.x, xyz.y / white.y, xyz.z / white.z};
}

Vec3 opponent_of(Vec3 rgb) {
  const Vec3 n = xyz_of(rgb);
  return {116 * n.y - 16, 500 * (n.x - n.y), 200 * (n.y - n.z)};
}

Vec3 rgb_of_opponent(Vec3 c) {
  const double y = (c.x + 16) / 116, x = y + c.y / 500, z = y - c.z / 200;
  static const Transform to_rgb = [] {
    Transform to_xyz;
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 unit;
      unit[axis] = 1;
      const Vec3 column = xyz_of(unit);
      for (int row = 0; row < 3; ++row) to_xyz.rows[static_cast<std::size_t>(row)][axis] = column[row];
    }
    return to_xyz.inverse();
  }();
  return to_rgb.vector({x, y, z});
}

/// CIELab with the Hunt effect: colours count for less where it is dark.
Vec3 hunt_lab_of(Vec3 rgb) {
  const auto f = [](double t) {
    constexpr double delta = 6.0 / 29;
    return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
  };
  const Vec3 n = xyz_of(rgb);
  const double lightness = 116 * f(n.y) - 16;
  return {lightness, 0.01 * lightness * 500 * (f(n.x) - f(n.y)), 0.01 * lightness * 200 * (f(n.y) - f(n.z))};
}

double hyab_distance(Vec3 a, Vec3 b) { return std::fabs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z); }

/// Weights for the offsets -radius ... radius in x and y, one set a channel.
struct Kernel {
  int radius;
  std::vector<Vec3> weights;

  Kernel(int r, const std::function<Vec3(int, int)>& weight) : radius(r) {
    for (int y = -r; y <= r; ++y)
      for (int x = -r; x <= r; ++x) weights.push_back(weight(x, y));
  }
};

/// Convolves channel by channel; pixels beyond an edge are those of the edge.
Field convolve(const Field& field, const Kernel& kernel) {
  Field out{field.width, field.height, std::vector<Vec3>(field.pixels.size())};
  parallel_chunks(static_cast<std::size_t>(field.height), 8, 0, [&](std::size_t first, std::size_t last) {
    for (int y = static_cast<int>(first); y < static_cast<int>(last); ++y)
      for (int x = 0; x < field.width; ++x) {
        Vec3 sum;
        const Vec3* weight = kernel.weights.data();
        for (int dy = -kernel.radius; dy <= kernel.radius; ++dy) {
          const auto row = static_cast<std::size_t>(std::clamp(y + dy, 0, field.height - 1)) * field.width;
          for (int dx = -kernel.radius; dx <= kernel.radius; ++dx, ++weight) {
            const Vec3& p =
                field.pixels[row + static_cast<std::size_t>(std::clamp(x + dx, 0, field.width - 1))];
            sum = {sum.x + weight->x * p.x, sum.y + weight->y * p.y, sum.z + weight->z * p.z};
          }
        }
        out.pixels[static_cast<std::size_t>(y) * field.width + x] = sum;
      }
  });
  return out;
}

/// What the eye resolves of each opponent channel: one or two Gaussians, with sum 1.
Kernel contrast_sensitivity() {
  struct Gaussians {
    double a1, b1, a2, b2;
  };
  constexpr Gaussians channels[3] = {{1, 0.0047, 0, 1e-5}, {1, 0.0053, 0, 1e-5}, {34.1, 0.04, 13.5, 0.025}};
  const int radius = static_cast<int>(
      std::ceil(3 * std::sqrt(0.04 / (2 * std::numbers::pi * std::numbers::pi)) * pixels_per_degree));
  Kernel kernel(radius, [&](int x, int y) {
    const double z = (x * x + y * y) / (pixels_per_degree * pixels_per_degree);
    Vec3 weight;
    for (int c = 0; c < 3; ++c) {
      const auto gaussian = [&](double a, double b) {
        return a * std::sqrt(std::numbers::pi / b) * std::exp(-std::numbers::pi * std::numbers::pi * z / b);
      };
      weight[c] = gaussian(channels[c].a1, channels[c].b1) + gaussian(channels[c].a2, channels[c].b2);
    }
    return weight;
  });
  Vec3 sum;
  for (const Vec3& w : kernel.weights) sum = sum + w;
  for (Vec3& w : kernel.weights) w = {w.x / sum.x, w.y / sum.y, w.z / sum.z};
  return kernel;
}

/// First (edges: x, y) or second (points: x, y) derivatives of a Gaussian in the channels x and y, the
/// positive and the negative weights each with sum 1.
Kernel feature_detector(bool points) {
  const double deviation = 0.5 * feature_width * pixels_per_degree;
  const auto along = [&](int t) {
    return points ? t * t / (deviation * deviation) - 1 : -static_cast<double>(t);
  };
  Kernel kernel(static_cast<int>(std::ceil(3 * deviation)), [&](int x, int y) {
    const double g = std::exp(-(x * x + y * y) / (2 * deviation * deviation));
    return Vec3{along(x) * g, along(y) * g, 0};
  });
  double positive = 0, negative = 0;
  for (const Vec3& w : kernel.weights) (w.x > 0 ? positive : negative) += std::fabs(w.x);
  for (Vec3& w : kernel.weights)
    for (int c = 0; c < 2; ++c) w[c] /= w[c] > 0 ? positive : negative;
  return kernel;
}

/// How much of an edge, or a point, each pixel is.
std::vector<double> features(const Field& opponent, bool points) {
  Field lightness = opponent;  // twice the same channel: one for each direction
  for (Vec3& p : lightness.pixels) p = {(p.x + 16) / 116, (p.x + 16) / 116, 0};
  const Field found = convolve(lightness, feature_detector(points));
  std::vector<double> result;
  for (const Vec3& p : found.pixels) result.push_back(std::hypot(p.x, p.y));
  return result;
}

/// Colours as they are perceived: blurred by the eye, in Hunt-adjusted CIELab.
std::vector<Vec3> perceived(const Field& opponent) {
  Field filtered = convolve(opponent, contrast_sensitivity());
  for (Vec3& p : filtered.pixels) {
    Vec3 rgb = rgb_of_opponent(p);
    for (int c = 0; c < 3; ++c) rgb[c] = std::clamp(rgb[c], 0.0, 1.0);
    p = hunt_lab_of(rgb);
  }
  return std::move(filtered.pixels);
}

Field opponent_field(const Picture& picture) {
  Field field{picture.width, picture.height, {}};
  for (std::size_t i = 0; i + 2 < picture.rgb.size(); i += 3)
    field.pixels.push_back(opponent_of(
        {displayed(picture.rgb[i]), displayed(picture.rgb[i + 1]), displayed(picture.rgb[i + 2])}));
  return field;
}

/// The distance of two colours, spread over [0, 1].
double color_difference(Vec3 a, Vec3 b) {
  static const double largest =
      std::pow(hyab_distance(hunt_lab_of({0, 1, 0}), hunt_lab_of({0, 0, 1})), q_color);
  const double difference = std::pow(hyab_distance(a, b), q_color), knee = p_color * largest;
  return difference < knee ? p_threshold / knee * difference
                           : p_threshold + (difference - knee) / (largest - knee) * (1 - p_threshold);
}

}  // namespace

std::vector<float> flip_map(const Picture& test, const Picture& reference) {
  const Field a = opponent_field(test), b = opponent_field(reference);
  const auto color_a = perceived(a), color_b = perceived(b);
  const auto edges_a = features(a, false), edges_b = features(b, false);
  const auto points_a = features(a, true), points_b = features(b, true);
  std::vector<float> map;
  for (std::size_t i = 0; i < color_a.size(); ++i) {
    const double feature =
        std::pow(std::max(std::fabs(edges_a[i] - edges_b[i]), std::fabs(points_a[i] - points_b[i])) /
                     std::numbers::sqrt2,
                 q_feature);
    map.push_back(static_cast<float>(std::pow(color_difference(color_a[i], color_b[i]), 1 - feature)));
  }
  return map;
}

}  // namespace causticl
