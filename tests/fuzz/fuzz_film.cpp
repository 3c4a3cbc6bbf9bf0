// Film files.
#include <limits>
#include <nlohmann/json.hpp>

#include "film/film_file.hpp"
#include "film/merge_films.hpp"
#include "fuzz_input.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace causticl {
namespace {

void check(const FilmState& film) {
  promise(film.pixels.size() == film.rect.pixels(), "a film has its pixels");
  promise(film.layers.empty() || film.layers.size() == film.pixels.size(), "layers are of the same pixels");
  promise(difference_of(film.identity, "a", film.identity, "b").empty(),
          "a film is of the same render as itself");
  // Another part of the same pixels.
  FilmState later = film;
  const std::uint64_t end = film.passes.end(), more = film.passes.count();
  if (more == 0 || end + more > std::numeric_limits<std::int32_t>::max()) return;
  later.passes = PassSet({end, end + more});
  const std::string a = fuzz_folder().path("a.film"), b = fuzz_folder().path("b.film");
  write_film(a, film);
  write_film(b, later);
  FilmMerger merger;
  merger.add(a);
  merger.add(b);
  promise(merger.whole().passes.count() > film.passes.count(), "films add up");
}

/// A header before a line break and blocks after it, with the checksums that they have: what a fuzzer cannot
/// guess and an attacker computes.
std::string with_checksums(const std::string& bytes) {
  const std::size_t end = std::min(bytes.find('\n'), bytes.size());
  const std::string blocks = end < bytes.size() ? bytes.substr(end + 1) : "";
  auto header = nlohmann::ordered_json::parse(bytes.substr(0, end), nullptr, false);
  if (header.is_discarded() || !header.is_object()) return film_bytes(bytes.substr(0, end), blocks);
  std::size_t at = 0;
  if (header.contains("blocks") && header["blocks"].is_array())
    for (auto& block : header["blocks"]) {
      if (!block.is_object() || !block.contains("bytes") || !block["bytes"].is_number_unsigned()) continue;
      const std::size_t size = std::min(block["bytes"].get<std::size_t>(), blocks.size() - at);
      const XXH128_hash_t hash = XXH3_128bits(blocks.data() + at, size);
      char text[33];
      std::snprintf(text, sizeof text, "%016llx%016llx", static_cast<unsigned long long>(hash.high64),
                    static_cast<unsigned long long>(hash.low64));
      block["xxh128"] = text;
      at += size;
    }
  return film_bytes(header.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace), blocks);
}

}  // namespace

void fuzz_film(const std::string& bytes) {
  read_or_refuse([&] { check(film_of_bytes("a.film", bytes)); });
  const std::string forged = with_checksums(bytes);
  read_or_refuse([&] { check(film_of_bytes("a.film", forged)); });
}

}  // namespace causticl
