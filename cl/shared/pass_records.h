// What the host tells the kernels of a pass, and what these count. Part of types.h.
#pragma once

// What the photons of a launch are: see projection_map.cl for those before the first pass, and metropolis_photons.cl for those
// from PHOTONS_PILOT_PATHS on.
#define PHOTONS_PLAIN 0u
#define PHOTONS_FOR_PROJECTION_MAP 1u
#define PHOTONS_PILOT_PATHS 2u
#define PHOTONS_MUTATED_PATHS 3u
#define PHOTONS_CURRENT_PATHS 4u
#define PHOTONS_TO_LEARN_BY 5u  // pilot paths of emission_map.cl, which leave nothing but the list of seeds

// Cells along each side of the square of numbers by which photons leave an emitter, and such squares at most: emitters
// beyond share one with others.
#define PROJECTION_SIDE 32u
#define PROJECTION_CELLS (PROJECTION_SIDE * PROJECTION_SIDE)
#define PROJECTION_SQUARES 16u

// Boxes of the photon grid along a camera ray's segment in the medium, at most.
#define MOST_SEGMENT_STEPS 1024u

// The points of every emitting surface are drawn with the same density per area and unit of radiance:
// largest channel of radiance * emitter_density (times two where both sides emit).
typedef struct {
  Camera camera;
  uint width, height;        // pixels of the picture
  uint first_pixel;          // the chunk that this launch works on: of the film, pixels [first_pixel, first_pixel +
  uint pixel_count;          //   pixel_count) in row order from the top left
  uint seed, pass;
  uint visible_points;       // per pixel per pass
  uint max_depth;            // longest path in scattering surface hits
  uint plane_count;          // infinite planes, the first of the shapes
  uint emitter_count;
  float emitter_density;     // pi / power of the largest channels of all emitters; 0 without emitters
  float photon_flux;         // flux of the largest channel of one emitted photon
  uint photon_count;         // emitted by this launch
  uint photon_capacity;      // stored at most
  float alpha;               // fraction of the new photons that the radius update keeps
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
  uint photon_mutations;        // of each seed
  uint sobol;                // 1 where the sample dimensions of camera paths are those of sobol.cl, 0 where they are independent
  uint coverage;             // 1 where visible points probe how much of their kernel lies on surfaces: see kernel_area.cl
  uint nested;               // NESTED_* bits; 0 where no dielectric touches or holds anything
  float contact_low[3], contact_high[3];  // the box outside of which dielectrics touch nothing (EFFECT_NESTED)
  float inside_direction[3];  // of the rays by which the dielectrics around a point are found
  uint channel_shifts;       // log2 of what photons carry each channel times: a byte each, red the lowest; see channel_shifts.cl
  uint crop_x, crop_y;       // of the picture, the pixel that is the film's first
  uint crop_width, crop_height;  // pixels of the film; 0: of the picture
  uint unused;
} Params;
CHECK_SIZE(Params, 320);

#define NESTED_ON 1u        // paths keep the dielectrics that they are in: see path_media.cl
#define NESTED_CAMERA 2u    // the camera may stand in one
#define NESTED_EMITTERS 4u  // an emitter may lie on the boundary of one

// Items of a work-group, at most: kernels keep a number for each in local memory.
#define LARGEST_WORK_GROUP 256u

// A cell of projection_map.cl, as in an alias table (Walker 1977).
typedef struct {
  float stay;   // the probability that numbers which fall into it keep it
  uint other;   // where they go else: a cell of the same square
  float weight;  // factor of the flux of a photon that leaves by this cell
} ProjectionCell;
CHECK_SIZE(ProjectionCell, 12);

// The numbers that decide how a photon starts: which emitter, two of the place, two of the direction.
#define START_NUMBERS 5u

// A cell of emission_map.cl: a box of the unit cube of these numbers. The cells of a map fill the cube.
typedef struct {
  float low[START_NUMBERS], size[START_NUMBERS];
  uint end;     // this cell and all before it own the random numbers below end, of EMISSION_NUMBERS
  float weight;  // factor of the flux of a photon that starts in the cell
} EmissionCell;
CHECK_SIZE(EmissionCell, 48);

#define EMISSION_NUMBERS 16777216u

// Counts that kernels add to; each wraps at 2^32 and is read as differences. Rays, of which a pass may have more, have
// upper bits besides.
typedef struct {
  uint photons;        // stored, or wanted where that is above Params.photon_capacity
  uint indirect;       // those of them that are marked INDIRECT_PHOTON
  uint seeds;          // pilot paths that landed where the camera sees
  uint rays;           // traced, shadow rays included
  uint non_finite;     // samples that were NaN or Inf and were left out
  uint saturated;      // photons whose flux, or samples whose sum, was above what the record holds
  uint unresolved;     // rays with a hit on a revolved curve whose root could not be told from its neighbours
  uint traversal_bound;  // rays whose walk through the tree was cut short
  uint media_full;     // paths in more dielectrics than they can keep
  uint media_left;     // boundaries of dielectrics that a path left without having entered
  uint rays_high;      // how often `rays` has wrapped
} Counters;
CHECK_SIZE(Counters, 44);
