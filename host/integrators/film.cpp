#include "integrators/film.hpp"

#include <algorithm>
#include <numeric>

#include "accuracy/error_estimate.hpp"
#include "shared/effects.h"

namespace causticl {
namespace {

/// 1 / the number of estimates that the pixel's mean is over.
double scale_of(const FilmPixel& pixel, std::uint64_t passes) {
  return 1.0 / static_cast<double>(std::max<std::uint64_t>(passes, pixel.left_out + 1ull) - pixel.left_out);
}

float mean_of(float sum, float low, double scale) {
  return static_cast<float>(scale * (static_cast<double>(sum) + low));
}

}  // namespace

Film::Film(Device& device, Programs& programs, int width, int height, bool even)
    : device_(device),
      width_(width),
      height_(height),
      even_(even),
      programs_(programs),
      pixels_(device.buffer(pixels() * bytes_per_pixel(), "film")) {
  device_.clear(pixels_, pixels() * bytes_per_pixel());
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

Picture Film::picture(std::uint64_t passes) {
  if (complete_) complete_();
  const auto sums = device_.download<FilmPixel>(pixels_, pixels());
  Picture picture{width_, height_, std::vector<float>(3 * pixels())};
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double scale = scale_of(sums[i], passes);
    for (int c = 0; c < 3; ++c) picture.rgb[3 * i + c] = mean_of(sums[i].sum[c], sums[i].low[c], scale);
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

std::vector<Channel> Film::layers(std::uint64_t passes) {
  if (complete_) complete_();
  const auto sums = device_.download<FilmPixel>(pixels_, pixels());
  const auto layers = device_.download<FilmLightPasses>(pixels_, pixels(), pixels() * sizeof(FilmPixel));
  auto channels = layer_channels(pixels());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double scale = scale_of(sums[i], passes);
    for (std::size_t k = 0; k < channels.size(); ++k)
      channels[k].values[i] = mean_of(layers[i].sum[k / 3][k % 3], layers[i].low[k / 3][k % 3], scale);
  }
  return channels;
}

std::vector<PixelError> Film::errors(std::uint64_t passes, std::size_t most, bool even) {
  if (complete_) complete_();
  // A stride that shares no factor with the width visits all columns.
  std::size_t stride = (pixels() + most - 1) / most;
  while (stride > 1 && std::gcd(stride, static_cast<std::size_t>(width_)) != 1) ++stride;
  const std::size_t count = (pixels() + stride - 1) / stride;
  if (errors_capacity_ < count) {
    errors_ = device_.buffer(count * sizeof(PixelError), "errors of pixels");
    errors_capacity_ = count;
  }
  if (!pixel_errors_()) pixel_errors_ = programs_.kernel("film", "pixel_errors");
  set_arguments(pixel_errors_, pixels_, errors_, static_cast<cl_uint>(width_), static_cast<cl_uint>(height_),
                static_cast<cl_uint>(passes), static_cast<cl_uint>(stride), static_cast<cl_uint>(count),
                static_cast<cl_uint>(even));
  device_.launch_pass(pixel_errors_, count);
  return device_.download<PixelError>(errors_, count);
}

}  // namespace causticl
