#include <array>

#include "chi_square_check.hpp"
#include "selftest/rough_lobe_oracle.hpp"
#include "vector_inputs.hpp"

using namespace causticl;

namespace {

const char* const source = R"(
#include "materials/bsdf.cl"
typedef struct {
  float4 wi;  // w: alpha
  float4 wo;   // w: ior
  float4 random;
} Input;
typedef struct {
  float4 direction;  // sampled; w: pdf
  float4 weight;     // w: alpha of the lobe
  float4 value;      // BSDF * cosine towards `wo`; w: pdf
} Output;
// An ideal conductor reflects all: its Fresnel factor is 1.
kernel void lobe(global const Input *in, global Output *out, uint count, uint kind, uint ideal) {
  uint i = get_global_id(0);
  if (i >= count) return;
  real ior = in[i].wo.w;
  Bsdf bsdf = {kind, (real3)(1, 1, 1), ior, lobe_alpha(in[i].wi.w, kind == MATERIAL_GLASS ? ior : 0),
               (real3)(0.2f, 0.9f, 1.4f), ideal ? (real3)(1e8f, 1e8f, 1e8f) : (real3)(3.9f, 2.4f, 1.6f), 0, false};
  real3 n = (real3)(0, 0, 1), wi = convert_real3(in[i].wi.xyz);
  Surface surface = {(real3)(0, 0, 0), n, n, (real2)(0, 0), 0, 0};
  BsdfSample next = bsdf_sample(&bsdf, &surface, wi, (real4)(convert_real3(in[i].random.xyz), 0), true);
  out[i].direction = convert_float4((real4)(next.direction, next.pdf));
  out[i].weight = convert_float4((real4)(next.weight, bsdf.alpha));
  BsdfSample other = rough_evaluate(&bsdf, &surface, wi, facing_normal(&surface, wi),
                                    convert_real3(in[i].wo.xyz));
  out[i].value = convert_float4((real4)(other.weight * other.pdf, other.pdf));
}
kernel void conductor(global const float4 *in, global float *out, uint count) {
  uint i = get_global_id(0);
  if (i < count) out[i] = fresnel_conductor(in[i].x, in[i].y, in[i].z);
}
)";

struct Input {
  float4 wi, wo, random;
};
struct Output {
  float4 direction, weight, value;
};

cl::Program& program() {
  static cl::Program built = build_test_program(source);
  return built;
}

std::vector<Output> lobe(const std::vector<Input>& inputs, uint kind, bool ideal = false) {
  auto in = test_device().upload(inputs, "inputs");
  auto out = test_device().buffer(inputs.size() * sizeof(Output), "outputs");
  run_kernel(program(), "lobe", inputs.size(), in, out, cl_uint(inputs.size()), cl_uint(kind),
             cl_uint(ideal));
  return test_device().download<Output>(out, inputs.size());
}

constexpr std::array<double, 4> alphas{0.05, 0.2, 0.5, 1};
constexpr std::array<double, 3> cosines{0.95, 0.5, 0.1};

/// From above (cosine > 0) or below, at a fixed azimuth.
Vec3 from_above(double cosine) {
  const double sine = std::sqrt(1 - cosine * cosine);
  return Vec3{-0.8 * sine, -0.6 * sine, -cosine};
}

/// The sphere in equal areas: direction number `i` of `rows` x 2 `rows`.
Vec3 grid_direction(std::size_t i, std::size_t rows) {
  const double z = 1 - 2 * (static_cast<double>(i / (2 * rows)) + 0.5) / static_cast<double>(rows);
  const double angle = M_PI * (static_cast<double>(i % (2 * rows)) + 0.5) / static_cast<double>(rows);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

/// What single scattering keeps of light in a white furnace, by quadrature over microfacets in double: the
/// fraction of visible normals whose mirror image is neither under the horizon nor shadowed.
double furnace_oracle(Vec3 v, double alpha) {
  const RoughLobeOracle oracle{alpha, 1.5};
  constexpr int steps = 400;
  double kept = 0;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      // Normals with density D cos: tan^2 = alpha^2 x / (1 - x). Taking x = 1 - y^2 tames the edge.
      const double y = (i + 0.5) / steps, angle = 2 * M_PI * (j + 0.5) / steps;
      const double tangent = alpha * std::sqrt(1 - y * y) / y, cosine = 1 / std::sqrt(1 + tangent * tangent);
      const Vec3 h = cosine * Vec3{tangent * std::cos(angle), tangent * std::sin(angle), 1};
      const double seen = dot(v, h);
      const Vec3 wo = 2 * seen * h - v;
      if (seen <= 0 || wo.z <= 0) continue;
      const double shadowing = 1 / (1 + oracle.lambda(v) + oracle.lambda(wo));
      kept += shadowing * seen / (v.z * cosine) * 2 * y / (steps * steps);
    }
  return kept;
}

}  // namespace

