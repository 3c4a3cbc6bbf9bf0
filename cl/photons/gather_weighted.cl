// Photons that do not count alike: the sums, and how one photon at a time is weighed by its direction.
#include "film/light_passes.cl"
#include "materials/over_lambert.cl"
#include "media/medium.cl"
#include "photons/grid.cl"
#include "photons/visible_point.cl"
#include "photons/walls.cl"

typedef struct {
  ulong red, green, blue;  // in units of Params.photon_flux / PHOTON_FLUX_UNIT
  ulong near_red, near_green, near_blue;  // of those within sqrt(radius2) / 2
  ulong direct_red, direct_green, direct_blue;     // with OUTPUT_LIGHT_PASSES, of those that came straight from a light
  ulong caustic_red, caustic_green, caustic_blue;  // and by specular surfaces alone
  uint count;
} Gathered;

// Whether nothing stands above the blue flux of a photon.
#define FLUX_ALONE (!HAS(OUTPUT_LIGHT_PASSES | EFFECTS_OF_MATERIALS(SCATTERS)))

// LIGHT_PASS_* of a photon's word of blue flux; of eight words.
INLINE uint photon_light_pass(uint flux_b) {
  uint layer = flux_b >> PHOTON_LIGHT_PASS_SHIFT;
  return HAS(EFFECTS_OF_MATERIALS(SCATTERS)) ? layer & 3u : layer;
}
INLINE uint8 photon_light_passes(uint8 flux_b) {
  uint8 layer = flux_b >> PHOTON_LIGHT_PASS_SHIFT;
  return HAS(EFFECTS_OF_MATERIALS(SCATTERS)) ? layer & 3u : layer;
}

INLINE Gathered gathered_none(void) {
  Gathered sum = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  return sum;
}

// A point around which photons are gathered.
typedef struct {
  real3 position;
  uint normal;   // packed, of the side on which photons count
  real radius2;  // within which they do
  const VisibleLobe *lobe;  // with an effect of the family SCATTERS, what they are weighed by; null where all count alike
} GatherPoint;

INLINE GatherPoint gather_point(real3 position, uint normal, real radius2) {
  GatherPoint point;
  point.position = position;
  point.normal = normal;
  point.radius2 = radius2;
  if (HAS(EFFECTS_OF_MATERIALS(SCATTERS))) point.lobe = 0;
  return point;
}

// Adds photon `lane` of the block times `weight`, which is rounded down.
INLINE void gather_weighted(global const PhotonBlock *photons, uint lane, real3 weight, bool near, Gathered *sum) {
  uint red_green = photons->flux_rg[lane], b = photons->flux_b[lane];
  ulong red = (ulong)weight.x * (red_green & 0xffffu), green = (ulong)weight.y * (red_green >> 16);
  ulong blue = (ulong)weight.z * (FLUX_ALONE ? b : b & 0xffffu);
  sum->red += red;
  sum->green += green;
  sum->blue += blue;
  ++sum->count;
  if (HAS(OUTPUT_LIGHT_PASSES) && photon_light_pass(b) == LIGHT_PASS_DIRECT) {
    sum->direct_red += red;
    sum->direct_green += green;
    sum->direct_blue += blue;
  }
  if (HAS(OUTPUT_LIGHT_PASSES) && photon_light_pass(b) == LIGHT_PASS_CAUSTIC) {
    sum->caustic_red += red;
    sum->caustic_green += green;
    sum->caustic_blue += blue;
  }
  if (!near) return;
  sum->near_red += red;
  sum->near_green += green;
  sum->near_blue += blue;
}

// A piece of a camera ray in the medium: what lies between `from` and `to` of its beginning.
typedef struct {
  real3 begin, direction;
  real from, to;
  real3 extinction;  // per unit length
  real g;            // of the phase function
} MediumSegment;

// The phase function as a fraction of its peak is counted in so many parts, so that sums in the medium are exact.
#define PHASE_UNIT 16777216.0f

