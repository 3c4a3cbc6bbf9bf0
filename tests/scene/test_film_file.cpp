// Film files: what is written is read, and what is damaged is refused.
#include <bit>
#include <filesystem>
#include <fstream>

#include "base/error.hpp"
#include "film/film_file.hpp"
#include "temporary_folder.hpp"
#include "vector_inputs.hpp"

using namespace causticl;
using Catch::Contains;

namespace {

FilmState some_film() {
  RandomInputs random(311);
  FilmState film;
  film.identity = {{"scene", "abc"}, {"seed", "7"}};
  film.width = 40;
  film.height = 30;
  film.crop = {3, 4, 8, 9};
  film.rect = {0, 0, 12, 13};
  film.passes.add({2, 5});
  film.passes.add({9, 10});
  film.even = film.photons_stored = true;
  film.pixels.resize(film.rect.pixels());
  for (auto& pixel : film.pixels)
    for (auto& sum : pixel.radiance)
      for (int n = 0; n < 3; ++n) sum = exact_sum_add(sum, static_cast<float>(random.uniform()));
  film.layers.resize(film.rect.pixels());
  film.state["sppm.pixels"] = std::vector<std::byte>(20 * film.rect.pixels(), std::byte{3});
  film.depends_on_history = {"a reason"};
  film.devices = {"one", "another \"name\""};
  film.photons = 1ull << 40;
  film.rays = 12;
  film.seconds = 0.1;
  film.diagnostics = {{"saturated", 3}};
  return film;
}

void write_bytes(const std::string& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

}  // namespace

TEST_CASE("a film is read as it was written") {
  TemporaryFolder folder;
  const FilmState film = some_film();
  const std::string file = folder.path("a.film");
  write_film(file, film);
  const FilmState read = read_film(file);
  CHECK(read.identity == film.identity);
  CHECK(read.width == 40);
  CHECK(read.height == 30);
  CHECK(read.crop == film.crop);
  CHECK(read.rect == film.rect);
  CHECK(read.passes == film.passes);
  CHECK(read.even);
  CHECK(read.photons_stored);
  CHECK(std::memcmp(read.pixels.data(), film.pixels.data(), film.pixels.size() * sizeof(FilmPixel)) == 0);
  CHECK(read.layers.size() == film.layers.size());
  CHECK(read.state == film.state);
  CHECK(read.depends_on_history == film.depends_on_history);
  CHECK(read.devices == film.devices);
  CHECK(read.photons == film.photons);
  CHECK(read.rays == film.rays);
  CHECK(read.seconds == film.seconds);
  CHECK(read.diagnostics == film.diagnostics);
  CHECK(is_film(file));
  CHECK(std::filesystem::directory_iterator(folder.path("")) != std::filesystem::directory_iterator());
}

TEST_CASE("a film that is cut off, damaged or of a newer version is refused with one line") {
  TemporaryFolder folder;
  RandomInputs random(312);
  const std::string file = folder.path("a.film"), broken = folder.path("broken.film");
  write_film(file, some_film());
  const std::string bytes = bytes_of(file);
  for (int n = 0; n < 300; ++n) {
    // Every one of the first bytes, and then any.
    const std::size_t at = n < 150 ? static_cast<std::size_t>(n) : random.engine() % bytes.size();
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ (1 << random.engine() % 8));
    write_bytes(broken, changed);
    CAPTURE(at, random.seed);
    CHECK_THROWS_AS(read_film(broken), UserError);
    write_bytes(broken, bytes.substr(0, n < 150 ? static_cast<std::size_t>(n) + 1 : at));
    CHECK_THROWS_AS(read_film(broken), UserError);
  }
  write_bytes(broken, bytes + "x");
  CHECK_THROWS_WITH(read_film(broken), Contains("is damaged or cut off"));
  std::string newer = bytes;
  newer[14] = '2';
  write_bytes(broken, newer);
  CHECK_THROWS_WITH(read_film(broken), Contains("is a film of version 2") && Contains("expected version 1"));
  write_bytes(broken, "{}");
  CHECK_THROWS_WITH(read_film(broken), Contains("is no film"));
  CHECK_FALSE(is_film(broken));
  CHECK_FALSE(is_film(folder.path("none.film")));
}

TEST_CASE("a film whose sums its passes cannot have added up is refused, however it is checksummed") {
  TemporaryFolder folder;
  const std::string file = folder.path("a.film");
  constexpr std::int64_t most = std::int64_t{4} << (EXACT_SUM_BITS - 1);  // by the four passes of the film
  const auto refused = [&](auto&& change) {
    FilmState film = some_film();
    change(film);
    write_film(file, film);
    try {
      read_film(file);
      return false;
    } catch (const UserError&) {
      return true;
    }
  };
  CHECK_FALSE(refused([&](FilmState& film) { film.pixels[7].radiance[1] = exact_sum_bins(most, -most, 5); }));
  CHECK(refused([&](FilmState& film) { film.pixels[7].radiance[1] = exact_sum_bins(most + 1, 0, 5); }));
  CHECK(refused([&](FilmState& film) { film.pixels[7].luminance[1] = exact_sum_bins(0, -most - 1, 5); }));
  CHECK(refused([&](FilmState& film) { film.pixels[8].luminance2 = exact_sum_bins(-most - 1, 0, 5); }));
  CHECK(refused([&](FilmState& film) { film.pixels[9].kernel_bias[0].high = INT64_MAX; }));
  CHECK(refused([&](FilmState& film) { film.layers[155].radiance[2][2].low_and_bin = INT64_MIN; }));
  CHECK(refused([&](FilmState& film) { film.pixels[3].left_out[1] = 5; }));
}

TEST_CASE("sets of passes know their ranges and halves") {
  RandomInputs random(313);
  for (int n = 0; n < 200; ++n) {
    std::vector<bool> in(300);
    PassSet passes;
    for (int k = 0; k < 12; ++k) {
      const std::uint64_t begin = random.engine() % 290, end = begin + 1 + random.engine() % 10;
      bool meets = false;
      for (std::uint64_t pass = begin; pass < end; ++pass) meets = meets || in[pass];
      CHECK(passes.meets({begin, end}) == meets);
      if (meets) continue;
      passes.add({begin, end});
      for (std::uint64_t pass = begin; pass < end; ++pass) in[pass] = true;
    }
    uint halves[2] = {0, 0};
    std::size_t ranges = 0;
    for (std::size_t pass = 0; pass < in.size(); ++pass) {
      if (!in[pass]) continue;
      ++halves[std::popcount(pass) % 2];
      ranges += pass == 0 || !in[pass - 1];
    }
    CAPTURE(n, random.seed);
    CHECK(passes.halves().x == halves[0]);
    CHECK(passes.halves().y == halves[1]);
    CHECK(passes.count() == halves[0] + halves[1]);
    CHECK(passes.ranges().size() == ranges);
  }
  CHECK(text_of(PassSet({0, 64})) == "1:64");
}
