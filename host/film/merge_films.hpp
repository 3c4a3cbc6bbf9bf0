// Films of parts of a render put together: passes added up, crops put side by side.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "film/film_file.hpp"

namespace causticl {

/// Adds films up one after the other, in any order.
class FilmMerger {
 public:
  /// Takes the film of the file `name`. Throws UserError where it is of another render than those before, or
  /// has passes of pixels that are there already.
  void add(const std::string& name, FilmState film);

  /// The whole. Throws UserError where passes or pixels are missing in between.
  FilmState finish();

 private:
  /// The sum of all films of one crop.
  struct Part {
    std::string name;  // of the first
    FilmState film;
    std::vector<std::pair<std::string, PassSet>> files;
  };

  std::string first_name_;
  RenderIdentity identity_;
  std::vector<Part> parts_;

  void check(const std::string& name, const FilmState& film) const;
};

}  // namespace causticl
