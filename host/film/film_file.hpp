// Film files: all that a render has added up so far, so that another run goes on from there.
#pragma once

#include <string>
#include <string_view>

#include "film/film_state.hpp"

namespace causticl {

/// Writes the film to a temporary file, syncs it and puts it in the place of `file`. Throws UserError.
void write_film(const std::string& file, const FilmState& film);

/// Throws UserError for what is no film, one of a newer version, or one that is damaged or cut off.
FilmState read_film(const std::string& file);
/// All but the blocks: neither pixels nor layers nor state.
FilmState read_film_header(const std::string& file);
/// The same of these bytes, which messages call `file`.
FilmState film_of_bytes(const std::string& file, std::string_view bytes);
/// The bytes of such a file, its header (a JSON object that lists the blocks) and what follows.
std::string film_bytes(const std::string& header, std::string_view blocks);

/// Whether there is a regular file of this name that begins as films do.
bool is_film(const std::string& file);

}  // namespace causticl