TEST_CASE("fresnel_conductor agrees with complex arithmetic, in [0, 1] everywhere") {
  RandomInputs random(61);
  std::vector<float4> inputs;
  for (const float cosine : {0.0f, 1e-20f, 1e-7f, 1e-3f, 0.5f, 0.99999994f, 1.0f, 1.0000001f})
    for (const float eta : {0.01f, 0.2f, 1.0f, 1.5f, 100.0f})
      for (const float k : {0.0f, 1e-20f, 1e-4f, 1.0f, 3.9f, 100.0f}) inputs.push_back({cosine, eta, k, 0});
  while (inputs.size() < 1 << 20)
    inputs.push_back({static_cast<float>(random.uniform()),
                      static_cast<float>(std::pow(10, random.uniform(-2, 1))),
                      static_cast<float>(std::pow(10, random.uniform(-4, 1))), 0});
  auto in = test_device().upload(inputs, "inputs");
  auto out = test_device().buffer(inputs.size() * sizeof(float), "outputs");
  run_kernel(program(), "conductor", inputs.size(), in, out, cl_uint(inputs.size()));
  const auto found = test_device().download<float>(out, inputs.size());
  std::size_t out_of_range = 0, wrong = 0;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const double cosine = inputs[i].x, eta = inputs[i].y, k = inputs[i].z;
    out_of_range += !(found[i] >= 0 && found[i] <= 1.000001f);
    // Nothing is reflected where there is no boundary, at any angle.
    const double exact = eta == 1 && k == 0 ? 0 : fresnel_oracle(cosine, {eta, k});
    // Next to total reflection the root of a rounded difference.
    const double square = std::abs(std::complex<double>(eta, k) * std::complex<double>(eta, k) - 1.0 +
                                   std::min(cosine, 1.0) * std::min(cosine, 1.0));
    wrong += !(std::fabs(found[i] - exact) < 2e-6 + 4e-7 * (1 + eta * eta) / std::sqrt(square + 1e-12));
  }
  CHECK(out_of_range == 0);
  CHECK(wrong == 0);
}

TEST_CASE("rough lobes are those of the equations in double, and reciprocal") {
  RandomInputs random(62);
  std::vector<Input> there(1 << 20), back(1 << 20);
  for (std::size_t i = 0; i < there.size(); ++i) {
    const auto alpha = static_cast<float>(random.uniform(0.05, 1)),
               ior = static_cast<float>(random.uniform(1.1, 2.5));
    const Vec3 v = random_direction(random), wo = random_direction(random);
    there[i] = {to_float4(-v, alpha), to_float4(wo, ior), {}};
    back[i] = {to_float4(-wo, alpha), to_float4(v, ior), {}};
  }
  for (const uint kind : {MATERIAL_GLASS, MATERIAL_CONDUCTOR}) {
    CAPTURE(kind);
    const auto values = lobe(there, kind), returned = lobe(back, kind);
    std::size_t wrong = 0, unreciprocal = 0, refracted = 0, reflected = 0;
    for (std::size_t i = 0; i < there.size(); ++i) {
      const Vec3 v = -to_vec3(there[i].wi), wo = to_vec3(there[i].wo);
      const double side = v.z > 0 ? 1 : -1, ior = there[i].wo.w, eta = side > 0 ? ior : 1 / ior;
      RoughLobeOracle oracle{there[i].wi.w, eta, kind == MATERIAL_GLASS};
      if (kind == MATERIAL_CONDUCTOR) oracle.eta = {double(0.2f), double(3.9f)};
      const auto exact = oracle.evaluate({v.x, v.y, side * v.z}, {wo.x, wo.y, side * wo.z});
      // Where microfacets are seen edge-on or light is all but totally reflected, rounding counts for more.
      if (std::fabs(v.z) < 0.01 || std::fabs(wo.z) < 0.01 || (exact.pdf > 0 && exact.cosine < 0.03)) continue;
      if (kind == MATERIAL_GLASS && std::fabs(eta * eta - 1 + exact.cosine * exact.cosine) < 0.02) continue;
      reflected += exact.pdf > 0 && side * wo.z > 0;
      refracted += exact.pdf > 0 && side * wo.z < 0;
      wrong += !(std::fabs(values[i].value.x - exact.value) <= 1e-3 * exact.value);
      wrong += !(std::fabs(values[i].value.w - exact.pdf) <= 1e-3 * exact.pdf);
      // f / eta^2 is symmetric (Veach 1997, 5.2): radiance that enters the denser side is compressed.
      const double f = values[i].value.x / std::fabs(wo.z), g = returned[i].value.x / std::fabs(v.z);
      const double scale = side * wo.z > 0 ? 1 : eta * eta;
      unreciprocal += !(std::fabs(f * scale - g) <= 2e-3 * std::max(f * scale, g) + 1e-12);
    }
    CHECK(wrong == 0);
    CHECK(unreciprocal == 0);
    CHECK(reflected > 100000);
    CHECK((refracted > 50000) == (kind == MATERIAL_GLASS));
  }
}

