// Colours from images and patterns.
#include "core/prelude.cl"
#include "shared/types.h"

INLINE real4 texture_texel(global const Texture *texture, global const half *texels, int x, int y) {
  float4 texel = vload_half4(texture->first_texel + (uint)y * texture->width + (uint)x, texels);
  return (real4)(texel.x, texel.y, texel.z, texel.w);
}

// x modulo n in [0, n), also for negative x.
INLINE int texture_wrap(int x, int n) {
  int r = x % n;
  return r < 0 ? r + n : r;
}

// Linear RGB and alpha at `uv`, repeated in both directions, v up. Nearest: the texel whose square holds the
// point. Bilinear: between the four nearest texel centres.
static real4 texture_lookup(global const Texture *texture, global const half *texels, real2 uv) {
  real u = uv.x * texture->scale.x, v = uv.y * texture->scale.y;
  if (texture->kind == TEXTURE_CHECKER) {
    // Parities as numbers, and of each axis alone: an int would overflow far out on a plane, and the sum of the
    // two would round.
    real column = floor(u), row = floor(v);
    bool even = column - 2 * floor(column * (real)0.5) == row - 2 * floor(row * (real)0.5);
    float4 color = even ? texture->a : texture->b;
    return (real4)(color.x, color.y, color.z, 1);
  }
  int width = (int)texture->width, height = (int)texture->height;
  real x = (u - floor(u)) * width, y = (v - floor(v)) * height;
  if (!texture->bilinear)
    return texture_texel(texture, texels, clamp((int)x, 0, width - 1), clamp((int)y, 0, height - 1));
  x -= (real)0.5;
  y -= (real)0.5;
  real x0 = floor(x), y0 = floor(y), fx = x - x0, fy = y - y0;
  int left = texture_wrap((int)x0, width), right = texture_wrap((int)x0 + 1, width);
  int low = texture_wrap((int)y0, height), high = texture_wrap((int)y0 + 1, height);
  real4 bottom = (1 - fx) * texture_texel(texture, texels, left, low) +
                 fx * texture_texel(texture, texels, right, low);
  real4 top = (1 - fx) * texture_texel(texture, texels, left, high) +
              fx * texture_texel(texture, texels, right, high);
  return (1 - fy) * bottom + fy * top;
}
