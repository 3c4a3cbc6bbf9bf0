#include "vector_inputs.hpp"

using namespace causticl;

namespace {

const char* const source = R"(
#include "materials/bsdf.cl"
kernel void lookup(global const Texture *textures, global const half *texels, global const float2 *uv,
                   global float4 *out, uint count, uint which) {
  uint i = get_global_id(0);
  if (i >= count) return;
  Texel texel = texture_lookup(textures + which, texels, uv[i]);
  out[i] = (real4)(texel.r, texel.g, texel.b, texel.a);
}
kernel void halves(global float *out) {
  uint i = get_global_id(0);
  if (i < 65536) out[i] = half_value(i | 0x5aa50000u);  // of the low bits alone
}
kernel void resolve(global const Material *materials, global const Texture *textures, global const half *texels,
                    global const float2 *uv, global float4 *out, uint count, uint which) {
  uint i = get_global_id(0);
  if (i >= count) return;
  Bsdf bsdf = bsdf_at(materials + which, textures, texels, uv[i]);
  out[i] = (float4)(bsdf.color, bsdf.kind);
}
)";

constexpr std::size_t lookup_count = 1 << 18;  // for each of eight image textures

/// k / 256 as a half, exactly.
cl_half half_of(unsigned k) {
  if (k == 0) return 0;
  unsigned exponent = 0;
  while (k >> (exponent + 1)) ++exponent;
  return static_cast<cl_half>(((exponent + 7) << 10) | (((k << 10) >> exponent) & 0x3ff));
}

struct Textures {
  std::vector<Texture> textures;
  std::vector<cl_half> texels;
  std::vector<double> values;  // the same numbers, read by the oracle

  void add_image(RandomInputs& random, uint width, uint height, bool bilinear, float2 scale) {
    Texture texture{};
    texture.scale = scale;
    texture.kind = TEXTURE_IMAGE;
    texture.bilinear = bilinear;
    texture.first_texel = static_cast<uint>(texels.size() / 4);
    texture.width = width;
    texture.height = height;
    textures.push_back(texture);
    for (uint i = 0; i < 4 * width * height; ++i) {
      const auto k = static_cast<unsigned>(random.uniform(0, 257));
      texels.push_back(half_of(k));
      values.push_back(k / 256.0);
    }
  }
  double value(const Texture& t, long long x, long long y, int channel) const {
    const auto wrap = [](long long i, long long n) { return ((i % n) + n) % n; };
    return values[4 * (t.first_texel + static_cast<std::size_t>(wrap(y, t.height)) * t.width +
                       static_cast<std::size_t>(wrap(x, t.width))) +
                  static_cast<std::size_t>(channel)];
  }
};

float channel_of(const float4& v, int channel) { return (&v.x)[channel]; }

/// Coordinates near 0, far out on both sides, and exactly on texel borders.
std::vector<float2> coordinates(RandomInputs& random, uint width, uint height) {
  std::vector<float2> result;
  for (std::size_t i = 0; i < lookup_count; ++i) {
    const double reach = i % 4 == 0 ? 1 : i % 4 == 1 ? 5 : i % 4 == 2 ? 1e4 : 3e7;
    double u = random.uniform(-reach, reach), v = random.uniform(-reach, reach);
    if (i % 16 == 0) u = std::round(random.uniform(-40, 40)) / width;
    if (i % 16 == 4) v = std::round(random.uniform(-40, 40)) / height;
    result.push_back({static_cast<float>(u), static_cast<float>(v)});
  }
  for (const float x :
       {0.0f, -0.0f, 1.0f, -1.0f, -1e-9f, 1e-9f, 0.99999994f, -0.99999994f, 1e20f, -1e20f, 1e38f})
    for (const float y : {0.0f, -1e-9f, 0.5f, 1.0f, -1e38f}) result.push_back({x, y});
  return result;
}

}  // namespace

