// The chi-square test as a check of the test framework.
#pragma once

#include <string>

#include "catch2.hpp"
#include "selftest/chi_square.hpp"

namespace causticl {

/// Checks one of `tests` histograms at a significance of 1% for all of them together (Sidak's correction):
/// with the seeds of a test fixed, a correct sampler either always passes or was unlucky once in a hundred.
inline void check_chi_square(const Histogram& histogram, int tests, const std::string& what) {
  INFO(what);
  double sum = 0;
  for (const double p : histogram.probabilities) sum += p;
  CHECK(sum == Approx(1).epsilon(1e-3));
  CHECK(histogram.outside == 0);
  CHECK(chi_square_p_value(histogram) > significance_of_one(0.01, tests));
}

}  // namespace causticl
