// Rough lobes: reflection off, and refraction through, a surface of microfacets, tinted by the material.
#include "materials/glass.cl"
#include "materials/microfacet.cl"
#include "materials/tint.cl"

// Where a path that arrives from v (in the local frame of microfacet.cl) meets microfacets.
typedef struct {
  real3 tangent, bitangent, n;
  real3 v;
  real eta;  // index beyond / before
} Facing;

INLINE Facing facing_frame(const Bsdf *bsdf, const Surface *surface, real3 wi, real3 n) {
  Facing facing;
  orthonormal_basis(n, &facing.tangent, &facing.bitangent);
  facing.n = n;
  facing.v = -(real3)(dot3(wi, facing.tangent), dot3(wi, facing.bitangent), dot3(wi, n));
  facing.v.z = fmax(facing.v.z, GRAZING_COSINE);
  facing.eta = dot3(surface->geometric_normal, wi) < 0 ? bsdf->ior : 1 / bsdf->ior;
  return facing;
}

// Weight and density of the direction `wo` off microfacets with the normal h, both in the local frame.
INLINE BsdfSample rough_lobe(const Bsdf *bsdf, const Facing *facing, real3 wo, real3 h, bool radiance) {
  BsdfSample sample = {wo, (real3)(0, 0, 0), 0};
  real cosine = fmin(dot3(facing->v, h), (real)1), cosine_t;
  if (!(cosine > 0)) return sample;
  real density = ggx_visible_density(facing->v, h, bsdf->alpha);
  real shadowing = ggx_shadowing(facing->v, wo, bsdf->alpha);
  if (transmits(bsdf->kind)) {
    real reflectance = fresnel_dielectric(cosine, facing->eta, &cosine_t);
    sample.weight = bsdf->color * shadowing;
    if (wo.z > 0) {
      sample.pdf = reflectance * density * (real)0.25f;
    } else {
      sample.pdf = (1 - reflectance) * density * refraction_jacobian(cosine, cosine_t, facing->eta);
      if (radiance) sample.weight = sample.weight / (facing->eta * facing->eta);
    }
  } else if (wo.z > 0) {
    sample.weight = lobe_tint(bsdf, cosine, false) * shadowing;
    sample.pdf = density * (real)0.25f;
  }
  return sample;
}

// The lobe in a direction that light sampling chose: weight * pdf is BSDF * cosine, pdf that of bsdf_sample.
INLINE BsdfSample rough_evaluate(const Bsdf *bsdf, const Surface *surface, real3 wi, real3 n, real3 direction) {
  Facing facing = facing_frame(bsdf, surface, wi, n);
  real3 wo = (real3)(dot3(direction, facing.tangent), dot3(direction, facing.bitangent), dot3(direction, n));
  real3 h = microfacet_normal(facing.v, wo, facing.eta);
  // A shading normal may see a direction on the other side than the true surface does: nothing goes there. Nor does
  // a microfacet refract what would leave on the side that it came from (Walter et al. 2007, section 4.2).
  real3 g = surface->geometric_normal;
  bool reflected = dot3(direction, g) * dot3(wi, g) < 0;
  if (reflected != wo.z > 0 || (!reflected && !(dot3(wo, h) < 0))) {
    BsdfSample nothing = {direction, (real3)(0, 0, 0), 0};
    return nothing;
  }
  return rough_lobe(bsdf, &facing, wo, h, true);
}

// Reflects off or refracts through a visible microfacet. Paths that end under the surface, where light would
// scatter more than once, carry nothing.
INLINE BsdfSample rough_sample(const Bsdf *bsdf, const Surface *surface, real3 wi, real3 n, real4 random,
                               bool radiance) {
  Facing facing = facing_frame(bsdf, surface, wi, n);
  real3 v = facing.v, h = ggx_visible_normal(v, bsdf->alpha, random.xy);
  real cosine = fmin(dot3(v, h), (real)1), cosine_t;
  bool refracts = transmits(bsdf->kind) &&
                  random.z >= fresnel_dielectric(cosine, facing.eta, &cosine_t);
  real3 wo = normalize(refracts ? (cosine / facing.eta - cosine_t) * h - v / facing.eta : 2 * cosine * h - v);
  BsdfSample sample = rough_lobe(bsdf, &facing, wo, h, radiance);
  sample.direction = normalize(wo.x * facing.tangent + wo.y * facing.bitangent + wo.z * n);
  real3 g = surface->geometric_normal;
  bool reflected = dot3(sample.direction, g) * dot3(wi, g) < 0;
  if (refracts == wo.z > 0 || refracts == reflected) sample.weight = (real3)(0, 0, 0);
  return sample;
}
