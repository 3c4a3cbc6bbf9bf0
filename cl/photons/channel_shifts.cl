// Colour channels of very unequal light. Records hold a photon's flux in units of the largest channel, of which a channel a
// million times weaker would be a fraction: it would be stored once in hundreds of photons, as noise, and would not keep a
// photon alive through a surface that reflects no other. Where no emitter has more of a channel than 1/256 of its largest,
// photons therefore carry that channel times a power of two, which the gather divides out. Powers of two round nothing.
#include "shared/types.h"
#include "core/vector.cl"

// What photons carry each channel times.
INLINE real3 channel_scale(uint shifts) {
  return (real3)(ldexp((real)1, (int)(shifts & 0xffu)), ldexp((real)1, (int)(shifts >> 8 & 0xffu)),
                 ldexp((real)1, (int)(shifts >> 16 & 0xffu)));
}

// What divides it out.
INLINE real3 channel_unit(uint shifts) {
  return (real3)(ldexp((real)1, -(int)(shifts & 0xffu)), ldexp((real)1, -(int)(shifts >> 8 & 0xffu)),
                 ldexp((real)1, -(int)(shifts >> 16 & 0xffu)));
}
