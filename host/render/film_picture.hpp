// The picture of films, as a render of all their passes would have written it.
#pragma once

#include "film/merge_films.hpp"
#include "opencl/device.hpp"
#include "render/render.hpp"

namespace causticl {

/// The picture of the whole with the errors of its pixels, which `device` tells, and its layers, and what is
/// known of the render. Only one crop at a time is in memory beside the picture. `confidence` as
/// RenderOptions has it.
RenderResult picture_of(const FilmMerger& films, Device& device, double confidence);

/// What an EXR says of the renders that left such a film.
Metadata metadata_of(const FilmState& film, const Statistics& statistics);

}  // namespace causticl
