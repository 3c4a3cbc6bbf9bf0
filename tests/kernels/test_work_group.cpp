#include "device_fixture.hpp"
#include "integrators/integrator.hpp"
#include "vector_inputs.hpp"

using namespace causticl;

namespace {

const char* const source = R"(
#include "core/work_group.cl"
kernel void sum_and_reserve(global const uint *counts, volatile global Counters *counters, global uint *owners,
                            uint count) {
  local uint values[LARGEST_WORK_GROUP];
  uint i = get_global_id(0), wanted = i < count ? counts[i] : 0;
  uint first = list_reserve(wanted, &counters->photons);
  for (uint k = 0; k < wanted; ++k) owners[first + k] = i;
  group_count_rays(wanted, values, counters);
}
)";

}  // namespace

TEST_CASE("work-groups of any size count all, and each place of a list is reserved once") {
  RandomInputs random(91);
  std::vector<uint> counts(10001);
  for (uint& count : counts) count = static_cast<uint>(random.engine() % 5);
  std::vector<uint> expected;
  for (uint i = 0; i < counts.size(); ++i) expected.insert(expected.end(), counts[i], i);
  static cl::Program program = build_test_program(source);
  for (const std::size_t local : {1, 7, 64, 256}) {
    CAPTURE(local);
    const WorkGroupSize restored;
    test_device().set_local_size(local);
    const auto in = test_device().upload(counts, "counts"),
               counters = test_device().upload(std::vector<Counters>(1), "counters"),
               owners = test_device().buffer(expected.size() * sizeof(uint), "owners");
    run_kernel(program, "sum_and_reserve", counts.size(), in, counters, owners, cl_uint(counts.size()));
    const Counters totals = test_device().download<Counters>(counters, 1)[0];
    CHECK(totals.photons == expected.size());
    CHECK((totals.rays == expected.size() && totals.rays_high == 0));
    auto found = test_device().download<uint>(owners, expected.size());
    std::sort(found.begin(), found.end());
    CHECK(found == expected);
  }
  CHECK_THROWS(test_device().set_local_size(257));
}

TEST_CASE("rays of a pass are counted beyond 32 bits") {
  static cl::Program program = build_test_program(R"(
#include "core/work_group.cl"
kernel void count_many(global const uint *rays, volatile global Counters *counters, uint count) {
  uint i = get_global_id(0);
  if (i < count) count_rays(rays[i], counters);
}
)");
  RandomInputs random(92);
  std::vector<uint> rays(5000);
  std::uint64_t expected = 0;
  for (uint& some : rays) {
    some = static_cast<uint>(random.engine());
    expected += some;
  }
  Counters before{};
  before.rays = 4000000000u;
  CounterTotals totals;
  totals.start_from(before);
  const auto in = test_device().upload(rays, "rays"),
             counters = test_device().upload(std::vector<Counters>{before}, "counters");
  for (int pass = 1; pass <= 2; ++pass) {
    run_kernel(program, "count_many", rays.size(), in, counters, cl_uint(rays.size()));
    totals.update(test_device().download<Counters>(counters, 1)[0]);
    CAPTURE(random.seed, pass);
    CHECK(expected > std::uint64_t{1} << 40);
    CHECK(totals.rays == pass * expected);
  }
}
