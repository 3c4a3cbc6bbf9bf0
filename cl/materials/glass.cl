// A dielectric boundary, smooth. It shows what a material of the family TRANSMITS holds:
//   name_sample()       where a path goes on; random.z chooses between reflection and transmission
//   name_reflectance()  the probability with which that is reflection
//   name_tint()         what the one that was chosen is multiplied by
//   name_ways()         the same for photons: SpecularWays
#include "materials/fresnel.cl"
#include "materials/mirror.cl"

// Reflects or refracts with the Fresnel probability; `radiance` says what the path carries: refraction
// concentrates radiance by the squared index ratio, but leaves a photon's flux as it is (Veach 1997, 5.2).
INLINE BsdfSample glass_sample(const Bsdf *bsdf, const Surface *surface, real3 d, real3 n, real4 random,
                               bool radiance) {
  real3 g = surface->geometric_normal;
  bool entering = dot3(g, d) < 0;
  real eta = entering ? bsdf->ior : 1 / bsdf->ior;
  real cosine = fmin(-dot3(d, n), (real)1), cosine_t;
  bool refracts = random.z >= fresnel_dielectric(cosine, eta, &cosine_t);
  real3 slowed = quotient3(d, eta), refracted = add3(slowed, scaled3(cosine / eta - cosine_t, n));
  // A refracted ray that a shading normal bends back over the surface is bent by the geometric one.
  real3 facing = scaled3(entering ? 1 : -1, g);
  real x = refracted.x, y = refracted.y, z = refracted.z;
  bool bent_back = refracts && !(dot3(refracted, facing) <= -GRAZING_COSINE);
  if (bent_back) {
    cosine = fmin(-dot3(d, facing), (real)1);
    refracts = fresnel_dielectric(cosine, eta, &cosine_t) < 1;
    real3 again = add3(slowed, scaled3(cosine / eta - fmax(cosine_t, GRAZING_COSINE), facing));
    x = again.x, y = again.y, z = again.z;
  }
  real3 wo;
  if (refracts) {
    wo = unit3((real3)(x, y, z));
    x = wo.x, y = wo.y, z = wo.z;
  } else {
    wo = mirror_direction(surface, d, choose3(bent_back, facing, n));
    x = wo.x, y = wo.y, z = wo.z;
  }
  BsdfSample sample = {(real3)(x, y, z), bsdf->color, 0};
  if (radiance) sample.weight = quotient3(sample.weight, refracts ? eta * eta : 1);
  return sample;
}

// The probability with which glass_sample() reflects.
INLINE real glass_reflectance(const Bsdf *bsdf, const Surface *surface, real3 d, real3 n) {
  real eta = dot3(surface->geometric_normal, d) < 0 ? bsdf->ior : 1 / bsdf->ior, cosine_t;
  return fresnel_dielectric(fmin(-dot3(d, n), (real)1), eta, &cosine_t);
}

// Whether refraction about Ns, to the cosine `cosine_t`, leaves a path on the side of Ng that it came from.
INLINE bool bends_back(real cosine_g, real cosine_s, real between, real eta, real cosine_t) {
  return !((cosine_s / eta - cosine_t) * between - cosine_g / eta <= -GRAZING_COSINE);
}

INLINE real3 glass_tint(const Bsdf *bsdf, real cosine, bool refracts) { return bsdf->color; }

// The ways of glass. `eta` is the index beyond over that on the photon's side.
INLINE SpecularWays glass_ways(const Bsdf *bsdf, ShadingFrame f, real eta) {
  SpecularWays ways = mirror_ways(f);
  ways.eta = eta;
  real cosine_t, back_s, back_g;
  real reflectance_s = fresnel_dielectric(f.cosine_s, eta, &back_s);
  real reflectance_g = fresnel_dielectric(f.cosine_g, eta, &back_g);
  ways.cosine_t_s = back_s, ways.cosine_t_g = back_g;
  ways.mirrored_s *= reflectance_s;

  // Reflection about Ng: of paths that choose it, and of those that Ns bends back and Ng reflects totally.
  real path_s = 2 * f.cosine_g * f.between - f.cosine_s;
  real reflectance = fresnel_dielectric(ways.tint_cosine_g, eta, &cosine_t);
  bool total = path_s > 0 && reflectance_g >= 1 && bends_back(f.cosine_g, path_s, f.between, eta, cosine_t);
  ways.mirrored_g = ways.mirrored_g * reflectance + (total ? 1 - reflectance : 0);

  // Refraction about Ns: it squeezes solid angle by the cosines about Ns, projected area goes by those about Ng.
  real wo_g = f.cosine_g / eta - (f.cosine_s / eta - back_s) * f.between;
  bool through = f.cosine_s > 0 && f.cosine_g >= GRAZING_COSINE && reflectance_s < 1 && wo_g >= GRAZING_COSINE;
  real factor = f.cosine_s * wo_g / (fmax(back_s, GRAZING_COSINE) * fmax(f.cosine_g, GRAZING_COSINE));
  ways.refracted_s = through ? (1 - reflectance_s) * factor : 0;

  // Refraction about Ng: of paths from which Ns is tilted away, and of those that Ns would bend back.
  real other_s = f.cosine_s / eta - (f.cosine_g / eta - back_g) * f.between;
  real other = fresnel_dielectric(other_s > 0 ? other_s : back_g, 1 / eta, &cosine_t);
  bool bent = reflectance_g < 1 && (!(other_s > 0) || bends_back(back_g, other_s, f.between, 1 / eta, cosine_t));
  ways.refracted_g = bent ? 1 - other : 0;
  return ways;
}
