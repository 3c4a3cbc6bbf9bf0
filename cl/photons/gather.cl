// Finding the photons around a point: exact integer sums, eight photons at a time.
#include "photons/gather_weighted.cl"

// Gathered by lanes of eight photons, which the ranges of a search have in common.
typedef struct {
  uint8 red, green, blue, near_red, near_green, near_blue;
  uint8 direct_red, direct_green, direct_blue, caustic_red, caustic_green, caustic_blue;
  int8 count;  // negative: a comparison's true is -1
  uint steps;  // of eight photons since the lanes were empty
} GatherLanes;

// As many steps of 16-bit flux as the 32-bit lanes hold.
#define GATHER_STEPS 65536u

INLINE GatherLanes gather_lanes_empty(void) {
  GatherLanes lanes = {(uint8)(0), (uint8)(0), (uint8)(0), (uint8)(0), (uint8)(0), (uint8)(0), (uint8)(0),
                       (uint8)(0), (uint8)(0), (uint8)(0), (uint8)(0), (uint8)(0), (int8)(0),  0};
  return lanes;
}

INLINE ulong sum_of_lanes(uint8 v) {
  ulong4 a = convert_ulong4(v.lo) + convert_ulong4(v.hi);
  ulong2 b = a.lo + a.hi;
  return b.x + b.y;
}

// Adds the lanes to the sums.
INLINE void gather_lanes_add(GatherLanes lanes, Gathered *sum) {
  sum->red += sum_of_lanes(lanes.red);
  sum->green += sum_of_lanes(lanes.green);
  sum->blue += sum_of_lanes(lanes.blue);
  sum->near_red += sum_of_lanes(lanes.near_red);
  sum->near_green += sum_of_lanes(lanes.near_green);
  sum->near_blue += sum_of_lanes(lanes.near_blue);
  if (HAS(OUTPUT_LIGHT_PASSES)) {
    sum->direct_red += sum_of_lanes(lanes.direct_red);
    sum->direct_green += sum_of_lanes(lanes.direct_green);
    sum->direct_blue += sum_of_lanes(lanes.direct_blue);
    sum->caustic_red += sum_of_lanes(lanes.caustic_red);
    sum->caustic_green += sum_of_lanes(lanes.caustic_green);
    sum->caustic_blue += sum_of_lanes(lanes.caustic_blue);
  }
  sum->count += (uint)sum_of_lanes(as_uint8(-lanes.count));
}

// Whether photons with these words of marks and normal landed on the side that a visible point's normal is of: the cosine
// of the two is more than GATHER_NORMAL_COSINE.
INLINE int8 same_side_by_floats(int8 photons, uint normal) {
  float3 n = normal_unpack(normal) * (1.0f / 127.0f);
  return n.x * convert_float8(photons << 24 >> 24) + n.y * convert_float8(photons << 16 >> 24) +
             n.z * convert_float8(photons << 8 >> 24) > GATHER_NORMAL_COSINE;
}
#ifdef __AVX2__
typedef char Bytes __attribute__((ext_vector_type(32)));
typedef short Words __attribute__((ext_vector_type(16)));
// Four products of bytes at once, in a third of the instructions that floats take, and the same: the product is a whole
// number, so that the limit may be rounded down. x86 multiplies bytes without a sign by bytes with one, which has to be
// that of both.
INLINE int8 same_side(int8 photons, uint normal) {
  Bytes p = __builtin_astype(photons, Bytes), n = __builtin_astype((int8)(int)(normal & 0xffffffu), Bytes);
  Words sums = __builtin_ia32_pmaddubsw256(__builtin_ia32_psignb256(p, p), __builtin_ia32_psignb256(n, p));
  return __builtin_ia32_pmaddwd256(sums, (Words)1) > (int)(GATHER_NORMAL_COSINE * 127 * 127);
}
#else
INLINE int8 same_side(int8 photons, uint normal) { return same_side_by_floats(photons, normal); }
#endif

// Those of the photons `inside` that no wall parts from the visible point.
OUTLINE int8 beside_walls(global const PhotonBlock *photons, int8 inside, const NearWalls *walls) {
  int kept[8];
  vstore8(inside, 0, kept);
  for (uint lane = 0; lane < 8; ++lane) {
    if (kept[lane] == 0) continue;
    real3 p = (real3)(photons->position[0][lane], photons->position[1][lane], photons->position[2][lane]);
    if (walls_between(walls, p, convert_real3(normal_unpack(photons->normal[lane])))) kept[lane] = 0;
  }
  return vload8(0, kept);
}

