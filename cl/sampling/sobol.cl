// The sample dimensions of camera paths: a pixel's samples fill the unit square more evenly than independent ones, for each pair of
// numbers of each dimension of dims.h. Every pair is a (0,2)-sequence, the first two dimensions of Sobol's, in an order
// of its own and moved by a digital shift: the numbers of one path are uniform and independent of each other, but from
// one path of a pixel to its next all of them take steps alike.
//
// The order is Owen's scrambling of the sample's index by a hash (Laine & Karras, "Stratified sampling for stochastic
// transparency", EGSR 2011; Burley, "Practical hash-based Owen scrambling", JCGT 2020, which shuffles indices so to pad
// pairs). Scrambling the points so as well, in place of shifting them, gave no less noise.
#include "sampling/half_buffers.cl"
#include "sampling/rng.cl"

// Beside the passes that independent numbers are of.
#define SOBOL_PASS 0x80000000u

// The numbers of one camera path.
typedef struct {
  RandomStream stream;  // independent ones, of the path alone
  uint pixel;           // which has sequences of its own, for each half of the passes
  uint of_half;         // of the passes, 0 or 1
  uint reversed;        // the path's index in its half's sequences, the first bit last
  uint sobol;           // 0 where all numbers are to be independent
} PathSampler;

INLINE uint reverse_bits(uint x) {
  x = x >> 16 | x << 16;
  x = (x >> 8 & 0x00ff00ffu) | (x & 0x00ff00ffu) << 8;
  x = (x >> 4 & 0x0f0f0f0fu) | (x & 0x0f0f0f0fu) << 4;
  x = (x >> 2 & 0x33333333u) | (x & 0x33333333u) << 2;
  return (x >> 1 & 0x55555555u) | (x & 0x55555555u) << 1;
}

// Path number `sample` of `samples` that the pixel has in pass `pass`.
INLINE PathSampler path_sampler(uint seed, uint pass, uint pixel, uint sample, uint samples, uint sobol) {
  RandomStream stream = {seed, pass, pixel * samples + sample};
  PathSampler sampler = {stream, pixel, half_of_passes(pass), reverse_bits((pass >> 1) * samples + sample), sobol};
  return sampler;
}

// Owen's scrambling of the digits of x, the lowest bit being the first of them: each is flipped or not by a hash of those
// before it (the constants are Vegdahl's, "Owen scrambling based on hash functions", 2021).
INLINE uint owen_scramble(uint x, uint seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= seed >> 16 | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

// Sobol's second dimension from the first at the same index: the matrix of Pascal's triangle modulo 2 over the digits,
// which is a power of that of two by two (Ahmed, "An implementation algorithm of 2D Sobol sequence fast, elegant, and
// compact", EGSR 2024).
INLINE uint sobol_second(uint first) {
  first ^= first << 1 & 0xaaaaaaaau;
  first ^= first << 2 & 0xccccccccu;
  first ^= first << 4 & 0xf0f0f0f0u;
  first ^= first << 8 & 0xff00ff00u;
  return first ^ first << 16;
}

// The path's points of the two sequences of a dimension, and what they are shifted by.
INLINE uint4 sobol_points(const PathSampler *sampler, uint dimension, uint4 *shift) {
  uint4 hash = pcg4d((uint4)(sampler->pixel, SOBOL_PASS + sampler->of_half, dimension, sampler->stream.seed));
  uint x = owen_scramble(sampler->reversed, hash.x), z = owen_scramble(sampler->reversed, hash.w);
  // The shifts of the second pair have their first sixteen bits from the last of what the others use.
  *shift = (uint4)(hash.y, hash.z, hash.y << 16 | hash.x >> 16, hash.z << 16 | hash.w >> 16);
  return (uint4)(x, sobol_second(x), z, sobol_second(z));
}

// The path's four uniform numbers in [0, 1) for a dimension of dims.h: xy and zw are pairs.
INLINE real4 path_random4(const PathSampler *sampler, uint dimension) {
  if (sampler->sobol == 0) return random4(sampler->stream, dimension);
  uint4 shift, points = sobol_points(sampler, dimension, &shift);
  return uniform4(points ^ shift);
}

// The same for loops over paths that are to be vectorised, where `sobol` is known when they are compiled: they take scalars
// alone, while elsewhere four words shifted at once are worth 4% of a camera path.
INLINE real4 path_random4_soa(const PathSampler *sampler, uint dimension) {
  if (sampler->sobol == 0) return random4(sampler->stream, dimension);
  uint4 shift, points = sobol_points(sampler, dimension, &shift);
  return uniform4((uint4)(points.x ^ shift.x, points.y ^ shift.y, points.z ^ shift.z, points.w ^ shift.w));
}

// The same for the vertex with index `bounce` (from 0).
INLINE real4 path_random_at(const PathSampler *sampler, uint bounce, uint dimension) {
  return path_random4(sampler, dimension_at(bounce, dimension));
}
