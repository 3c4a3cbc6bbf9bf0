// What a photon does at a surface or in the medium: the record that it deposits, and how it goes on or ends.
#include "materials/adjoint_bsdf.cl"
#include "lights/direct.cl"
#include "lights/horizon.cl"
#include "photons/grid.cl"
#include "photons/photon_stream.cl"
#include "paths/lambert_vertex.cl"

// Flux in stored units, dithered so that its expectation is exact; *saturated where it does not fit.
INLINE uint flux_quantise(real flux, real random, bool *saturated) {
  real units = flux * PHOTON_FLUX_UNIT + random;
  *saturated = *saturated || units >= 65536;
  return (uint)clamp(units, (real)0, (real)65535);
}

// The record of a photon, whose `flux` is relative to Params.photon_flux. Returns EVENT_* bits. Where shading normals, or
// what a diffuse surface reflects at grazing angles, have raised the flux above what a record holds, several alike share
// it: else the tail of their factor, which has no bound, would be missing.
INLINE uint photon_record(real3 position, uint normal, real3 flux, uint prefix, real4 dither, Photon *record) {
  bool saturated = false;
  uint more = 0;
  if (HAS(EFFECT_SMOOTH | EFFECTS_OF_MATERIALS(SCATTERS))) {
    more = (uint)fmin(max_component(flux) * (PHOTON_FLUX_UNIT / 65534), (real)EVENT_MOST_COPIES);
    flux = quotient3(flux, 1 + (real)more);
  }
  uint r = flux_quantise(flux.x, dither.x, &saturated), g = flux_quantise(flux.y, dither.y, &saturated),
       b = flux_quantise(flux.z, dither.z, &saturated);
  bool finite = isfinite(flux.x + flux.y + flux.z + position.x + position.y + position.z);
  record->position[0] = position.x, record->position[1] = position.y, record->position[2] = position.z;
  record->normal = normal;
  record->flux_rg = r | g << 16;
  record->flux_b = b;
  if (HAS(OUTPUT_LIGHT_PASSES)) record->flux_b |= prefix_light_pass(prefix) << PHOTON_LIGHT_PASS_SHIFT;
  return (finite ? EVENT_STORED : EVENT_NON_FINITE) | (saturated ? EVENT_SATURATED : 0u) | more << EVENT_COPIES_SHIFT;
}

// Whether the medium scatters or absorbs the photon before its hit; then *events tells what came of it.
INLINE bool photon_in_medium(const Scene *scene, const Params *params, RandomStream stream, uint bounce, Hit hit,
                             PhotonState *photon, Photon *record, uint *events) {
  bool shadow_rays = HAS(EFFECT_SHADOW_RAYS) && params->shadow_rays != 0;
  if (!medium_along(scene, photon->ray, hit, hit.primitive != HIT_NONE, photon->interior)) return false;
  real before = max_component(photon->flux), distance;
  if (!medium_flight(&scene->medium, hit.t, random_at(stream, bounce, DIM_MEDIUM).xy, &photon->flux, &distance))
    return false;
  photon->flux *= scene->medium.scattering;
  photon->ray.origin += distance * photon->ray.direction;
  *events = 0;
  if (!(shadow_rays && bounce == 0))
    *events = photon_record(photon->ray.origin, direction_pack(photon->ray.direction), photon->flux, photon->prefix,
                            random_at(stream, bounce, DIM_QUANTISE), record);
  real4 random = random_at(stream, bounce, DIM_BSDF);
  real survival = fmin(max_component(photon->flux) / before, (real)1);
  if (bounce + 1 == params->max_depth || random.w >= survival) return true;
  photon->flux /= survival;
  photon->ray.direction = phase_sample(scene->medium.g, photon->ray.direction, random.xy);
  photon->prefix = prefix_after(photon->prefix, false);
  photon->mark = INDIRECT_PHOTON;
  if (max_component(photon->flux) > 0) *events |= EVENT_ALIVE;
  return true;
}

