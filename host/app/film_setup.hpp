// The film file of `render`: where it goes, and what it is a film of.
#pragma once

#include "app/options.hpp"

namespace causticl {

/// What decides the estimates of this render.
RenderIdentity identity_of(const Options& options, const Scene& scene);

/// Throws UserError where a film cannot be written, or would take the place of a file that is no film. Where
/// it `is_read` as well, that is told then.
void check_film_place(const std::string& file, bool is_read = false);

/// Fills in what the options say of the film. Throws UserError where it cannot be written, or would take the
/// place of one that is not gone on from.
void set_film(const Options& options, const Scene& scene, RenderOptions& render);

}  // namespace causticl
