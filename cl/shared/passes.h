// The programs, each a pass of an integrator or of all: NAME is cl/passes/pass_NAME.cl. One table that the host reads
// as a whole; the table of effects says which programs read an effect.
#pragma once

// What the host may ask of a program.
#define SERVES_PHOTONS 1u       // it does not run where no photon could be stored, or found
#define HOLDS_LIGHT_PASSES 2u   // it reads OUTPUT_LIGHT_PASSES
#define TRACES_CAMERA_RAYS 4u   // it has a kernel primary_hits where CAMERA_PACKETS is defined
#define TRACES_BATCHES 8u       // rays of its batches meet every primitive where BRUTE_FORCE is defined

// Columns: IN_name is its bit; its word; the number of that bit; the kernel that runs whenever the pass does; properties.
// `ROW(x, ...)` is made of each row.
#define PASS_TABLE(ROW, x) \
  ROW(x, PHOTON, photon, 0, trace_photons,  SERVES_PHOTONS | HOLDS_LIGHT_PASSES | TRACES_BATCHES) \
  ROW(x, CAMERA, camera, 1, trace_camera,   HOLDS_LIGHT_PASSES | TRACES_CAMERA_RAYS | TRACES_BATCHES) \
  ROW(x, GATHER, gather, 2, gather_photons, HOLDS_LIGHT_PASSES) \
  ROW(x, PATH,   path,   3, trace_paths,    HOLDS_LIGHT_PASSES | TRACES_CAMERA_RAYS) \
  ROW(x, GRID,   grid,   4, move_photons,   SERVES_PHOTONS) \
  ROW(x, FILM,   film,   5, pixel_errors,   0u)

#ifdef __cplusplus
enum ProgramBit : unsigned {
#else
enum ProgramBit {
#endif
#define PROGRAM_BIT(argument, name, word, bit, kernel, properties) IN_##name = 1u << bit,
  PASS_TABLE(PROGRAM_BIT, )
#undef PROGRAM_BIT
};

#define IN_PATHS (IN_PHOTON | IN_CAMERA | IN_PATH)  // wherever a ray is traced