// Adds photons begin to end - 1 of the map that lie within the radius of `point` and landed on the same side to the lanes,
// and these to `sum` where they are full. `walls` are those near the point, or null.
INLINE void gather_range(global const PhotonBlock *sorted, uint begin, uint end, const GatherPoint *point,
                         const NearWalls *walls, GatherLanes *lanes, Gathered *sum) {
  real3 position = point->position;
  uint normal = point->normal;
  real radius2 = point->radius2;
  const uint8 lane = (uint8)(0, 1, 2, 3, 4, 5, 6, 7);
  real near_radius2 = radius2 / 4;
  uint block = begin / 8, blocks_end = begin < end ? (end + 7) / 8 : block;
  uint8 number = block * 8 + lane - begin;  // in the range; of those before it, beyond all
  while (block < blocks_end) {
    if (lanes->steps == GATHER_STEPS) {
      gather_lanes_add(*lanes, sum);
      *lanes = gather_lanes_empty();
    }
    uint steps = min(blocks_end - block, GATHER_STEPS - lanes->steps), stop = block + steps;
    lanes->steps += steps;
    for (; block < stop; ++block) {
      global const PhotonBlock *photons = sorted + block;
      real8 dx = vload8(0, photons->position[0]) - position.x;
      real8 dy = vload8(0, photons->position[1]) - position.y;
      real8 dz = vload8(0, photons->position[2]) - position.z;
      int8 packed = as_int8(vload8(0, photons->normal));
      real8 distance2 = dx * dx + dy * dy + dz * dz;
      int8 inside = mask_lanes(distance2 <= radius2) & same_side(packed, normal) & (number < end - begin);
      number += 8;
      if (HAS(EFFECT_MEDIUM)) inside &= packed >= 0;  // the others are marked IN_MEDIUM
      if (HAS(EFFECT_WALLS) && walls) inside = beside_walls(photons, inside, walls);
      uint8 keep = as_uint8(inside), near = as_uint8(mask_lanes(distance2 <= near_radius2));
      uint8 red_green = vload8(0, photons->flux_rg) & keep, b = vload8(0, photons->flux_b) & keep;
      uint8 r = red_green & 0xffffu, g = red_green >> 16;
      if (HAS(OUTPUT_LIGHT_PASSES)) {
        uint8 layer = photon_light_passes(b);
        b &= 0xffffu;
        uint8 direct = as_uint8(layer == LIGHT_PASS_DIRECT), caustic = as_uint8(layer == LIGHT_PASS_CAUSTIC);
        lanes->direct_red += r & direct;
        lanes->direct_green += g & direct;
        lanes->direct_blue += b & direct;
        lanes->caustic_red += r & caustic;
        lanes->caustic_green += g & caustic;
        lanes->caustic_blue += b & caustic;
      }
      if (HAS(EFFECTS_OF_MATERIALS(SCATTERS))) b &= 0xffffu;
      lanes->red += r;
      lanes->green += g;
      lanes->blue += b;
      lanes->near_red += r & near;
      lanes->near_green += g & near;
      lanes->near_blue += b & near;
      lanes->count += inside;
    }
  }
}

// The cubes that can hold a photon within `reach` of `centre` along each axis: the *first bucket, and how many there are,
// at most all of that axis. The interval is widened by the rounding of its ends. Six cubes at once take half the time of
// one at a time.
INLINE uint4 gather_window(Grid grid, real3 centre, real3 reach, uint4 *first) {
  real4 x = (real4)(centre, 0), wider = (real4)(reach * (real)1.000001, 0) + fabs(x) * (real)2.4e-7;
  real4 origin = convert_real4(grid.origin);
  int8 cubes = convert_int8(GRID_COORDINATE((real8)(x - wider, x + wider), (real8)(origin, origin), grid.origin.w));
  uint4 n = (uint4)(grid.nx, grid.ny, grid.nz, 1), low = as_uint4(cubes.lo), span = as_uint4(cubes.hi) - low;
  *first = low & (n - 1);  // as grid_wrap()
  return span >= n ? n : span + 1;
}

