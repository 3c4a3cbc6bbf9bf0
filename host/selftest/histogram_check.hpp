// A check by chi-square: samples of the device, binned on the host, against the densities that they claim.
#pragma once

#include <mutex>

#include "selftest/chi_square.hpp"
#include "selftest/random_check.hpp"

namespace causticl {

/// All histograms of all checks together: what the significance of one is corrected for.
constexpr int histograms_of_all_checks = 64;

/// With correct samplers one selftest in ten thousand fails here for one seed, and passes for the next.
constexpr double histogram_significance = 1e-4;

/// Draws context.inputs samples: `draw(first, count)` returns those from number `first` on, and
/// `add(sample, number, histograms)` puts one into the histograms, on any thread. An input fails as a whole
/// histogram does: its p-value is too small, or a sample lies where its density is zero.
///
/// Random numbers have 24 bits, and a float rounds to as many: samples move across the edges of bins by about
/// 1e-7 of their range. A bin of probability p then errs by d = 1e-7, which adds n d^2 / p to its statistic:
/// with 10^8 samples and a few hundred bins less than a thousandth of the statistic's deviation. So bins are
/// few and wide, their number a power of two so that no edge lies between two of the 24-bit numbers.
template <typename Draw, typename Add>
CheckResult run_histogram_check(CheckContext& context, std::vector<Histogram> histograms, Draw& draw,
                                const Add& add) {
  constexpr std::size_t batch = std::size_t{1} << 18, chunk = std::size_t{1} << 16;
  CheckResult result;
  result.unit = "-log10 p";
  result.tolerance = -std::log10(significance_of_one(histogram_significance, histograms_of_all_checks));
  std::mutex mutex;
  for (std::uint64_t first = 0; first < context.inputs; first += batch) {
    const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(batch, context.inputs - first));
    const auto samples = draw(first, size);
    parallel_chunks(size, chunk, context.threads, [&](std::size_t low, std::size_t high) {
      std::vector<Histogram> part;
      for (const auto& histogram : histograms) part.emplace_back(histogram.counts.size());
      for (std::size_t i = low; i < high; ++i) add(samples[i], first + i, part);
      const std::lock_guard lock(mutex);
      for (std::size_t h = 0; h < part.size(); ++h) histograms[h].add(part[h]);
    });
    result.inputs += size;
  }
  for (const auto& histogram : histograms) {
    const double p = chi_square_p_value(histogram);
    const double error = histogram.outside > 0 ? INFINITY : std::min(300.0, -std::log10(p));
    result.failures += !(error <= result.tolerance);
    result.worst_error = std::max(result.worst_error, error);
  }
  return result;
}

/// A histogram whose bins are all as probable.
inline Histogram flat_histogram(std::size_t bins) {
  Histogram histogram(bins);
  histogram.probabilities.assign(bins, 1.0 / static_cast<double>(bins));
  return histogram;
}

/// A kernel with the signature kernel(global Sample*, uint count, uint first, uint seed, further
/// arguments...), which draws samples number `first` and on.
template <typename Sample>
class SampleKernel {
 public:
  template <typename... Arguments>
  SampleKernel(CheckContext& context, const cl::Program& program, const char* name,
               const Arguments&... arguments)
      : device_(context.device), kernel_(program, name), seed_(context.seed) {
    [[maybe_unused]] cl_uint index = 4;
    ((index = set_argument(kernel_, index, arguments)), ...);
  }

  std::vector<Sample> operator()(std::uint64_t first, std::size_t count) {
    if (count > capacity_) {
      capacity_ = count;
      samples_ = device_.buffer(capacity_ * sizeof(Sample), "samples of a check");
    }
    set_arguments(kernel_, samples_, static_cast<cl_uint>(count), static_cast<cl_uint>(first), seed_);
    device_.launch_pass(kernel_, count);
    return device_.download<Sample>(samples_, count);
  }

 private:
  Device& device_;
  cl::Kernel kernel_;
  cl_uint seed_;
  cl::Buffer samples_;
  std::size_t capacity_ = 0;
};

}  // namespace causticl
