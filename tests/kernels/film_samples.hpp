// Films of given estimates, on the test device.
#pragma once

#include <vector>

#include "device_fixture.hpp"
#include "film/film.hpp"

namespace causticl {

/// Adds as many estimates to each of `pixels` pixels, radiance in xyz and kernel bias in w, pixel after
/// pixel.
inline std::vector<FilmPixel> add_samples(const std::vector<float4>& samples, uint pixels,
                                          Counters& counters) {
  auto program = build_test_program(R"(
#include "film/film.cl"
kernel void add_samples(global const float4 *samples, global FilmPixel *film, volatile global Counters *counters,
                        uint pixels, uint count) {
  uint i = get_global_id(0);
  if (i >= pixels) return;
  for (uint n = 0; n < count; ++n) film_add(film + i, samples[i * count + n].xyz, samples[i * count + n].w, n, counters);
}
)");
  auto film = test_device().upload(std::vector<FilmPixel>(pixels), "film");
  auto counter = test_device().upload(std::vector<Counters>(1), "counters");
  run_kernel(program, "add_samples", pixels, test_device().upload(samples, "samples"), film, counter, pixels,
             static_cast<uint>(samples.size() / pixels));
  counters = test_device().download<Counters>(counter, 1)[0];
  return test_device().download<FilmPixel>(film, pixels);
}

/// What such a film tells of its pixels after the first `passes` passes; *found as film_statistics() leaves
/// it.
inline std::vector<PixelStatistics> statistics_of(const std::vector<FilmPixel>& film, uint passes,
                                                  uint* found = nullptr) {
  auto program = build_test_program("#include \"passes/pass_film.cl\"\n");
  const uint2 halves = PassSet({0, passes}).halves();
  const uint pixels = static_cast<uint>(film.size());
  auto statistics = test_device().buffer(pixels * sizeof(PixelStatistics), "statistics");
  auto any_found = test_device().upload(std::vector<uint>{0}, "found");
  run_kernel(program, "film_statistics", pixels, test_device().upload(film, "film"), statistics, any_found,
             cl_uint2{{halves.x, halves.y}}, pixels);
  if (found) *found = test_device().download<uint>(any_found, 1)[0];
  return test_device().download<PixelStatistics>(statistics, pixels);
}

}  // namespace causticl
