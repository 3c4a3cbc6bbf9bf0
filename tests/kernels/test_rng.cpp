#include <set>

#include "device_fixture.hpp"

using namespace causticl;

namespace {

const char* const source = R"(
#include "sampling/rng.cl"
kernel void draw(global uint4 *bits, global float4 *numbers, uint count, uint4 first) {
  uint i = get_global_id(0);
  if (i >= count) return;
  uint4 v = first;
  v.x += i;
  bits[i] = pcg4d(v);
  RandomStream stream = {first.w, first.y, first.x + i};
  numbers[i] = convert_float4(random4(stream, first.z));
}
)";

// The published PCG4D, written out on the host.
uint4 reference(uint4 v) {
  uint* w[4] = {&v.x, &v.y, &v.z, &v.w};
  for (auto* x : w) *x = *x * 1664525u + 1013904223u;
  const auto mix = [&] {
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
  };
  mix();
  for (auto* x : w) *x ^= *x >> 16;
  mix();
  return v;
}

}  // namespace

TEST_CASE("pcg4d gives the published words, and numbers stay below 1, across a counter of 2^32") {
  auto program = build_test_program(source);
  const std::size_t count = 1 << 20;
  for (const uint4 first : {uint4{0, 0, 0, 0}, uint4{0xffff8000u, 7, 3, 42}}) {
    auto bits = test_device().buffer(count * sizeof(uint4), "bits");
    auto numbers = test_device().buffer(count * sizeof(float4), "numbers");
    run_kernel(program, "draw", count, bits, numbers, cl_uint(count), first);
    const auto words = test_device().download<uint4>(bits, count);
    const auto values = test_device().download<float4>(numbers, count);
    std::set<std::array<uint, 4>> seen;
    double sum = 0;
    std::size_t wrong = 0, out_of_range = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const uint4 expected = reference({first.x + static_cast<uint>(i), first.y, first.z, first.w});
      const uint4 w = words[i];
      wrong += w.x != expected.x || w.y != expected.y || w.z != expected.z || w.w != expected.w;
      const float4 v = values[i];
      for (float x : {v.x, v.y, v.z, v.w}) {
        out_of_range += !(x >= 0 && x < 1);
        sum += x;
      }
      seen.insert({w.x, w.y, w.z, w.w});
    }
    CHECK(wrong == 0);
    CHECK(out_of_range == 0);
    CHECK(seen.size() == count);  // no equal tuple over 2^20 streams
    // The mean of 4 M uniform numbers has a standard deviation of 1.4e-4: six of them.
    CHECK(sum / (4.0 * count) == Approx(0.5).margin(8.5e-4));
  }
}
