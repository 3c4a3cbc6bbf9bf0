// What a scene is made of on the device: camera, materials, geometry, tree and emitters. Part of types.h.
#pragma once

// The thin lens, one form for both cameras of the scene format. A ray through film position (u, v) in
// [0,1]^2, v from the bottom, has D = axis + right (u - 1/2) + up (v - 1/2).
typedef struct {
  float4 origin;      // xyz; w: plane_distance, where along D the ray starts
  float4 axis;        // unit viewing direction; w: focal_distance
  float4 right;       // full width of the film at distance 1; w: aperture, the lens radius
  float4 up;          // full height of the film at distance 1; w: 1 if the focus is a plane, 0 if a sphere
  float4 lens_right;  // unit axes of the lens disc
  float4 lens_up;
} Camera;
CHECK_SIZE(Camera, 96);

#define MATERIAL_TWO_SIDED 1u      // emits on both sides
#define MATERIAL_ALPHA_DIFFUSE 2u  // texels with alpha > 0 are diffuse, whatever `kind` says (base format)

typedef struct {
  float4 color;        // reflectance; w: index of refraction inside / outside
  float4 emission;     // emitted radiance; w: which emitter of the family SURFACE has it, counted from the last; 0 for none
  float4 eta, k;       // conductor: complex index inside / outside; plastic: eta.w, reflectance from inside; oren_nayar: eta.w, roughness
  float4 absorption;   // glass: per unit length inside; w: Cauchy's B in um^2 / index outside, 0 without dispersion
  uint kind;           // MATERIAL_DIFFUSE ...
  uint flags;          // MATERIAL_TWO_SIDED | MATERIAL_ALPHA_DIFFUSE
  uint color_texture;  // 1 + index into textures, 0 for none: then replaces `color`
  float alpha;         // GGX width of a rough lobe
} Material;
CHECK_SIZE(Material, 96);

#define TEXTURE_IMAGE 0u
#define TEXTURE_CHECKER 1u

typedef struct {
  float4 a, b;        // checker: the two colours
  float2 scale;       // multiplies (u, v) before the lookup
  uint kind;          // TEXTURE_IMAGE ...
  uint bilinear;      // 0 nearest, 1 bilinear
  uint first_texel;   // into the texel buffer: four halfs a texel, linear RGB and alpha, bottom row first
  uint width, height; // texels
  uint unused;
} Texture;
CHECK_SIZE(Texture, 64);

// What is not a triangle: see shapes.h.
typedef struct {
  float4 sphere;       // SHAPE_SPHERE: centre and radius
  float4 to_world[3];  // rows of the affine map from local space (disk: unit disc in z = 0)
  float4 to_local[3];  // rows of its inverse
  uint type;           // SHAPE_SPHERE ...
  uint material;
  uint curve;          // SHAPE_BEZIER: first float of its data in the curve buffer
  uint degree;         // SHAPE_BEZIER: degree of the curve
  uint area_table;     // emissive SHAPE_BEZIER: first of EMITTER_AREA_STEPS floats in the curve buffer
  float area;          // emissive shapes: world area
  float own[2];        // what the file of the shape keeps there
} Shape;
CHECK_SIZE(Shape, 144);

// A node of the wide KD-tree: the bounds of up to eight disjoint cells, by component, so that one test takes
// all eight. Rows 0 to 2 of `bounds` are the low planes in x, y, z and rows 3 to 5 the high ones; an unused
// child has low > high. The root of an empty tree has child[0] = 0.
typedef struct {
  float bounds[6][8];
  uint child[8];       // KD_LEAF | KD_SHAPES | index of the first block; else the index of a node
  ushort block_count[8];  // leaves: blocks, consecutive from the first
  uint parent;         // index of the node above; the root is node 0
  uint slot;           // which child of its parent the node is
  float extent;        // the longest edge of the bounds of the whole tree
  uint unused;
} KdNode;
CHECK_SIZE(KdNode, 256);

#define KD_LEAF 0x80000000u
#define KD_SHAPES 0x40000000u  // the leaf holds shapes beside triangles
#define KD_INDEX 0x3fffffffu
#define KD_LEVELS 16           // wide levels at most, so that a trail of 4 or 8 bits a level has a fixed size

