#include "chi_square_check.hpp"
#include "kernels/fresnel_oracle.hpp"
#include "vector_inputs.hpp"

using namespace causticl;

namespace {

const char* const source = R"(
#include "materials/bsdf.cl"
typedef struct {
  float4 direction;  // wi; w: ior
  float4 geometric, shading, random;
} Input;
typedef struct {
  float4 direction;  // w: pdf
  float4 weight;
  float4 facing;     // the facing normal
  float4 emission;   // at this side of a one- and two-sided light
  float4 side;       // cosine of the geometric normal with wi and wo, as kernels see it
} Output;
kernel void sample(global const Input *in, global Output *out, uint count, uint kind, uint radiance,
                   global const Material *lights) {
  uint i = get_global_id(0);
  if (i >= count) return;
  Bsdf bsdf = {kind, (real3)(0.25f, 0.5f, 1), in[i].direction.w};
  Surface surface = {(real3)(0, 0, 0), in[i].geometric.xyz, in[i].shading.xyz, (real2)(0, 0), 0, 0};
  real3 d = in[i].direction.xyz;
  BsdfSample next = bsdf_sample(&bsdf, &surface, d, in[i].random, radiance != 0);
  real3 n = facing_normal(&surface, d);
  out[i].direction = (float4)(next.direction, next.pdf);
  out[i].weight = (float4)(next.weight, 0);
  out[i].facing = (float4)(n, 0);
  out[i].side = (float4)(dot3(d, surface.geometric_normal), dot3(next.direction, surface.geometric_normal), 0, 0);
  out[i].emission = (float4)(emission_at(lights, &surface, d).x, emission_at(lights + 1, &surface, d).x, 0, 0);
}
)";

struct Input {
  float4 direction, geometric, shading, random;
};
struct Output {
  float4 direction, weight, facing, emission, side;
};

constexpr std::size_t sample_count = 1 << 20;

cl::Program& program() {
  static cl::Program built = build_test_program(source);
  return built;
}

std::vector<Output> sample(const std::vector<Input>& inputs, uint kind, bool radiance) {
  Material one_sided{}, two_sided{};
  one_sided.emission = two_sided.emission = {3, 3, 3, 0};
  two_sided.flags = MATERIAL_TWO_SIDED;
  auto lights = test_device().upload(std::vector<Material>{one_sided, two_sided}, "lights");
  auto in = test_device().upload(inputs, "inputs");
  auto out = test_device().buffer(inputs.size() * sizeof(Output), "outputs");
  run_kernel(program(), "sample", inputs.size(), in, out, cl_uint(inputs.size()), cl_uint(kind),
             cl_uint(radiance), lights);
  return test_device().download<Output>(out, inputs.size());
}

constexpr double cosine_rounding = 2e-7;  // of a dot product of unit vectors

/// Directions wi on both sides of flat surfaces, some of them grazing.
std::vector<Input> flat_inputs(RandomInputs& random) {
  std::vector<Input> inputs(sample_count);
  for (std::size_t i = 0; i < sample_count; ++i) {
    const Vec3 n = random_direction(random);
    const double cosine =
        i % 8 ? random.uniform(-1, 1) : std::pow(10, random.uniform(-8, -1)) * (i % 16 ? 1 : -1);
    inputs[i].direction =
        to_float4(tilted_direction(random, n, std::acos(cosine)), i % 64 == 9 ? 1 : random_ior(random));
    inputs[i].geometric = inputs[i].shading = to_float4(n);
    inputs[i].random = {uniform24(random), uniform24(random), uniform24(random), uniform24(random)};
  }
  return inputs;
}

/// The same with shading normals tilted by up to 80 degrees.
std::vector<Input> tilted_inputs(RandomInputs& random) {
  auto inputs = flat_inputs(random);
  for (auto& input : inputs)
    input.shading =
        to_float4(tilted_direction(random, to_vec3(input.geometric), random.uniform(0, 80 * M_PI / 180)));
  return inputs;
}

double wi_cosine(const Input& input) {
  return std::fabs(dot(to_vec3(input.direction), to_vec3(input.geometric)));
}

/// Whether the path leaves on the side of the true surface that it arrived from.
bool same_side(const Output& output) {
  return (output.side.x < 0 && output.side.y > 0) || (output.side.x >= 0 && output.side.y < 0);
}

}  // namespace

