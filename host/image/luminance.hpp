// The luminance of a pixel.
#pragma once

namespace causticl {

/// Y of linear sRGB (IEC 61966-2-1); cl/film/film.cl weighs channels alike.
inline double luminance(const float* rgb) { return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]; }

}  // namespace causticl
