// A perfect mirror. Its way of reflecting is that of every smooth material of the family REFLECTS.
#include "materials/shading_frame.cl"

// A mirror image of d about n, and about the geometric normal where that one would end under the surface.
INLINE real3 mirror_direction(const Surface *surface, real3 d, real3 n) {
  real3 reflected = sub3(d, scaled3(2 * dot3(d, n), n));
  real3 g = surface->geometric_normal;
  real cosine = dot3(d, g), side = cosine < 0 ? 1 : -1;
  real x = reflected.x, y = reflected.y, z = reflected.z;
  if (!(side * dot3(reflected, g) >= GRAZING_COSINE)) {
    real3 lifted = add3(d, scaled3(side * 2 * fmax(fabs(cosine), GRAZING_COSINE), g));
    x = lifted.x, y = lifted.y, z = lifted.z;
  }
  return unit3((real3)(x, y, z));
}

// What reflection is multiplied by, where `cosine` is of incidence.
INLINE real3 mirror_tint(const Bsdf *bsdf, real cosine, bool refracts) { return bsdf->color; }

// The ways of a mirror: see SpecularWays.
INLINE SpecularWays mirror_ways(ShadingFrame f) {
  SpecularWays ways;
  bool agrees = f.cosine_s > 0 && f.cosine_g >= GRAZING_COSINE;
  real wo_g = 2 * f.cosine_s * f.between - f.cosine_g;
  ways.mirrored_s = agrees && wo_g >= GRAZING_COSINE ? wo_g / f.cosine_g : 0;
  // The path that Ng mirrors to the photon's direction has this cosine with Ns.
  real path_s = 2 * f.cosine_g * f.between - f.cosine_s;
  ways.mirrored_g = reflects_about_shading(f.cosine_g, path_s, f.between) ? 0 : 1;
  ways.tint_cosine_g = path_s > 0 ? path_s : f.cosine_g;
  ways.refracted_s = 0, ways.refracted_g = 0, ways.cosine_t_s = 0, ways.cosine_t_g = 0, ways.eta = 1;
  ways.through_cosine_g = f.cosine_g;
  return ways;
}
