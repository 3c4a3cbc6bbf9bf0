// Where a ray's path crosses one span of a revolved curve's profile, by subdivision of pairs of arcs.
//
// Both the span and the path on one side of its closest approach to the axis are convex arcs whose position and
// direction are monotone, and so are their parts: the ends and end tangents of an arc bound it. A pair is done
// where the arcs are apart, where they lie on each other, or where no direction of the one is a direction of the
// other: then they cross at most once, and Newton's iteration finds where. Else the longer of the two is halved.
// (Fat lines and subdivision as in Sederberg & Nishita, "Curve intersection using Bezier clipping", CAD 22(9),
// 1990.)
#include "shapes/bezier_curve.cl"
#include "shapes/ray.cl"

// In unit space, whose coordinates are of order 1. The spans' coefficients are floats in every build, so that two
// spans meet only up to their rounding: these bounds stay the same in double, but for how far Newton's iteration goes.
#define BEZIER_TOLERANCE ((real)2.4e-7)           // arcs farther apart than this do not touch: rounding of a coordinate
#define BEZIER_COINCIDENT (2 * BEZIER_TOLERANCE)  // arcs nowhere farther apart than this do
#define BEZIER_ERROR (8 * BEZIER_TOLERANCE)       // offset of spawned rays, above both
#define BEZIER_OVERLAP (8 * BEZIER_TOLERANCE)     // arcs reach beyond their ends by this, so that joints do not leak
#define BEZIER_STRAIGHT (80 * BEZIER_TOLERANCE)   // transversal arcs as short as this are their chords

#define BEZIER_TRANSVERSAL ((real)1e-3)  // least angle between arcs for Newton's iteration
#define BEZIER_CONVERGED (sizeof(real) > sizeof(float) ? (real)4e-9 : (real)1e-4)  // its square is under rounding
#define BEZIER_LONGER ((real)4)          // an arc so many times longer than the other is halved alone
#define BEZIER_LEVELS 30u                // of halvings of one or both arcs; 32 fit into BezierPair
#define BEZIER_STEPS 1000u               // pairs of arcs looked at for one span

// The best hit so far; t is the bound to beat.
typedef struct {
  real t, w;
  bool unresolved;  // stands for arcs that were not told apart
} BezierHit;

INLINE void bezier_take(BezierHit *best, real t, real w, bool unresolved) {
  if (!(t > 0 && t < best->t)) return;
  best->t = t;
  best->w = w;
  best->unresolved = unresolved;
}

// A part of the profile or of the path: its parameters, points and directions at both ends. The directions have
// any length.
typedef struct {
  real begin, end;
  real2 p0, p1;
  real2 tangent0, tangent1;
} Arc;

INLINE Arc bezier_profile_arc(global const float *span, real w0, real w1) {
  real4 at0 = bezier_evaluate(span, w0), at1 = bezier_evaluate(span, w1);
  Arc arc = {w0, w1, at0.xy, at1.xy, bezier_tangent(span, w0, at0.zw), bezier_tangent(span, w1, at1.zw)};
  return arc;
}

// Path point (xy) and its derivative by t (zw) of a ray in unit space.
INLINE real4 bezier_path(Ray ray, real t) {
  real2 q = fma((real2)(t), ray.direction.xz, ray.origin.xz);
  real rho = sqrt(dot(q, q));
  real slope = rho > 0 ? dot(q, ray.direction.xz) / rho : length(ray.direction.xz);
  return (real4)(rho, fma(t, ray.direction.y, ray.origin.y), slope, ray.direction.y);
}

// `side` is -1 before and 1 after the closest approach to the axis.
INLINE Arc bezier_path_arc(Ray ray, real side, real t0, real t1) {
  real4 at0 = bezier_path(ray, t0), at1 = bezier_path(ray, t1);
  Arc arc = {t0, t1, at0.xy, at1.xy, (real2)(side * fabs(at0.z), at0.w), (real2)(side * fabs(at1.z), at1.w)};
  return arc;
}

INLINE bool arc_boxes_apart(Arc a, Arc b) {
  real2 low = fmin(a.p0, a.p1) - fmax(b.p0, b.p1), high = fmin(b.p0, b.p1) - fmax(a.p0, a.p1);
  return max(max(low.x, low.y), max(high.x, high.y)) > BEZIER_TOLERANCE;
}

// Length of the chord in the norm of sums.
INLINE real arc_extent(Arc arc) { return fabs(arc.p1.x - arc.p0.x) + fabs(arc.p1.y - arc.p0.y); }

// The least and largest sine of the angle from a direction of the profile to one of the path, up to a factor:
// all directions of an arc are between those of its ends.
INLINE real2 arc_angles(Arc profile, Arc path) {
  real size0 = 1 / (fabs(profile.tangent0.x) + fabs(profile.tangent0.y));
  real size1 = 1 / (fabs(profile.tangent1.x) + fabs(profile.tangent1.y));
  real2 at0 = (real2)(cross2(profile.tangent0, path.tangent0), cross2(profile.tangent0, path.tangent1)) * size0;
  real2 at1 = (real2)(cross2(profile.tangent1, path.tangent0), cross2(profile.tangent1, path.tangent1)) * size1;
  real2 least = fmin(at0, at1), most = fmax(at0, at1);
  return (real2)(min(least.x, least.y), max(most.x, most.y));
}

