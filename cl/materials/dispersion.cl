// Dispersion: an index that depends on the wavelength, and paths that stand for one wavelength each.
//
// Each colour channel stands for a spectrum of its own (host/spectrum), and in one pass for one wavelength of it, the
// same for all paths. A path that meets dispersive glass goes on as one channel alone, drawn in proportion to what it
// carries and with the weight of all: on average every channel is kept as it is. Photons and camera paths draw
// independently, and channels are multiplied by channels; so where both met such glass, the product has the right
// average as well, and both were bent by the same wavelength.
#include "materials/bsdf.cl"

// Chooses the channel of `carried` (throughput or flux) that goes on, in proportion to what each carries: it carries all.
INLINE uint choose_channel(real random, real3 *throughput) {
  real sum = throughput->x + throughput->y + throughput->z, u = random * sum;
  // Rounding must not choose a channel that carries nothing: the last that carries something takes what is left.
  if (u < throughput->x || !(throughput->y + throughput->z > 0)) {
    *throughput = (real3)(sum, 0, 0);
    return 0;
  }
  if (u < throughput->x + throughput->y || !(throughput->z > 0)) {
    *throughput = (real3)(0, sum, 0);
    return 1;
  }
  *throughput = (real3)(0, 0, sum);
  return 2;
}

// Cauchy's index n = A + B / wavelength^2 at glass, of the one channel of `carried` that goes on.
INLINE void disperse(Bsdf *bsdf, global const Material *material, real3 inverse_wavelength2, real random,
                     real3 *throughput) {
  real b = material->absorption.w, sum = throughput->x + throughput->y + throughput->z;
  if (!bounds_body(bsdf->kind) || !(b > 0) || !(sum > 0)) return;
  uint channel = choose_channel(random, throughput);
  real3 w = inverse_wavelength2;
  bsdf->ior += b * (channel == 0 ? w.x : channel == 1 ? w.y : w.z);
  if (HAS(EFFECT_ROUGH)) bsdf->alpha = lobe_alpha(material->alpha, bsdf->ior);
}