TEST_CASE("glass reflects with the Fresnel probability and refracts by Snell's law") {
  RandomInputs random(42);
  const auto inputs = flat_inputs(random);
  for (const bool radiance : {true, false}) {
    const auto outputs = sample(inputs, MATERIAL_GLASS, radiance);
    double reflected_count = 0, expected = 0, variance = 0;
    std::size_t wrong_choice = 0, wrong_direction = 0, wrong_weight = 0, wrong_side = 0, wrong_length = 0,
                wrong_pdf = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      const Vec3 d = to_vec3(inputs[i].direction), g = to_vec3(inputs[i].geometric),
                 out = to_vec3(outputs[i].direction);
      const double ior = inputs[i].direction.w;
      const bool entering = outputs[i].side.x < 0;
      const double eta = entering ? ior : 1 / ior;
      const Vec3 n = entering ? g : -g;
      const double cosine = std::min(-dot(d, n), 1.0);
      const Boundary exact = fresnel_oracle(cosine, eta);
      const Boundary low = fresnel_oracle(cosine, eta, -rounding, -cosine_rounding);
      const Boundary high = fresnel_oracle(cosine, eta, rounding, cosine_rounding);
      const bool reflected = same_side(outputs[i]);
      reflected_count += reflected;
      expected += exact.reflectance;
      variance += exact.reflectance * (1 - exact.reflectance);
      const double z = inputs[i].random.z;
      if (z < std::min(low.reflectance, high.reflectance) - 2e-6) wrong_choice += !reflected;
      if (z > std::max(low.reflectance, high.reflectance) + 2e-6) wrong_choice += reflected;

      // A grazing ray is lifted off the surface by a cosine of up to 2e-6.
      const Vec3 mirrored = d + 2 * cosine * n;
      const Vec3 bent = d / eta + (cosine / eta - exact.cosine_t) * n;
      const double bend = reflected ? 0 : high.cosine_t - low.cosine_t;
      wrong_direction += !(length(out - (reflected ? mirrored : bent)) < 3e-6 + bend);
      wrong_length += !(std::fabs(length(out) - 1) < 3e-7);
      wrong_side += dot(out, g) == 0;
      wrong_pdf += outputs[i].direction.w != 0;
      const double factor = reflected || !radiance ? 1 : 1 / (eta * eta);
      const Vec3 weight = Vec3{0.25, 0.5, 1} * factor;
      wrong_weight += length(to_vec3(outputs[i].weight) - weight) > 1e-6 * factor;
    }
    CHECK(wrong_choice == 0);
    CHECK(wrong_direction == 0);
    CHECK(wrong_length == 0);
    CHECK(wrong_side == 0);
    CHECK(wrong_pdf == 0);
    CHECK(wrong_weight == 0);
    CHECK(std::fabs(reflected_count - expected) < 5 * std::sqrt(variance));
  }
}

TEST_CASE("a refracted ray sent back comes out where it came from") {
  RandomInputs random(43);
  auto inputs = flat_inputs(random);
  for (auto& input : inputs) input.random.z = 0.99999994f;  // refract unless everything is reflected
  const auto there = sample(inputs, MATERIAL_GLASS, true);
  auto returning = inputs;
  for (std::size_t i = 0; i < inputs.size(); ++i)
    returning[i].direction = to_float4(-to_vec3(there[i].direction), inputs[i].direction.w);
  const auto back = sample(returning, MATERIAL_GLASS, true);
  std::size_t refracted = 0, wrong = 0;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const Vec3 d = to_vec3(inputs[i].direction), out = to_vec3(there[i].direction);
    // Next to grazing or the critical angle the way back is ill-conditioned, or reflected.
    const double cosine = wi_cosine(inputs[i]), cosine_t = std::fabs(dot(out, to_vec3(inputs[i].geometric)));
    if (same_side(there[i]) || cosine < 0.01 || cosine_t < 0.01) continue;
    ++refracted;
    wrong += !(length(to_vec3(back[i].direction) + d) < 1e-6 + 3e-6 / std::min(cosine, cosine_t));
    // Radiance gains on one way what it loses on the other.
    wrong += !(std::fabs(there[i].weight.z * back[i].weight.z - 1) < 1e-6);
  }
  CHECK(refracted > sample_count / 2);
  CHECK(wrong == 0);
}

