// How a surface scatters: Lambert, perfect mirror, smooth dielectric.
#include "effects.h"
#include "ray.cl"
#include "texture.cl"
#include "types.h"
#include "warp.cl"

// A material at one point, textures resolved.
typedef struct {
  uint kind;  // MATERIAL_DIFFUSE ...
  real3 color;
  real ior;   // inside / outside
} Bsdf;

INLINE Bsdf bsdf_at(global const Material *material, global const Texture *textures, global const half *texels,
                    real2 uv) {
  Bsdf bsdf = {material->kind, convert_real3(material->color.xyz), material->color.w};
  if (HAS(EFFECT_TEXTURES) && material->color_texture != 0) {
    real4 texel = texture_lookup(textures + material->color_texture - 1, texels, uv);
    bsdf.color = texel.xyz;
    if ((material->flags & MATERIAL_ALPHA_DIFFUSE) && texel.w > 0) bsdf.kind = MATERIAL_DIFFUSE;
  }
  return bsdf;
}

// Reflectance of unpolarised light at a smooth boundary; `cosine` is that of the angle of incidence, eta the
// index beyond over the index before the boundary. Sets *cosine_t, that of the refracted angle; total
// reflection returns 1 and leaves it 0. (Born & Wolf, section 1.5.2)
INLINE real fresnel_dielectric(real cosine, real eta, real *cosine_t) {
  cosine = clamp(cosine, (real)0, (real)1);
  // eta^2 - sin^2 in a form that cancels nothing: grazing rays and nearly equal indices stay exact.
  real square = (eta - 1) * (eta + 1) + cosine * cosine;
  // Between equal indices nothing is reflected or bent, also at grazing incidence, where the square underflows.
  *cosine_t = eta == 1 ? cosine : 0;
  if (square <= 0) return eta == 1 ? 0 : 1;
  real c = sqrt(square) / eta;
  *cosine_t = fmin(c, (real)1);
  real parallel = (eta * cosine - c) / (eta * cosine + c);
  real perpendicular = (cosine - eta * c) / (cosine + eta * c);
  return (real)0.5 * (parallel * parallel + perpendicular * perpendicular);
}

// The shading normal on the side of the surface that `direction` arrives at. Where interpolation tilted it
// away from the ray altogether, the geometric normal takes its place.
INLINE real3 facing_normal(const Surface *surface, real3 direction) {
  bool front = dot(surface->geometric_normal, direction) < 0;
  real3 n = front ? surface->shading_normal : -surface->shading_normal;
  if (dot(n, direction) < 0) return n;
  return front ? surface->geometric_normal : -surface->geometric_normal;
}

typedef struct {
  real3 direction;
  real3 weight;  // BSDF * cosine / pdf; zero ends the path
  real pdf;      // per solid angle; 0 for a perfectly specular lobe
} BsdfSample;

// Lambert: density cos / pi about the facing normal n.
INLINE BsdfSample diffuse_sample(const Bsdf *bsdf, const Surface *surface, real3 arriving, real3 n, real4 random) {
  BsdfSample sample;
  sample.direction = hemisphere_cosine(random.xy, n);
  sample.pdf = max(dot(sample.direction, n), (real)0) * INV_PI;
  // A direction under the true surface, which only a shading normal can give, carries nothing.
  bool same_side = dot(sample.direction, surface->geometric_normal) * dot(arriving, surface->geometric_normal) < 0;
  sample.weight = same_side ? bsdf->color : (real3)(0, 0, 0);
  return sample;
}

// A grazing ray is lifted by this cosine off the surface where rounding might put it on the other side.
#define GRAZING_COSINE ((real)1e-6 * (REAL_EPSILON / STORED_EPSILON))

// A mirror image of d about n, and about the geometric normal where that one would end under the surface.
INLINE real3 mirror_direction(const Surface *surface, real3 d, real3 n) {
  real3 reflected = d - 2 * dot(d, n) * n;
  real3 g = surface->geometric_normal;
  real side = dot(d, g) < 0 ? 1 : -1;
  if (!(side * dot(reflected, g) >= GRAZING_COSINE))
    reflected = d + side * 2 * fmax(fabs(dot(d, g)), GRAZING_COSINE) * g;
  return normalize(reflected);
}