// A random number in [0, 1) that is the same wherever a photon of direction `packed` is met at distance `along`: by it
// weights are rounded, since far from the peak of the phase function they are a few parts or less.
INLINE real weight_dither(uint packed, real along) {
  uint hash = (packed ^ as_uint((float)along)) * 2654435769u;
  hash = (hash ^ (hash >> 15)) * 2246822519u;
  return (real)(hash >> 8) / 16777216;
}

// Adds photons begin to end - 1 of the map that lie within sqrt(radius2) of the line of `segment`, between its ends: each
// times the phase function for light that turns back along it and times transmittance to its beginning, in units of
// phase_density(g, +-1) / PHASE_UNIT. Those within half the radius are also summed alone. This is the estimate of a beam by
// points, with a blur in two dimensions (Jarosz, Nowrouzezahrai, Sadeghi, Jensen 2011, table 1).
INLINE void gather_range_medium(global const PhotonBlock *sorted, uint begin, uint end, const MediumSegment *segment,
                                real radius2, Gathered *sum) {
  real peak = phase_density(segment->g, segment->g < 0 ? -1 : 1);
  for (uint i = begin; i < end; ++i) {
    global const PhotonBlock *photons = sorted + i / 8;
    uint lane = i % 8, packed = photons->normal[lane];
    if (!(packed & IN_MEDIUM)) continue;
    real3 d = (real3)(photons->position[0][lane], photons->position[1][lane], photons->position[2][lane]) - segment->begin;
    real along = dot(d, segment->direction);
    d -= along * segment->direction;
    real distance2 = dot(d, d);
    if (!(distance2 <= radius2) || !(along >= segment->from) || !(along < segment->to)) continue;
    real phase = fmin(phase_density(segment->g, -dot(direction_unpack(packed), segment->direction)) / peak, (real)1);
    real3 weight = phase * transmittance(segment->extinction, along) * PHASE_UNIT + weight_dither(packed, along);
    gather_weighted(photons, lane, weight, distance2 <= radius2 / 4, sum);
  }
}

// The factor of a lobe is counted in so many parts, and bounded, which it is but where both directions graze.
#define LOBE_UNIT 1048576.0f
#define MOST_OVER_LAMBERT 1024.0f

// Adds photons begin to end - 1 of the map as gather_range() does, each times what its direction makes of a Lambert
// surface's BSDF, in units of 1 / LOBE_UNIT.
INLINE void gather_range_lobe(global const PhotonBlock *sorted, uint begin, uint end, const GatherPoint *point,
                              const NearWalls *walls, Gathered *sum) {
  const VisibleLobe *lobe = point->lobe;
  Bsdf bsdf;
  bsdf.kind = lobe->kind;
  bsdf.color = vload3(0, lobe->color);
  bsdf.own = lobe->own;
  real3 wo = -vload3(0, lobe->wi), n = vload3(0, lobe->normal);
  float3 side = normal_unpack(point->normal);
  for (uint i = begin; i < end; ++i) {
    global const PhotonBlock *photons = sorted + i / 8;
    uint lane = i % 8, packed = photons->normal[lane];
    if (HAS(EFFECT_MEDIUM) && (packed & IN_MEDIUM)) continue;
    real3 p = (real3)(photons->position[0][lane], photons->position[1][lane], photons->position[2][lane]);
    real3 d = p - point->position;
    real distance2 = dot(d, d);
    if (!(distance2 <= point->radius2) || !(dot(normal_unpack(packed), side) > GATHER_NORMAL_COSINE)) continue;
    if (HAS(EFFECT_WALLS) && walls && walls_between(walls, p, convert_real3(normal_unpack(packed)))) continue;
    uint direction = photons->flux_b[lane] >> PHOTON_DIRECTION_SHIFT;
    real3 over = over_lambert(&bsdf, direction_unpack_dithered(direction), wo, n);
    real3 weight = min(over, (real)MOST_OVER_LAMBERT) * LOBE_UNIT + weight_dither(direction ^ photons->flux_rg[lane], distance2);
    gather_weighted(photons, lane, weight, distance2 <= point->radius2 / 4, sum);
  }
}
