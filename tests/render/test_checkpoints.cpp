// When outputs are rewritten, by a clock of the test's own.
#include <vector>

#include "catch2.hpp"
#include "render/checkpoints.hpp"

using namespace causticl;

namespace {

using Passes = std::vector<std::uint64_t>;

/// The passes after which outputs are written, where each pass and each writing takes so many seconds.
Passes written(Integrator integrator, std::uint64_t passes, double pass_seconds, double write_seconds) {
  Checkpoints checkpoints(integrator);
  Passes result;
  double now = 0, longest_write = 0;
  for (std::uint64_t pass = 1; pass <= passes; ++pass) {
    now += pass_seconds;
    if (!checkpoints.due(pass, now, longest_write)) continue;
    result.push_back(pass);
    now += longest_write = write_seconds;
  }
  return result;
}

}  // namespace

TEST_CASE("SPPM writes at powers of two up to 64, then every 64 passes") {
  CHECK(written(Integrator::sppm, 300, 1, 0.01) == Passes{1, 2, 4, 8, 16, 32, 64, 128, 192, 256});
}

TEST_CASE("SPPM of quick passes writes every 30 seconds after the first 64") {
  CHECK(written(Integrator::sppm, 2000, 0.0625, 0.001) ==
        Passes{1, 2, 4, 8, 16, 32, 64, 544, 1024, 1504, 1984});
}

TEST_CASE("path tracing writes every 30 seconds") {
  CHECK(written(Integrator::pt, 100, 1, 0) == Passes{30, 60, 90});
}

TEST_CASE("early writing takes no more than a tenth of the time, but for the first") {
  // Ten times the writing is 2.5 seconds, of which the writing itself is a tenth.
  CHECK(written(Integrator::sppm, 64, 0.25, 0.25) == Passes{1, 16, 32, 64});
  CHECK(written(Integrator::sppm, 64, 0.001, 0.25) == Passes{1});
}