// Puts the adjoint of what camera paths do in place of *next where the shading normal is not the geometric one.
INLINE void adjoint_where_bent(const PhotonState *photon, const Bsdf *bsdf, const Surface *surface, real3 direction,
                               real4 random, BsdfSample *next) {
  const bool lambert = photon->lambert;
  bool bent = has_bent_normal(surface);
  if (lambert || VECTORISED(EFFECTS_NOT_BATCHED(SCALAR_EVENTS))) {
    BsdfSample adjoint = lambert ? adjoint_diffuse_sample(bsdf, surface, direction, random)
                                 : adjoint_bsdf_sample_smooth(bsdf, surface, direction, random);
    next->direction = choose3(bent, adjoint.direction, next->direction);
    next->weight = choose3(bent, adjoint.weight, next->weight);
  } else if (bent) {
    *next = adjoint_bsdf_sample(bsdf, surface, direction, random);
  }
}

// The record of a photon of this flux that the surface keeps. Returns EVENT_* bits.
INLINE uint photon_deposit(const LitPoint *at, const PhotonState *photon, real3 flux, real4 dither, Photon *record) {
  const Surface *surface = at->surface;
  real3 deposited = scaled3(shading_normal_arrival(surface, at->wi), flux);
  if (is_layered(at->bsdf->kind)) deposited = scaled3(base_transmittance(at->bsdf, -dot3(at->wi, at->n)), deposited);
  real side = dot3(surface->geometric_normal, at->wi) < 0 ? 1 : -1;
  uint normal = normal_pack(scaled3(side, surface->geometric_normal)) | photon->mark;
  uint stored = photon_record(surface->position, normal, deposited, photon->prefix, dither, record);
  // Points of either law may lie around it. The low digits of a number are as good as another.
  if (HAS(EFFECTS_OF_MATERIALS(SCATTERS))) {
    real2 digits = (real2)(dither.w, dither.x * 4096);
    record->flux_b |= direction_pack_dithered(at->wi, digits - floor(digits)) << PHOTON_DIRECTION_SHIFT;
  }
  return stored;
}

// The Bsdf of the surface that a photon comes to; *events tells where its texture is no number.
INLINE Bsdf photon_bsdf(const Scene *scene, const PhotonState *photon, global const Material *material, real2 uv,
                        uint *events) {
  const bool in_batch = photon->lambert || VECTORISED(EFFECTS_NOT_BATCHED(SCALAR_EVENTS));
  Bsdf bsdf = photon->lambert ? lambert_untextured(material)
              : in_batch      ? bsdf_untextured(material)
                              : bsdf_at(material, scene->textures, scene->texels, uv);
  if (HAS(EFFECT_TEXTURES)) {
    if (in_batch) bsdf_texture_soa(material, scene->textures, scene->texels, uv, &bsdf);
    bool finite = isfinite(bsdf.color.x + bsdf.color.y + bsdf.color.z);
    *events |= finite ? 0u : EVENT_NON_FINITE;
    bsdf.color = choose3(finite, bsdf.color, (real3)(0, 0, 0));
  }
  return bsdf;
}

