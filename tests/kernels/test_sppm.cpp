#include <cfloat>
#include <cstring>

#include "vector_inputs.hpp"

using namespace causticl;

namespace {

const char* const source = R"(
#include "photons/sppm.cl"
// `passes` updates of each pixel. Photons found in a pass: from a linear congruential sequence, shifted right by
// item % 32 bits, and none at all in about a quarter of the passes.
kernel void update_many(global SppmPixel *pixels, uint items, uint passes, float alpha) {
  uint i = get_global_id(0);
  if (i >= items) return;
  SppmPixel pixel = pixels[i];
  uint state = i + 1u;
  for (uint n = 0; n < passes; ++n) {
    state = state * 1664525u + 1013904223u;
    uint found = (state & 0x300u) == 0 ? 0u : (state >> 1) >> i % 32u;
    pixel = sppm_update(pixel, found, alpha);
  }
  pixels[i] = pixel;
}
kernel void update_once(global SppmPixel *pixels, global const uint *found, uint items, float alpha) {
  uint i = get_global_id(0);
  if (i < items) pixels[i] = sppm_update(pixels[i], found[i], alpha);
}
)";

cl::Program& program() {
  static cl::Program built = build_test_program(source);
  return built;
}

/// Equations (8) and (9) as they stand, with N itself and not the number of photons.
struct Reference {
  long double n, radius2;
  std::uint64_t photons;
  void update(uint found, float alpha) {
    photons += found;
    if (found == 0) return;
    const long double m = found, kept = n + alpha * m;
    radius2 *= kept / (n + m);
    n = kept;
  }
};

double radius2_of(const SppmPixel& pixel) { return static_cast<double>(pixel.radius2_hi) + pixel.radius2_lo; }
std::uint64_t photons_of(const SppmPixel& pixel) {
  return static_cast<std::uint64_t>(pixel.photons_high) << 32 | pixel.photons_low;
}
bool same_bits(const SppmPixel& a, const SppmPixel& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

/// Largest relative error of R^2 after `passes` passes; checks the number of photons and N exactly.
double drift(uint items, uint passes, float alpha) {
  std::vector<SppmPixel> pixels(items);
  for (uint i = 0; i < items; ++i) pixels[i].radius2_hi = 0.37f + static_cast<float>(i);
  std::vector<Reference> expected;
  for (uint i = 0; i < items; ++i) {
    expected.push_back({0, pixels[i].radius2_hi, 0});
    uint state = i + 1u;
    for (uint n = 0; n < passes; ++n) {
      state = state * 1664525u + 1013904223u;
      expected[i].update((state & 0x300u) == 0 ? 0u : (state >> 1) >> i % 32u, alpha);
    }
  }
  auto buffer = test_device().upload(pixels, "pixels");
  run_kernel(program(), "update_many", items, buffer, items, passes, alpha);
  pixels = test_device().download<SppmPixel>(buffer, items);
  double worst = 0;
  for (uint i = 0; i < items; ++i) {
    CHECK(photons_of(pixels[i]) == expected[i].photons);
    worst = std::max(worst, std::fabs(radius2_of(pixels[i]) / static_cast<double>(expected[i].radius2) - 1));
  }
  return worst;
}

std::vector<SppmPixel> update_once(const std::vector<SppmPixel>& pixels, const std::vector<uint>& found,
                                   float alpha) {
  auto buffer = test_device().upload(pixels, "pixels");
  auto counts = test_device().upload(found, "found");
  run_kernel(program(), "update_once", pixels.size(), buffer, counts, uint(pixels.size()), alpha);
  return test_device().download<SppmPixel>(buffer, pixels.size());
}

}  // namespace

TEST_CASE("the radius follows equations (8) and (9) over many passes") {
  for (const float alpha : {0.7f, 0.3f, 0.95f}) {
    CAPTURE(alpha);
    CHECK(drift(64, 10000, alpha) < 1e-6);
  }
  CHECK(drift(8, 1000000, 0.7f) < 1e-6);
}

TEST_CASE("one update is right for any state, and no photon changes no bit") {
  RandomInputs random(61);
  constexpr std::size_t count = 1 << 20;
  // Equation (9) moves R^2 by a fraction known to a few roundings, also where alpha leaves next to nothing of
  // it.
  for (const float alpha : {1e-6f, 0.01f, 0.5f, 0.7f, 0.99f, 0.999999f}) {
    CAPTURE(alpha);
    std::vector<SppmPixel> before(count);
    std::vector<uint> found(count);
    for (std::size_t i = 0; i < count; ++i) {
      const auto photons = static_cast<std::uint64_t>(i % 5 == 0 ? 0 : std::pow(2, random.uniform(0, 50)));
      before[i].radius2_hi = static_cast<float>(std::pow(10, random.uniform(-12, 12)));
      before[i].radius2_lo = before[i].radius2_hi * static_cast<float>(random.uniform(-2e-8, 2e-8));
      before[i].photons_low = static_cast<uint>(photons);
      before[i].photons_high = static_cast<uint>(photons >> 32);
      found[i] = i % 7 == 0 ? 0 : static_cast<uint>(std::pow(2, random.uniform(0, 31.99)));
      if (i % 70 == 1) found[i] = 1u << 31;
    }
    const auto after = update_once(before, found, alpha);
    double worst = 0;
    std::size_t wrong_photons = 0, changed = 0, grown = 0;
    for (std::size_t i = 0; i < count; ++i) {
      Reference expected{static_cast<long double>(alpha) * photons_of(before[i]), radius2_of(before[i]),
                         photons_of(before[i])};
      expected.update(found[i], alpha);
      wrong_photons += photons_of(after[i]) != expected.photons;
      if (found[i] == 0) changed += !same_bits(before[i], after[i]);
      grown += !(after[i].radius2_hi <= before[i].radius2_hi);
      worst = std::max(worst, std::fabs(radius2_of(after[i]) / static_cast<double>(expected.radius2) - 1));
    }
    CHECK(wrong_photons == 0);
    CHECK(changed == 0);
    CHECK(grown == 0);
    CHECK(worst < 1e-6);
  }
}

TEST_CASE("the number of photons carries past 2^32, and the smallest radii stay finite") {
  std::vector<SppmPixel> before;
  for (const uint low : {0u, 1u, 0x7fffffffu, 0x80000000u, 0xfffffff0u, 0xffffffffu})
    for (const float radius2 : {FLT_MIN, 1.0f, FLT_MAX}) before.push_back({radius2, 0, low, 3, 0});
  for (const uint found : {1u, 15u, 16u, 1u << 31, 0xffffffffu})
    for (const float alpha : {FLT_MIN, 1e-9f, 0.7f, 0.99999994f}) {
      const auto after = update_once(before, std::vector<uint>(before.size(), found), alpha);
      for (std::size_t i = 0; i < before.size(); ++i) {
        CHECK(photons_of(after[i]) == photons_of(before[i]) + found);
        CHECK((std::isfinite(after[i].radius2_hi) && std::isfinite(after[i].radius2_lo)));
        CHECK((after[i].radius2_hi >= 0 && after[i].radius2_hi <= before[i].radius2_hi));
      }
    }
}
