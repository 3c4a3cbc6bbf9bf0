#include "film/film.hpp"

#include <cmath>
#include <numeric>

#include "accuracy/error_estimate.hpp"
#include "shared/effects.h"

namespace causticl {
namespace {

/// The number of estimates that a pixel's mean is over.
std::uint64_t estimates_of(const FilmPixel& pixel, const PassSet& passes) {
  const std::uint64_t left_out = std::uint64_t{pixel.left_out[0]} + pixel.left_out[1], all = passes.count();
  return all > left_out ? all - left_out : 1;
}

std::size_t record_bytes(bool layers) { return sizeof(FilmPixel) + (layers ? sizeof(FilmLightPasses) : 0); }

}  // namespace

double mean_of(const ExactSum& sum, std::uint64_t count) {
  const long double units = std::ldexp(static_cast<long double>(sum.high), EXACT_SUM_BITS) +
                            static_cast<long double>(exact_sum_low(sum));
  const int exponent = EXACT_SUM_BITS * (exact_sum_bin(sum) - 1) - EXACT_SUM_UNIT;
  return static_cast<double>(std::ldexp(units / static_cast<long double>(count), exponent));
}

std::size_t look_stride(const PixelRect& crop, std::size_t most) {
  std::size_t stride = (crop.pixels() + most - 1) / most;
  while (stride > 1 && std::gcd(stride, static_cast<std::size_t>(crop.width())) != 1) ++stride;
  return stride;
}

Film::Film(Device& device, Programs& programs, int width, int height, const PixelRect& crop, bool even)
    : device_(device),
      crop_(crop),
      rect_(with_margin(crop, width, height)),
      even_(even),
      programs_(programs),
      pixels_(device.buffer(pixels() * record_bytes(has_layers()), "film")) {
  device_.clear(pixels_, pixels() * record_bytes(has_layers()));
}

bool Film::has_layers() const { return (programs_.options().effects & OUTPUT_LIGHT_PASSES) != 0; }

void Film::take_pixels(Film& from, std::size_t first, std::size_t count) {
  const auto take = [&](std::size_t begin, std::size_t bytes) {
    if (bytes == 0) return;
    const auto data = from.device_.download<std::byte>(from.pixels_, bytes, begin);
    device_.queue().enqueueWriteBuffer(pixels_, CL_TRUE, begin, bytes, data.data());
  };
  take(first * sizeof(FilmPixel), count * sizeof(FilmPixel));
  if (has_layers())
    take(pixels() * sizeof(FilmPixel) + first * sizeof(FilmLightPasses), count * sizeof(FilmLightPasses));
}

void Film::set_pixels(Params& params) const {
  params.crop_x = static_cast<uint>(rect_.x0);
  params.crop_y = static_cast<uint>(rect_.y0);
  params.crop_width = rect_.width() == static_cast<int>(params.width) ? 0 : static_cast<uint>(rect_.width());
  params.crop_height =
      rect_.height() == static_cast<int>(params.height) ? 0 : static_cast<uint>(rect_.height());
}

std::vector<PixelError> Film::errors() { return errors(crop_.pixels(), even_); }

void Film::save(FilmState& state) {
  if (complete_) complete_();
  state.crop = crop_;
  state.rect = rect_;
  state.passes = passes_;
  state.even = even_;
  state.photons_stored = photons_stored_;
  state.pixels = device_.download<FilmPixel>(pixels_, pixels());
  state.layers.clear();
  if (has_layers())
    state.layers = device_.download<FilmLightPasses>(pixels_, pixels(), pixels() * sizeof(FilmPixel));
}

void Film::restore(const FilmState& state) {
  passes_ = state.passes;
  photons_stored_ = state.photons_stored;
  const auto put = [&](const auto& records, std::size_t at) {
    if (!records.empty())
      device_.queue().enqueueWriteBuffer(pixels_, CL_TRUE, at, records.size() * sizeof(records[0]),
                                         records.data());
  };
  put(state.pixels, 0);
  put(state.layers, pixels() * sizeof(FilmPixel));
}

Picture Film::picture() {
  if (complete_) complete_();
  const auto film = cropped(device_.download<FilmPixel>(pixels_, pixels()));
  Picture picture{crop_.width(), crop_.height(), std::vector<float>(3 * film.size())};
  for (std::size_t i = 0; i < film.size(); ++i) {
    const std::uint64_t estimates = estimates_of(film[i], passes_);
    for (int c = 0; c < 3; ++c)
      picture.rgb[3 * i + c] = static_cast<float>(mean_of(film[i].radiance[c], estimates));
  }
  return picture;
}

void append_errors(std::vector<Channel>& channels, const std::vector<PixelError>& errors) {
  for (const auto& kind : pixel_error_kinds) {
    Channel channel{kind.channel, {}};
    for (const auto& error : errors) channel.values.push_back(error.*kind.value);
    channels.push_back(std::move(channel));
  }
}

std::vector<Channel> layer_channels(std::size_t pixels) {
  std::vector<Channel> channels;
  for (const char* layer : {"direct", "caustic", "indirect"})  // LIGHT_PASS_* of cl/shared/pixel_records.h
    for (const char* color : {".R", ".G", ".B"})
      channels.push_back({std::string(layer) + color, std::vector<float>(pixels)});
  return channels;
}

std::vector<Channel> Film::layers() {
  if (complete_) complete_();
  const auto film = cropped(device_.download<FilmPixel>(pixels_, pixels()));
  const auto layers =
      cropped(device_.download<FilmLightPasses>(pixels_, pixels(), pixels() * sizeof(FilmPixel)));
  auto channels = layer_channels(film.size());
  for (std::size_t i = 0; i < film.size(); ++i) {
    const std::uint64_t estimates = estimates_of(film[i], passes_);
    for (std::size_t k = 0; k < channels.size(); ++k)
      channels[k].values[i] = static_cast<float>(mean_of(layers[i].radiance[k / 3][k % 3], estimates));
  }
  return channels;
}

std::vector<PixelError> Film::errors(std::size_t most, bool even) {
  if (complete_) complete_();
  const std::size_t stride = look_stride(crop_, most), count = (crop_.pixels() + stride - 1) / stride;
  if (errors_capacity_ < count) {
    errors_ = device_.buffer(count * sizeof(PixelError), "errors of pixels");
    errors_capacity_ = count;
  }
  if (!pixel_errors_()) {
    statistics_ = device_.buffer(pixels() * sizeof(PixelStatistics), "errors of pixels");
    found_ = device_.buffer(sizeof(cl_uint), "errors of pixels");
    film_statistics_ = programs_.kernel("film", "film_statistics");
    pixel_errors_ = programs_.kernel("film", "pixel_errors");
  }
  const auto number = [](std::size_t value) { return static_cast<cl_uint>(value); };
  const uint2 halves = passes_.halves();
  const cl_uint found = photons_stored_ ? 0 : 1;
  device_.queue().enqueueWriteBuffer(found_, CL_TRUE, 0, sizeof found, &found);
  set_arguments(film_statistics_, pixels_, statistics_, found_, cl_uint2{{halves.x, halves.y}},
                number(pixels()));
  device_.launch_pass(film_statistics_, pixels());
  const cl_uint2 size{{number(rect_.width()), number(rect_.height())}};
  const cl_uint4 part{{number(crop_.x0 - rect_.x0), number(crop_.y0 - rect_.y0), number(crop_.width()),
                       number(crop_.height())}};
  set_arguments(pixel_errors_, statistics_, errors_, found_, size, part, number(stride), number(count),
                number(even));
  device_.launch_pass(pixel_errors_, count);
  return device_.download<PixelError>(errors_, count);
}

}  // namespace causticl
