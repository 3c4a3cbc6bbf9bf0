// Indices by wavelength, and paths that go on as one channel.
#include "vector_inputs.hpp"

using namespace causticl;

namespace {

const char* const source = R"(
#include "materials/dispersion.cl"
typedef struct {
  float4 throughput;      // w: random number
  float4 wavelength2;  // 1 / wavelength^2 of each channel; w: A
} Input;
kernel void split(global const Input *in, global float4 *out, uint count, global const Material *material) {
  uint i = get_global_id(0);
  if (i >= count) return;
  Bsdf bsdf = {MATERIAL_GLASS, (real3)(1, 1, 1), in[i].wavelength2.w};
  real3 throughput = in[i].throughput.xyz;
  disperse(&bsdf, material, in[i].wavelength2.xyz, in[i].throughput.w, &throughput);
  out[i] = (float4)(throughput, bsdf.ior);
}
// Refracts a ray along +x twice, through the sides of a prism of apex angle `apex` that is turned by `turn`, and
// returns the angle that it was turned by.
kernel void deviate(global const float4 *in, global float *out, uint count, global const Material *material) {
  uint i = get_global_id(0);
  if (i >= count) return;
  real apex = in[i].x, turn = in[i].y;
  Bsdf bsdf = {MATERIAL_GLASS, (real3)(1, 1, 1), in[i].z};
  real3 throughput = (real3)(0, 1, 0);
  disperse(&bsdf, material, (real3)(0, in[i].w, 0), 0, &throughput);
  real3 d = (real3)(1, 0, 0);
  for (int side = 0; side < 2; ++side) {
    real angle = turn + (side == 0 ? PI - apex / 2 : apex / 2);
    real3 n = (real3)(cos(angle), sin(angle), 0);
    Surface surface = {(real3)(0, 0, 0), n, n, (real2)(0, 0), 0, 0};
    // The largest random number refracts unless all is reflected.
    d = bsdf_sample(&bsdf, &surface, d, (real4)(0, 0, (real)0.99999994f, 0), true).direction;
  }
  out[i] = atan2(-d.y, d.x);
}
)";

cl::Program& program() {
  static cl::Program built = build_test_program(source);
  return built;
}

cl::Buffer flint(double b) {
  Material material{};
  material.kind = MATERIAL_GLASS;
  material.absorption.w = static_cast<float>(b);
  return test_device().upload(std::vector<Material>{material}, "material");
}

}  // namespace

TEST_CASE(
    "dispersive glass keeps every channel on average, bends it by Cauchy's index, and changes a single one "
    "no more") {
  constexpr std::size_t count = 1 << 20;
  constexpr double b = 0.02;
  struct Input {
    float4 throughput, wavelength2;
  };
  RandomInputs random(211);
  std::vector<Input> inputs(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto channel = [&] { return i % 3 && random.uniform() < 0.3 ? 0.0 : random.uniform(); };
    inputs[i].throughput =
        to_float4({channel(), channel(), channel()}, i % 64 ? uniform24(random) : 0.99999994f);
    const auto inverse2 = [&] { return std::pow(random.uniform(0.38, 0.72), -2); };
    inputs[i].wavelength2 = to_float4({inverse2(), inverse2(), inverse2()}, random.uniform(1, 2));
  }
  auto in = test_device().upload(inputs, "inputs");
  auto out = test_device().buffer(count * sizeof(float4), "outputs");
  run_kernel(program(), "split", count, in, out, cl_uint(count), flint(b));
  const auto outputs = test_device().download<float4>(out, count);
  std::size_t wrong_sum = 0, not_single = 0, wrong_index = 0, empty = 0;
  Vec3 before, after, variance;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 throughput = to_vec3(inputs[i].throughput), found = to_vec3(outputs[i]),
               wavelength2 = to_vec3(inputs[i].wavelength2);
    const double sum = throughput.x + throughput.y + throughput.z;
    if (sum == 0) {
      empty += !(found == throughput);
      continue;
    }
    not_single += (found.x > 0) + (found.y > 0) + (found.z > 0) != 1;
    const int channel = found.x > 0 ? 0 : found.y > 0 ? 1 : 2;
    not_single += !(throughput[channel] > 0);
    wrong_sum += !(std::fabs(found[channel] - sum) <= 3e-7 * sum);
    const double n =
        inputs[i].wavelength2.w + static_cast<double>(static_cast<float>(b)) * wavelength2[channel];
    wrong_index += !(std::fabs(outputs[i].w - n) <= 4e-7 * n);
    if (i % 64 == 0) continue;  // whose random number is none
    for (int c = 0; c < 3; ++c) {
      before[c] += throughput[c];
      after[c] += found[c];
      variance[c] += throughput[c] * (sum - throughput[c]);
    }
  }
  CHECK(wrong_sum == 0);
  CHECK(not_single == 0);
  CHECK(wrong_index == 0);
  CHECK(empty == 0);
  for (int c = 0; c < 3; ++c) CHECK(std::fabs(after[c] - before[c]) < 5 * std::sqrt(variance[c]));
}

TEST_CASE("a prism turns each wavelength as the formula says, least where the ray runs symmetrically") {
  constexpr std::size_t count = 1 << 18;
  constexpr double b = 0.04;
  RandomInputs random(212);
  std::vector<float4> inputs(count);
  std::vector<double> exact(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double apex = random.uniform(0.2, 1.1), a = random.uniform(1.2, 1.6),
                 wavelength = random.uniform(0.38, 0.72);
    const double n = a + b / (wavelength * wavelength), least = 2 * std::asin(n * std::sin(apex / 2)) - apex;
    // Every other prism stands at least deviation, where the ray comes in at (least + apex) / 2; others are
    // turned from there, with the angles of either side by Snell's law.
    const double incidence = (least + apex) / 2 - (i % 2 ? 0 : random.uniform(-0.05, 0.2));
    const double inside = std::asin(std::sin(incidence) / n),
                 emergence = std::asin(n * std::sin(apex - inside));
    exact[i] = i % 2 ? least : incidence + emergence - apex;
    inputs[i] = {float(apex), float(apex / 2 - incidence), float(a), float(1 / (wavelength * wavelength))};
  }
  auto in = test_device().upload(inputs, "inputs");
  auto out = test_device().buffer(count * sizeof(float), "outputs");
  run_kernel(program(), "deviate", count, in, out, cl_uint(count), flint(b));
  const auto outputs = test_device().download<float>(out, count);
  std::size_t checked = 0, wrong = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!std::isfinite(exact[i]) || exact[i] > 1.2) continue;  // reflected inside, or leaving near grazing
    ++checked;
    wrong += !(std::fabs(outputs[i] - exact[i]) < 2e-5);
  }
  CHECK(checked > count / 3);
  CHECK(wrong == 0);
}
