// The effects that a scene can call for: one table that the host and the kernels read.
//
// The host prepends EFFECTS, the bits to compile for, to every program as one #define. Kernels ask
// `if (HAS(EFFECT_GLASS))`, never #if, so that every branch is type-checked in every build and the compiler removes what
// the scene does not need.
#pragma once

#include "shared/lights.h"
#include "shared/materials.h"
#include "shared/passes.h"
#include "shared/shapes.h"

// Batched steps that cannot hold an effect, because it needs loops or arithmetic of whole vectors on the way. With such
// an effect the step runs photon by photon, or path by path: then branches save work that a batch would do for nothing.
#define BATCHED 0u
#define SCALAR_EMISSION 1u       // photons leave their emitter
#define SCALAR_EVENTS 2u         // photons meet any surface; those at Lambert surfaces of plain shapes are a batch even so
#define SCALAR_LIGHT_SAMPLES 4u  // camera paths draw a point of an emitter
#define SCALAR_HITS 8u           // rays meet every primitive of a small scene: brute_force.cl
#define SCALAR_LAMBERT 16u       // paths come to a Lambert surface of a plain shape: lambert_vertex.cl
#define SCALAR_LIGHTS (SCALAR_EMISSION | SCALAR_LIGHT_SAMPLES)
#define SCALAR_BODIES (SCALAR_EMISSION | SCALAR_EVENTS)
#define SCALAR_PATHS (SCALAR_EVENTS | SCALAR_LAMBERT)
#define SCALAR_SHAPE (SCALAR_LIGHTS | SCALAR_EVENTS | SCALAR_HITS)

// Where the primitives are that an effect stands for.
#define NO_GEOMETRY 0u
#define TRIANGLE_LEAVES 1u  // among the triangles of a leaf of the tree
#define SHAPE_LEAVES 2u     // among the shapes of a leaf
#define UNBOUNDED 4u        // beside the tree

// Columns: EFFECT_name is its bit; the number of that bit; the key, as --effects takes it and `explain` prints it; the
// programs of passes.h whose kernels ask for it with HAS() (the others are compiled without it, and are the same for every
// scene); the steps that cannot be batched with it; where its primitives are; its name in text.
// What in a scene calls for an effect: the function of its name in host/effects/effect_reasons.cpp.
// Those of shapes, lights and materials are in shapes.h, lights.h and materials.h. `ROW(x, ...)` is made of each row.
#define EFFECT_TABLE(ROW, x) \
  ROW(x, TRIANGLES,      0,  "triangles",      IN_PATHS,              BATCHED,                  TRIANGLE_LEAVES, "triangles") \
  SHAPE_EFFECTS(ROW, x) \
  ROW(x, TEXTURES,       5,  "textures",       IN_PATHS,              BATCHED,                  NO_GEOMETRY,     "textures") \
  ROW(x, LENS,           8,  "lens",           IN_CAMERA | IN_PATH,   BATCHED,                  NO_GEOMETRY,     "depth of field") \
  ROW(x, SHADOW_RAYS,    9,  "shadow_rays",    IN_CAMERA | IN_PHOTON, BATCHED,                  NO_GEOMETRY,     "direct light by shadow rays") \
  ROW(x, ROUGH,          10, "rough",          IN_PATHS,              SCALAR_EVENTS,            NO_GEOMETRY,     "rough lobes") \
  LIGHT_EFFECTS(ROW, x) \
  ROW(x, ABSORPTION,     15, "absorption",     IN_PATHS,              SCALAR_BODIES,            NO_GEOMETRY,     "absorption in glass") \
  ROW(x, DISPERSION,     16, "dispersion",     IN_PATHS,              SCALAR_EVENTS,            NO_GEOMETRY,     "dispersion") \
  ROW(x, MOTION,         17, "motion",         0u,                    BATCHED,                  NO_GEOMETRY,     "motion blur") \
  ROW(x, MEDIUM,         18, "medium",         IN_PATHS | IN_GATHER,  SCALAR_PATHS | SCALAR_EMISSION, NO_GEOMETRY,     "medium") \
  ROW(x, GUIDED_PHOTONS, 19, "guided_photons", IN_PHOTON,             BATCHED,                  NO_GEOMETRY,     "photons guided to what the camera sees") \
  ROW(x, AIMED_PHOTONS,  20, "aimed_photons",  IN_PHOTON,             BATCHED,                  NO_GEOMETRY,     "photons aimed at what focuses them") \
  ROW(x, SMOOTH,         21, "smooth",         IN_PATHS,              BATCHED,                  NO_GEOMETRY,     "shading normals") \
  ROW(x, SLIVERS,        22, "needles",        IN_PATHS,              BATCHED,                  NO_GEOMETRY,     "thin triangles") \
  ROW(x, NESTED,         23, "nested",         IN_PATHS,              SCALAR_BODIES,            NO_GEOMETRY,     "dielectrics that touch or hold something") \
  ROW(x, WALLS,          24, "walls",          IN_CAMERA | IN_GATHER, BATCHED,                  NO_GEOMETRY,     "walls between photons and visible points") \
  ROW(x, HORIZON,        25, "horizon",        IN_CAMERA | IN_PHOTON, SCALAR_EVENTS,            NO_GEOMETRY,     "light from beyond the scene on infinite planes") \
  MATERIAL_EFFECTS(ROW, x)

#ifdef __cplusplus
enum EffectBit : unsigned {
#else
enum EffectBit {
#endif
#define EFFECT_BIT(argument, name, bit, key, programs, scalar, geometry, text) EFFECT_##name = 1u << bit,
  EFFECT_TABLE(EFFECT_BIT, )
#undef EFFECT_BIT
};

// Sets of effects. Constants of the preprocessor, since #if decides whether a batched step is compiled.
#define EFFECT_IF_ANY(argument, name, bit, key, programs, scalar, geometry, text) | (1u << bit)
#define EFFECT_IF_SCALAR(wanted, name, bit, key, programs, scalar, geometry, text) \
  | (((scalar) & (wanted)) ? 1u << bit : 0u)
#define EFFECT_IF_GEOMETRY(wanted, name, bit, key, programs, scalar, geometry, text) \
  | (((geometry) & (wanted)) ? 1u << bit : 0u)

#define EFFECT_ALL (0u EFFECT_TABLE(EFFECT_IF_ANY, ))
#define EFFECTS_NOT_BATCHED(steps) (0u EFFECT_TABLE(EFFECT_IF_SCALAR, steps))
#define EFFECTS_IN_SHAPE_LEAVES (0u EFFECT_TABLE(EFFECT_IF_GEOMETRY, SHAPE_LEAVES))
#define EFFECTS_IN_LEAVES (0u EFFECT_TABLE(EFFECT_IF_GEOMETRY, SHAPE_LEAVES | TRIANGLE_LEAVES))
#define EFFECTS_OF_SHAPES (0u EFFECT_TABLE(EFFECT_IF_GEOMETRY, SHAPE_LEAVES | UNBOUNDED))

// Compiled in like an effect, but asked for by the user and by no scene: the layers of light_passes.cl beside the picture.
#define OUTPUT_LIGHT_PASSES (1u << 31)

#define HAS(effect) ((EFFECTS & (effect)) != 0u)
