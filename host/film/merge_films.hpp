// Films of parts of a render put together: passes added up, crops put side by side.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "film/film_file.hpp"

namespace causticl {

/// Film files that make up a whole. Their pixels are read only when they are asked for, one file at a time.
class FilmMerger {
 public:
  /// Takes the film file, in any order. Throws UserError where it is no film, is of another render than those
  /// before, or has passes of pixels that are there already.
  void add(const std::string& file);

  /// After all files: the whole without its pixels. Throws UserError where passes or pixels are missing in
  /// between.
  FilmState summary() const;

  /// Calls `take` with the film of each crop: the sum of all its passes.
  void for_each_crop(const std::function<void(const FilmState&)>& take) const;

  /// The whole as one film.
  FilmState whole() const;

 private:
  struct File {
    std::string name;
    FilmState film;  // without pixels
  };
  /// All files of one crop.
  struct Part {
    std::vector<File> files;
    PassSet passes;
  };

  std::vector<Part> parts_;

  const File& first() const { return parts_.front().files.front(); }
  void check(const std::string& name, const FilmState& film) const;
  FilmState sum_of(const Part& part) const;
};

}  // namespace causticl
