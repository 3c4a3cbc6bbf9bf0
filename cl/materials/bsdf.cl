// How a surface scatters: Lambert, perfect mirror, dielectric and conductor, smooth or rough, coated diffuse.
// Here wi is the direction in which a path arrives and wo that in which it goes on, both along the path.
#include "shared/effects.h"
#include "materials/fresnel.cl"
#include "materials/microfacet.cl"
#include "shapes/ray.cl"
#include "materials/texture.cl"
#include "shared/types.h"
#include "sampling/warp.cl"

// A material at one point, textures resolved.
typedef struct {
  uint kind;  // MATERIAL_DIFFUSE ...
  real3 color;
  real ior;      // inside / outside
  real alpha;    // of a rough lobe; 0 for a perfectly specular one
  real3 eta, k;  // conductor: complex index inside / outside
  real inner;    // coated diffuse: diffuse reflectance of the boundary from inside
  bool coated;   // the Lambert lobe of coated diffuse, under its boundary
} Bsdf;

INLINE Bsdf bsdf_at(global const Material *material, global const Texture *textures, global const half *texels,
                    real2 uv) {
  global const float *color = (global const float *)&material->color;
  Bsdf bsdf = {material->kind, (real3)(color[0], color[1], color[2]), color[3], 0,
               (real3)(0, 0, 0), (real3)(0, 0, 0), 0, false};
  if (HAS(EFFECT_ROUGH)) bsdf.alpha = lobe_alpha(material->alpha, bsdf.kind == MATERIAL_GLASS ? bsdf.ior : 0);
  if (HAS(EFFECT_CONDUCTOR)) {
    bsdf.eta = convert_real3(material->eta.xyz);
    bsdf.k = convert_real3(material->k.xyz);
  }
  if (HAS(EFFECT_PLASTIC)) bsdf.inner = material->eta.w;
  if (HAS(EFFECT_TEXTURES) && material->color_texture != 0) {
    real4 texel = texture_lookup(textures + material->color_texture - 1, texels, uv);
    bsdf.color = texel.xyz;
    if ((material->flags & MATERIAL_ALPHA_DIFFUSE) && texel.w > 0) bsdf.kind = MATERIAL_DIFFUSE;
  }
  return bsdf;
}

// The shading normal on the side of the surface that `direction` arrives at. Where interpolation tilted it
// away from the ray altogether, the geometric normal takes its place.
INLINE real3 facing_normal(const Surface *surface, real3 direction) {
  real side = dot3(surface->geometric_normal, direction) < 0 ? 1 : -1;
  bool tilted = !(side * dot3(surface->shading_normal, direction) < 0);
  return scaled3(side, choose3(tilted, surface->geometric_normal, surface->shading_normal));
}

typedef struct {
  real3 direction;
  real3 weight;  // BSDF * cosine / pdf; zero ends the path
  real pdf;      // per solid angle; 0 for a perfectly specular lobe
} BsdfSample;

// Lambert: density cos / pi about the facing normal n.
INLINE BsdfSample diffuse_sample(const Bsdf *bsdf, const Surface *surface, real3 wi, real3 n, real4 random) {
  BsdfSample sample;
  sample.direction = hemisphere_cosine_by(random.x, random.y, n);
  sample.pdf = max(dot3(sample.direction, n), (real)0) * INV_PI;
  // A direction under the true surface, which only a shading normal can give, carries nothing.
  bool same_side = dot3(sample.direction, surface->geometric_normal) * dot3(wi, surface->geometric_normal) < 0;
  sample.weight = choose3(same_side, bsdf->color, (real3)(0, 0, 0));
  if (HAS(EFFECT_PLASTIC) && bsdf->coated)
    sample.weight *= fresnel_transmittance(dot3(sample.direction, n), bsdf->ior);
  return sample;
}

// A grazing ray is lifted by this cosine off the surface where rounding might put it on the other side.
#define GRAZING_COSINE ((real)1e-6 * (REAL_EPSILON / STORED_EPSILON))

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

