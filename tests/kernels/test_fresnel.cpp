// Fresnel's equations on the device against double precision.
#include "kernels/fresnel_oracle.hpp"

using namespace causticl;

namespace {

const char* const source = R"(
#include "materials/fresnel.cl"
kernel void fresnel(global const float2 *in, global float2 *out, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  real cosine_t;
  real reflectance = fresnel_dielectric(in[i].x, in[i].y, &cosine_t);
  out[i] = (float2)(reflectance, cosine_t);
}
)";

}  // namespace

TEST_CASE("fresnel_dielectric agrees with the exact equations, in [0, 1] everywhere") {
  RandomInputs random(41);
  std::vector<float2> inputs;
  std::vector<float> indices{1.0f, 1.0f / 3, 3.0f, 1.5f, 1 / 1.5f, 1.00001f, 0.99999f};
  indices.push_back(std::nextafter(1.0f, 2.0f));
  indices.push_back(std::nextafter(1.0f, 0.0f));
  while (indices.size() < 1000) indices.push_back(static_cast<float>(random_ior(random)));
  for (const float eta : indices) {
    for (const float cosine : {0.0f, -0.0f, 1e-7f, -1e-7f, 1e-20f, 1e-4f, 1.0f, 0.99999994f, 1.0000001f})
      inputs.push_back({cosine, eta});
    if (eta < 1) {
      // The critical angle, one and two ulp to either side of it.
      const auto critical = static_cast<float>(std::sqrt(1 - double(eta) * eta));
      float up = critical, down = critical;
      inputs.push_back({critical, eta});
      for (int i = 0; i < 2; ++i) {
        inputs.push_back({up = std::nextafter(up, 2.0f), eta});
        inputs.push_back({down = std::nextafter(down, 0.0f), eta});
      }
    }
    for (int i = 0; i < 1100; ++i) inputs.push_back({static_cast<float>(random.uniform()), eta});
  }
  auto in = test_device().upload(inputs, "inputs");
  auto out = test_device().buffer(inputs.size() * sizeof(float2), "outputs");
  cl::Program program = build_test_program(source);
  run_kernel(program, "fresnel", inputs.size(), in, out, cl_uint(inputs.size()));
  const auto found = test_device().download<float2>(out, inputs.size());
  std::size_t out_of_range = 0, past_critical = 0, wrong = 0, wrong_cosine = 0, wrong_equal = 0;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const double cosine = std::clamp(double(inputs[i].x), 0.0, 1.0), eta = inputs[i].y;
    const double r = found[i].x, c = found[i].y;
    out_of_range += !(r >= 0 && r <= 1 && c >= 0 && c <= 1);
    // What the exact equations give for a squared cosine within rounding of the exact one.
    const Boundary low = fresnel_oracle(cosine, eta, -rounding), high = fresnel_oracle(cosine, eta, rounding);
    wrong += !(r <= std::max(low.reflectance, high.reflectance) + 2e-6 &&
               r >= std::min(low.reflectance, high.reflectance) - 2e-6);
    wrong_cosine += !(c >= low.cosine_t - 3e-7 && c <= high.cosine_t + 3e-7);
    if (eta < 1 && high.cosine_t == 0) past_critical += r != 1 || c != 0;
    if (eta == 1) wrong_equal += r > 1e-9;
  }
  CHECK(out_of_range == 0);
  CHECK(wrong == 0);
  CHECK(wrong_cosine == 0);
  CHECK(past_critical == 0);
  CHECK(wrong_equal == 0);
}
