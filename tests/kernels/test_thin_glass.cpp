// The pane of thin glass against a series of its reflections in double precision.
#include "catch2.hpp"
#include "kernels/fresnel_oracle.hpp"

using namespace causticl;

namespace {

const char* const source = R"(
#include "materials/bsdf.cl"
typedef struct {
  float4 color;      // w: ior
  float4 direction;  // w: random.z
} Input;
typedef struct {
  float4 direction;    // w: the probability of reflection
  float4 weight;
  float4 reflected;    // weight times probability of each lobe
  float4 transmitted;
} Output;
kernel void sample(global const Input *in, global Output *out, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  Bsdf bsdf = {MATERIAL_THIN_GLASS, convert_real3(in[i].color.xyz), in[i].color.w};
  Surface surface = {(real3)(0, 0, 0), (real3)(0, 0, 1), (real3)(0, 0, 1), (real2)(0, 0), 0, 0};
  real3 d = convert_real3(in[i].direction.xyz), n = facing_normal(&surface, d);
  BsdfSample next = bsdf_sample(&bsdf, &surface, d, (real4)(0, 0, in[i].direction.w, 0), true);
  real pmf = lobe_reflectance(&bsdf, &surface, d, n), cosine = -dot3(d, n);
  out[i].direction = (float4)(convert_float3(next.direction), pmf);
  out[i].weight = (float4)(convert_float3(next.weight), next.pdf);
  out[i].reflected = (float4)(convert_float3(pmf > 0 ? pmf * lobe_tint(&bsdf, cosine, false) : (real3)(0)), 0);
  out[i].transmitted = (float4)(convert_float3(pmf < 1 ? (1 - pmf) * lobe_tint(&bsdf, cosine, true) : (real3)(0)), 0);
}
)";

struct Input {
  float4 color, direction;
};
struct Output {
  float4 direction, weight, reflected, transmitted;
};

/// Light that goes to and fro in the pane until nothing is left of it.
std::array<double, 2> pane(double cosine, double ior, double color) {
  const Boundary face = fresnel_oracle(cosine, ior);
  if (face.reflectance >= 1) return {1, 0};
  const double inside = std::pow(color, 1 / face.cosine_t), f = face.reflectance;
  double reflected = f, transmitted = 0, energy = (1 - f) * inside;
  for (int i = 0; i < 100000 && energy > 1e-15; ++i) {
    transmitted += energy * (1 - f);
    energy *= f * inside;
    reflected += energy * (1 - f);
    energy *= f * inside;
  }
  return {reflected, transmitted};
}

}  // namespace

TEST_CASE("a pane reflects and transmits what the series of its reflections does") {
  RandomInputs random(2601);
  std::vector<Input> inputs;
  for (int i = 0; i < 200000; ++i) {
    // Every tenth is met at a grazing angle, every seventh lets everything or nothing through.
    const double cosine = i % 10 ? random.uniform(0.01, 1) : std::pow(10, random.uniform(-4, -2));
    const double phi = random.uniform(0, 2 * M_PI), sine = std::sqrt(1 - cosine * cosine);
    const float side = random.uniform() < 0.5 ? 1.0f : -1.0f;
    const auto color = [&] {
      return i % 7 ? static_cast<float>(random.uniform()) : (random.uniform() < 0.5 ? 1.0f : 0.0f);
    };
    inputs.push_back({{color(), color(), color(), static_cast<float>(random_ior(random))},
                      {static_cast<float>(sine * std::cos(phi)), static_cast<float>(sine * std::sin(phi)),
                       side * static_cast<float>(cosine), static_cast<float>(random.uniform())}});
  }
  auto in = test_device().upload(inputs, "inputs");
  auto out = test_device().buffer(inputs.size() * sizeof(Output), "outputs");
  cl::Program program = build_test_program(source);
  run_kernel(program, "sample", inputs.size(), in, out, cl_uint(inputs.size()));
  const auto found = test_device().download<Output>(out, inputs.size());
  std::size_t wrong_fraction = 0, wrong_direction = 0, wrong_weight = 0;
  double worst = 0;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const auto& [color, direction] = inputs[i];
    const auto& [wo, weight, reflected, transmitted] = found[i];
    const float colors[]{color.x, color.y, color.z}, r[]{reflected.x, reflected.y, reflected.z},
        t[]{transmitted.x, transmitted.y, transmitted.z}, w[]{weight.x, weight.y, weight.z};
    const bool reflects = direction.w < wo.w;
    for (int channel = 0; channel < 3; ++channel) {
      const double cosine = std::fabs(double(direction.z));
      const auto [exact_r, exact_t] = pane(cosine, color.w, colors[channel]);
      // By how much they change where the cosine is rounded: steeply near the critical angle.
      const auto [low_r, low_t] = pane(cosine * (1 - 1e-6) - 1e-7, color.w, colors[channel]);
      const auto [high_r, high_t] = pane(cosine * (1 + 1e-6) + 1e-7, color.w, colors[channel]);
      const double slack_r = std::max(std::fabs(low_r - exact_r), std::fabs(high_r - exact_r)) + 1e-5,
                   slack_t = std::max(std::fabs(low_t - exact_t), std::fabs(high_t - exact_t)) + 1e-5;
      wrong_fraction +=
          !(std::fabs(r[channel] - exact_r) <= slack_r) + !(std::fabs(t[channel] - exact_t) <= slack_t);
      worst = std::max(
          {worst, std::fabs(r[channel] - exact_r) - slack_r, std::fabs(t[channel] - exact_t) - slack_t});
      const double part = reflects ? r[channel] / wo.w : t[channel] / (1 - wo.w);
      wrong_weight += !(std::fabs(w[channel] - part) <= 1e-5 * (1 + part));
    }
    const float z = reflects ? -direction.z : direction.z;
    wrong_direction += !(std::fabs(wo.x - direction.x) < 1e-6f && std::fabs(wo.y - direction.y) < 1e-6f &&
                         std::fabs(wo.z - z) < 1e-6f);
  }
  INFO("worst " << worst);
  CHECK(wrong_fraction == 0);
  CHECK(wrong_weight == 0);
  CHECK(wrong_direction == 0);
}
