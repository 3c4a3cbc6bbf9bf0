// All lights: what arrives from them at a point, photons that leave them, and the density with which a ray is drawn that
// has met one. Each kind is a file and a row of LIGHT_TABLE; what is in none of its rows is an emissive surface.
#include "lights/all_lights.cl"

#define IS_LIGHT(emitter, NAME, effect) (HAS(effect) && (emitter)->type == LIGHT_##NAME)

// Whether the light is one of `lights`, as LIGHTS_WITH() gives them.
INLINE bool light_is(global const Emitter *emitter, uint lights) { return (lights >> emitter->type & 1u) != 0u; }

#define SAMPLE_DELTA(NAME, name, effect) \
  if (IS_LIGHT(emitter, NAME, effect)) return name##_sample(scene, emitter, position, random);
#define SAMPLE_BACKGROUND(NAME, name, effect) SAMPLE_DELTA(NAME, name, effect)
#define SAMPLE_SURFACE(NAME, name, effect) SAMPLE_DELTA(NAME, name, effect)
#define SAMPLE_EMISSIVE(NAME, name, effect)
#define SAMPLE_LIGHT(x, NAME, number, name, effect, family, ...) SAMPLE_##family(NAME, name, effect)

// light_sample() from the emitter that emitter_choose() finds by random.x and random.w.
INLINE LightSample light_sample_from(const Scene *scene, uint chosen, real3 position, real4 random) {
  global const Emitter *emitter = scene->emitters + chosen;
  LIGHT_TABLE(SAMPLE_LIGHT, )
  return area_light_sample(scene, emitter, position, random);
}

// Light that may reach `position` from one emitter, chosen by power. A sphere seen from outside is sampled in
// its cone of directions (Shirley, Wang, Zimmerman 1996), other surfaces by area.
static LightSample light_sample(const Scene *scene, real3 position, real4 random) {
  return light_sample_from(scene, emitter_choose(scene, random.x, random.w), position, random);
}

// Whether the material is that of a light of the family SURFACE, and which.
INLINE bool has_own_light(global const Material *material) {
  return HAS(EFFECTS_OF_LIGHTS(SURFACE)) && material->emission.w > 0;
}
INLINE global const Emitter *own_light(const Scene *scene, global const Material *material) {
  return scene->emitters + (scene->emitter_count - (uint)material->emission.w);
}

#define EMISSION_DELTA(NAME, name, effect)
#define EMISSION_BACKGROUND(NAME, name, effect)
#define EMISSION_SURFACE(NAME, name, effect) \
  if (IS_LIGHT(emitter, NAME, effect)) return name##_emission(scene, emitter, surface);
#define EMISSION_EMISSIVE(NAME, name, effect)
#define SURFACE_EMISSION(x, NAME, number, name, effect, family, ...) EMISSION_##family(NAME, name, effect)

// The radiance of the material's own light; `radiance` where it has none, or sends none that way.
INLINE real3 own_emission(const Scene *scene, global const Material *material, const Surface *surface, real3 radiance) {
  if (has_own_light(material) && max_component(radiance) > 0) {
    global const Emitter *emitter = own_light(scene, material);
    LIGHT_TABLE(SURFACE_EMISSION, )
  }
  return radiance;
}

// Radiance of the surface towards where `direction` came from.
INLINE real3 surface_emission(const Scene *scene, global const Material *material, const Surface *surface,
                              real3 direction) {
  real3 emission = emission_at(material, surface, direction);
  if (HAS(EFFECTS_OF_LIGHTS(SURFACE))) emission = own_emission(scene, material, surface, emission);
  return emission;
}

#define PDF_DELTA(NAME, name, effect)
#define PDF_BACKGROUND(NAME, name, effect)
#define PDF_SURFACE(NAME, name, effect) \
  if (IS_LIGHT(emitter, NAME, effect)) return name##_pdf(scene, emitter, direction, hit, surface);
#define PDF_EMISSIVE(NAME, name, effect)
#define SURFACE_PDF(x, NAME, number, name, effect, family, ...) PDF_##family(NAME, name, effect)

// The density per solid angle with which light_sample at `origin` draws the direction in which an emissive
// surface was hit: the other half of multiple importance sampling. Zero for an infinite plane, which
// light_sample never draws.
static real light_pdf(const Scene *scene, real3 origin, real3 direction, Hit hit, const Surface *surface,
                      global const Material *material) {
  if (has_own_light(material)) {
    global const Emitter *emitter = own_light(scene, material);
    LIGHT_TABLE(SURFACE_PDF, )
  }
  return area_light_pdf(scene, origin, direction, hit, surface, material);
}

#define RADIANCE_DELTA(NAME, name, effect)
#define RADIANCE_BACKGROUND(NAME, name, effect) \
  if (IS_LIGHT(emitter, NAME, effect)) return name##_radiance(scene, emitter, direction, pdf);
#define RADIANCE_SURFACE(NAME, name, effect)
#define RADIANCE_EMISSIVE(NAME, name, effect)
#define BACKGROUND_RADIANCE(x, NAME, number, name, effect, family, ...) RADIANCE_##family(NAME, name, effect)

// Radiance that a ray into the open finds along `direction`, and *pdf, the density per solid angle with which
// light_sample draws that direction. Zero in a scene without background, which is the last of the emitters.
INLINE real3 background_radiance(const Scene *scene, real3 direction, real *pdf) {
  *pdf = 0;
  if (scene->emitter_count == 0) return (real3)(0, 0, 0);
  global const Emitter *emitter = scene->emitters + scene->emitter_count - 1;
  LIGHT_TABLE(BACKGROUND_RADIANCE, )
  return (real3)(0, 0, 0);
}

// The emitter of a photon, chosen by power.
INLINE uint photon_emitter(const Scene *scene, RandomStream stream) {
  real4 choice = random4(stream, DIM_EMITTER);
  return emitter_choose(scene, choice.x, choice.w);
}

#define EMIT_DELTA(NAME, name, effect) \
  if (IS_LIGHT(emitter, NAME, effect)) return name##_emit(scene, emitter, choice, (real2)(u, v), flux);
#define EMIT_BACKGROUND(NAME, name, effect) EMIT_DELTA(NAME, name, effect)
#define EMIT_SURFACE(NAME, name, effect) EMIT_DELTA(NAME, name, effect)
#define EMIT_EMISSIVE(NAME, name, effect)
#define EMIT_LIGHT(x, NAME, number, name, effect, family, ...) EMIT_##family(NAME, name, effect)

// Starts a photon of an emitter, which `choice`, the numbers of DIM_EMITTER by which the emitter was chosen too, and u and
// v draw, uniform numbers. Returns its ray; *flux is relative to Params.photon_flux, its largest channel 1 on average: 1
// from triangles, spheres, disks, point and directional lights; about 1 from curves and the environment, whose points are
// not exactly in proportion to power; up to 2 from a spot.
INLINE Ray photon_emit_from(const Scene *scene, uint chosen, real4 choice, real u, real v, real3 *flux) {
  global const Emitter *emitter = scene->emitters + chosen;
  LIGHT_TABLE(EMIT_LIGHT, )
  return area_light_emit(scene, emitter, choice, u, v, flux);
}
