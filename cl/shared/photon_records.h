// Visible points, photons and the grid that photons are sorted into. Part of types.h.
#pragma once

// The mark of visible points and photons that lie in the medium: a photon's `normal` holds a direction then
// (direction_pack).
#define IN_MEDIUM 0x80000000u
// The mark of visible points whose path was scattered before by other than a perfectly specular lobe: their `normal`.
#define BEYOND_DIFFUSE 0x40000000u
// The mark of photons that landed on a surface after another diffuse one, or the medium, had scattered them: their
// `normal`. Light that came so is smooth where caustics and the borders of shadows are sharp, and may be gathered within
// a larger radius (Jensen, "Global Illumination using Photon Maps", 1996, keeps two maps for the same reason).
#define INDIRECT_PHOTON 0x40000000u

// What the probe of kernel_area.cl tells, in VisiblePoint.normal: that there is one, whether it is of the disc of half
// the radius, and how much surface there is over its place, by area: 0 to 2, drawn so that its expectation is exact.
#define KERNEL_AREA_PROBED 0x08000000u
#define KERNEL_AREA_OF_HALF 0x04000000u
#define KERNEL_AREA_SHIFT 24u

// Where a camera path met a diffuse surface. `weight` is throughput * albedo / pi: times the flux density
// found around the point it is reflected radiance at the camera. A path that met none has weight 0. In the medium
// `position` is where a segment of the path begins, and `weight` what is carried there over the probability of an event
// within it (medium_segment): times the scattered flux around it per area, times the phase function and transmittance to
// its beginning, it is radiance at the camera.
typedef struct {
  real position[3];
  uint normal;         // normal_pack, facing the camera path, and KERNEL_AREA_*; in the medium, nothing but marks
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
} PrimaryHit;
CHECK_SIZE(PrimaryHit, 40);

// What of VisiblePoint.radiance belongs to each layer. With OUTPUT_LIGHT_PASSES those of all points of a launch follow the
// points in their buffer.
typedef struct {
  real radiance[LIGHT_PASS_COUNT][3];
} VisibleLightPasses;

// What leads from the beginning of a visible point's segment in the medium to its end. With EFFECT_MEDIUM those of all
// points of a launch follow the points and layers in their buffer.
typedef struct {
  real offset[3];
} VisibleSegment;

// What a diffuse surface that is not Lambert's weighs photons by: Bsdf and LitPoint of the visible point. With an effect of
// the family SCATTERS those of all points of a launch follow the points, layers and segments in their buffer.
typedef struct {
  real wi[3], normal[3], color[3];
  real own;
  uint kind;
} VisibleLobe;

// A photon that landed on a diffuse surface, or that the medium scatters, as traced. Flux is quantised with unbiased
// dithering in units of Params.photon_flux / PHOTON_FLUX_UNIT, so that sums of flux are exact integers in any order.
// Sixteen bits hold 16 times the flux of an emitted photon, which is as far as the factors of shading normals go: up to
// 4, 3 where dispersion or the medium made one channel of three, and 1.25 for photons that are aimed.
#define PHOTON_FLUX_UNIT 4096.0f
typedef struct {
  real position[3];
  uint normal;         // normal_pack, facing the side that the photon came from; in the medium, where it was going
  uint flux_rg;        // red in the low 16 bits, green in the high ones
  uint flux_b;         // in the low 16 bits; from bit PHOTON_LIGHT_PASS_SHIFT on, with OUTPUT_LIGHT_PASSES, the photon's layer;
                       // from PHOTON_DIRECTION_SHIFT on, with an effect of the family SCATTERS, where it was going
} Photon;

#define PHOTON_LIGHT_PASS_SHIFT 16u
#define PHOTON_DIRECTION_SHIFT 18u

// Eight photons as the gather takes them, eight at a time. In the sorted map photon i is lane i % 8 of block i / 8.
typedef struct {
  real position[3][8];
  uint normal[8];
  uint flux_rg[8];
  uint flux_b[8];
} PhotonBlock;

#ifdef CAUSTICL_DOUBLE
CHECK_SIZE(VisiblePoint, 80);
CHECK_SIZE(VisibleLightPasses, 72);
CHECK_SIZE(VisibleSegment, 24);
CHECK_SIZE(VisibleLobe, 88);
CHECK_SIZE(Photon, 40);
CHECK_SIZE(PhotonBlock, 288);
#else
CHECK_SIZE(VisiblePoint, 40);
CHECK_SIZE(VisibleLightPasses, 36);
CHECK_SIZE(VisibleSegment, 12);
CHECK_SIZE(VisibleLobe, 44);
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
