// The homogeneous medium that fills the scene outside glass: how far light goes, and where it is scattered to.
#include "shared/effects.h"
#include "sampling/warp.cl"

typedef struct {
  real3 extinction;  // absorption + scattering, per unit length
  real3 scattering;
  real g;            // mean cosine of the phase function
} Medium;

// Fraction of light left after `distance` (Beer & Lambert). Where nothing absorbs all is, however far.
INLINE real3 transmittance(real3 extinction, real distance) {
  return exp(-extinction * fmin(distance, (real)FLT_MAX));
}

// Draws whether the medium interacts with a path before t_max, and then *distance, by the extinction of one channel,
// which is chosen in proportion to what the path carries. `carried` (throughput or flux) is multiplied by transmittance
// over the density of the distance (per unit length; times the medium's scattering it is what is scattered) or over
// the probability of none, either averaged over the choice of channel (the balance heuristic): the sum of its
// channels after scattering is never more than before.
INLINE bool medium_flight(const Medium *medium, real t_max, real2 random, real3 *throughput, real *distance) {
  real sum = throughput->x + throughput->y + throughput->z;
  if (!(sum > 0) || !(max_component(medium->extinction) > 0)) return false;
  real u = random.x * sum;
  real3 pmf = *throughput / sum;
  // Rounding must not choose a channel that carries nothing.
  bool first = u < throughput->x || !(throughput->y + throughput->z > 0);
  bool second = u < throughput->x + throughput->y || !(throughput->z > 0);
  real extinction = first ? medium->extinction.x : second ? medium->extinction.y : medium->extinction.z;
  *distance = extinction > 0 ? -log1p(-random.y) / extinction : (real)INFINITY;
  bool interacts = *distance < t_max;
  real3 left = transmittance(medium->extinction, interacts ? *distance : t_max);
  *throughput *= left / (interacts ? dot3(pmf, medium->extinction * left) : dot3(pmf, left));
  return interacts;
}

// Segments of this length are what a ray of a camera path is cut into, from its origin on: the one that holds `distance`,
// which medium_flight drew for a path that carried `carried`, begins at *begin and is *length long. Returns what the
// path carries to its beginning over the probability of any distance within it.
INLINE real3 medium_segment(const Medium *medium, real3 throughput, real t_max, real distance, real segment, real *begin,
                            real *length) {
  *begin = floor(distance / segment) * segment;
  *length = fmin(segment, t_max - *begin);
  real3 left = transmittance(medium->extinction, *begin);
  real probability = dot3(throughput, -left * expm1(-medium->extinction * *length)) / (throughput.x + throughput.y + throughput.z);
  return probability > 0 ? throughput * left / probability : (real3)(0, 0, 0);
}

// Henyey & Greenstein's phase function, per solid angle, for light that is turned by an angle with this cosine.
INLINE real phase_density(real g, real cosine) {
  // (1 - g)^2 + 2 g (1 - cosine), in which nothing cancels; for g < 0 its mirror image.
  real s = fabs(g), drop = 1 - (g < 0 ? -cosine : cosine);
  real square = (1 - s) * (1 - s) + 2 * s * fmax(drop, (real)0);
  return (1 - s) * (1 + s) / (4 * PI * square * sqrt(square));
}

// A direction with that density, for light that came along `direction`.
INLINE real3 phase_sample(real g, real3 direction, real2 u) {
  // 1 - cosine by inverting the distribution, in a form that neither cancels nor divides by g.
  real s = fabs(g), d = 1 - s + 2 * s * u.x;
  real drop = 2 * (1 - s) * (1 - s) * (1 - u.x) * (1 + s * u.x) / (d * d);
  real2 around = sqrt(fmax(drop * (2 - drop), (real)0)) * cos_sin_turn(u.y);
  real3 axis = g < 0 ? -direction : direction, tangent, bitangent;
  orthonormal_basis(axis, &tangent, &bitangent);
  return normalize(around.x * tangent + around.y * bitangent + (1 - drop) * axis);
}