TEST_CASE("half_value is exact for every half") {
  auto& device = test_device();
  const auto out = device.buffer(65536 * sizeof(float), "values");
  cl::Program program = build_test_program(source, EFFECT_TEXTURES);
  run_kernel(program, "halves", 65536, out);
  const auto values = device.download<float>(out, 65536);
  std::size_t wrong = 0;
  for (unsigned bits = 0; bits < 65536; ++bits) {
    const int exponent = static_cast<int>(bits >> 10 & 31);
    const double mantissa = bits & 0x3ff, sign = bits >> 15 ? -1 : 1;
    double expected = exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
    if (exponent == 31) expected = mantissa > 0 ? NAN : INFINITY;
    const double value = values[bits];
    wrong += std::isnan(expected) ? !std::isnan(value)
                                  : value != sign * expected || std::signbit(value) != (sign < 0);
  }
  CHECK(wrong == 0);
}

TEST_CASE("texture_lookup repeats images, nearest or bilinear, at any coordinate") {
  RandomInputs random(21);
  Textures scene;
  struct Size {
    uint width, height;
  };
  for (const Size size : {Size{1, 1}, Size{3, 5}, Size{64, 32}, Size{1000, 3}})
    for (const bool bilinear : {false, true})
      scene.add_image(random, size.width, size.height, bilinear,
                      size.width == 3 ? float2{2.5f, -0.3f} : float2{1, 1});
  auto program = build_test_program(source);
  auto textures = test_device().upload(scene.textures, "textures");
  auto texels = test_device().upload(scene.texels, "texels");
  for (std::size_t which = 0; which < scene.textures.size(); ++which) {
    const Texture& t = scene.textures[which];
    CAPTURE(t.width, t.height, t.bilinear);
    const auto uv = coordinates(random, t.width, t.height);
    auto in = test_device().upload(uv, "uv");
    auto out = test_device().buffer(uv.size() * sizeof(float4), "out");
    run_kernel(program, "lookup", uv.size(), textures, texels, in, out, cl_uint(uv.size()), cl_uint(which));
    const auto found = test_device().download<float4>(out, uv.size());
    double worst = 0;
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < uv.size(); ++i) {
      // The position in texels: products round once in single precision, the rest is exact in double.
      const double u = uv[i].x * t.scale.x, v = uv[i].y * t.scale.y;
      const double x = (u - std::floor(u)) * t.width, y = (v - std::floor(v)) * t.height;
      for (int channel = 0; channel < 4; ++channel) {
        const double value = channel_of(found[i], channel);
        if (t.bilinear) {
          const double x0 = std::floor(x - 0.5), y0 = std::floor(y - 0.5), fx = x - 0.5 - x0,
                       fy = y - 0.5 - y0;
          const auto at = [&](int dx, int dy) {
            return scene.value(t, static_cast<long long>(x0) + dx, static_cast<long long>(y0) + dy, channel);
          };
          const double expected =
              (1 - fy) * ((1 - fx) * at(0, 0) + fx * at(1, 0)) + fy * ((1 - fx) * at(0, 1) + fx * at(1, 1));
          worst = std::max(worst, std::fabs(value - expected));
          wrong += std::isnan(value);
        } else {
          // Within rounding of a border either neighbour will do.
          const double ex = 2e-7 * t.width, ey = 2e-7 * t.height;
          bool fits = false;
          for (const double dx : {-ex, ex})
            for (const double dy : {-ey, ey})
              fits = fits || value == scene.value(t, static_cast<long long>(std::floor(x + dx)),
                                                  static_cast<long long>(std::floor(y + dy)), channel);
          wrong += !fits;
        }
      }
    }
    CHECK(wrong == 0);
    // A coordinate is off by 2^-24 of the width in texels, and neighbours differ by at most 1.
    CHECK(worst < 3e-7 * std::max({t.width, t.height, 4u}));
  }
}

