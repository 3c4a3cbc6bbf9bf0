// What glass leaves of the light along a path.
#include "vector_inputs.hpp"

using namespace causticl;

namespace {

const char* const source = R"(
#include "media/interior.cl"
typedef struct {
  float4 direction;   // w: the material's kind
  float4 normal;      // w: whether the path is inside glass so far
  float4 absorption;  // of the material; w: distance
  float4 around;      // absorption of the glass that the path is inside of
} Input;
kernel void pass_boundary(global const Input *in, global float4 *out, uint count, global Material *materials) {
  uint i = get_global_id(0);
  if (i >= count) return;
  materials[i].kind = (uint)in[i].direction.w;
  materials[i].absorption = in[i].absorption;
  real3 n = in[i].normal.xyz;
  Surface surface = {(real3)(0, 0, 0), n, n, (real2)(0, 0), 0, 0};
  Interior interior = {in[i].normal.w != 0, in[i].around.xyz};
  Interior before = interior_before(interior, materials + i, &surface, in[i].direction.xyz);
  Interior after = interior_after(interior, materials + i, &surface, in[i].direction.xyz);
  real side = dot(in[i].direction.xyz, n);
  out[4 * i] = (float4)(before.absorption, before.glass ? 1 : 0);
  out[4 * i + 1] = (float4)(after.absorption, after.glass ? 1 : 0);
  out[4 * i + 2] = (float4)(interior_transmittance(before, in[i].absorption.w), side);
  out[4 * i + 3] = (float4)(interior_transmittance(interior_none(), in[i].absorption.w), 0);
}
)";

struct Input {
  float4 direction, normal, absorption, around;
};

Vec3 random_absorption(RandomInputs& random) {
  const auto channel = [&] { return random.uniform() < 0.2 ? 0.0 : std::pow(10, random.uniform(-4, 3)); };
  return {channel(), channel(), channel()};
}

}  // namespace

TEST_CASE("a path knows by the sides of glass what it is inside of, and what that leaves of its light") {
  constexpr std::size_t count = 1 << 18;
  RandomInputs random(201);
  std::vector<Input> inputs(count);
  for (auto& input : inputs) {
    const bool inside = random.uniform() < 0.5;
    input.direction =
        to_float4(random_direction(random), random.uniform() < 0.6 ? MATERIAL_GLASS : MATERIAL_DIFFUSE);
    input.normal = to_float4(random_direction(random), inside);
    // Distances up to what infinitely far light has.
    input.absorption = to_float4(random_absorption(random),
                                 random.uniform() < 0.1 ? INFINITY : std::pow(10, random.uniform(-4, 3)));
    input.around = inside ? to_float4(random_absorption(random)) : float4{};
  }
  auto program = build_test_program(source);
  auto in = test_device().upload(inputs, "inputs");
  auto out = test_device().buffer(4 * count * sizeof(float4), "outputs");
  auto materials = test_device().buffer(count * sizeof(Material), "materials");
  run_kernel(program, "pass_boundary", count, in, out, cl_uint(count), materials);
  const auto outputs = test_device().download<float4>(out, 4 * count);
  std::size_t wrong_before = 0, wrong_after = 0, wrong_light = 0, lost_outside = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Input& input = inputs[i];
    const bool glass = input.direction.w == float(MATERIAL_GLASS), along = outputs[4 * i + 2].w > 0;
    const Vec3 own = to_vec3(input.absorption), around = to_vec3(input.around);
    const bool was_inside = input.normal.w != 0;
    // Met from behind, glass encloses the way there; gone into, the way on.
    const Vec3 before = glass && along ? own : around, after = !glass ? around : along ? Vec3{} : own;
    wrong_before += !(to_vec3(outputs[4 * i]) == before) ||
                    outputs[4 * i].w != (glass && along ? 1.0f : float(was_inside));
    wrong_after += !(to_vec3(outputs[4 * i + 1]) == after) ||
                   outputs[4 * i + 1].w != (glass ? float(!along) : float(was_inside));
    const Vec3 left = to_vec3(outputs[4 * i + 2]);
    for (int c = 0; c < 3; ++c) {
      const double depth = before[c] == 0 ? 0 : before[c] * input.absorption.w, exact = std::exp(-depth);
      // The exponent is rounded; what is too small for a float may be 0.
      wrong_light += !(std::fabs(left[c] - exact) <= exact * (1e-6 + 2e-7 * std::min(depth, 1e9)) + 1e-37);
    }
    lost_outside += !(to_vec3(outputs[4 * i + 3]) == Vec3{1, 1, 1});
  }
  CHECK(wrong_before == 0);
  CHECK(wrong_after == 0);
  CHECK(wrong_light == 0);
  CHECK(lost_outside == 0);
}
