// Random numbers as a pure function of (seed, pass, path, dimension): nothing is carried from draw to draw,
// so the result does not depend on the order of execution, and any range of passes can be computed alone.
#include "prelude.cl"
#include "dims.h"

typedef struct {
  uint seed, pass, path;
} RandomStream;

// PCG4D: four well-mixed words from four (Jarzynski & Olano, "Hash Functions for GPU Rendering", JCGT 2020).
INLINE uint4 pcg4d(uint4 v) {
  v.x = v.x * 1664525u + 1013904223u;
  v.y = v.y * 1664525u + 1013904223u;
  v.z = v.z * 1664525u + 1013904223u;
  v.w = v.w * 1664525u + 1013904223u;
  v.x += v.y * v.w;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v.w += v.y * v.z;
  v.x ^= v.x >> 16u;
  v.y ^= v.y >> 16u;
  v.z ^= v.z >> 16u;
  v.w ^= v.w >> 16u;
  v.x += v.y * v.w;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v.w += v.y * v.z;
  return v;
}

// Four independent uniform numbers in [0, 1) for a dimension of dims.h. 24 bits each, so 1 never appears.
INLINE real4 random4(RandomStream stream, uint dimension) {
  uint4 bits = pcg4d((uint4)(stream.path, stream.pass, dimension, stream.seed));
  const real unit = (real)5.9604644775390625e-8;
  return (real4)((int)(bits.x >> 8u) * unit, (int)(bits.y >> 8u) * unit, (int)(bits.z >> 8u) * unit,
                 (int)(bits.w >> 8u) * unit);
}

// The same for the vertex with index `depth` (from 0) of a path.
INLINE real4 random_at(RandomStream stream, uint depth, uint dimension) {
  return random4(stream, DIM_BOUNCE_FIRST + depth * DIM_BOUNCE_STRIDE + dimension);
}
