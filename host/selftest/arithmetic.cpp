// Hard case 24: what the kernels assume of the device's arithmetic. A driver that breaks it is named.
#include <bit>
#include <cstring>

#include "selftest/random_check.hpp"
#include "selftest/stability_checks.hpp"

namespace causticl {
namespace {

constexpr const char* source = R"(
#include "core/prelude.cl"
kernel void divide(global const float2 *in, global float *out, uint count) {
  uint i = get_global_id(0);
  if (i < count) out[i] = in[i].x / in[i].y;
}
kernel void root(global const float *in, global float *out, uint count) {
  uint i = get_global_id(0);
  if (i < count) out[i] = sqrt(in[i]);
}
kernel void fused(global const float4 *in, global float *out, uint count) {
  uint i = get_global_id(0);
  if (i < count) out[i] = fma(in[i].x, in[i].y, in[i].z);
}
// a b + c rounded twice: a compiler that contracts it would break the sums of film.cl and the edges of triangle.cl.
kernel void unfused(global const float4 *in, global float *out, uint count) {
  uint i = get_global_id(0);
  if (i < count) out[i] = in[i].x * in[i].y + in[i].z;
}
// The rounding error of a sum (TwoSum): zero where a compiler reassociates.
kernel void sum_error(global const float2 *in, global float *out, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  float a = in[i].x, b = in[i].y, s = a + b, c = s - a;
  out[i] = (a - (s - c)) + (b - c);
}
// One bit for each predicate that kernels ask of a value.
kernel void predicates(global const float *in, global uint *out, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  float x = in[i];
  out[i] = (isnan(x) ? 1u : 0u) | (isinf(x) ? 2u : 0u) | (isfinite(x) ? 4u : 0u) | (x == x ? 8u : 0u) |
           (x > 0 ? 16u : 0u) | (!(x >= 0) ? 32u : 0u) | (max(x, 1.0f) >= 1.0f ? 64u : 0u);
}
)";

struct Pair {
  float a, b;
};
struct Quad {
  float a, b, c, unused;
};

/// A float with random sign, exponent and fraction; denormals, zeros and infinities among them.
float any_float(InputRandom& random) {
  switch (random.below(16)) {
    case 0:
      return std::bit_cast<float>(static_cast<std::uint32_t>(random.bits()) & 0x807fffffu);
    case 1:
      return std::copysign(0.0f, static_cast<float>(random.uniform(-1, 1)));
    case 2:
      return std::copysign(INFINITY, static_cast<float>(random.uniform(-1, 1)));
    default:
      return std::bit_cast<float>(static_cast<std::uint32_t>(random.bits()));
  }
}

float normal_float(InputRandom& random, double low = -6, double high = 6) {
  return static_cast<float>(std::copysign(random.scale(low, high), random.uniform(-1, 1)));
}

Pair normal_pair(InputRandom& random) { return {normal_float(random), normal_float(random)}; }

/// a, b and c with a b + c almost zero: what is left is the rounding of the product.
Quad cancelling_terms(InputRandom& random) {
  const auto [a, b] = normal_pair(random);
  return {a, b, next_float(-a * b, static_cast<int>(random.below(9)) - 4), 0};
}

/// The distance in units of the last place of `exact`, whatever both are.
double ulps(double value, double exact) {
  if (std::isnan(value) || std::isnan(exact)) return std::isnan(value) && std::isnan(exact) ? 0 : NAN;
  if (value == exact) return 0;
  const int exponent = std::max(std::ilogb(exact), -126);
  return std::fabs(value - exact) / std::ldexp(1.0, exponent - 23);
}

CheckResult division(CheckContext& context) {
  CheckKernel kernel(context, context.program(source), "divide");
  return run_random_check(
      context, 2.5, "ulp", [](InputRandom& random, std::uint64_t) { return normal_pair(random); },
      [&](const auto& inputs) { return kernel.run<float>(inputs); },
      [](const Pair& in, float out) { return ulps(out, static_cast<double>(in.a) / in.b); });
}

CheckResult square_root(CheckContext& context) {
  CheckKernel kernel(context, context.program(source), "root");
  return run_random_check(
      context, 3, "ulp",
      [](InputRandom& random, std::uint64_t) { return std::fabs(normal_float(random, -30, 30)); },
      [&](const auto& inputs) { return kernel.run<float>(inputs); },
      [](float in, float out) { return ulps(out, std::sqrt(static_cast<double>(in))); });
}

/// The exact product of two floats is a double, and cancels the third almost wholly: an unfused device is far
/// off.
CheckResult fused_multiply_add(CheckContext& context) {
  CheckKernel kernel(context, context.program(source), "fused");
  return run_random_check(
      context, 0.5, "ulp", [](InputRandom& random, std::uint64_t) { return cancelling_terms(random); },
      [&](const auto& inputs) { return kernel.run<float>(inputs); },
      [](const Quad& in, float out) { return ulps(out, static_cast<double>(in.a) * in.b + in.c); });
}

CheckResult no_contraction(CheckContext& context) {
  CheckKernel kernel(context, context.program(source), "unfused");
  return run_random_check(
      context, 0, "ulp", [](InputRandom& random, std::uint64_t) { return cancelling_terms(random); },
      [&](const auto& inputs) { return kernel.run<float>(inputs); },
      [](const Quad& in, float out) {
        volatile float product = in.a * in.b;
        return ulps(out, product + in.c);
      });
}

CheckResult no_reassociation(CheckContext& context) {
  CheckKernel kernel(context, context.program(source), "sum_error");
  return run_random_check(
      context, 0, "ulp", [](InputRandom& random, std::uint64_t) { return normal_pair(random); },
      [&](const auto& inputs) { return kernel.run<float>(inputs); },
      [](const Pair& in, float out) {
        volatile float sum = in.a + in.b;
        const double large = std::fabs(in.a) > std::fabs(in.b) ? in.a : in.b;
        const double small = std::fabs(in.a) > std::fabs(in.b) ? in.b : in.a;
        return ulps(out, small - (sum - large));
      });
}

/// isnan() and its kin on every kind of value. Denormals may count as zero.
CheckResult classification(CheckContext& context) {
  CheckKernel kernel(context, context.program(source), "predicates");
  return run_random_check(
      context, 0, "", [](InputRandom& random, std::uint64_t) { return any_float(random); },
      [&](const auto& inputs) { return kernel.run<std::uint32_t>(inputs); },
      [](float x, std::uint32_t out) {
        const bool nan = std::isnan(x), inf = std::isinf(x), denormal = std::fpclassify(x) == FP_SUBNORMAL;
        const std::uint32_t expected = (nan ? 1u : 0u) | (inf ? 2u : 0u) | (nan || inf ? 0u : 4u) |
                                       (nan ? 0u : 8u) | (x > 0 ? 16u : 0u) | (x >= 0 ? 0u : 32u) | 64u;
        const std::uint32_t mask = denormal ? ~48u : ~0u;
        return (out & mask) == (expected & mask) ? 0.0 : 1.0;
      });
}

/// Denormals are not relied on, but the user should know.
CheckResult denormals(CheckContext& context) {
  CheckResult result;
  result.inputs = 1;
  CheckKernel kernel(context, context.program(source), "divide");
  const std::vector<Pair> in{{0x1p-126f, 2.0f}};
  result.note =
      kernel.run<float>(in)[0] == 0x1p-127f ? "denormals are kept" : "denormals are flushed to zero";
  return result;
}

}  // namespace

std::vector<Check> arithmetic_checks() {
  return {{24, "division", 1, division},
          {24, "square root", 1, square_root},
          {24, "fma rounds once", 1, fused_multiply_add},
          {24, "products and sums round twice", 1, no_contraction},
          {24, "sums are not reassociated", 1, no_reassociation},
          {24, "NaN, infinity and comparisons", 1, classification},
          {24, "denormals", 1, denormals}};
}

}  // namespace causticl
