// Colours from images and patterns. Scalars alone, and choices in place of loops, so that loops over paths that ask for them
// become vector code (vector.cl).
#include "core/prelude.cl"
#include "shared/types.h"

// Linear RGB and alpha.
typedef struct {
  real r, g, b, a;
} Texel;

// The number that the low 16 bits hold as a half: exact, also where the device has no subnormal floats.
INLINE float half_value(uint bits) {
  uint magnitude = (bits & 0x7fffu) << 13, exponent = bits & 0x7c00u;
  float subnormal = as_float(magnitude + (113u << 23)) - 0x1p-14f;
  float others = as_float(magnitude + (exponent == 0x7c00u ? 224u << 23 : 112u << 23));
  return as_float(as_uint(exponent == 0 ? subnormal : others) | (bits & 0x8000u) << 16);
}

INLINE Texel texture_texel(global const Texture *texture, global const half *texels, int x, int y) {
  global const uint *pair =
      (global const uint *)texels + 2 * (size_t)(texture->first_texel + (uint)y * texture->width + (uint)x);
  uint low = pair[0], high = pair[1];
  Texel texel = {half_value(low), half_value(low >> 16), half_value(high), half_value(high >> 16)};
  return texel;
}

INLINE Texel texel_mix(Texel a, Texel b, real f) {
  Texel mixed = {(1 - f) * a.r + f * b.r, (1 - f) * a.g + f * b.g, (1 - f) * a.b + f * b.b, (1 - f) * a.a + f * b.a};
  return mixed;
}

INLINE Texel texel_choose(bool first, Texel a, Texel b) {
  Texel chosen = {first ? a.r : b.r, first ? a.g : b.g, first ? a.b : b.b, first ? a.a : b.a};
  return chosen;
}

INLINE Texel texture_checker(global const Texture *texture, real u, real v) {
  // Parities as numbers, and of each axis alone: an int would overflow far out on a plane, and the sum of the
  // two would round.
  real column = floor(u), row = floor(v);
  bool even = column - 2 * floor(column * (real)0.5) == row - 2 * floor(row * (real)0.5);
  global const float *a = (global const float *)&texture->a, *b = (global const float *)&texture->b;
  Texel texel = {even ? a[0] : b[0], even ? a[1] : b[1], even ? a[2] : b[2], 1};
  return texel;
}

// Linear RGB and alpha at `uv`, repeated in both directions, v up. Nearest: the texel whose square holds the
// point. Bilinear: between the four nearest texel centres.
INLINE Texel texture_lookup(global const Texture *texture, global const half *texels, real2 uv) {
  global const float *scale = (global const float *)&texture->scale;
  bool bilinear = texture->bilinear != 0;
  real u = uv.x * scale[0], v = uv.y * scale[1];
  int width = max((int)texture->width, 1), height = max((int)texture->height, 1);
  real x = (u - floor(u)) * width, y = (v - floor(v)) * height;
  x = x > 0 ? x : 0, y = y > 0 ? y : 0;  // far out they are no numbers
  x -= bilinear ? (real)0.5 : 0, y -= bilinear ? (real)0.5 : 0;
  real x0 = floor(x), y0 = floor(y);
  // From -1 to the number of texels.
  int left = (int)x0, low = (int)y0, right = left + 1, high = low + 1;
  left = left < 0 ? width - 1 : min(left, width - 1), low = low < 0 ? height - 1 : min(low, height - 1);
  right = bilinear ? (right >= width ? 0 : right) : left, high = bilinear ? (high >= height ? 0 : high) : low;
  real fx = bilinear ? x - x0 : 0, fy = bilinear ? y - y0 : 0;
  Texel bottom = texel_mix(texture_texel(texture, texels, left, low), texture_texel(texture, texels, right, low), fx);
  Texel top = texel_mix(texture_texel(texture, texels, left, high), texture_texel(texture, texels, right, high), fx);
  return texel_choose(texture->kind == TEXTURE_CHECKER, texture_checker(texture, u, v), texel_mix(bottom, top, fy));
}