TEST_CASE("the density of a rough lobe integrates to 1 but for what ends under the surface") {
  constexpr std::size_t rows = 512;
  RandomInputs random(63);
  for (const uint kind : {MATERIAL_GLASS, MATERIAL_CONDUCTOR})
    for (const double alpha : {0.2, 0.5, 1.0})
      for (const double cosine : {0.95, 0.5, 0.1, -0.95, -0.5}) {
        CAPTURE(kind, alpha, cosine);
        std::vector<Input> inputs(2 * rows * rows);
        for (std::size_t i = 0; i < inputs.size(); ++i)
          inputs[i] = {to_float4(from_above(cosine), alpha),
                       to_float4(grid_direction(i, rows), 1.5),
                       {uniform24(random), uniform24(random), uniform24(random), 0}};
        double sum = 0, value = 0, kept = 0, weights = 0;
        for (const auto& output : lobe(inputs, kind)) {
          sum += output.value.w;
          value += output.value.x;
          kept += output.weight.x > 0;
          weights += output.weight.x;
        }
        const double count = static_cast<double>(inputs.size());
        // The fraction of samples that go on, within five of its standard deviations and the quadrature's
        // error.
        const double fraction = kept / count;
        CHECK(std::fabs(4 * M_PI * sum / count - fraction) <
              5 * std::sqrt(fraction * (1 - fraction) / count) + 2e-3);
        // Both estimate how much radiance the lobe reflects.
        CHECK(4 * M_PI * value / count == Approx(weights / count).epsilon(5e-3));
      }
}

TEST_CASE("sampled directions have the density that they state") {
  constexpr std::size_t count = 1 << 17, bins_across = 16, refinement = 64;
  RandomInputs random(64);
  for (const uint kind : {MATERIAL_GLASS, MATERIAL_CONDUCTOR})
    for (const double alpha : {0.2, 0.5, 1.0})
      for (const double cosine : {0.95, 0.5, 0.1, -0.95, -0.6}) {
        CAPTURE(kind, alpha, cosine);
        // The bins are cells of equal area, each a mean of what evaluation says at many points of it.
        constexpr std::size_t rows = bins_across * refinement;
        std::vector<Input> grid(2 * rows * rows), inputs(count);
        for (std::size_t i = 0; i < grid.size(); ++i)
          grid[i] = {to_float4(from_above(cosine), alpha), to_float4(grid_direction(i, rows), 1.5), {}};
        const auto densities = lobe(grid, kind);
        Histogram histogram(2 * bins_across * bins_across + 1);
        double all = 0;
        for (std::size_t i = 0; i < grid.size(); ++i) {
          const std::size_t row = i / (2 * rows), column = i % (2 * rows);
          const double probability = 4 * M_PI * densities[i].value.w / static_cast<double>(grid.size());
          histogram.probabilities[row / refinement * 2 * bins_across + column / refinement] += probability;
          all += probability;
        }
        histogram.probabilities.back() = std::max(0.0, 1 - all);  // paths that end
        for (auto& input : inputs)
          input = {to_float4(from_above(cosine), alpha),
                   to_float4({0, 0, 1}, 1.5),
                   {uniform24(random), uniform24(random), uniform24(random), 0}};
        const SquareBins bins{2 * bins_across, bins_across};
        for (const auto& output : lobe(inputs, kind)) {
          const Vec3 d = to_vec3(output.direction);
          histogram.add(output.weight.x > 0 ? bins.bin(turn(d.y, d.x), (1 - d.z) / 2) : bins.count());
        }
        check_chi_square(histogram, 30, "rough lobe");
      }
}

TEST_CASE("in a white furnace an ideal rough mirror loses what single scattering loses, no more") {
  constexpr std::size_t count = 1 << 18;
  RandomInputs random(65);
  for (const double alpha : alphas)
    for (const double cosine : cosines) {
      CAPTURE(alpha, cosine);
      std::vector<Input> inputs(count);
      for (auto& input : inputs)
        input = {to_float4(from_above(cosine), alpha),
                 to_float4({0, 0, 1}, 1.5),
                 {uniform24(random), uniform24(random), uniform24(random), 0}};
      double sum = 0, squares = 0, most = 0;
      for (const auto& output : lobe(inputs, MATERIAL_CONDUCTOR, true)) {
        const double weight = output.weight.x;
        sum += weight;
        squares += weight * weight;
        most = std::max(most, weight);
      }
      const double mean = sum / count, deviation = std::sqrt((squares / count - mean * mean) / count);
      CHECK(most < 1.000001);
      CHECK(std::fabs(mean - furnace_oracle(-from_above(cosine), alpha)) < 5 * deviation + 1e-4);
    }
}
