// How photons scatter where the shading normal Ns differs from the geometric normal Ng: by the adjoint of what camera
// paths do there.
//
// Camera paths define the picture. bsdf_sample() leads one that leaves the surface towards wo back to wi with some density
// K(wo -> wi), which is BSDF times cosine about the normal that it uses: Ns, or Ng where Ns is tilted away from the path or
// would lead it through the surface. A photon carries flux through the true surface, so that it must go from wi to wo with
// K(wo -> wi) |wo.Ng| / |wi.Ng| (Veach 1997, 5.3.2). Where both use Ns that is the photon's BSDF and cosine times
// |wi.Ns| |wo.Ng| / (|wi.Ng| |wo.Ns|); to what camera paths do about Ng photons do the same about Ng, without a factor.
// The factor has no bound: see photon_record().
#include "materials/bsdf.cl"

INLINE bool has_bent_normal(const Surface *surface) {
  real3 g = surface->geometric_normal, s = surface->shading_normal;
  return g.x != s.x || g.y != s.y || g.z != s.z;
}

// What the flux of a photon that lands is multiplied by: density estimation divides by geometric area, while the BSDF
// takes its cosine with the shading normal. Light from below the horizon of that is none, as for shadow rays.
INLINE real shading_normal_arrival(const Surface *surface, real3 direction) {
  if (!HAS(EFFECT_SMOOTH)) return 1;
  ShadingFrame frame = shading_frame(surface, direction);
  return fmax(frame.cosine_s, (real)0) / fmax(frame.cosine_g, (real)1e-6f);
}

#define WAYS_OF_LAMBERT(NAME, name, effect)
#define WAYS_OF_SCATTERS(NAME, name, effect)
#define WAYS_OF_REFLECTS(NAME, name, effect)
#define WAYS_OF_TRANSMITS(NAME, name, effect)                                      \
  if (HAS(effect)) {                                                               \
    bool chosen = bsdf->kind == MATERIAL_##NAME;                                   \
    SpecularWays own = name##_ways(bsdf, f, eta);                                  \
    ways.mirrored_s = chosen ? own.mirrored_s : ways.mirrored_s;                   \
    ways.mirrored_g = chosen ? own.mirrored_g : ways.mirrored_g;                   \
    ways.refracted_s = chosen ? own.refracted_s : ways.refracted_s;                \
    ways.refracted_g = chosen ? own.refracted_g : ways.refracted_g;                \
    ways.cosine_t_s = chosen ? own.cosine_t_s : ways.cosine_t_s;                   \
    ways.cosine_t_g = chosen ? own.cosine_t_g : ways.cosine_t_g;                   \
    ways.eta = chosen ? own.eta : ways.eta;                                        \
    ways.tint_cosine_g = chosen ? own.tint_cosine_g : ways.tint_cosine_g;          \
    ways.through_cosine_g = chosen ? own.through_cosine_g : ways.through_cosine_g; \
  }
#define WAYS_OF_ROW(x, NAME, number, name, effect, family, layers, fields, properties, ...) \
  WAYS_OF_##family(NAME, name, effect)

// Takes a photon along one of the ways, chosen in proportion to what it has to carry on.
INLINE BsdfSample adjoint_specular_sample(const Bsdf *bsdf, const Surface *surface, real3 d, real4 random) {
  ShadingFrame f = shading_frame(surface, d);
  bool through = transmits(bsdf->kind);
  real eta = dot3(surface->geometric_normal, d) < 0 ? bsdf->ior : 1 / bsdf->ior;
  SpecularWays ways = mirror_ways(f);
  MATERIAL_TABLE(WAYS_OF_ROW, )
  real mirrored = ways.mirrored_s + ways.mirrored_g, all = mirrored + ways.refracted_s + ways.refracted_g;
  // The boundary of coated diffuse has been chosen by random.z.
  real place = (through ? random.z : random.x) * all;
  bool refracts = through && place >= mirrored, about_s = refracts ? place < mirrored + ways.refracted_s : place < ways.mirrored_s;
  real cosine = about_s ? f.cosine_s : fmax(f.cosine_g, GRAZING_COSINE);
  real cosine_t = fmax(about_s ? ways.cosine_t_s : ways.cosine_t_g, GRAZING_COSINE);
  real3 normal = choose3(about_s, f.shading, f.geometric);
  real along = refracts ? cosine / ways.eta - cosine_t : 2 * cosine;
  real3 wo = add3(choose3(refracts, quotient3(d, ways.eta), d), scaled3(along, normal));
  real seen_g = refracts ? ways.through_cosine_g : ways.tint_cosine_g;
  real3 tint = lobe_tint(bsdf, about_s ? f.cosine_s : seen_g, refracts);
  BsdfSample sample = {unit3(wo), scaled3(all, tint), 0};
  return sample;
}

