// The picture of a film, as a render of all its passes would have written it.
#pragma once

#include "film/film_file.hpp"
#include "opencl/device.hpp"
#include "render/render.hpp"

namespace causticl {

/// The picture of `film` with the errors of its pixels, which `device` tells, and its layers, and what is
/// known of the render; `confidence` as RenderOptions has it.
RenderResult picture_of(const FilmState& film, Device& device, double confidence);

/// What an EXR says of the render that left such a film.
Metadata metadata_of(const FilmState& film, const Statistics& statistics);

}  // namespace causticl
