#include "device_fixture.hpp"
#include "vector_inputs.hpp"

using namespace causticl;

namespace {

const char* const source = R"(
#include "work_group.cl"
kernel void sum_and_reserve(global const uint *counts, volatile global uint *totals, global uint *owners, uint count) {
  local uint values[LARGEST_WORK_GROUP];
  uint i = get_global_id(0), wanted = i < count ? counts[i] : 0;
  uint first = list_reserve(wanted, totals);
  for (uint k = 0; k < wanted; ++k) owners[first + k] = i;
  group_add(wanted, values, totals + 1);
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
               totals = test_device().upload(std::vector<uint>{0, 0}, "totals"),
               owners = test_device().buffer(expected.size() * sizeof(uint), "owners");
    run_kernel(program, "sum_and_reserve", counts.size(), in, totals, owners, cl_uint(counts.size()));
    CHECK(test_device().download<uint>(totals, 2) ==
          std::vector<uint>(2, static_cast<uint>(expected.size())));
    auto found = test_device().download<uint>(owners, expected.size());
    std::sort(found.begin(), found.end());
    CHECK(found == expected);
  }
  CHECK_THROWS(test_device().set_local_size(257));
}