// Takes a photon from its hit number `bounce` to its next ray. Returns EVENT_* bits; what `photon` and
// `record` hold where these say that it ends, or leaves no record, is of no use. Without a medium only where
// something is hit.
INLINE uint photon_interact(const Scene *scene, const Params *params, RandomStream stream, uint bounce, Hit hit,
                         PhotonState *photon, Photon *record) {
  const bool lambert = photon->lambert;
  const bool in_batch = lambert || VECTORISED(EFFECTS_NOT_BATCHED(SCALAR_EVENTS)), on_body = nested(scene) && !lambert;
  bool shadow_rays = HAS(EFFECT_SHADOW_RAYS) && params->shadow_rays != 0;
  uint events = 0;
  if (HAS(EFFECT_MEDIUM) && photon_in_medium(scene, params, stream, bounce, hit, photon, record, &events))
    return events;
  if (HAS(EFFECT_MEDIUM) && hit.primitive == HIT_NONE) return events;
  real3 direction = photon->ray.direction;
  Surface surface;
  if (in_batch) geometry_surface_soa(&scene->geometry, photon->ray, hit, &surface);
  else geometry_surface(&scene->geometry, photon->ray, hit, &surface);
  Interface interface;
  if (on_body) {
    interface = media_arrive(scene, &photon->media, photon->ray, &hit, &surface, &photon->diagnostics);
    photon->interior = interior_of_stack(scene, &interface.before);
  }
  global const Material *material = scene->materials + surface.material;
  Bsdf bsdf = photon_bsdf(scene, photon, material, surface.uv, &events);
  if (on_body) {
    if (interface.crosses)
      media_bsdf(scene, &interface, &surface, direction, random_at(stream, bounce, DIM_CHANNEL).x, &bsdf, &photon->flux);
  } else if (!lambert && HAS(EFFECT_DISPERSION))
    disperse(&bsdf, material, scene->inverse_wavelength2, random_at(stream, bounce, DIM_CHANNEL).x, &photon->flux);
  real3 flux = photon->flux, n = facing_normal(&surface, direction);
  real4 random = random_at(stream, bounce, DIM_BSDF);
  real before = max_component(flux);
  if (!lambert && HAS(EFFECT_ABSORPTION | EFFECT_MEDIUM)) {
    if (!nested(scene)) photon->interior = interior_before(photon->interior, material, &surface, direction);
    flux *= interior_transmittance(photon->interior, hit.t);
  }

  bool layered = !lambert && is_layered(bsdf.kind), diffuse = is_diffuse(bsdf.kind);
  bool black = is_black(&bsdf, material);
  // With shadow rays the light that arrives straight from an emitter is counted there; so is that of sun and sky where far.
  bool counted = shadow_rays && bounce == 0, far = !lambert && is_far(&scene->geometry, hit, surface.position);
  if (far && bounce == 0) counted = counted || (photon->mark & FROM_BEYOND) != 0;
  if (HAS(EFFECT_HORIZON)) photon->mark &= ~FROM_BEYOND;
  bool deposits_here = keeps_photons(&bsdf, material);
  if (!HAS(EFFECT_GUIDED_PHOTONS)) deposits_here = deposits_here && !counted;
  if (deposits_here) {
    LitPoint at = {&bsdf, &surface, photon->interior, direction, n, false};
    uint stored = photon_deposit(&at, photon, flux, random_at(stream, bounce, DIM_QUANTISE), record);
    events |= counted ? EVENT_DEPOSITED_ELSEWHERE : stored;
  }
  bool alive = !(diffuse && black) && bounce + 1 != params->max_depth;
  if (!in_batch && !alive) return events;

  if (layered) choose_lobe(&bsdf, direction, n, random.z);
  photon->prefix = prefix_after(photon->prefix, bsdf_is_specular(&bsdf));
  photon->mark = is_diffuse(bsdf.kind) ? INDIRECT_PHOTON : photon->mark;
  BsdfSample next = lambert    ? diffuse_sample(&bsdf, &surface, direction, n, random)
                    : in_batch ? bsdf_sample_smooth(&bsdf, &surface, direction, n, random, false)
                               : bsdf_sample(&bsdf, &surface, direction, random, false);
  if (HAS(EFFECT_SMOOTH)) adjoint_where_bent(photon, &bsdf, &surface, direction, random, &next);
  if (far && is_diffuse(bsdf.kind))
    next = horizon_sample(&scene->geometry, &bsdf, &surface, direction, n, random);
  flux = mul3(flux, next.weight);
  // Absorption by Russian roulette: survivors keep the largest channel of the flux that they came with.
  // What a far surface has scattered may be more than was emitted, and is to become less.
  if (has_horizon(&scene->geometry)) before = fmin(before, (real)1);
  real survival = fmin(max_component(flux) / before, (real)1);
  flux = quotient3(flux, survival);
  alive = alive && random.w < survival && max_component(flux) > 0;
  if (!in_batch && !alive) return events;
  if (!lambert && HAS(EFFECT_ABSORPTION | EFFECT_MEDIUM))
    photon->interior = interior_after(photon->interior, material, &surface, next.direction);
  if (on_body) {
    photon->ray.origin = media_depart(scene, &interface, &surface, hit, direction, next.direction, &photon->media);
    photon->interior = interior_of_stack(scene, &photon->media.stack);
  } else {
    photon->ray.origin = offset_origin(surface.position, surface.error, surface.geometric_normal, next.direction);
  }
  photon->ray.direction = next.direction;
  photon->flux = flux;
  return events | (alive ? EVENT_ALIVE : 0u);
}
