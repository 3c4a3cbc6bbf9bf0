// Random numbers as a pure function of (seed, pass, path, dimension): nothing is carried from draw to draw,
// so the result does not depend on the order of execution, and any range of passes can be computed alone.
#include "core/prelude.cl"
#include "shared/dims.h"
#include "shared/effects.h"

typedef struct {
  uint seed, pass, path;
  uint copy;   // 0, or with EFFECT_GUIDED_PHOTONS the number of a mutated copy of the path
  uint fresh;  // of a copy: the dimension from which on it has numbers of its own
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

// Sets the random numbers of mutations apart from those that they change.
#define MUTATION_SEED 0x7f4a7c15u

// Before it has numbers of its own, no number of a copy differs by more than this from that of its path.
#define LARGEST_MUTATION 0.0078125f

// What the numbers of a copy have more than those of its path, modulo 1 and in units of 2^-32. As likely as its negative,
// so that a copy's copy is as likely to be the path as the other way round; cubed, so that there are steps of all sizes.
INLINE uint4 mutation(RandomStream stream, uint dimension) {
  uint4 bits = pcg4d((uint4)(stream.path, stream.pass + stream.copy * 2654435769u, dimension, stream.seed ^ MUTATION_SEED));
  bool fresh = dimension >= stream.fresh;
  const float unit = 4.656612873077393e-10f;
  float x = (int)bits.x * unit, y = (int)bits.y * unit, z = (int)bits.z * unit, w = (int)bits.w * unit;
  const float largest = LARGEST_MUTATION * 4294967296.0f;
  return (uint4)(fresh ? bits.x : (uint)(int)(x * x * x * largest), fresh ? bits.y : (uint)(int)(y * y * y * largest),
                 fresh ? bits.z : (uint)(int)(z * z * z * largest), fresh ? bits.w : (uint)(int)(w * w * w * largest));
}

// Uniform numbers in [0, 1) of so many bits: 24 of each, so 1 never appears.
INLINE real4 uniform4(uint4 bits) {
  const real unit = (real)5.9604644775390625e-8;
  return (real4)((int)(bits.x >> 8u) * unit, (int)(bits.y >> 8u) * unit, (int)(bits.z >> 8u) * unit,
                 (int)(bits.w >> 8u) * unit);
}

// The dimension of the vertex with index `bounce` (from 0) of a path.
INLINE uint dimension_at(uint bounce, uint dimension) {
  return DIM_BOUNCE_FIRST + bounce * DIM_BOUNCE_STRIDE + dimension;
}

// Four independent uniform numbers in [0, 1) for a dimension of dims.h.
INLINE real4 random4(RandomStream stream, uint dimension) {
  uint4 bits = pcg4d((uint4)(stream.path, stream.pass, dimension, stream.seed));
  if (HAS(EFFECT_GUIDED_PHOTONS)) bits += mutation(stream, dimension) * (uint4)(stream.copy != 0 ? 1u : 0u);
  return uniform4(bits);
}

// The same for the vertex with index `bounce` (from 0) of a path.
INLINE real4 random_at(RandomStream stream, uint bounce, uint dimension) {
  return random4(stream, dimension_at(bounce, dimension));
}