// Whether light sampling can find the lobe, and its density weighs against that of lights.
INLINE bool bsdf_is_rough(const Bsdf *bsdf) {
  return HAS(EFFECT_ROUGH) && bsdf->kind != MATERIAL_DIFFUSE && bsdf->alpha > 0;
}

// Whether the path leaves in the one direction that goes with its arrival.
INLINE bool bsdf_is_specular(const Bsdf *bsdf) { return bsdf->kind != MATERIAL_DIFFUSE && !bsdf_is_rough(bsdf); }

// Photons are kept whatever the texel that they land on reflects: the points around it may reflect more. Only where all is
// black, as on most emitters, are they of no use.
INLINE bool is_black(const Bsdf *bsdf, global const Material *material) {
  return material->color_texture == 0 && !(max_component(bsdf->color) > 0);
}

// Whether photons that land there are stored.
INLINE bool keeps_photons(const Bsdf *bsdf, global const Material *material) {
  bool plastic = HAS(EFFECT_PLASTIC) && bsdf->kind == MATERIAL_PLASTIC;
  return (plastic || bsdf->kind == MATERIAL_DIFFUSE) && !is_black(bsdf, material);
}

// What the reflection of a conductor, mirror or coated diffuse is tinted by, where `cosine` is of incidence.
INLINE real3 specular_tint(const Bsdf *bsdf, real cosine) {
  if (HAS(EFFECT_CONDUCTOR) && bsdf->kind == MATERIAL_CONDUCTOR)
    return (real3)(fresnel_conductor(cosine, bsdf->eta.x, bsdf->k.x),
                   fresnel_conductor(cosine, bsdf->eta.y, bsdf->k.y),
                   fresnel_conductor(cosine, bsdf->eta.z, bsdf->k.z));
  if (HAS(EFFECT_PLASTIC) && bsdf->kind == MATERIAL_PLASTIC)
    return bsdf->color * (1 - fresnel_transmittance(cosine, bsdf->ior));
  return bsdf->color;
}

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
  if (HAS(EFFECT_GLASS) && bsdf->kind == MATERIAL_GLASS) {
    real reflectance = fresnel_dielectric(cosine, facing->eta, &cosine_t);
    sample.weight = bsdf->color * shadowing;
    if (wo.z > 0) {
      sample.pdf = reflectance * density * (real)0.25f;
    } else {
      sample.pdf = (1 - reflectance) * density * refraction_jacobian(cosine, cosine_t, facing->eta);
      if (radiance) sample.weight = sample.weight / (facing->eta * facing->eta);
    }
  } else if (wo.z > 0) {
    sample.weight = specular_tint(bsdf, cosine) * shadowing;
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
  bool refracts = HAS(EFFECT_GLASS) && bsdf->kind == MATERIAL_GLASS &&
                  random.z >= fresnel_dielectric(cosine, facing.eta, &cosine_t);
  real3 wo = normalize(refracts ? (cosine / facing.eta - cosine_t) * h - v / facing.eta : 2 * cosine * h - v);
  BsdfSample sample = rough_lobe(bsdf, &facing, wo, h, radiance);
  sample.direction = normalize(wo.x * facing.tangent + wo.y * facing.bitangent + wo.z * n);
  real3 g = surface->geometric_normal;
  bool reflected = dot3(sample.direction, g) * dot3(wi, g) < 0;
  if (refracts == wo.z > 0 || refracts == reflected) sample.weight = (real3)(0, 0, 0);
  return sample;
}

