#include "film/merge_films.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#include "base/error.hpp"
#include "base/printable.hpp"

namespace causticl {
namespace {

void add_sum(ExactSum& sum, const ExactSum& more) { sum = exact_sum_of_parts(sum, more); }

/// The last of the passes at which pixels look for photons that they miss (UnknownError::due); 0 where there
/// is none.
std::uint64_t last_look(const PassSet& passes) {
  std::uint64_t last = 0;
  for (const PassRange& range : passes.ranges()) {
    const std::uint64_t pass = std::bit_floor(range.end) - 1;  // 2^k - 1 below the end
    if (pass >= range.begin && pass > 0) last = std::max(last, pass);
  }
  return last;
}

/// `other_is_later`: whether it has the last look.
void add_pixel(FilmPixel& pixel, const FilmPixel& other, bool other_is_later) {
  for (int c = 0; c < 3; ++c) add_sum(pixel.radiance[c], other.radiance[c]);
  add_sum(pixel.luminance2, other.luminance2);
  for (int k = 0; k < 2; ++k) {
    add_sum(pixel.luminance[k], other.luminance[k]);
    add_sum(pixel.kernel_bias[k], other.kernel_bias[k]);
    pixel.left_out[k] += other.left_out[k];
  }
  if (pixel.missed < 0 || other.missed < 0)
    pixel.missed = -1;
  else if (other_is_later)
    pixel.missed = other.missed;
}

void add_sppm_pixels(std::vector<std::byte>& bytes, const std::vector<std::byte>& more) {
  SppmPixel own, other;
  for (std::size_t at = 0; at + sizeof own <= std::min(bytes.size(), more.size()); at += sizeof own) {
    std::memcpy(&own, bytes.data() + at, sizeof own);
    std::memcpy(&other, more.data() + at, sizeof other);
    const std::uint64_t photons = (std::uint64_t{own.photons_high} << 32 | own.photons_low) +
                                  (std::uint64_t{other.photons_high} << 32 | other.photons_low);
    own.photons_low = static_cast<uint>(photons);
    own.photons_high = static_cast<uint>(photons >> 32);
    std::memcpy(bytes.data() + at, &own, sizeof own);
  }
}

void add_counts(FilmState& film, const FilmState& more) {
  film.photons_stored = film.photons_stored || more.photons_stored;
  film.rays += more.rays;
  film.seconds += more.seconds;
  for (const auto& [key, count] : more.diagnostics) film.diagnostics[key] += count;
  for (const auto& device : more.devices)
    if (std::find(film.devices.begin(), film.devices.end(), device) == film.devices.end())
      film.devices.push_back(device);
}

/// Other passes of the same pixels.
void add_passes(FilmState& film, const FilmState& more) {
  const bool more_is_later = last_look(more.passes) > last_look(film.passes);
  for (std::size_t i = 0; i < film.pixels.size(); ++i)
    add_pixel(film.pixels[i], more.pixels[i], more_is_later);
  for (std::size_t i = 0; i < film.layers.size(); ++i)
    for (uint k = 0; k < LIGHT_PASS_COUNT; ++k)
      for (int c = 0; c < 3; ++c) add_sum(film.layers[i].radiance[k][c], more.layers[i].radiance[k][c]);
  for (auto& [name, bytes] : film.state)
    if (const auto other = more.state.find(name); name == "sppm.pixels" && other != more.state.end())
      add_sppm_pixels(bytes, other->second);
  for (const PassRange& range : more.passes.ranges()) film.passes.add(range);
  film.photons += more.photons;
  add_counts(film, more);
}

bool meet(const PixelRect& a, const PixelRect& b) {
  return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

/// Copies what `from` holds of the pixels of `to`, which both hold in rows, `record` bytes a pixel.
void copy_pixels(const PixelRect& from_rect, const std::byte* from, const PixelRect& to_rect, std::byte* to,
                 std::size_t record) {
  const int x0 = std::max(from_rect.x0, to_rect.x0), x1 = std::min(from_rect.x1, to_rect.x1);
  for (int y = std::max(from_rect.y0, to_rect.y0); y < std::min(from_rect.y1, to_rect.y1) && x0 < x1; ++y) {
    const auto place = [&](const PixelRect& rect) {
      return (static_cast<std::size_t>(y - rect.y0) * static_cast<std::size_t>(rect.width()) +
              static_cast<std::size_t>(x0 - rect.x0)) *
             record;
    };
    std::memcpy(to + place(to_rect), from + place(from_rect), static_cast<std::size_t>(x1 - x0) * record);
  }
}

template <typename Record>
void paste(const PixelRect& from_rect, const std::vector<Record>& from, const PixelRect& to_rect,
           std::vector<Record>& to) {
  to.resize(to_rect.pixels());
  copy_pixels(from_rect, reinterpret_cast<const std::byte*>(from.data()), to_rect,
              reinterpret_cast<std::byte*>(to.data()), sizeof(Record));
}

/// The rectangle around all crops.
PixelRect around(const std::vector<PixelRect>& crops) {
  PixelRect whole = crops.front();
  for (const PixelRect& crop : crops) {
    whole.x0 = std::min(whole.x0, crop.x0);
    whole.y0 = std::min(whole.y0, crop.y0);
    whole.x1 = std::max(whole.x1, crop.x1);
    whole.y1 = std::max(whole.y1, crop.y1);
  }
  return whole;
}

/// A pixel of `whole` that is in no crop, as text; empty where there is none.
std::string missing_pixel(const std::vector<PixelRect>& crops, const PixelRect& whole) {
  std::size_t covered = 0;
  for (const PixelRect& crop : crops) covered += crop.pixels();
  if (covered == whole.pixels()) return "";
  for (int y = whole.y0; y < whole.y1; ++y)
    for (int x = whole.x0; x < whole.x1; ++x) {
      const auto held = std::find_if(crops.begin(), crops.end(), [&](const PixelRect& crop) {
        return meet(crop, {x, y, x + 1, y + 1});
      });
      if (held == crops.end()) return std::to_string(x) + "," + std::to_string(y);
      x = held->x1 - 1;
    }
  return "";
}

/// Bytes a pixel of a block.
std::size_t record_of(const FilmState& film, const std::vector<std::byte>& bytes) {
  return bytes.size() / film.rect.pixels();
}

/// Films of one render have blocks of one form.
void check_form(const std::string& name, const FilmState& film, const FilmState& first) {
  bool same = film.width == first.width && film.height == first.height &&
              film.layers.empty() == first.layers.empty() && film.state.size() == first.state.size();
  for (const auto& [block, bytes] : film.state) {
    const auto other = first.state.find(block);
    same = same && other != first.state.end() && bytes.size() % film.rect.pixels() == 0 &&
           record_of(film, bytes) == record_of(first, other->second);
  }
  if (!same) throw UserError(name + ": does not hold what films of this render hold; render it again");
}

/// Puts what `film` holds of the pixels of `whole` there.
void paste(const FilmState& film, FilmState& whole) {
  paste(film.rect, film.pixels, whole.rect, whole.pixels);
  if (!film.layers.empty()) paste(film.rect, film.layers, whole.rect, whole.layers);
  for (const auto& [name, bytes] : film.state) {
    const std::size_t record = record_of(film, bytes);
    whole.state[name].resize(whole.rect.pixels() * record);
    copy_pixels(film.rect, bytes.data(), whole.rect, whole.state[name].data(), record);
  }
}

}  // namespace

void FilmMerger::check(const std::string& name, const FilmState& film) const {
  if (film.passes.count() == 0) throw UserError(name + ": holds no pass");
  if (parts_.empty()) return;
  const std::string difference =
      difference_of(film.identity, "it", first().film.identity, "in " + first().name);
  if (!difference.empty())
    throw UserError(name + ": is of another render than " + first().name + " (" + difference +
                    "); expected films of one scene, seed and kernels, with the same options");
  for (const Part& part : parts_) {
    const File& of_part = part.files.front();
    if (of_part.film.crop != film.crop) {
      if (meet(of_part.film.crop, film.crop))
        throw UserError(name + ": its pixels " + text_of(film.crop) + " overlap those of " + of_part.name +
                        ", " + text_of(of_part.film.crop) + "; expected the same pixels or others");
      continue;
    }
    for (const File& other : part.files)
      for (const PassRange& range : film.passes.ranges())
        if (other.film.passes.meets(range))
          throw UserError(name + ": holds the passes " + text_of(film.passes) + ", and " + other.name +
                          " holds " + text_of(other.film.passes) + "; expected each pass once");
    if (!film.depends_on_history.empty())
      throw UserError(name + ": its passes cannot be added to others: " + film.depends_on_history.front());
  }
}

void FilmMerger::add(const std::string& file) {
  FilmState film = read_film_header(file);
  const std::string name = printable_line(file);
  check(name, film);
  auto part = std::find_if(parts_.begin(), parts_.end(),
                           [&](const Part& other) { return other.files.front().film.crop == film.crop; });
  if (part == parts_.end()) part = parts_.insert(parts_.end(), Part{});
  for (const PassRange& range : film.passes.ranges()) part->passes.add(range);
  part->files.push_back({file, std::move(film)});
}

FilmState FilmMerger::summary() const {
  std::vector<PixelRect> crops;
  FilmState whole = first().film;
  for (const Part& part : parts_) {
    const auto& ranges = part.passes.ranges();
    if (ranges.size() > 1)
      throw UserError("the passes " + text_of(PassRange{ranges[0].end, ranges[1].begin}) +
                      " are missing between those of the films; expected the film that holds them as well");
    if (part.passes != parts_.front().passes)
      throw UserError(part.files.front().name + ": its pixels have the passes " + text_of(part.passes) +
                      ", those of " + first().name + " have " + text_of(parts_.front().passes) +
                      "; expected crops of the same passes");
    crops.push_back(part.files.front().film.crop);
    for (const File& file : part.files)
      if (&file != &first()) add_counts(whole, file.film);
  }
  // Every crop has all photons.
  whole.photons = 0;
  for (const File& file : parts_.front().files) whole.photons += file.film.photons;
  whole.passes = parts_.front().passes;
  whole.crop = around(crops);
  whole.rect = with_margin(whole.crop, whole.width, whole.height);
  if (const std::string pixel = missing_pixel(crops, whole.crop); !pixel.empty())
    throw UserError("the pixel " + pixel + " is missing: the crops leave a gap within " +
                    text_of(whole.crop) + "; expected crops that fill a rectangle");
  return whole;
}

FilmState FilmMerger::sum_of(const Part& part) const {
  FilmState sum;
  for (const File& file : part.files) {
    FilmState film = read_film(file.name);
    if (film.passes != file.film.passes || film.crop != file.film.crop || film.identity != file.film.identity)
      throw UserError(printable_line(file.name) +
                      ": was changed meanwhile; merge again when no render writes it");
    if (&file == &part.files.front()) {
      sum = std::move(film);
      continue;
    }
    check_form(printable_line(file.name), film, sum);
    add_passes(sum, film);
  }
  return sum;
}

void FilmMerger::for_each_crop(const std::function<void(const FilmState&)>& take) const {
  for (const Part& part : parts_) take(sum_of(part));
}

FilmState FilmMerger::whole() const {
  FilmState whole = summary();
  if (parts_.size() == 1) return sum_of(parts_.front());
  for_each_crop([&](const FilmState& film) {
    check_form(first().name, film, whole.pixels.empty() ? film : whole);
    paste(film, whole);
  });
  return whole;
}

}  // namespace causticl
