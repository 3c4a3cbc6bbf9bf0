// The format: a line "causticl film VERSION", the length of what follows as eight bytes, a JSON object that
// says what the film is and lists its blocks, the checksum (XXH3, 128 bits) of all that, and the blocks, each
// with its checksum in the list. Numbers are little-endian.
#include "film/film_file.hpp"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include <unistd.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "base/error.hpp"
#include "base/input_file.hpp"
#include "base/output_file.hpp"
#include "base/printable.hpp"

namespace causticl {
namespace {

static_assert(std::endian::native == std::endian::little, "film files hold numbers as the machine does");

using Json = nlohmann::ordered_json;

const std::string film_text = "a film as `causticl render --film` writes it";
const std::string magic = "causticl film ";
constexpr int version = 1;
constexpr int largest_edge = 65536;

std::string checksum_text(const void* data, std::size_t size) {
  const XXH128_hash_t hash = XXH3_128bits(data, size);
  char text[33];
  std::snprintf(text, sizeof text, "%016llx%016llx", static_cast<unsigned long long>(hash.high64),
                static_cast<unsigned long long>(hash.low64));
  return text;
}

using Bytes = std::string_view;

template <typename Record>
Bytes bytes_of(const std::vector<Record>& records) {
  return {reinterpret_cast<const char*>(records.data()), records.size() * sizeof(Record)};
}

/// The blocks of a film, by name.
std::vector<std::pair<std::string, Bytes>> blocks_of(const FilmState& film) {
  std::vector<std::pair<std::string, Bytes>> blocks{{"film.pixels", bytes_of(film.pixels)}};
  if (!film.layers.empty()) blocks.emplace_back("film.layers", bytes_of(film.layers));
  for (const auto& [name, bytes] : film.state) blocks.emplace_back(name, bytes_of(bytes));
  return blocks;
}

Json json_of(const PixelRect& rect) { return {rect.x0, rect.y0, rect.x1, rect.y1}; }

/// Throws where it does not lie within `outer`.
PixelRect rect_of(const Json& json, const PixelRect& outer) {
  const PixelRect rect{json.at(0).get<int>(), json.at(1).get<int>(), json.at(2).get<int>(),
                       json.at(3).get<int>()};
  if (rect.x0 < outer.x0 || rect.x0 >= rect.x1 || rect.x1 > outer.x1 || rect.y0 < outer.y0 ||
      rect.y0 >= rect.y1 || rect.y1 > outer.y1)
    throw std::out_of_range("rect");
  return rect;
}

Json header_of(const FilmState& film) {
  Json header;
  for (const auto& [name, value] : film.identity) header["identity"].push_back({name, value});
  header["width"] = film.width;
  header["height"] = film.height;
  header["crop"] = json_of(film.crop);
  header["rect"] = json_of(film.rect);
  header["passes"] = Json::array();
  for (const PassRange& range : film.passes.ranges()) header["passes"].push_back({range.begin, range.end});
  header["even"] = film.even;
  header["photons_stored"] = film.photons_stored;
  header["depends_on_history"] = film.depends_on_history;
  header["devices"] = film.devices;
  header["photons"] = film.photons;
  header["rays"] = film.rays;
  header["seconds"] = film.seconds;
  header["diagnostics"] = film.diagnostics;
  header["blocks"] = Json::array();
  for (const auto& [name, bytes] : blocks_of(film))
    header["blocks"].push_back(
        {{"name", name}, {"bytes", bytes.size()}, {"xxh128", checksum_text(bytes.data(), bytes.size())}});
  return header;
}

/// Reads pieces of a file's bytes one after the other; false where they end.
class Reader {
 public:
  explicit Reader(Bytes bytes) : left_(bytes) {}
  bool take(std::size_t count, Bytes& piece) {
    if (count > left_.size()) return false;
    piece = left_.substr(0, count);
    left_.remove_prefix(count);
    return true;
  }
  bool at_end() const { return left_.empty(); }

