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

// The normals on the side that a photon comes from, and their cosines with the direction that it came from and with each
// other.
typedef struct {
  real3 geometric, shading;
  real cosine_g, cosine_s, between;
} ShadingFrame;

INLINE ShadingFrame shading_frame(const Surface *surface, real3 direction) {
  ShadingFrame frame;
  real side = dot3(surface->geometric_normal, direction) < 0 ? 1 : -1;
  frame.geometric = scaled3(side, surface->geometric_normal);
  frame.shading = scaled3(side, surface->shading_normal);
  frame.cosine_g = -dot3(direction, frame.geometric);
  frame.cosine_s = -dot3(direction, frame.shading);
  frame.between = dot3(frame.geometric, frame.shading);
  return frame;
}

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

// Whether mirror_direction() reflects about Ns a camera path whose cosines with Ng and Ns are these.
INLINE bool reflects_about_shading(real cosine_g, real cosine_s, real between) {
  return cosine_s > 0 && 2 * cosine_s * between - cosine_g >= GRAZING_COSINE;
}

// Whether refraction about Ns, to the cosine `cosine_t`, leaves a path on the side of Ng that it came from.
INLINE bool bends_back(real cosine_g, real cosine_s, real between, real eta, real cosine_t) {
  return !((cosine_s / eta - cosine_t) * between - cosine_g / eta <= -GRAZING_COSINE);
}

// The ways in which camera paths at a specular surface may come to a photon's direction, as what the photon has to carry
// on with each: by reflection and refraction about the normal of each kind.
typedef struct {
  real mirrored_s, mirrored_g, refracted_s, refracted_g;
  real cosine_t_s, cosine_t_g;  // of the refracted directions
  real tint_cosine_g;           // with which the path that is mirrored about Ng sees the surface
} SpecularWays;

// Those of a mirror.
INLINE SpecularWays mirror_ways(ShadingFrame f) {
  SpecularWays ways;
  bool agrees = f.cosine_s > 0 && f.cosine_g >= GRAZING_COSINE;
  real wo_g = 2 * f.cosine_s * f.between - f.cosine_g;
  ways.mirrored_s = agrees && wo_g >= GRAZING_COSINE ? wo_g / f.cosine_g : 0;
  // The path that Ng mirrors to the photon's direction has this cosine with Ns.
  real path_s = 2 * f.cosine_g * f.between - f.cosine_s;
  ways.mirrored_g = reflects_about_shading(f.cosine_g, path_s, f.between) ? 0 : 1;
  ways.tint_cosine_g = path_s > 0 ? path_s : f.cosine_g;
  ways.refracted_s = 0, ways.refracted_g = 0, ways.cosine_t_s = 0, ways.cosine_t_g = 0;
  return ways;
}

// Those of glass with the index `eta` beyond over that on the photon's side.
INLINE SpecularWays glass_ways(ShadingFrame f, real eta) {
  SpecularWays ways = mirror_ways(f);
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

// Takes a photon along one of the ways, chosen in proportion to what it has to carry on.
INLINE BsdfSample adjoint_specular_sample(const Bsdf *bsdf, const Surface *surface, real3 d, real4 random) {
  ShadingFrame f = shading_frame(surface, d);
  bool glass = HAS(EFFECT_GLASS) && bsdf->kind == MATERIAL_GLASS;
  real eta = dot3(surface->geometric_normal, d) < 0 ? bsdf->ior : 1 / bsdf->ior;
  SpecularWays ways = mirror_ways(f);
  if (HAS(EFFECT_GLASS)) {
    SpecularWays through = glass_ways(f, eta);
    ways.mirrored_s = glass ? through.mirrored_s : ways.mirrored_s;
    ways.mirrored_g = glass ? through.mirrored_g : ways.mirrored_g;
    ways.refracted_s = glass ? through.refracted_s : 0;
    ways.refracted_g = glass ? through.refracted_g : 0;
    ways.cosine_t_s = through.cosine_t_s, ways.cosine_t_g = through.cosine_t_g;
  }
  real mirrored = ways.mirrored_s + ways.mirrored_g, all = mirrored + ways.refracted_s + ways.refracted_g;
  // The boundary of coated diffuse has been chosen by random.z.
  real place = (glass ? random.z : random.x) * all;
  bool refracts = glass && place >= mirrored, about_s = refracts ? place < mirrored + ways.refracted_s : place < ways.mirrored_s;
  real cosine = about_s ? f.cosine_s : fmax(f.cosine_g, GRAZING_COSINE);
  real cosine_t = fmax(about_s ? ways.cosine_t_s : ways.cosine_t_g, GRAZING_COSINE);
  real3 normal = choose3(about_s, f.shading, f.geometric);
  real along = refracts ? cosine / eta - cosine_t : 2 * cosine;
  real3 wo = add3(choose3(refracts, quotient3(d, eta), d), scaled3(along, normal));
  real3 tint = bsdf->color;
  if (HAS(EFFECT_CONDUCTOR | EFFECT_PLASTIC)) tint = specular_tint(bsdf, about_s ? f.cosine_s : ways.tint_cosine_g);
  BsdfSample sample = {unit3(wo), scaled3(all, tint), 0};
  return sample;
}

// Lambert: about Ng, so that the cosine of departure cancels.
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
    // plastic_choose() let the photon in by its facing normal.
    real cosine_wo = tilted ? dot3(sample.direction, f.geometric) : wo_s;
    real let_in = fresnel_transmittance(f.cosine_s > 0 ? f.cosine_s : f.cosine_g, bsdf->ior);
    real lets_in = fresnel_transmittance(cosine, bsdf->ior);
    sample.weight *= fresnel_transmittance(cosine_wo, bsdf->ior) * (let_in > 0 ? lets_in / let_in : 0);
  }
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
  if (HAS(EFFECT_GLASS) && bsdf->kind == MATERIAL_GLASS && fresnel_dielectric(f.cosine_g, eta, &cosine_t) < 1)
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
  if (bsdf->kind == MATERIAL_DIFFUSE) return adjoint_diffuse_sample(bsdf, surface, direction, random);
  if (bsdf_is_rough(bsdf)) return adjoint_rough_sample(bsdf, surface, direction, random);
  return adjoint_specular_sample(bsdf, surface, direction, random);
}

// The same for loops over photons: see bsdf_sample_smooth().
INLINE BsdfSample adjoint_bsdf_sample_smooth(const Bsdf *bsdf, const Surface *surface, real3 direction, real4 random) {
  bool diffuse = bsdf->kind == MATERIAL_DIFFUSE;
  BsdfSample sample = adjoint_diffuse_sample(bsdf, surface, direction, random);
  if (!HAS(EFFECT_MIRROR | EFFECT_GLASS)) return sample;
  BsdfSample specular = adjoint_specular_sample(bsdf, surface, direction, random);
  sample.direction = choose3(diffuse, sample.direction, specular.direction);
  sample.weight = choose3(diffuse, sample.weight, specular.weight);
  sample.pdf = diffuse ? sample.pdf : 0;
  return sample;
}
