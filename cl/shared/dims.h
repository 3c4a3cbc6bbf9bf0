// Named dimensions of the random function. Every path vertex owns a fixed stride of four-number draws, so
// that an effect that is compiled out never shifts the numbers of another.
#pragma once

#define DIM_FILM 0u          // position in the pixel (xy), lens (zw)
#define DIM_EMITTER 1u       // which emitter (xw), point on it (yz), side of it (w)
#define DIM_EMISSION 2u      // direction (xy), whether it keeps the cell of projection_map.cl (z)
#define DIM_EMISSION_CELL 3u // cell of emission_map.cl (x)
#define DIM_BOUNCE_FIRST 8u  // first dimension of vertex 0
#define DIM_BOUNCE_STRIDE 8u

#define DIM_BSDF 0u        // direction (xy), lobe (z), Russian roulette (w)
#define DIM_LIGHT 1u       // which emitter (xw), point on it (yz)
#define DIM_QUANTISE 2u    // dithering of stored flux (xyz) and direction (w)
#define DIM_CHANNEL 3u     // which colour channel goes on through dispersive glass (x)
#define DIM_MEDIUM 4u      // free flight in the medium: channel (x), distance (y)
#define DIM_BRANCH 5u        // Russian roulette of looks along unlikely lobes (x)
#define DIM_KERNEL_AREA 6u    // place in the disc that a visible point probes (xy), rounding (z), which disc (w)