// Looks for the crossing of transversal arcs by Newton's iteration for both parameters from the crossing of
// their chords, and takes it if it is better. A limit inside is the only crossing there is; a limit outside says
// that there is none only where that stays true outside. True if the pair is done with.
INLINE bool arcs_cross(global const float *span, Ray ray, Arc profile, Arc path, real2 angles, BezierHit *best) {
  real least_angle = min(fabs(angles.x), fabs(angles.y)), largest_angle = max(fabs(angles.x), fabs(angles.y));
  real2 chord = profile.p1 - profile.p0, leg = path.p1 - path.p0, gap = path.p0 - profile.p0;
  real determinant = cross2(chord, leg);
  real fraction_w = cross2(gap, leg) / determinant, fraction_t = cross2(gap, chord) / determinant;
  real range_w = profile.end - profile.begin, range_t = path.end - path.begin;
  real w = profile.begin + range_w * clamp(fraction_w, (real)0, (real)1);
  real t = path.begin + range_t * clamp(fraction_t, (real)0, (real)1);
  real length = arc_extent(profile), leg_length = arc_extent(path);

  // How far along either arc the rounding of positions may move the crossing; an edge stays sharp. Arcs shorter
  // than that would be found coincident, so their own length is enough.
  real overlap = BEZIER_TOLERANCE / least_angle + BEZIER_OVERLAP, overlap_w = min(overlap, length);
  real overlap_low = fma(overlap_w, profile.begin > -1 ? (real)1 : (real)span[18], BEZIER_OVERLAP);
  real overlap_high = fma(overlap_w, profile.end < 1 ? (real)1 : (real)span[19], BEZIER_OVERLAP);

  if (length + leg_length < BEZIER_STRAIGHT) {
    if (fraction_w * length > -overlap_low && (fraction_w - 1) * length < overlap_high &&
        fabs(fraction_t - (real)0.5) * leg_length < (real)0.5 * leg_length + overlap)
      bezier_take(best, t, w, false);
    return true;
  }

  // Where the profile slows down and turns back, at a cusp, the iteration creeps or leaves: halve.
  real least_advance = (real)0.02 * dot(chord, chord) / range_w, reach_t = range_t + (real)1e-3;
  for (int i = 0; i < 8; ++i) {
    real4 c = bezier_evaluate(span, w), p = bezier_path(ray, t);
    real2 rest = p.xy - c.xy;
    real scale = 1 / cross2(c.zw, p.zw);
    real dw = cross2(rest, p.zw) * scale, dt = cross2(rest, c.zw) * scale;
    w += dw;
    t += dt;
    if (!(w > profile.begin - range_w && w < profile.end + range_w)) return false;
    if (!(t > path.begin - reach_t && t < path.end + reach_t)) return false;
    if (dot(c.zw, chord) < least_advance) return false;
    real speed = fabs(c.z) + fabs(c.w);
    // A short step is not enough: where the path turns close to the axis its curvature has no bound. Nor is a
    // small rest: where the directions agree, it says little of how far the crossing is.
    if (fabs(dw) * speed + fabs(dt) < BEZIER_CONVERGED && fabs(rest.x) + fabs(rest.y) < BEZIER_COINCIDENT) {
      if ((profile.begin - w) * speed <= overlap_low && (w - profile.end) * speed <= overlap_high &&
          t >= path.begin - overlap && t <= path.end + overlap)
        bezier_take(best, t, clamp(w, (real)-1, (real)1), false);
      bool within = w >= profile.begin && w <= profile.end && t >= path.begin && t <= path.end;
      // So steady that the arcs, made longer by half, stay transversal.
      return within || 2 * least_angle > largest_angle;
    }
  }
  return false;
}

