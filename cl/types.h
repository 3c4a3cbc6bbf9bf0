// Every struct that the host and the kernels share, compiled by C++20 and by OpenCL C alike.
//
// Only scalars, float2/float4 and uint2/uint4 appear here, and `real` in what passes hand on: float3, bool, size_t,
// pointers and enums have sizes that differ between the two languages. CHECK_SIZE stops either compiler when a layout drifts, and a
// test compares the offset of every field as the device sees it with offsetof on the host.
#ifndef CAUSTICL_TYPES_H
#define CAUSTICL_TYPES_H

#ifdef __OPENCL_VERSION__
#include "prelude.cl"
#define CHECK_SIZE(type, size) typedef char type##_has_size_##size[(sizeof(type) == (size)) ? 1 : -1]
#else
#include <cstdint>
namespace causticl {
using uint = std::uint32_t;
using ushort = std::uint16_t;
using ulong = std::uint64_t;
/// As in the float build, whose records the host knows; in the double build they take up to twice the bytes.
using real = float;
struct alignas(8) float2 {
  float x = 0, y = 0;
};
struct alignas(16) float4 {
  float x = 0, y = 0, z = 0, w = 0;
};
struct alignas(8) uint2 {
  uint x = 0, y = 0;
};
struct alignas(16) uint4 {
  uint x = 0, y = 0, z = 0, w = 0;
};
#define CHECK_SIZE(type, size) static_assert(sizeof(type) == (size), #type " must have the device's layout")
#endif

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

#define MATERIAL_DIFFUSE 0u
#define MATERIAL_MIRROR 1u
#define MATERIAL_GLASS 2u
#define MATERIAL_CONDUCTOR 3u
#define MATERIAL_PLASTIC 4u  // a dielectric boundary over a Lambert base

#define MATERIAL_TWO_SIDED 1u      // emits on both sides
#define MATERIAL_ALPHA_DIFFUSE 2u  // texels with alpha > 0 are diffuse, whatever `kind` says (base format)

typedef struct {
  float4 color;        // reflectance; w: index of refraction inside / outside
  float4 emission;     // emitted radiance
  float4 eta, k;       // conductor: complex index inside / outside; plastic: eta.w, reflectance from inside
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

// What is not a triangle. Rectangles and boxes become triangles on upload.
#define SHAPE_SPHERE 0u
#define SHAPE_PLANE 1u
#define SHAPE_DISK 2u
#define SHAPE_BEZIER 3u

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
  uint unused[2];
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

#define EMITTER_TRIANGLE 0u
#define EMITTER_SPHERE 1u
#define EMITTER_DISK 2u
#define EMITTER_BEZIER 3u
#define EMITTER_POINT 4u        // the first that is no surface
#define EMITTER_SPOT 5u
#define EMITTER_DIRECTIONAL 6u
#define EMITTER_ENVIRONMENT 7u  // the last emitter of a scene that has one

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
  // environment: sphere around the scene, (by how much of a turn the map is turned)
  float4 a, b, c;
  float4 radiance;    // point, spot: intensity; directional: irradiance; environment: integral over all directions
  ulong cdf;          // how many numbers this emitter and all before it own; the last one's are all
  float probability;  // the share of the numbers that it owns
  uint type;          // EMITTER_TRIANGLE ...
  uint two_sided;
  uint shape;         // EMITTER_BEZIER: index into shapes; EMITTER_ENVIRONMENT: width of the map
  uint first_area;    // EMITTER_BEZIER: first float of its area table in the curve buffer; EMITTER_ENVIRONMENT: height
  uint unused;
} Emitter;
CHECK_SIZE(Emitter, 96);

// A texel of the environment's map of latitude and longitude, rows from the bottom (straight down) to the top.
typedef struct {
  float radiance[3];
  float density;      // the share of the environment's numbers that it owns, times the number of texels
  ulong cdf;          // how many of these numbers this texel and all before it own
} EnvironmentTexel;
CHECK_SIZE(EnvironmentTexel, 24);

// Boxes of the photon grid along a camera ray's segment in the medium, at most.
#define MOST_SEGMENT_STEPS 1024u

// The points of every emitting surface are drawn with the same density per area and unit of radiance:
// largest channel of radiance * emitter_density (times two where both sides emit).
typedef struct {
  Camera camera;
  uint width, height;        // pixels of the picture
  uint first_pixel;          // the chunk that this launch works on: pixels [first_pixel, first_pixel +
  uint pixel_count;          //   pixel_count) in row order from the top left
  uint seed, pass;
  uint visible_points;       // per pixel per pass; a square number is stratified
  uint max_depth;            // longest path in scattering surface hits
  uint plane_count;          // infinite planes, the first of the shapes
  uint emitter_count;
  float emitter_density;     // pi / power of the largest channels of all emitters; 0 without emitters
  float photon_flux;         // flux of the largest channel of one emitted photon
  uint photon_count;         // emitted by this launch
  uint photon_capacity;      // stored at most
  float alpha;               // share of the new photons that the radius update keeps
  float radius2;             // squared radius of every pixel; 0: each pixel has its own (SppmPixel)
  float inverse_wavelength2[3];  // 1 / wavelength^2 in um^-2 that each channel stands for in this pass
  float segment;             // length of the pieces of camera rays in the medium around which photons are gathered:
                             // at most MOST_SEGMENT_STEPS times two cubes of the grid
  float4 extinction;         // of the medium, absorption + scattering per unit length; w: Henyey & Greenstein's g
  float4 scattering;         // of the medium, per unit length
  uint shadow_rays;          // sppm: 1 where direct light comes by shadow rays, 0 where photons carry it
  uint delta_lights;         // how many of the emitters are point, spot and directional lights
  uint first_photon;         // of those that this launch traces: photons [first_photon, first_photon + photon_count) of
                             //   the pass; several devices share them
  float indirect_radius;     // the radius within which indirect photons are gathered, over that of the others
  uint emission_met;         // 1 where a ray can meet emission: of a surface or from beyond the scene
  uint photon_role;          // PHOTONS_*
  uint photon_copies;        // of each seed
  uint coverage;             // 1 where visible points probe how much of their kernel lies on surfaces: see coverage.cl
} Params;
CHECK_SIZE(Params, 240);

// What SPPM keeps of a pixel between passes besides the film: its squared radius as an unevaluated sum
// hi + lo, the number of all photons found so far, as two halves, and how much of its kernel lies on surfaces. N of the
// paper is alpha times the photons.
typedef struct {
  float radius2_hi, radius2_lo;
  uint photons_low, photons_high;
  uint coverage;  // see coverage_mean.cl
} SppmPixel;
CHECK_SIZE(SppmPixel, 20);

// A pixel's sum of radiance estimates, one per pass, each channel as an unevaluated sum hi + lo, and what tells how
// far their mean may be off.
typedef struct {
  float sum[3];
  float low[3];
  uint left_out;  // estimates that were not finite: the mean is over the others
  float spread;   // sum of the squared deviations of the estimates' luminance from their mean
  float blur[2];  // what luminance owes to the photons' kernel, summed over passes of even and of odd number
  float alternating;  // sum of the estimates' luminance under changing signs: see sign_of_estimate of film.cl
} FilmPixel;
CHECK_SIZE(FilmPixel, 44);

// The layers of a picture, see layers.cl.
#define LAYER_DIRECT 0u
#define LAYER_CAUSTIC 1u
#define LAYER_INDIRECT 2u
#define LAYER_COUNT 3u

// A pixel's sums of what belongs to each layer, as FilmPixel has them of the whole. With OUTPUT_LAYERS those of all
// pixels follow the film in its buffer.
typedef struct {
  float sum[LAYER_COUNT][3];
  float low[LAYER_COUNT][3];
} FilmLayers;
CHECK_SIZE(FilmLayers, 72);

// How far a pixel's luminance may be off.
typedef struct {
  float luminance;     // the mean of its estimates
  float noise;         // standard deviation of that by the pixel's own passes: its course tells that of the picture's noise
  float pooled_noise;  // the same, such that it is right of this pixel: see pixel_error of pass_film.cl
  float bias;          // absolute
  float drawn;         // an error as noise makes it: half by how much one half of the passes is brighter than the other
} PixelError;
CHECK_SIZE(PixelError, 20);

// The mark of visible points and photons that lie in the medium: a photon's `normal` holds a direction then
// (direction_pack).
#define IN_MEDIUM 0x80000000u
// The mark of visible points whose path was scattered before by other than a perfectly specular lobe: their `normal`.
#define BEYOND_RECEIVER 0x40000000u
// The mark of photons that landed on a surface after another diffuse one, or the medium, had scattered them: their
// `normal`. Light that came so is smooth where caustics and the borders of shadows are sharp, and may be gathered within
// a larger radius (Jensen, "Global Illumination using Photon Maps", 1996, keeps two maps for the same reason).
#define INDIRECT_PHOTON 0x40000000u

// What the probe of coverage.cl tells, in VisiblePoint.normal: that there is one, whether it is of the disc of half
// the radius, and how much surface there is over its place, by area: 0 to 2, drawn so that its expectation is exact.
#define COVERAGE_PROBED 0x08000000u
#define COVERAGE_OF_HALF 0x04000000u
#define COVERAGE_SHIFT 24u

// Where a camera path met a diffuse surface. `weight` is throughput * albedo / pi: times the flux density
// found around the point it is reflected radiance at the camera. A path that met none has weight 0. In the medium
// `position` is where a segment of the path begins, and `weight` what is carried there over the probability of an event
// within it (medium_segment): times the scattered flux around it per area, times the phase function and transmittance to
// its beginning, it is radiance at the camera.
typedef struct {
  real position[3];
  uint normal;         // normal_pack, facing the camera path, and COVERAGE_*; in the medium, nothing but marks
  real weight[3];
  real radiance[3];    // emission seen by the path and direct light by shadow rays
} VisiblePoint;

// The ray with which a camera path begins, and what it meets first, as Hit of ray.cl has it. Of float alone. In SPPM it
// lies where the path will put its visible point.
typedef struct {
  float origin[3];
  float direction[3];
  float t, u, v;
  uint primitive;
} FirstHit;
CHECK_SIZE(FirstHit, 40);

// What of VisiblePoint.radiance belongs to each layer. With OUTPUT_LAYERS those of all points of a launch follow the
// points in their buffer.
typedef struct {
  real radiance[LAYER_COUNT][3];
} VisibleLayers;

// What leads from the beginning of a visible point's segment in the medium to its end. With EFFECT_MEDIUM those of all
// points of a launch follow the points and layers in their buffer.
typedef struct {
  real offset[3];
} VisibleSegment;

// A photon that landed on a diffuse surface, or that the medium scatters, as traced. Flux is quantised with unbiased
// dithering in units of Params.photon_flux / PHOTON_FLUX_UNIT, so that sums of flux are exact integers in any order.
// Sixteen bits hold 16 times the flux of an emitted photon, which is as far as the factors of shading normals go: up to
// 4, and 3 where dispersion or the medium made one channel of three.
#define PHOTON_FLUX_UNIT 4096.0f
typedef struct {
  real position[3];
  uint normal;         // normal_pack, facing the side that the photon came from; in the medium, where it was going
  uint flux_rg;        // red in the low 16 bits, green in the high ones
  uint flux_b;         // in the low 16 bits; from bit PHOTON_LAYER_SHIFT on, with OUTPUT_LAYERS, the photon's layer
} Photon;

#define PHOTON_LAYER_SHIFT 16u

// Eight photons as the gather takes them, eight at a time. In the sorted map photon i is lane i % 8 of block i / 8.
typedef struct {
  real position[3][8];
  uint normal[8];
  uint flux_rg[8];
  uint flux_b[8];
} PhotonBlock;

#ifdef CAUSTICL_DOUBLE
CHECK_SIZE(VisiblePoint, 80);
CHECK_SIZE(VisibleLayers, 72);
CHECK_SIZE(VisibleSegment, 24);
CHECK_SIZE(Photon, 40);
CHECK_SIZE(PhotonBlock, 288);
#else
CHECK_SIZE(VisiblePoint, 40);
CHECK_SIZE(VisibleLayers, 36);
CHECK_SIZE(VisibleSegment, 12);
CHECK_SIZE(Photon, 24);
CHECK_SIZE(PhotonBlock, 192);
#endif

// The grid of photons: space is cut into cubes of `cell` units; cube (i, j, k) owns bucket
// (i mod nx, j mod ny, k mod nz), where nx, ny and nz are powers of two. A box of at most n cubes along each axis
// meets each bucket once, so nothing is ever gathered twice, whatever the table's size.
typedef struct {
  float4 origin;       // of the cube (0, 0, 0); w: 1 / cell
  uint nx, ny, nz;
  uint first_bucket;   // of the table that both grids of a photon map share
} Grid;
CHECK_SIZE(Grid, 32);

// What the photons of a launch are: see guided_photons.cl.
#define PHOTONS_PLAIN 0u
#define PHOTONS_SCOUTS 1u
#define PHOTONS_COPIES 2u
#define PHOTONS_SEEDS 3u

// The kinds of photons that a map tells apart.
#define FOCUSED_PHOTONS 0u   // straight from a light or by specular surfaces and rough lobes alone; all in the medium
#define INDIRECT_PHOTONS 1u  // marked INDIRECT_PHOTON
#define PHOTON_KINDS 2u

// The grids of a photon map: each kind's own, or with separate = 0 that of FOCUSED_PHOTONS for all.
typedef struct {
  Grid grid[PHOTON_KINDS];
  uint present[PHOTON_KINDS];  // 0 where there is none of the kind
  uint separate;
  uint photon_count;   // of all kinds
} PhotonGrids;
CHECK_SIZE(PhotonGrids, 80);

// Items of a work-group, at most: kernels keep a number for each in local memory.
#define LARGEST_WORK_GROUP 256u

// Counts that kernels add to; each wraps at 2^32 and is read as differences.
typedef struct {
  uint photons;        // stored, or wanted where that is above Params.photon_capacity
  uint indirect;       // those of them that are marked INDIRECT_PHOTON
  uint seeds;          // scouts that landed where the camera sees
  uint rays;           // traced, shadow rays included
  uint non_finite;     // samples that were NaN or Inf and were left out
  uint saturated;      // photons whose flux, or samples whose sum, was above what the record holds
  uint unresolved;     // rays with a hit on a revolved curve whose root could not be told from its neighbours
  uint traversal_bound;  // rays whose walk through the tree was cut short
} Counters;
CHECK_SIZE(Counters, 32);

#ifndef __OPENCL_VERSION__
}  // namespace causticl
#endif
#endif