// Whether a camera path that leaves towards `direction` uses Ng since Ns is tilted away from it.
INLINE bool is_tilted_away(const Surface *surface, real3 direction) {
  return !(dot3(surface->geometric_normal, direction) * dot3(surface->shading_normal, direction) > 0);
}

// With which probability a photon is scattered about Ng, for the camera paths that Ns is tilted away from. Where the
// middle of the lobe goes there, half the time; else as often as a Lambert lobe goes there.
INLINE real scatter_about_geometric(const Bsdf *bsdf, const Surface *surface, ShadingFrame f, real3 d) {
  if (!(f.cosine_s > 0)) return 1;
  real cosine_t, eta = dot3(surface->geometric_normal, d) < 0 ? bsdf->ior : 1 / bsdf->ior;
  bool there = is_tilted_away(surface, add3(d, scaled3(2 * f.cosine_g, f.geometric)));
  if (transmits(bsdf->kind) && fresnel_dielectric(f.cosine_g, eta, &cosine_t) < 1)
    there = there || is_tilted_away(surface, add3(quotient3(d, eta), scaled3(f.cosine_g / eta - cosine_t, f.geometric)));
  return there ? (real)0.5f : (real)0.5f * (1 - f.between);
}

// A rough lobe: K is that about Ns for some camera paths and that about Ng for the others, of which the photon tries one.
INLINE BsdfSample adjoint_rough_sample(const Bsdf *bsdf, const Surface *surface, real3 d, real4 random) {
  ShadingFrame f = shading_frame(surface, d);
  real geometric = scatter_about_geometric(bsdf, surface, f, d);
  bool about_g = random.x < geometric;
  random.x = about_g ? random.x / geometric : (random.x - geometric) / (1 - geometric);
  real3 n = about_g ? f.geometric : f.shading;
  BsdfSample sample = rough_sample(bsdf, surface, d, n, random, false);
  if (is_tilted_away(surface, sample.direction) != about_g) sample.weight = (real3)(0, 0, 0);
  real wo_g = fabs(dot3(sample.direction, f.geometric)), wo_s = fabs(dot3(sample.direction, f.shading));
  real factor = f.cosine_s * wo_g / fmax(f.cosine_g * wo_s, (real)1e-12f);
  sample.weight *= about_g ? 1 / geometric : factor / (1 - geometric);
  return sample;
}

// Draws where a photon that arrives along `direction` goes on, with all factors.
INLINE BsdfSample adjoint_bsdf_sample(const Bsdf *bsdf, const Surface *surface, real3 direction, real4 random) {
  if (is_diffuse(bsdf->kind)) return adjoint_diffuse_sample(bsdf, surface, direction, random);
  if (bsdf_is_rough(bsdf)) return adjoint_rough_sample(bsdf, surface, direction, random);
  return adjoint_specular_sample(bsdf, surface, direction, random);
}

// The same for loops over photons: see bsdf_sample_smooth().
INLINE BsdfSample adjoint_bsdf_sample_smooth(const Bsdf *bsdf, const Surface *surface, real3 direction, real4 random) {
  bool diffuse = is_diffuse(bsdf->kind);
  BsdfSample sample = adjoint_diffuse_sample(bsdf, surface, direction, random);
  if (!HAS(EFFECTS_OF_MATERIALS(REFLECTS | TRANSMITS))) return sample;
  BsdfSample specular = adjoint_specular_sample(bsdf, surface, direction, random);
  sample.direction = choose3(diffuse, sample.direction, specular.direction);
  sample.weight = choose3(diffuse, sample.weight, specular.weight);
  sample.pdf = diffuse ? sample.pdf : 0;
  return sample;
}
