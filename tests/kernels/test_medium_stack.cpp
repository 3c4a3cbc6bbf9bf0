// The stack of dielectrics that hold a path, against a sorted list.
#include <algorithm>

#include "device_fixture.hpp"

using namespace causticl;

namespace {

const char* const source = R"(
#include "media/medium_stack.cl"
// Each of `steps` numbers: 2 m enters material m, 2 m + 1 leaves it. Results by step: the material that fills the place,
// how many bodies hold it, whether the material of the step is one of them, and the faults so far.
kernel void run(global const uint *steps, global uint4 *out, uint sequences, uint length) {
  uint s = get_global_id(0);
  if (s >= sequences) return;
  MediumStack stack = medium_stack_none();
  uint diagnostics = 0;
  for (uint i = s * length; i < (s + 1u) * length; ++i) {
    uint material = steps[i] / 2u;
    if (steps[i] % 2u == 0)
      medium_stack_enter(&stack, material, &diagnostics);
    else if (!medium_stack_leave(&stack, material))
      diagnostics |= DIAGNOSTIC_MEDIA_LEFT;
    out[i] = (uint4)(medium_stack_top(&stack), stack.count, medium_stack_holds(&stack, material) ? 1u : 0u, diagnostics);
  }
}
)";

constexpr std::size_t capacity = 8;
constexpr uint full = 4, left = 8, outside = 0xffffffffu;

}  // namespace

TEST_CASE("the greatest material of those entered and not left fills the place") {
  constexpr std::size_t sequences = 1 << 12, length = 64;
  RandomInputs random(231);
  std::vector<uint> steps(sequences * length);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    // Few materials in some sequences, so that bodies are entered twice; mostly entering in others, so that
    // it gets full.
    const double entering = (i / length) % 3 == 0 ? 0.7 : 0.5, materials = (i / length) % 2 ? 3 : 20;
    steps[i] = 2 * static_cast<uint>(random.uniform(0, materials)) + (random.uniform() < entering ? 0 : 1);
  }
  auto program = build_test_program(source);
  auto in = test_device().upload(steps, "steps");
  auto out = test_device().buffer(steps.size() * sizeof(uint4), "results");
  run_kernel(program, "run", sequences, in, out, cl_uint(sequences), cl_uint(length));
  const auto results = test_device().download<uint4>(out, steps.size());
  std::size_t wrong = 0, times_full = 0, times_left = 0;
  for (std::size_t s = 0; s < sequences; ++s) {
    std::vector<uint> held;
    uint diagnostics = 0;
    for (std::size_t i = s * length; i < (s + 1) * length; ++i) {
      const uint material = steps[i] / 2;
      const auto found = std::find(held.begin(), held.end(), material);
      if (steps[i] % 2 == 0) {
        if (held.size() == capacity)
          diagnostics |= full, ++times_full;
        else
          held.push_back(material);
      } else if (found == held.end()) {
        diagnostics |= left, ++times_left;
      } else {
        held.erase(found);
      }
      const uint top = held.empty() ? outside : *std::max_element(held.begin(), held.end());
      const bool holds = std::find(held.begin(), held.end(), material) != held.end();
      wrong += results[i].x != top || results[i].y != held.size() || results[i].z != (holds ? 1u : 0u) ||
               results[i].w != diagnostics;
    }
  }
  CHECK(wrong == 0);
  CHECK(times_full > 1000);
  CHECK(times_left > 1000);
}