// Eight primitives of a leaf. A lane with a triangle has position[vertex][axis][lane]; a lane with a shape has
// the low and high corner of its bounds in the place of vertices 0 and 1 and NaN in that of vertex 2; an empty
// lane has NaN throughout. NaN is never inside a triangle, so the triangle test needs no mask.
typedef struct {
  float position[3][3][8];
  uint primitive[8];  // index of the triangle; BLOCK_SHAPE | index into shapes; BLOCK_EMPTY
} TriangleBlock;
CHECK_SIZE(TriangleBlock, 320);

#define BLOCK_SHAPE 0x80000000u
#define BLOCK_EMPTY 0xffffffffu

// Primitives of a tree that brute_force.cl meets in place of walking it, at most: with more it gains little or loses. It
// tells them apart by 64 bits.
#define BRUTE_FORCE_PRIMITIVES 40u

// The maps of a block's triangles to (0, 0), (1, 0), (0, 1) in z = 0, for triangle_precomputed.cl: row i of a map is
// row[i][0] x + row[i][1] y + row[i][2], plus z for i = 2, where z is the coordinate along the axis in which the
// normal is largest and x and y are those that follow it. A lane without a triangle has NaN in its rows.
typedef struct {
  float row[3][3][8];
  float axis[8];  // 0, 1 or 2
} TriangleTransforms;
CHECK_SIZE(TriangleTransforms, 320);

// What shading needs of a triangle beside its positions.
typedef struct {
  float2 uv[3];    // of each corner
  uint normal[3];  // of each corner, octahedral, 16 bits each way
  uint material;   // index of the material | TRIANGLE_SMOOTH
} TriangleAttributes;
CHECK_SIZE(TriangleAttributes, 40);

#define TRIANGLE_SMOOTH 0x80000000u  // `normal` holds shading normals

// The squared sine of the angle at its first corner below which a triangle is a sliver (EFFECT_SLIVERS).
#define SLIVER_SINE2 0.01f

// Emitters that are surfaces. The numbers of the others are in lights.h.
#define EMITTER_TRIANGLE 0u
#define EMITTER_SPHERE 1u
#define EMITTER_DISK 2u
#define EMITTER_SHAPE 3u        // any shape that draws points on itself

// Steps in t of the table of cumulative area by which points on a revolved curve are drawn.
#define EMITTER_AREA_STEPS 64u

// Emitters are chosen by a number of this many bits, and own numbers in proportion to their power's largest
// channel: a running sum in single precision would give small ones a probability that is not what they draw.
#define EMITTER_CHOICE_BITS 47

// One light: radiance.w times the largest channel of `radiance` is its power over pi (of one side of a surface, where
// radiance.w is the area).
typedef struct {
  // triangle: vertex, two edges; sphere: centre and radius; disk: centre, two half axes; point: place; spot: place,
  // axis, (1 - cosine of the half angle of the cone, of its even part); directional: sphere around the scene, direction;
  // environment: sphere around the scene, (by how much of a turn the map is turned); those of the family SURFACE: corner,
  // two edges with width and height of the map
  float4 a, b, c;
  float4 radiance;    // point, spot: intensity; directional: irradiance; environment: integral over all directions;
                      // SURFACE: mean of the texels' largest channels, thrice
  ulong cdf;          // how many numbers this emitter and all before it own; the last one's are all
  float probability;  // the fraction of the numbers that it owns
  uint type;          // EMITTER_TRIANGLE ..., LIGHT_POINT ...
  uint two_sided;
  uint shape;         // EMITTER_SHAPE: index into shapes; LIGHT_ENVIRONMENT: width of the map; SURFACE: its first texel
  uint first_area;    // LIGHT_ENVIRONMENT: height
  uint in_dielectric; // 1 where a dielectric may hold or touch it (EFFECT_NESTED)
} Emitter;
CHECK_SIZE(Emitter, 96);

// A texel of an emitter's map, rows from the bottom to the top: of latitude and longitude for the environment, whose map is
// the first.
typedef struct {
  float radiance[3];
  float density;      // the fraction of the emitter's numbers that it owns, times the number of texels
  ulong cdf;          // how many of these numbers this texel and all before it own
} EnvironmentTexel;
CHECK_SIZE(EnvironmentTexel, 24);