TEST_CASE("a mirror obeys its law about the facing normal") {
  RandomInputs random(44);
  const auto inputs = flat_inputs(random);
  const auto outputs = sample(inputs, MATERIAL_MIRROR, true);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const Vec3 d = to_vec3(inputs[i].direction), g = to_vec3(inputs[i].geometric),
               out = to_vec3(outputs[i].direction);
    wrong += !(length(out - (d - 2 * dot(d, g) * g)) < 3e-6) || !same_side(outputs[i]);
    wrong += outputs[i].direction.w != 0 || !(to_vec3(outputs[i].weight) == Vec3{0.25, 0.5, 1});
  }
  CHECK(wrong == 0);
}

TEST_CASE("diffuse_sample has the density that it states and passes on the albedo exactly") {
  RandomInputs random(45);
  const Vec3 n = random_direction(random);
  std::vector<Input> inputs(sample_count);
  for (auto& input : inputs) {
    input.direction = to_float4(tilted_direction(random, n, std::acos(random.uniform(-1, -0.01))));
    input.geometric = input.shading = to_float4(n);
    input.random = {uniform24(random), uniform24(random), uniform24(random), uniform24(random)};
  }
  const SquareBins bins{16, 16};
  Histogram histogram(bins.count());
  histogram.probabilities.assign(bins.count(), 1.0 / static_cast<double>(bins.count()));
  const Frame frame(n);
  std::size_t wrong = 0;
  for (const auto& output : sample(inputs, MATERIAL_DIFFUSE, true)) {
    const Vec3 local = frame.to_local(to_vec3(output.direction));
    wrong += !(local.z > 0) || std::fabs(output.direction.w - local.z / M_PI) > 1e-6;
    wrong += !(to_vec3(output.weight) == Vec3{0.25, 0.5, 1});
    histogram.add(bins.bin(local.z * local.z, turn(local.y, local.x)));
  }
  CHECK(wrong == 0);
  check_chi_square(histogram, 1, "diffuse_sample");
}

TEST_CASE("tilted shading normals send nothing through the surface") {
  RandomInputs random(46);
  const auto inputs = tilted_inputs(random);
  for (const uint kind : {MATERIAL_DIFFUSE, MATERIAL_MIRROR, MATERIAL_GLASS}) {
    CAPTURE(kind);
    const auto outputs = sample(inputs, kind, true);
    std::size_t not_finite = 0, wrong_normal = 0, through = 0, refracted = 0, wrong_weight = 0,
                wrong_emission = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      const Vec3 d = to_vec3(inputs[i].direction), g = to_vec3(inputs[i].geometric),
                 s = to_vec3(inputs[i].shading);
      const Vec3 out = to_vec3(outputs[i].direction), weight = to_vec3(outputs[i].weight),
                 n = to_vec3(outputs[i].facing);
      not_finite += !(std::fabs(length(out) - 1) < 1e-6) || !std::isfinite(weight.x + weight.y + weight.z);
      const bool front = outputs[i].side.x < 0, same = same_side(outputs[i]);

      // The shading normal turned to the side of arrival, or the geometric one where that still leans away.
      const Vec3 shading = front ? s : -s, geometric = front ? g : -g;
      if (std::fabs(dot(shading, d)) > 1e-6)
        wrong_normal += !(n == (dot(shading, d) < 0 ? shading : geometric));

      if (kind == MATERIAL_DIFFUSE) {
        // Exactly along the surface, nothing arrives.
        wrong_weight += !(weight == (same && outputs[i].side.x != 0 ? Vec3{0.25, 0.5, 1} : Vec3{}));
      } else if (kind == MATERIAL_MIRROR) {
        through += !same;
        wrong_weight += !(weight == Vec3{0.25, 0.5, 1});
      } else {
        // The weight of radiance tells a refracted ray from a reflected one.
        const double ior = inputs[i].direction.w, scale = front ? 1 / (ior * ior) : ior * ior;
        if (std::fabs(scale - 1) < 1e-3) continue;
        const bool bent = std::fabs(weight.z - scale) < 1e-5 * scale;
        wrong_weight += !bent && weight.z != 1;
        through += bent == same;
        refracted += bent;
      }
      const float4 emission = outputs[i].emission;
      wrong_emission += emission.x != (front ? 3 : 0) || emission.y != 3;
    }
    CHECK(not_finite == 0);
    CHECK(wrong_normal == 0);
    CHECK(through == 0);
    CHECK(wrong_weight == 0);
    CHECK(wrong_emission == 0);
    if (kind == MATERIAL_GLASS) CHECK(refracted > sample_count / 4);
  }
}