// Compares the arcs' fat lines: the signed distances from the chord of the profile, of the profile's bulge and of
// the path. True if they are apart, or if the arcs are so close together that they count as touching, in the
// middle; so they do, `unresolved`, if this pair is the last resort.
INLINE bool arcs_apart_or_coincident(Arc profile, Arc path, bool last_resort, BezierHit *best) {
  real2 chord = profile.p1 - profile.p0;
  real inverse_length = rsqrt(max(dot(chord, chord), (real)1e-30));
  real2 along = chord * inverse_length, normal = (real2)(-along.y, along.x);
  real s0 = cross2(along, profile.tangent0), s1 = -cross2(along, profile.tangent1);
  real k0 = dot(along, profile.tangent0), k1 = dot(along, profile.tangent1);
  real slopes = fabs(s0) * k1 + fabs(s1) * k0;
  real bulge = slopes > 0 ? dot(chord, along) * s0 * fabs(s1) / slopes : (real)0;
  real d0 = dot(normal, path.p0 - profile.p0), d1 = dot(normal, path.p1 - profile.p0);
  real range_t = path.end - path.begin;
  real sag = -normal.x * fabs(path.tangent1.x - path.tangent0.x) * range_t * (real)0.25;  // rho(t) is convex
  real path_low = min(d0, d1) + min(sag, (real)0), path_high = max(d0, d1) + max(sag, (real)0);
  real profile_low = min(bulge, (real)0), profile_high = max(bulge, (real)0);
  bool apart = path_low > profile_high + BEZIER_TOLERANCE || path_high < profile_low - BEZIER_TOLERANCE;
  bool coincident = max(path_high, profile_high) - min(path_low, profile_low) < BEZIER_COINCIDENT;
  real fraction_t = (real)0.5;

  // An arc of the profile no longer than rounding has no direction: a point beside a straight path.
  if (dot(chord, along) < BEZIER_COINCIDENT && fabs(sag) < BEZIER_COINCIDENT) {
    real2 leg = path.p1 - path.p0, gap = profile.p0 - path.p0;
    real leg_length2 = max(dot(leg, leg), (real)1e-30);
    coincident = fabs(cross2(leg, gap)) < BEZIER_COINCIDENT * sqrt(leg_length2);
    apart = !coincident;
    fraction_t = clamp(dot(leg, gap) / leg_length2, (real)0, (real)1);
  }
  if (apart) return true;
  if (!coincident && !last_resort) return false;
  bezier_take(best, fma(range_t, fraction_t, path.begin), (profile.begin + profile.end) * (real)0.5, !coincident);
  return true;
}

// A pair of arcs in the tree of halves: cell i of 2^level equal cells of either parameter, and for each level of
// the tree, the deepest in the lowest two bits, which arcs were halved there: never none.
typedef struct {
  uint cell_t, level_t, cell_w, level_w;
  ulong halved;
} BezierPair;

#define BEZIER_HALVED_PROFILE 1u
#define BEZIER_HALVED_PATH 2u

INLINE void bezier_pair_halve(BezierPair *pair, uint halves) {
  uint profile = halves & 1u, path = halves >> 1;
  pair->level_w += profile;
  pair->cell_w <<= profile;
  pair->level_t += path;
  pair->cell_t <<= path;
  pair->halved = (pair->halved << 2) | halves;
}

// Goes on to the next pair that is no part of this one, in order of t. False if there is none.
INLINE bool bezier_pair_next(BezierPair *pair) {
  for (; pair->halved != 0; pair->halved >>= 2) {
    uint profile = (uint)pair->halved & 1u, path = (uint)(pair->halved >> 1) & 1u;
    pair->cell_w ^= profile;
    if (pair->cell_w & profile) return true;
    pair->cell_t ^= path;
    if (pair->cell_t & path) return true;
    pair->level_w -= profile;
    pair->cell_w >>= profile;
    pair->level_t -= path;
    pair->cell_t >>= path;
  }
  return false;
}

// Looks for a crossing of one span with the path over [t_first, t_last], which lies on one side (-1 before, 1
// after) of the closest approach to the axis, and takes the first one if it is better than `best`. Where the arcs
// cannot be told apart a hit is taken, since light must not leak; if they were not resolved, it is marked.
INLINE void bezier_span_intersect(global const float *span, Ray ray, real t_first, real t_last, real side,
                                  BezierHit *best) {
  BezierPair pair = {0, 0, 0, 0, 0};
  for (uint step = 0;; ++step) {
    real part_t = (t_last - t_first) / (real)(1u << pair.level_t), part_w = 2 / (real)(1u << pair.level_w);
    real t0 = fma((real)pair.cell_t, part_t, t_first);
    bool done = !(t0 < best->t);
    uint halves = 0;
    if (!done) {
      real w0 = fma((real)pair.cell_w, part_w, (real)-1);
      Arc profile = bezier_profile_arc(span, w0, fma((real)(pair.cell_w + 1u), part_w, (real)-1));
      Arc path = bezier_path_arc(ray, side, t0, fma((real)(pair.cell_t + 1u), part_t, t_first));
      done = arc_boxes_apart(profile, path);
      if (!done) {
        real2 angles = arc_angles(profile, path);
        if (angles.x > BEZIER_TRANSVERSAL || angles.y < -BEZIER_TRANSVERSAL)
          done = arcs_cross(span, ray, profile, path, angles, best);
        bool last_resort = pair.halved >> (2u * BEZIER_LEVELS - 2u) != 0 || step >= BEZIER_STEPS;
        done = done || arcs_apart_or_coincident(profile, path, last_resort, best);
        real length = arc_extent(profile), leg_length = arc_extent(path);
        halves = (BEZIER_LONGER * length > leg_length ? BEZIER_HALVED_PROFILE : 0u) |
                 (BEZIER_LONGER * leg_length > length ? BEZIER_HALVED_PATH : 0u);
      }
    }
    if (!done)
      bezier_pair_halve(&pair, halves);
    else if (!bezier_pair_next(&pair))
      return;
  }
}
