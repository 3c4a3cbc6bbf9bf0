// The film file of `render`: where it goes, and what it is a film of.
#pragma once

#include "app/options.hpp"

namespace causticl {

/// What decides the estimates of this render.
RenderIdentity identity_of(const Options& options, const Scene& scene);

/// Fills in what the options say of the film. Throws UserError where it cannot be written, or would take the
/// place of one that is not gone on from.
void set_film(const Options& options, const Scene& scene, FilmOptions& film);

}  // namespace causticl