// Adds to `sum` what gather_range finds in every bucket that may hold a photon within `reach` of the point along each axis,
// once, or gather_range_medium where there is a `segment`, or gather_range_lobe where the point has a lobe: a window of at
// most n cubes along an axis of n buckets has no two in one bucket.
OUTLINE void gather_buckets(Grid grid, global const uint *starts, global const PhotonBlock *sorted, const GatherPoint *at,
                            real3 reach, const MediumSegment *segment, const NearWalls *walls, Gathered *sum) {
  const GatherPoint point = *at;
  GatherLanes lanes = gather_lanes_empty();
  uint4 first, number = gather_window(grid, point.position, reach, &first);
  // Buckets along x are neighbours in memory: a row is one range, or two where it wraps around.
  uint first_end = min(first.x + number.x, grid.nx), wrapped = first.x + number.x - first_end;
  for (uint k = 0; k < number.z; ++k) {
    uint kk = first.z + k >= grid.nz ? first.z + k - grid.nz : first.z + k;
    for (uint j = 0; j < number.y; ++j) {
      uint jj = first.y + j >= grid.ny ? first.y + j - grid.ny : first.y + j;
      global const uint *row = starts + grid.first_bucket + (kk * grid.ny + jj) * grid.nx;
      for (uint part = 0; part < (wrapped != 0 ? 2u : 1u); ++part) {
        uint begin = part == 0 ? row[first.x] : row[0], end = part == 0 ? row[first_end] : row[wrapped];
        if (HAS(EFFECT_MEDIUM) && segment)
          gather_range_medium(sorted, begin, end, segment, point.radius2, sum);
        else if (HAS(EFFECTS_OF_MATERIALS(SCATTERS)) && point.lobe)
          gather_range_lobe(sorted, begin, end, &point, walls, sum);
        else if (HAS(EFFECT_WALLS) && walls)
          gather_range(sorted, begin, end, &point, walls, &lanes, sum);
        else
          gather_range(sorted, begin, end, &point, 0, &lanes, sum);
      }
    }
  }
  gather_lanes_add(lanes, sum);
}

// Sums over all photons on surfaces within sqrt(radius2) of `point` that none of `walls` parts from it (null: there are
// none), and over those within half that radius: what the two say differently of the density is a measure of how much the
// larger one blurs. With a `lobe`, the sums are in units of 1 / LOBE_UNIT of those.
INLINE Gathered gather_beside(Grid grid, global const uint *starts, global const PhotonBlock *sorted, real3 point,
                              uint normal, real radius2, const NearWalls *walls, const VisibleLobe *lobe) {
  Gathered sum = gathered_none();
  real radius = sqrt(radius2);
  GatherPoint at = gather_point(point, normal, radius2);
  if (HAS(EFFECTS_OF_MATERIALS(SCATTERS))) at.lobe = lobe;
  gather_buckets(grid, starts, sorted, &at, (real3)(radius, radius, radius), 0, walls, &sum);
  return sum;
}

// The same whatever walls there are.
INLINE Gathered gather(Grid grid, global const uint *starts, global const PhotonBlock *sorted, real3 point,
                       uint normal, real radius2) {
  return gather_beside(grid, starts, sorted, point, normal, radius2, 0, 0);
}

// The same over all photons of the medium within sqrt(radius2) of the segment of length `length` that begins at
// `segment.begin`, as gather_range_medium weighs them. Goes along it in steps of two cubes, so that the boxes around them
// hold little else; a photon belongs to the step that it projects into.
INLINE Gathered gather_medium(Grid grid, global const uint *starts, global const PhotonBlock *sorted,
                              MediumSegment segment, real length, real radius2) {
  Gathered sum = gathered_none();
  real radius = sqrt(radius2), step = 2 / (real)grid.origin.w;
  uint steps = (uint)fmin(ceil(length / step), (real)MOST_SEGMENT_STEPS);
  step = length / fmax((real)steps, (real)1);
  for (uint i = 0; i < steps; ++i) {
    segment.from = i * step;
    segment.to = i + 1 == steps ? length : (i + 1) * step;
    GatherPoint at = gather_point(segment.begin + (segment.from + step / 2) * segment.direction, 0, radius2);
    gather_buckets(grid, starts, sorted, &at, fabs(segment.direction) * (step / 2) + radius, &segment, 0, &sum);
  }
  return sum;
}
