// The shapes: tables that the host and the kernels read. What the kernels know of one is in cl/shapes/primitives/NAME.cl,
// what the host knows in host/shapes/NAME.cpp.
#pragma once

// How points on a shape are drawn.
#define NO_POINTS 0u       // not at all: it has no area that could be chosen by
#define EMITTER_POINTS 1u  // by the batch of cl/lights/area_light.cl, which knows it by its EMITTER_NAME
#define OWN_POINTS 2u      // by its own file: name_draw_point(), name_unevenness(). Its emitters are EMITTER_SHAPE

// Shapes that are primitives of their own on the device.
// Columns: SHAPE_NAME is its number in records; that number; its enumerator, and its name in functions and files; its type
// in scene files; its effect; how points on it are drawn where it emits. `ROW(x, ...)` is made of each row.
#define SHAPE_TABLE(ROW, x) \
  ROW(x, SPHERE, 0, sphere, "sphere",        EFFECT_SPHERES, EMITTER_POINTS) \
  ROW(x, PLANE,  1, plane,  "plane",         EFFECT_PLANES,  NO_POINTS)      \
  ROW(x, DISK,   2, disk,   "disk",          EFFECT_DISKS,   EMITTER_POINTS) \
  ROW(x, BEZIER, 3, bezier, "bezier_rotate", EFFECT_BEZIER,  OWN_POINTS)     \
  ROW(x, CYLINDER, 4, cylinder, "cylinder",  EFFECT_CYLINDERS, OWN_POINTS)

// Their rows of EFFECT_TABLE: see effects.h for the columns.
#define SHAPE_EFFECTS(ROW, x) \
  ROW(x, SPHERES, 1, "spheres", IN_PATHS, BATCHED,                  SHAPE_LEAVES, "spheres") \
  ROW(x, PLANES,  2, "planes",  IN_PATHS, BATCHED,                  UNBOUNDED,    "infinite planes") \
  ROW(x, DISKS,   3, "disks",   IN_PATHS, BATCHED,                  SHAPE_LEAVES, "disks") \
  ROW(x, BEZIER,  4, "curves",  IN_PATHS, SCALAR_SHAPE,             SHAPE_LEAVES, "revolved curves") \
  ROW(x, CYLINDERS, 27, "cylinders", IN_PATHS, SCALAR_SHAPE,        SHAPE_LEAVES, "cylinders")

// Shapes that become triangles on upload: enumerator and name; type in scene files.
#define TRIANGLE_SHAPE_TABLE(ROW, x) \
  ROW(x, rectangle, "rectangle") \
  ROW(x, box,       "box")       \
  ROW(x, mesh,      "mesh")

#ifdef __cplusplus
enum ShapeType : unsigned {
#else
enum ShapeType {
#endif
#define SHAPE_NUMBER(x, NAME, number, ...) SHAPE_##NAME = number,
  SHAPE_TABLE(SHAPE_NUMBER, )
#undef SHAPE_NUMBER
};

// The effects of shapes whose points are drawn in that way.
#define SHAPE_EFFECT_IF(wanted, NAME, number, name, type, effect, points) | ((points) == (wanted) ? (effect) : 0u)
#define EFFECTS_OF_OWN_POINTS (0u SHAPE_TABLE(SHAPE_EFFECT_IF, OWN_POINTS))
