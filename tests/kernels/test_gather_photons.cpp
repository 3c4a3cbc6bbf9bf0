// The end of an SPPM pass against the host: radiance by equation (7), and each pixel's statistics.
#include <cstring>

#include "film/film.hpp"
#include "kernels/gather_fixture.hpp"

using namespace causticl;

TEST_CASE("gather_photons estimates radiance by equation (7) and updates each pixel") {
  RandomInputs random(84);
  constexpr uint pixels = 500, first = 100, samples = 4;
  const Space room{{0, 0, 0}, 1};
  std::vector<Photon> photons, of_kind[PHOTON_KINDS];
  for (int i = 0; i < 60000; ++i) {
    photons.push_back(photon_at(random, room.position(random)));
    const bool indirect = random.uniform() < 0.6;
    if (indirect) photons.back().normal |= INDIRECT_PHOTON;
    of_kind[indirect ? INDIRECT_PHOTONS : FOCUSED_PHOTONS].push_back(photons.back());
  }
  const PhotonGrids grids =
      two_grids(make_grid({}, 0.2, 8, 8, 8), make_grid({}, 0.17, 16, 8, 4), photons.size());
  std::vector<VisiblePoint> visible(pixels * samples);
  std::vector<GatherPoint> points;
  for (auto& v : visible) {
    const Photon& near = photons[random.engine() % photons.size()];
    std::copy(near.position, near.position + 3, v.position);
    v.normal = near.normal;
    for (int c = 0; c < 3; ++c) {
      v.weight[c] = random.uniform() < 0.1 ? 0 : float(random.uniform());
      v.radiance[c] = float(random.uniform());
    }
    // A path that met no diffuse surface.
    if (random.uniform() < 0.2) v.weight[0] = v.weight[1] = v.weight[2] = 0;
    points.push_back({v.position[0], v.position[1], v.position[2], v.normal});
  }
  // One path went wrong: its pixel is left out of the film, and counted.
  constexpr uint broken = 17;
  visible[broken * samples].radiance[1] = NAN;

  Params params{};
  params.first_pixel = first;
  params.pixel_count = pixels;
  params.visible_points = samples;
  params.photon_flux = 0.125f;
  params.alpha = 0.7f;
  params.indirect_radius = 1.7f;
  const SortedPhotons map = sort_photons(test_device(), gather_program(), photons, grids);
  auto in = test_device().upload(visible, "visible points");
  auto counter = test_device().upload(std::vector<Counters>{{}}, "counters");
  auto no_walls = test_device().upload(std::vector<WallGrid>{{}}, "walls");

  for (const float shared_radius2 : {0.0f, 0.0144f}) {
    CAPTURE(shared_radius2);
    params.radius2 = shared_radius2;
    auto state = test_device().buffer((first + pixels) * sizeof(SppmPixel), "pixels");
    run_kernel(gather_program(), "start_pixels", first + pixels, state, cl_uint(first + pixels), 0.01f);
    auto film = test_device().buffer((first + pixels) * sizeof(FilmPixel), "film");
    test_device().clear(film, (first + pixels) * sizeof(FilmPixel));
    test_device().clear(counter, sizeof(Counters));
    run_kernel(gather_program(), "gather_photons", pixels, in, state, film, map.starts, map.sorted, counter,
               grids, params, no_walls);
    const auto out = test_device().download<FilmPixel>(film, first + pixels);
    const auto after = test_device().download<SppmPixel>(state, first + pixels);
    CHECK(test_device().download<Counters>(counter, 1)[0].non_finite == 1);

    const float radius2 = shared_radius2 > 0 ? shared_radius2 : 0.01f;
    const float wider = 1.7f * 1.7f;
    const auto focused = brute_force(points, of_kind[FOCUSED_PHOTONS], radius2);
    const auto indirect = brute_force(points, of_kind[INDIRECT_PHOTONS], radius2 * wider);
    double worst = 0, worst_radius = 0, worst_blur = 0, largest_blur = 0;
    std::size_t wrong = 0;
    for (uint i = 0; i < pixels; ++i) {
      double radiance[3] = {0, 0, 0}, kernel_bias = 0;
      std::uint64_t count = 0;
      for (uint s = 0; s < samples; ++s) {
        const VisiblePoint& v = visible[i * samples + s];
        const GatherSums &a = focused[i * samples + s], &b = indirect[i * samples + s];
        if (v.weight[0] + v.weight[1] + v.weight[2] > 0) count += a.count + b.count;
        const auto both = [&](std::uint64_t GatherSums::*sum) {
          return double(a.*sum) + double(b.*sum) / wider;
        };
        const double flux[3] = {both(&GatherSums::red), both(&GatherSums::green), both(&GatherSums::blue)};
        const double near[3] = {both(&GatherSums::near_red), both(&GatherSums::near_green),
                                both(&GatherSums::near_blue)};
        constexpr double luminance[3] = {0.2126, 0.7152, 0.0722};
        for (int c = 0; c < 3; ++c) {
          const double density = v.weight[c] * 0.125 / PHOTON_FLUX_UNIT / (M_PI * radius2);
          radiance[c] += v.radiance[c] + density * flux[c];
          kernel_bias += luminance[c] * density * (flux[c] - 4 * near[c]) / samples;
        }
      }
      largest_blur = std::max(largest_blur, std::fabs(kernel_bias));
      if (i != broken)
        worst_blur = std::max(worst_blur, std::fabs(mean_of(out[first + i].kernel_bias[0], 1) - kernel_bias));
      wrong += mean_of(out[first + i].kernel_bias[1], 1) != 0 || mean_of(out[first + i].luminance[1], 1) != 0;
      wrong += (out[first + i].missed < 0) != (count > 0);
      const SppmPixel& pixel = after[first + i];
      if (shared_radius2 > 0) {
        wrong += pixel.radius2_hi != 0.01f || pixel.photons_low != count;
      } else {
        wrong += pixel.photons_low != count;
        const double expected = 0.01f * (count ? 0.7 : 1);
        worst_radius = std::max(worst_radius, std::fabs(pixel.radius2_hi / expected - 1));
      }
      for (int c = 0; c < 3; ++c) {
        const double value = mean_of(out[first + i].radiance[c], 1);
        if (i == broken)
          wrong += value != 0;
        else
          worst = std::max(worst, std::fabs(value / (radiance[c] / samples) - 1));
      }
    }
    for (uint i = 0; i < first; ++i) wrong += out[i].radiance[0].high != 0 || after[i].radius2_hi != 0.01f;
    CHECK(wrong == 0);
    CHECK(worst < 2e-6);
    CHECK(worst_blur < 1e-5 * largest_blur);
    CHECK(worst_radius < 1e-6);
  }

  // The count that chooses the first radius.
  params.radius2 = 0.01f;
  auto out = test_device().buffer(pixels * samples * sizeof(cl_uint), "counts");
  run_kernel(gather_program(), "count_around", pixels * samples, in, map.starts, map.sorted, out, grids,
             params);
  const auto counts = test_device().download<uint>(out, pixels * samples);
  const auto focused = brute_force(points, of_kind[FOCUSED_PHOTONS], 0.01f);
  const auto indirect = brute_force(points, of_kind[INDIRECT_PHOTONS], 0.01f * (1.7f * 1.7f));
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const VisiblePoint& v = visible[i];
    const bool diffuse = v.weight[0] + v.weight[1] + v.weight[2] > 0;
    wrong +=
        counts[i] !=
        (diffuse ? static_cast<uint>(focused[i].count + indirect[i].count / (1.7 * 1.7) + 0.5) : 0xffffffffu);
  }
  CHECK(wrong == 0);
}