 private:
  Bytes left_;
};

[[noreturn]] void damaged(const std::string& file) {
  throw UserError(printable_line(file) + ": is damaged or cut off; expected " + film_text +
                  ". Take another copy or render it again");
}

template <typename Record>
std::vector<Record> records_of(Bytes bytes, std::size_t count) {
  if (bytes.size() != count * sizeof(Record)) throw std::length_error("records");
  std::vector<Record> records(count);
  std::memcpy(records.data(), bytes.data(), bytes.size());
  return records;
}

PassSet passes_of(const Json& ranges) {
  // Parts with gaps between them; more of them are no work of a person.
  constexpr std::size_t most_ranges = 1024;
  if (!ranges.is_array() || ranges.size() > most_ranges) throw std::out_of_range("passes");
  PassSet passes;
  for (const auto& range : ranges) {
    const PassRange next{range.at(0).get<std::uint64_t>(), range.at(1).get<std::uint64_t>()};
    if (next.begin >= next.end || next.end > std::numeric_limits<std::int32_t>::max() || passes.meets(next))
      throw std::out_of_range("passes");
    passes.add(next);
  }
  return passes;
}

std::uint64_t count_of(const Json& number) {
  if (!number.is_number_unsigned()) throw std::out_of_range("count");
  return number.get<std::uint64_t>();
}

/// All but the blocks. Throws where something is missing or makes no sense.
FilmState state_of(const Json& header) {
  FilmState film;
  for (const auto& entry : header.at("identity"))
    film.identity.emplace_back(entry.at(0).get<std::string>(), entry.at(1).get<std::string>());
  const std::uint64_t width = count_of(header.at("width")), height = count_of(header.at("height"));
  if (width > largest_edge || height > largest_edge) throw std::out_of_range("size");
  film.width = static_cast<int>(width);
  film.height = static_cast<int>(height);
  film.rect = rect_of(header.at("rect"), {0, 0, film.width, film.height});
  film.crop = rect_of(header.at("crop"), film.rect);
  if (film.rect != with_margin(film.crop, film.width, film.height)) throw std::out_of_range("rect");
  film.passes = passes_of(header.at("passes"));
  header.at("even").get_to(film.even);
  header.at("photons_stored").get_to(film.photons_stored);
  header.at("depends_on_history").get_to(film.depends_on_history);
  header.at("devices").get_to(film.devices);
  film.photons = count_of(header.at("photons"));
  film.rays = count_of(header.at("rays"));
  header.at("seconds").get_to(film.seconds);
  if (!(film.seconds >= 0 && film.seconds < 1e12)) throw std::out_of_range("seconds");
  header.at("diagnostics").get_to(film.diagnostics);
  return film;
}

void read_blocks(const Json& list, Reader& reader, FilmState& film) {
  for (const auto& entry : list) {
    Bytes bytes;
    const std::string name = entry.at("name").get<std::string>();
    if (!reader.take(entry.at("bytes").get<std::size_t>(), bytes) ||
        checksum_text(bytes.data(), bytes.size()) != entry.at("xxh128").get<std::string>())
      throw std::length_error("blocks");
    if (name == "film.pixels")
      film.pixels = records_of<FilmPixel>(bytes, film.rect.pixels());
    else if (name == "film.layers")
      film.layers = records_of<FilmLightPasses>(bytes, film.rect.pixels());
    else
      film.state[name] = records_of<std::byte>(bytes, bytes.size());
  }
  if (film.pixels.empty() || !reader.at_end()) throw std::length_error("blocks");
  if (!sums_fit(film)) throw std::out_of_range("sums");
}

/// The version that the first line of `bytes` says, which is taken off; none where that is no film's.
std::optional<int> version_of(Reader& reader) {
  Bytes piece;
  if (!reader.take(magic.size(), piece) || piece != magic) return {};
  int number = 0;
  for (int digits = 0; digits < 6; ++digits) {
    if (!reader.take(1, piece)) return {};
    if (piece[0] == '\n' && digits > 0) return number;
    if (piece[0] < '0' || piece[0] > '9') return {};
    number = 10 * number + (piece[0] - '0');
  }
  return {};
}

constexpr std::uint64_t longest_header = 1 << 24;

/// Takes the header from `reader`, which is at the first of `bytes`. Throws UserError where there is none.
Json header_of_bytes(const std::string& file, Bytes bytes, Reader& reader) {
  const auto found = version_of(reader);
  if (!found) throw UserError(printable_line(file) + ": is no film; expected " + film_text);
  if (*found != version)
    throw UserError(printable_line(file) + ": is a film of version " + std::to_string(*found) +
                    ", which this causticl does not read; expected version " + std::to_string(version) +
                    ". Use the causticl that wrote it");
  Bytes piece, header, sum;
  std::uint64_t length = 0;
  if (!reader.take(sizeof length, piece)) damaged(file);
  std::memcpy(&length, piece.data(), sizeof length);
  const std::size_t begin = magic.size() + std::to_string(version).size() + 1 + sizeof length;
  if (length > longest_header || !reader.take(static_cast<std::size_t>(length), header) ||
      !reader.take(32, sum) || checksum_text(bytes.data(), begin + header.size()) != sum)
    damaged(file);
  return Json::parse(header);
}

}  // namespace

std::string film_bytes(const std::string& header, std::string_view blocks) {
  const std::uint64_t length = header.size();
  std::string bytes = magic + std::to_string(version) + "\n";
  bytes.append(reinterpret_cast<const char*>(&length), sizeof length);
  bytes += header;
  bytes += checksum_text(bytes.data(), bytes.size());
  bytes += blocks;
  return bytes;
}

void write_film(const std::string& file, const FilmState& film) {
  const std::string begin = film_bytes(header_of(film).dump(), "");
  std::vector<Bytes> pieces{begin};
  for (const auto& [name, bytes] : blocks_of(film)) pieces.push_back(bytes);
  write_file_synced(file, pieces);
}

FilmState read_film(const std::string& file) {
  return film_of_bytes(file, read_input(file, film_text, std::numeric_limits<std::int64_t>::max()));
}

FilmState read_film_header(const std::string& file) {
  const InputFile input = open_input(file, film_text);
  std::string begin(static_cast<std::size_t>(std::min(input.size, longest_header + 1024)), '\0');
  for (std::size_t done = 0; done < begin.size();) {
    const ssize_t count = read(input.descriptor.get(), begin.data() + done, begin.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) damaged(file);
    done += static_cast<std::size_t>(count);
  }
  Reader reader(begin);
  try {
    return state_of(header_of_bytes(file, begin, reader));
  } catch (const nlohmann::json::exception&) {
    damaged(file);
  } catch (const std::out_of_range&) {
    damaged(file);
  }
}

FilmState film_of_bytes(const std::string& file, std::string_view bytes) {
  Reader reader(bytes);
  try {
    const Json header = header_of_bytes(file, bytes, reader);
    FilmState film = state_of(header);
    read_blocks(header.at("blocks"), reader, film);
    return film;
  } catch (const nlohmann::json::exception&) {
    damaged(file);
  } catch (const std::out_of_range&) {
    damaged(file);
  } catch (const std::length_error&) {
    damaged(file);
  }
}

bool is_film(const std::string& file) {
  try {
    const InputFile input = open_input(file, "a film");
    std::string begin(magic.size(), '\0');
    return read(input.descriptor.get(), begin.data(), begin.size()) == static_cast<ssize_t>(begin.size()) &&
           begin == magic;
  } catch (const UserError&) {
    return false;
  }
}

}  // namespace causticl
