// A pane of glass so thin that nothing is shifted: windows, bulbs, soap bubbles. Light goes to and fro between its two
// faces; what leaves it does so in the direction of a mirror or in that in which it came.
#include "materials/fresnel.cl"
#include "materials/mirror.cl"

// What the pane does with light, and the probability with which a path is reflected: in proportion to the sums of the
// channels.
typedef struct {
  real3 reflected, transmitted;
  real pmf;
} ThinGlass;

// All orders of reflection between the faces together. With the reflectance F of a face and the transmittance t of one way
// through the inside (Beer's law: color^(1 / cos theta_t)) the pane reflects and transmits
//   R = F + (1 - F)^2 F t^2 / (1 - F^2 t^2)      T = (1 - F)^2 t / (1 - F^2 t^2)
// (Stokes 1862, on piles of plates). Where a face reflects totally, so does the pane. `cosine` is of incidence.
INLINE ThinGlass thin_glass_at(const Bsdf *bsdf, real cosine) {
  ThinGlass pane = {(real3)(1, 1, 1), (real3)(0, 0, 0), 1};
  real cosine_t, f = fresnel_dielectric(fmin(cosine, (real)1), bsdf->ior, &cosine_t);
  if (!(f < 1)) return pane;
  real3 t = fmin(pow(bsdf->color, (real3)(1 / cosine_t)), (real3)(1, 1, 1));
  pane.transmitted = (1 - f) * (1 - f) * t / (1 - f * f * t * t);
  pane.reflected = f + f * t * pane.transmitted;
  real r = pane.reflected.x + pane.reflected.y + pane.reflected.z;
  real through = pane.transmitted.x + pane.transmitted.y + pane.transmitted.z;
  pane.pmf = through > 0 ? r / (r + through) : 1;
  return pane;
}

// What the lobe that was chosen is multiplied by; nothing where it is never chosen.
INLINE real3 thin_glass_weight(const ThinGlass *pane, bool refracts) {
  real pmf = refracts ? 1 - pane->pmf : pane->pmf;
  return pmf > 0 ? (refracts ? pane->transmitted : pane->reflected) / pmf : (real3)(0, 0, 0);
}

INLINE real3 thin_glass_tint(const Bsdf *bsdf, real cosine, bool refracts) {
  ThinGlass pane = thin_glass_at(bsdf, cosine);
  return thin_glass_weight(&pane, refracts);
}

INLINE real thin_glass_reflectance(const Bsdf *bsdf, const Surface *surface, real3 d, real3 n) {
  return thin_glass_at(bsdf, -dot3(d, n)).pmf;
}

INLINE BsdfSample thin_glass_sample(const Bsdf *bsdf, const Surface *surface, real3 d, real3 n, real4 random,
                                    bool radiance) {
  ThinGlass pane = thin_glass_at(bsdf, -dot3(d, n));
  bool refracts = random.z >= pane.pmf;
  BsdfSample sample = {refracts ? d : mirror_direction(surface, d, n), thin_glass_weight(&pane, refracts), 0};
  return sample;
}

// Those of a mirror, and straight on, by the normal that the camera path sees there.
INLINE SpecularWays thin_glass_ways(const Bsdf *bsdf, ShadingFrame f, real eta) {
  SpecularWays ways = mirror_ways(f);
  bool tilted = !(f.cosine_s > 0);
  real straight = 1 - thin_glass_at(bsdf, tilted ? f.cosine_g : f.cosine_s).pmf;
  ways.mirrored_s = f.cosine_s > 0 ? ways.mirrored_s * thin_glass_at(bsdf, f.cosine_s).pmf : 0;
  ways.mirrored_g *= thin_glass_at(bsdf, ways.tint_cosine_g).pmf;
  ways.refracted_s = tilted ? 0 : straight, ways.refracted_g = tilted ? straight : 0;
  ways.cosine_t_s = f.cosine_s, ways.cosine_t_g = f.cosine_g;
  return ways;
}
