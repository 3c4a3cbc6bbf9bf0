// Pearson's chi-square test: do samples follow the density that they claim?
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

namespace causticl {

/// The regularised upper incomplete gamma function Q(a, x) for a > 0, x >= 0: its series below a + 1, its
/// continued fraction (Lentz) above (Press et al., Numerical Recipes, section 6.2).
inline double gamma_q(double a, double x) {
  if (!(x > 0)) return 1;
  const double scale = std::exp(a * std::log(x) - x - std::lgamma(a));
  if (x < a + 1) {
    double term = 1 / a, sum = term;
    for (double n = a + 1; term > sum * 1e-16; ++n) sum += term *= x / n;
    return 1 - sum * scale;
  }
  constexpr double tiny = 1e-300;
  double b = x + 1 - a, c = 1 / tiny, d = 1 / b, h = d;
  for (int i = 1; i < 100000; ++i) {
    const double an = -i * (i - a);
    b += 2;
    d = an * d + b;
    d = 1 / (std::fabs(d) < tiny ? tiny : d);
    c = b + an / c;
    if (std::fabs(c) < tiny) c = tiny;
    h *= d * c;
    if (std::fabs(d * c - 1) < 1e-15) break;
  }
  return scale * h;
}

/// Probability of a statistic at least this large if the samples do follow the density.
inline double chi_square_p_value(double statistic, double degrees) {
  return gamma_q(degrees / 2, statistic / 2);
}

/// Counts of samples in bins, beside the probability of each bin.
struct Histogram {
  std::vector<double> counts, probabilities;
  double total = 0;    // samples, those outside all bins included
  double outside = 0;  // samples that no bin of positive probability took

  explicit Histogram(std::size_t bins) : counts(bins), probabilities(bins) {}
  void add(std::size_t bin) {
    ++total;
    if (bin < counts.size())
      ++counts[bin];
    else
      ++outside;
  }
  /// The counts of another histogram of the same bins.
  void add(const Histogram& other) {
    for (std::size_t i = 0; i < counts.size(); ++i) counts[i] += other.counts[i];
    total += other.total;
    outside += other.outside;
  }
  /// A sample that is known to lie in no bin.
  void add_outside() {
    ++total;
    ++outside;
  }
};

/// The p-value of a histogram. Bins that expect fewer than five samples are pooled (Cochran's rule).
inline double chi_square_p_value(const Histogram& histogram) {
  double statistic = 0, pooled_count = 0, pooled_expected = 0;
  int used = 0;
  const auto take = [&](double count, double expected) {
    statistic += (count - expected) * (count - expected) / expected;
    ++used;
  };
  for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
    const double expected = histogram.probabilities[i] * histogram.total;
    if (expected >= 5) {
      take(histogram.counts[i], expected);
    } else {
      pooled_count += histogram.counts[i];
      pooled_expected += expected;
    }
  }
  if (pooled_expected >= 1)
    take(pooled_count, pooled_expected);
  else if (pooled_count > 10)
    return 0;
  return used > 1 ? chi_square_p_value(statistic, used - 1) : 1;
}

/// The p-value below which one of `tests` histograms fails, where all together are wrongly failed with
/// probability `significance` (Sidak's correction).
inline double significance_of_one(double significance, double tests) {
  return -std::expm1(std::log1p(-significance) / tests);
}

/// Bins of the unit square, `nx` by `ny`, for the coordinates in which a density is easy to integrate.
struct SquareBins {
  std::size_t nx, ny;
  std::size_t count() const { return nx * ny; }
  /// The bin of (x, y); 1 itself, and rounding up to `slack` beyond an edge, belong to the last bin.
  std::size_t bin(double x, double y, double slack = 1e-6) const {
    if (!(x >= -slack && x <= 1 + slack && y >= -slack && y <= 1 + slack)) return count();
    const auto clamp = [](double v, std::size_t n) {
      const double scaled = std::floor(v * static_cast<double>(n));
      return scaled < 0 ? 0 : scaled >= static_cast<double>(n) ? n - 1 : static_cast<std::size_t>(scaled);
    };
    return clamp(y, ny) * nx + clamp(x, nx);
  }
};

/// An angle as a fraction of a full turn, in [0, 1).
inline double turn(double y, double x) {
  const double angle = std::atan2(y, x) / (2 * M_PI);
  return angle < 0 ? angle + 1 : angle;
}

}  // namespace causticl
