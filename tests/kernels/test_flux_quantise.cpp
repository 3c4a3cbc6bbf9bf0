// Flux as whole units of the photon record.
#include "vector_inputs.hpp"

#include "device_fixture.hpp"

using namespace causticl;

namespace {

const char* const source = R"(
#include "passes/pass_photon.cl"
kernel void quantise(global const float2 *in, global uint2 *out, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  bool saturated = false;
  uint units = flux_quantise(in[i].x, in[i].y, &saturated);
  out[i] = (uint2)(units, saturated);
}
)";

cl::Program& program() {
  static cl::Program built = build_test_program(source);
  return built;
}

}  // namespace

TEST_CASE("flux is quantised without bias, and says where it does not fit") {
  RandomInputs random(94);
  const std::vector<float> fluxes{0, 1e-6f,   3.7e-5f, 0.3f, 1,    2.71828f, 3.9999f,
                                  4, 15.999f, 16,      17,   1e6f, INFINITY};
  constexpr std::size_t each = 1 << 18;
  std::vector<float2> in;
  for (const float flux : fluxes)
    for (std::size_t i = 0; i < each; ++i) in.push_back({flux, uniform24(random)});
  const auto units = outputs_of<uint2>(program(), "quantise", in);
  for (std::size_t f = 0; f < fluxes.size(); ++f) {
    CAPTURE(fluxes[f]);
    double sum = 0;
    std::size_t saturated = 0, wrong = 0;
    const double exact = static_cast<double>(fluxes[f]) * PHOTON_FLUX_UNIT;
    for (std::size_t i = f * each; i < (f + 1) * each; ++i) {
      sum += units[i].x;
      saturated += units[i].y;
      wrong += exact < 65535 ? std::fabs(units[i].x - exact) > 1.001 : units[i].x != 65535;
    }
    CHECK(wrong == 0);
    CHECK(saturated == (exact < 65535 ? 0 : each));
    // The standard deviation of one is at most 1/2.
    if (exact < 65535)
      CHECK(std::fabs(sum / each - exact) < 5 * 0.5 / std::sqrt(each) + 4e-3 * (exact > 32768));
  }
}
