// The pixels that a film holds: all of the picture's, or a crop.
#include "core/prelude.cl"
#include "shared/types.h"

// A pixel of the picture by its number among those of the film, and the other way around. All that is random goes by the
// picture's pixels: a crop is the picture's part to the bit.
INLINE uint picture_pixel(const Params *params, uint pixel) {
  if (params->crop_width == 0) return pixel + params->crop_y * params->width;
  uint y = pixel / params->crop_width, x = pixel - y * params->crop_width;
  return (params->crop_y + y) * params->width + params->crop_x + x;
}
INLINE uint film_pixel(const Params *params, uint pixel) {
  if (params->crop_width == 0) return pixel - params->crop_y * params->width;
  uint y = pixel / params->width, x = pixel - y * params->width;
  return (y - params->crop_y) * params->crop_width + x - params->crop_x;
}

// Pixels of a row of the film, of its columns, and of all.
INLINE uint film_width(const Params *params) { return params->crop_width != 0 ? params->crop_width : params->width; }
INLINE uint film_height(const Params *params) { return params->crop_height != 0 ? params->crop_height : params->height; }
INLINE uint film_pixels(const Params *params) { return film_width(params) * film_height(params); }
