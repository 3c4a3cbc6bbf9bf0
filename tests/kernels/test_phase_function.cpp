// The phase function: its density, what it draws, and how directions in the medium are stored.
#include "chi_square_check.hpp"
#include "phase_oracle.hpp"
#include "vector_inputs.hpp"

using namespace causticl;

namespace {

const char* const source = R"(
#include "photons/grid.cl"
#include "media/medium.cl"
// x: g, y: cosine, out: density.
kernel void phase(global const float2 *in, global float *out, uint count) {
  uint i = get_global_id(0);
  if (i < count) out[i] = phase_density(in[i].x, in[i].y);
}
kernel void turn(global const float4 *uniform, global float4 *out, uint count, float4 direction, float g) {
  uint i = get_global_id(0);
  if (i < count) out[i] = (float4)(phase_sample(g, direction.xyz, uniform[i].xy), 0);
}
kernel void pack(global const float4 *in, global float4 *out, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  uint packed = direction_pack(in[i].xyz);
  out[i] = (float4)(direction_unpack(packed), packed & IN_MEDIUM ? 1 : 0);
}
)";

cl::Program& program() {
  static cl::Program built = build_test_program(source);
  return built;
}

}  // namespace

TEST_CASE("the phase function is Henyey and Greenstein's") {
  RandomInputs random(221);
  std::vector<float2> inputs(1 << 18);
  for (auto& input : inputs)
    input = {static_cast<float>(random.uniform(-0.99, 0.99)), static_cast<float>(random.uniform(-1, 1))};
  inputs[0] = {0, 0.5f};
  inputs[1] = {0.99f, 1};
  inputs[2] = {-0.99f, -1};
  auto in = test_device().upload(inputs, "inputs");
  auto out = test_device().buffer(inputs.size() * sizeof(float), "outputs");
  run_kernel(program(), "phase", inputs.size(), in, out, cl_uint(inputs.size()));
  const auto found = test_device().download<float>(out, inputs.size());
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const double exact = phase_oracle(inputs[i].x, inputs[i].y);
    wrong += !(std::fabs(found[i] - exact) <= 2e-5 * exact);  // 1 - |g| loses up to seven bits
  }
  CHECK(wrong == 0);
}

TEST_CASE("directions in the medium follow the phase function") {
  constexpr std::size_t count = 1 << 20;
  const double values[] = {0, 1e-6, 0.4, -0.7, 0.95};
  for (const double g : values) {
    RandomInputs random(222);
    const Vec3 axis = random_direction(random);
    auto in = test_device().upload(uniform_tuples(random, count), "numbers");
    auto out = test_device().buffer(count * sizeof(float4), "directions");
    run_kernel(program(), "turn", count, in, out, cl_uint(count), to_float4(axis), static_cast<float>(g));
    // Bins of equal probability in the distribution of the cosine, by its closed form.
    const auto below = [&](double cosine) {
      if (std::fabs(g) < 1e-3) return (1 + cosine) / 2 + g * 0.75 * (cosine * cosine - 1);
      return (1 - g * g) / (2 * g) * (1 / std::sqrt(1 + g * g - 2 * g * cosine) - 1 / (1 + g));
    };
    const SquareBins bins{24, 16};
    Histogram histogram(bins.count());
    histogram.probabilities.assign(bins.count(), 1.0 / static_cast<double>(bins.count()));
    const Frame frame(axis);
    std::size_t wrong = 0;
    for (const auto& direction : test_device().download<float4>(out, count)) {
      const Vec3 local = frame.to_local(to_vec3(direction));
      wrong += !(std::fabs(length(local) - 1) < 1e-6);
      histogram.add(bins.bin(std::clamp(below(std::clamp(local.z, -1.0, 1.0)), 0.0, 0.9999999),
                             turn(local.y, local.x)));
    }
    CHECK(wrong == 0);
    check_chi_square(histogram, 5, "g = " + std::to_string(g));
  }
}

TEST_CASE("directions are packed to two ten-thousandths, and marked") {
  RandomInputs random(224);
  std::vector<float4> inputs;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) {
      Vec3 d;
      d[axis] = sign;
      inputs.push_back(to_float4(d));
    }
  while (inputs.size() < (1 << 18)) inputs.push_back(to_float4(random_direction(random)));
  auto in = test_device().upload(inputs, "directions");
  auto out = test_device().buffer(inputs.size() * sizeof(float4), "directions");
  run_kernel(program(), "pack", inputs.size(), in, out, cl_uint(inputs.size()));
  const auto found = test_device().download<float4>(out, inputs.size());
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < inputs.size(); ++i)
    wrong += !(length(to_vec3(found[i]) - to_vec3(inputs[i])) < 2e-4) || found[i].w != 1;
  CHECK(wrong == 0);
}