TEST_CASE("the checker alternates exactly, however far out") {
  RandomInputs random(22);
  Texture checker{};
  checker.kind = TEXTURE_CHECKER;
  checker.a = {1, 2, 3, 0};
  checker.b = {4, 5, 6, 0};
  checker.scale = {2, 0.5f};
  std::vector<float2> uv;
  for (std::size_t i = 0; i < (1 << 20); ++i) {
    const double reach = std::pow(10.0, random.uniform(-1, 12)),
                 other = std::pow(10.0, random.uniform(-1, 12));
    uv.push_back({static_cast<float>(random.uniform(-reach, reach)),
                  static_cast<float>(random.uniform(-other, other))});
  }
  auto program = build_test_program(source);
  auto textures = test_device().upload(std::vector<Texture>{checker}, "textures");
  auto texels = test_device().buffer(16, "texels");
  auto in = test_device().upload(uv, "uv");
  auto out = test_device().buffer(uv.size() * sizeof(float4), "out");
  run_kernel(program, "lookup", uv.size(), textures, texels, in, out, cl_uint(uv.size()), cl_uint(0));
  const auto found = test_device().download<float4>(out, uv.size());
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < uv.size(); ++i) {
    const auto odd = [](float x) { return std::fmod(std::floor(static_cast<double>(x)), 2.0) != 0; };
    const bool even = odd(uv[i].x * checker.scale.x) == odd(uv[i].y * checker.scale.y);
    const float4 expected = even ? checker.a : checker.b;
    const float4 v = found[i];
    wrong += v.x != expected.x || v.y != expected.y || v.z != expected.z || v.w != 1;
  }
  CHECK(wrong == 0);
}

TEST_CASE("a texture replaces the colour, and alpha makes texels diffuse where the material says so") {
  RandomInputs random(23);
  // Two texels: the left one opaque, the right one transparent.
  Texture texture{};
  texture.scale = {1, 1};
  texture.width = 2;
  texture.height = 1;
  const std::vector<cl_half> texels{half_of(64), half_of(128), half_of(192), half_of(256),
                                    half_of(32), half_of(16),  half_of(8),   half_of(0)};
  Material plain{};
  plain.color = {0.5f, 0.6f, 0.7f, 1.5f};
  plain.kind = MATERIAL_MIRROR;
  Material tinted = plain, by_alpha = plain;
  tinted.color_texture = by_alpha.color_texture = 1;
  by_alpha.flags = MATERIAL_ALPHA_DIFFUSE;
  auto program = build_test_program(source);
  auto materials = test_device().upload(std::vector<Material>{plain, tinted, by_alpha}, "materials");
  auto textures = test_device().upload(std::vector<Texture>{texture}, "textures");
  auto buffer = test_device().upload(texels, "texels");
  auto in = test_device().upload(std::vector<float2>{{0.25f, 0.5f}, {0.75f, 0.5f}}, "uv");
  auto out = test_device().buffer(2 * sizeof(float4), "out");
  const auto at = [&](cl_uint which) {
    run_kernel(program, "resolve", 2, materials, textures, buffer, in, out, cl_uint(2), which);
    return test_device().download<float4>(out, 2);
  };
  const auto is = [](float4 v, float r, float g, float b, uint kind) {
    return v.x == r && v.y == g && v.z == b && v.w == static_cast<float>(kind);
  };
  CHECK(is(at(0)[0], 0.5f, 0.6f, 0.7f, MATERIAL_MIRROR));
  CHECK(is(at(1)[0], 0.25f, 0.5f, 0.75f, MATERIAL_MIRROR));
  CHECK(is(at(1)[1], 0.125f, 0.0625f, 0.03125f, MATERIAL_MIRROR));
  CHECK(is(at(2)[0], 0.25f, 0.5f, 0.75f, MATERIAL_DIFFUSE));
  CHECK(is(at(2)[1], 0.125f, 0.0625f, 0.03125f, MATERIAL_MIRROR));
}
