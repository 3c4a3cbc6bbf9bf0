#include "world/environment.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace causticl {
namespace {

/// What each texel's fraction of all numbers is in proportion to.
class TexelWeights {
 public:
  TexelWeights(const Image& map, std::vector<double> of_rows) : map_(map), of_rows_(std::move(of_rows)) {}
  double operator()(std::size_t texel) const {
    const float* rgb = map_.rgba.data() + 4 * texel;
    return std::max({rgb[0], rgb[1], rgb[2]}) * of_rows_[texel / static_cast<std::size_t>(map_.width)];
  }
  std::size_t texels() const { return map_.rgba.size() / 4; }
  double sum() const {
    double sum = 0;
    for (std::size_t i = 0; i < texels(); ++i) sum += (*this)(i);
    return sum;
  }

 private:
  const Image& map_;
  std::vector<double> of_rows_;
};

/// The sine of a row's middle stands for its solid angle.
TexelWeights sphere_weights(const Image& map) {
  std::vector<double> sines;
  for (int row = 0; row < map.height; ++row)
    sines.push_back(std::sin(std::numbers::pi * (row + 0.5) / map.height));
  return {map, std::move(sines)};
}

TexelWeights flat_weights(const Image& map) {
  return {map, std::vector<double>(static_cast<std::size_t>(map.height), 1)};
}

std::vector<EnvironmentTexel> table_of(const Image& map, const TexelWeights& weight, std::uint64_t numbers) {
  const double total = weight.sum(), all = static_cast<double>(numbers);
  std::vector<EnvironmentTexel> table(weight.texels());
  double sum = 0;
  std::uint64_t before = 0;
  for (std::size_t i = 0; i < table.size(); ++i) {
    sum += weight(i);
    table[i].cdf = static_cast<std::uint64_t>(std::llround(sum / total * all));
    if (numbers > 0)
      table[i].density = static_cast<float>(static_cast<double>(table[i].cdf - before) / all *
                                            static_cast<double>(table.size()));
    before = table[i].cdf;
    std::copy_n(map.rgba.data() + 4 * i, 3, table[i].radiance);
  }
  return table;
}

}  // namespace

double environment_integral(const Image& map) {
  const TexelWeights weight = sphere_weights(map);
  return 2 * std::numbers::pi * std::numbers::pi * weight.sum() / static_cast<double>(weight.texels());
}

double mean_radiance(const Image& map) {
  const TexelWeights weight = flat_weights(map);
  return weight.sum() / static_cast<double>(weight.texels());
}

std::vector<EnvironmentTexel> environment_table(const Image& map, std::uint64_t numbers) {
  return table_of(map, sphere_weights(map), numbers);
}

std::vector<EnvironmentTexel> flat_table(const Image& map, std::uint64_t numbers) {
  return table_of(map, flat_weights(map), numbers);
}

}  // namespace causticl