// Reflects or refracts with the Fresnel probability; `radiance` says what the path carries: refraction
// concentrates radiance by the squared index ratio, but leaves a photon's flux as it is (Veach 1997, 5.2).
INLINE BsdfSample glass_sample(const Bsdf *bsdf, const Surface *surface, real3 d, real3 n, real4 random,
                               bool radiance) {
  real3 g = surface->geometric_normal;
  bool entering = dot(g, d) < 0;
  real eta = entering ? bsdf->ior : 1 / bsdf->ior;
  real cosine = fmin(-dot(d, n), (real)1), cosine_t;
  real reflectance = fresnel_dielectric(cosine, eta, &cosine_t);
  BsdfSample sample = {d, bsdf->color, 0};
  if (random.z >= reflectance) {
    real3 refracted = d / eta + (cosine / eta - cosine_t) * n;
    // A refracted ray that a shading normal bends back over the surface is bent by the geometric one.
    real3 facing = entering ? g : -g;
    if (!(dot(refracted, facing) <= -GRAZING_COSINE)) {
      cosine = fmin(-dot(d, facing), (real)1);
      if (fresnel_dielectric(cosine, eta, &cosine_t) >= 1) {
        sample.direction = mirror_direction(surface, d, facing);
        return sample;
      }
      refracted = d / eta + (cosine / eta - fmax(cosine_t, GRAZING_COSINE)) * facing;
    }
    sample.direction = normalize(refracted);
    if (radiance) sample.weight = sample.weight / (eta * eta);
    return sample;
  }
  sample.direction = mirror_direction(surface, d, n);
  return sample;
}

// Draws where a path that arrives along `direction` goes on. `radiance` is true on camera paths.
INLINE BsdfSample bsdf_sample(const Bsdf *bsdf, const Surface *surface, real3 direction, real4 random,
                              bool radiance) {
  real3 n = facing_normal(surface, direction);
  if (HAS(EFFECT_GLASS) && bsdf->kind == MATERIAL_GLASS)
    return glass_sample(bsdf, surface, direction, n, random, radiance);
  if (HAS(EFFECT_MIRROR) && bsdf->kind == MATERIAL_MIRROR) {
    BsdfSample sample = {mirror_direction(surface, direction, n), bsdf->color, 0};
    return sample;
  }
  return diffuse_sample(bsdf, surface, direction, n, random);
}

// Camera paths of more hits than this may end by Russian roulette.
#define ROULETTE_DEPTH 5u

// Whether a camera path goes on after hit number `depth`; a survivor of Russian roulette carries what the others
// would have carried.
INLINE bool path_survives(real3 *throughput, uint depth, real random) {
  if (depth >= ROULETTE_DEPTH) {
    real survival = fmin(max_component(*throughput), (real)1);
    if (random >= survival) return false;
    *throughput /= survival;
  }
  return max_component(*throughput) > 0;
}

// What a photon's flux is multiplied by on arrival at a smooth-shaded surface: density estimation divides by
// geometric area, while the BSDF takes its cosine with the shading normal (Veach 1997, 5.3). Bounded, since
// the ratio has no bound at grazing incidence.
// Light from below the horizon of the shading normal is none, as for shadow rays.
INLINE real shading_normal_arrival(const Surface *surface, real3 direction) {
  real geometric = -dot(direction, surface->geometric_normal);
  real shading = -dot(direction, surface->shading_normal) * (geometric < 0 ? -1 : 1);
  return clamp(shading / fmax(fabs(geometric), (real)1e-6f), (real)0, (real)4);
}

// The same for departure of a photon in `direction` from a Lambert surface that was sampled about n.
INLINE real shading_normal_departure(const Surface *surface, real3 direction, real3 n) {
  real geometric = fabs(dot(direction, surface->geometric_normal));
  real shading = fabs(dot(direction, n));
  return fmin(geometric / fmax(shading, (real)1e-6f), (real)4);
}

// Emitted radiance towards where `direction` came from.
INLINE real3 emission_at(global const Material *material, const Surface *surface, real3 direction) {
  bool front = dot(surface->geometric_normal, direction) < 0;
  if (!front && !(material->flags & MATERIAL_TWO_SIDED)) return (real3)(0, 0, 0);
  return convert_real3(material->emission.xyz);
}
