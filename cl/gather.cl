// Finding the photons around a point: exact integer sums, eight photons at a time.
#include "grid.cl"

// Photons whose surface leans away by more than this cosine lie on another wall.
#define GATHER_NORMAL_COSINE 0.5f

typedef struct {
  ulong red, green, blue;  // in units of Params.photon_flux / PHOTON_FLUX_UNIT
  ulong near_red, near_green, near_blue;  // of those within sqrt(radius2) / 2
  uint count;
} Gathered;

INLINE ulong sum_of_lanes(uint8 v) {
  return (ulong)v.s0 + v.s1 + v.s2 + v.s3 + v.s4 + v.s5 + v.s6 + v.s7;
}

// Adds the photons sorted[begin, end) within sqrt(radius2) of `point` that landed on the same side.
INLINE void gather_range(global const uint *sorted, uint stride, uint begin, uint end, real3 point, float3 normal,
                         real radius2, Gathered *sum) {
  global const real *xs = (global const real *)sorted;
  global const uint *words = photon_words(sorted, stride);
  const uint8 lane = (uint8)(0, 1, 2, 3, 4, 5, 6, 7);
  float3 n = normal * (1.0f / 127.0f);
  real near_radius2 = radius2 / 4;
  while (begin < end) {
    // 2^16 steps of 16-bit flux are what the 32-bit lanes hold.
    uint stop = end - begin > (1u << 19) ? begin + (1u << 19) : end;
    uint8 red = 0, green = 0, blue = 0, near_red = 0, near_green = 0, near_blue = 0;
    int8 count = 0;
    for (uint i = begin; i < stop; i += 8) {
      real8 dx = vload8(0, xs + i) - point.x;
      real8 dy = vload8(0, xs + stride + i) - point.y;
      real8 dz = vload8(0, xs + 2 * stride + i) - point.z;
      int8 packed = as_int8(vload8(0, words + i));
      float8 facing = n.x * convert_float8(packed << 24 >> 24) + n.y * convert_float8(packed << 16 >> 24) +
                      n.z * convert_float8(packed << 8 >> 24);
      real8 distance2 = dx * dx + dy * dy + dz * dz;
      int8 inside =
          mask_lanes(distance2 <= radius2) & (facing > GATHER_NORMAL_COSINE) & (lane < (uint8)(stop - i));
      uint8 keep = as_uint8(inside), near = as_uint8(mask_lanes(distance2 <= near_radius2));
      uint8 red_green = vload8(0, words + stride + i) & keep, b = vload8(0, words + 2 * stride + i) & keep;
      uint8 r = red_green & 0xffffu, g = red_green >> 16;
      red += r;
      green += g;
      blue += b;
      near_red += r & near;
      near_green += g & near;
      near_blue += b & near;
      count -= inside;
    }
    sum->red += sum_of_lanes(red);
    sum->green += sum_of_lanes(green);
    sum->blue += sum_of_lanes(blue);
    sum->near_red += sum_of_lanes(near_red);
    sum->near_green += sum_of_lanes(near_green);
    sum->near_blue += sum_of_lanes(near_blue);
    sum->count += (uint)sum_of_lanes(as_uint8(count));
    begin = stop;
  }
}

// The cubes along one axis that can hold a photon within `radius` of x: *first bucket and their number, at
// most n. The interval is widened by the rounding of its ends.
INLINE uint gather_window(real x, real radius, float origin, float inverse_cell, uint n, uint *first) {
  real reach = radius * (real)1.000001 + fabs(x) * (real)2.4e-7;
  int low = grid_coordinate(x - reach, origin, inverse_cell), high = grid_coordinate(x + reach, origin, inverse_cell);
  uint span = (uint)high - (uint)low;
  *first = grid_wrap(low, n);
  return span >= n ? n : span + 1;
}

// Sums over all photons within sqrt(radius2) of `point`, and over those within half that radius: what the two say
// differently of the density is a measure of how much the larger one blurs. Each bucket is visited once: a window of at most n
// cubes along an axis of n buckets has no two cubes in one bucket.
OUTLINE Gathered gather(Grid grid, global const uint *starts, global const uint *sorted, real3 point, float3 normal,
                       real radius2) {
  Gathered sum = {0, 0, 0, 0, 0, 0, 0};
  real radius = sqrt(radius2);
  uint stride = photon_stride(grid.photon_count);
  uint i0, j0, k0;
  uint ni = gather_window(point.x, radius, grid.origin.x, grid.origin.w, grid.nx, &i0);
  uint nj = gather_window(point.y, radius, grid.origin.y, grid.origin.w, grid.ny, &j0);
  uint nk = gather_window(point.z, radius, grid.origin.z, grid.origin.w, grid.nz, &k0);
  // Buckets along x are neighbours in memory: a row is one range, or two where it wraps around.
  uint first_end = min(i0 + ni, grid.nx), wrapped = i0 + ni - first_end;
  for (uint k = 0; k < nk; ++k) {
    uint kk = k0 + k >= grid.nz ? k0 + k - grid.nz : k0 + k;
    for (uint j = 0; j < nj; ++j) {
      uint jj = j0 + j >= grid.ny ? j0 + j - grid.ny : j0 + j;
      global const uint *row = starts + (kk * grid.ny + jj) * grid.nx;
      gather_range(sorted, stride, row[i0], row[first_end], point, normal, radius2, &sum);
      if (wrapped != 0) gather_range(sorted, stride, row[0], row[wrapped], point, normal, radius2, &sum);
    }
  }
  return sum;
}