// Coated diffuse is a dielectric boundary over a Lambert base that sends light back and forth between them:
// its base reflects c T(in) T(out) / (pi eta^2 (1 - c inner)), T the boundary's transmittance (Ashikhmin &
// Shirley 2000, with the sum over inner reflections of Kubelka 1942). Makes the material one of its lobes,
// chosen by `random`, its weight divided by the probability.
INLINE void plastic_choose(Bsdf *bsdf, real3 wi, real3 n, real random) {
  real transmittance = fresnel_transmittance(-dot3(wi, n), bsdf->ior);
  real3 base = bsdf->color * transmittance / (bsdf->ior * bsdf->ior * (1 - bsdf->color * bsdf->inner));
  real reflectance = 1 - transmittance, sum = reflectance + max_component(base);
  real specular_pmf = sum > 0 ? reflectance / sum : 1;
  if (random < specular_pmf) {
    bsdf->color = (real3)(1, 1, 1) / specular_pmf;
  } else {
    bsdf->kind = MATERIAL_DIFFUSE;
    bsdf->coated = true;
    bsdf->color = base / (1 - specular_pmf);
  }
}

// What bsdf_sample() draws where every material is diffuse, a mirror or smooth glass. What the branches hand on are
// scalars: see vector.cl.
INLINE BsdfSample bsdf_sample_smooth(const Bsdf *bsdf, const Surface *surface, real3 direction, real3 n, real4 random,
                                     bool radiance) {
  BsdfSample sample = {direction, bsdf->color, 0};
  bool diffuse = bsdf->kind == MATERIAL_DIFFUSE;
  BsdfSample lambert = diffuse_sample(bsdf, surface, direction, n, random);
  real x = lambert.direction.x, y = lambert.direction.y, z = lambert.direction.z;
  if (HAS(EFFECT_MIRROR | EFFECT_GLASS) && !diffuse) {
    real3 wo = mirror_direction(surface, direction, n);
    x = wo.x, y = wo.y, z = wo.z;
  }
  if (HAS(EFFECT_GLASS)) {
    bool glass = bsdf->kind == MATERIAL_GLASS;
    BsdfSample through = glass_sample(bsdf, surface, direction, n, random, radiance);
    x = glass ? through.direction.x : x, y = glass ? through.direction.y : y, z = glass ? through.direction.z : z;
    sample.weight = choose3(glass, through.weight, sample.weight);
  }
  sample.direction = (real3)(x, y, z);
  sample.weight = choose3(diffuse, lambert.weight, sample.weight);
  sample.pdf = diffuse ? lambert.pdf : 0;
  return sample;
}

// Draws where a path that arrives along `direction` goes on. `radiance` is true on camera paths.
INLINE BsdfSample bsdf_sample(const Bsdf *bsdf, const Surface *surface, real3 direction, real4 random,
                              bool radiance) {
  real3 n = facing_normal(surface, direction);
  if (bsdf_is_rough(bsdf)) return rough_sample(bsdf, surface, direction, n, random, radiance);
  if (HAS(EFFECT_GLASS) && bsdf->kind == MATERIAL_GLASS)
    return glass_sample(bsdf, surface, direction, n, random, radiance);
  if (HAS(EFFECT_MIRROR) && bsdf->kind == MATERIAL_MIRROR) {
    BsdfSample sample = {mirror_direction(surface, direction, n), bsdf->color, 0};
    return sample;
  }
  if (HAS(EFFECT_CONDUCTOR | EFFECT_PLASTIC) && bsdf->kind != MATERIAL_DIFFUSE) {
    BsdfSample sample = {mirror_direction(surface, direction, n), specular_tint(bsdf, -dot3(direction, n)), 0};
    return sample;
  }
  return diffuse_sample(bsdf, surface, direction, n, random);
}

// Emitted radiance towards where `direction` came from.
INLINE real3 emission_at(global const Material *material, const Surface *surface, real3 direction) {
  global const float *emission = (global const float *)&material->emission;
  bool front = dot3(surface->geometric_normal, direction) < 0;
  bool emits = front || (material->flags & MATERIAL_TWO_SIDED) != 0;
  return choose3(emits, (real3)(emission[0], emission[1], emission[2]), (real3)(0, 0, 0));
}
