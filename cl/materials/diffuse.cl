// Diffuse surfaces: Lambert's, bare or as the base of coated diffuse, and those of over_lambert.cl, sampled alike.
#include "materials/fresnel.cl"
#include "materials/over_lambert.cl"
#include "materials/shading_frame.cl"
#include "sampling/warp.cl"

// Density cos / pi about the facing normal n.
INLINE BsdfSample diffuse_sample(const Bsdf *bsdf, const Surface *surface, real3 wi, real3 n, real4 random) {
  BsdfSample sample;
  sample.direction = hemisphere_cosine_by(random.x, random.y, n);
  sample.pdf = max(dot3(sample.direction, n), (real)0) * INV_PI;
  // A direction under the true surface, which only a shading normal can give, carries nothing.
  bool same_side = dot3(sample.direction, surface->geometric_normal) * dot3(wi, surface->geometric_normal) < 0;
  sample.weight = choose3(same_side, bsdf->color, (real3)(0, 0, 0));
  if (HAS(EFFECT_PLASTIC) && bsdf->coated)
    sample.weight *= fresnel_transmittance(dot3(sample.direction, n), bsdf->ior);
  if (HAS(EFFECTS_OF_MATERIALS(SCATTERS))) sample.weight *= over_lambert(bsdf, wi, sample.direction, n);
  return sample;
}

// About Ng, so that the cosine of departure cancels.
INLINE BsdfSample adjoint_diffuse_sample(const Bsdf *bsdf, const Surface *surface, real3 d, real4 random) {
  ShadingFrame f = shading_frame(surface, d);
  BsdfSample sample;
  sample.direction = hemisphere_cosine_by(random.x, random.y, f.geometric);
  sample.pdf = max(dot3(sample.direction, f.geometric), (real)0) * INV_PI;
  // Camera paths that Ns is tilted away from see a surface with the normal Ng.
  real wo_s = dot3(sample.direction, f.shading);
  bool tilted = !(wo_s > 0);
  real cosine = tilted ? f.cosine_g : fmax(f.cosine_s, (real)0);
  sample.weight = scaled3(cosine / fmax(f.cosine_g, GRAZING_COSINE), bsdf->color);
  if (HAS(EFFECT_PLASTIC) && bsdf->coated) {
    // plastic_choose_lobe() let the photon in by its facing normal.
    real cosine_wo = tilted ? dot3(sample.direction, f.geometric) : wo_s;
    real let_in = fresnel_transmittance(f.cosine_s > 0 ? f.cosine_s : f.cosine_g, bsdf->ior);
    real lets_in = fresnel_transmittance(cosine, bsdf->ior);
    sample.weight *= fresnel_transmittance(cosine_wo, bsdf->ior) * (let_in > 0 ? lets_in / let_in : 0);
  }
  if (HAS(EFFECTS_OF_MATERIALS(SCATTERS)))
    sample.weight *= over_lambert(bsdf, d, sample.direction, choose3(tilted, f.geometric, f.shading));
  return sample;
}
