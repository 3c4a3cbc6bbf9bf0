// The layers of a picture: which one a path belongs to, and their sums.
#include <cmath>
#include <limits>
#include <regex>

#include "film/film.hpp"
#include "selftest/photon_grid.hpp"
#include "vector_inputs.hpp"

using namespace causticl;

namespace {

constexpr unsigned with_layers = EFFECT_ALL | OUTPUT_LIGHT_PASSES;

/// By the regular expressions of light_passes.cl, for a path from the camera E to the light L.
uint layer_of(const std::string& path) {
  static const std::regex direct("ES*D?L"), caustic("ES*DS+L");
  if (std::regex_match(path, direct)) return LIGHT_PASS_DIRECT;
  return std::regex_match(path, caustic) ? LIGHT_PASS_CAUSTIC : LIGHT_PASS_INDIRECT;
}

/// Photons of a surface and of the medium alike: their normals are directions there.
std::vector<Photon> random_photons(RandomInputs& random, std::size_t count, bool in_medium) {
  std::vector<Photon> photons;
  for (std::size_t i = 0; i < count; ++i) {
    Photon photon{{},
                  pack_normal({0, 1, 0}),
                  static_cast<uint>(random.engine()),
                  static_cast<uint>(random.engine()) & 0xffffu};
    for (float& x : photon.position) x = static_cast<float>(random.uniform(-1, 1));
    if (in_medium) photon.normal = IN_MEDIUM | (static_cast<uint>(random.engine()) & 0x3fffffffu);
    photon.flux_b |= static_cast<uint>(random.engine() % LIGHT_PASS_COUNT) << PHOTON_LIGHT_PASS_SHIFT;
    photons.push_back(photon);
  }
  return photons;
}

/// Those of one layer, without its mark.
std::vector<Photon> of_layer(const std::vector<Photon>& photons, uint layer) {
  std::vector<Photon> result;
  for (Photon photon : photons) {
    if (photon.flux_b >> PHOTON_LIGHT_PASS_SHIFT != layer) continue;
    photon.flux_b &= 0xffffu;
    result.push_back(photon);
  }
  return result;
}

}  // namespace

TEST_CASE("the layer of every path of up to ten vertices is that of its regular expression") {
  auto program = build_test_program(R"(
#include "film/light_passes.cl"
// Bit k of a path is 1 where vertex k is specular. layers: of the path from the camera; of the photon that comes the
// other way and lands on its first vertex that is not specular, where there is one.
kernel void classify(global const uint2 *paths, global uint2 *layers, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  uint bits = paths[i].x, length = paths[i].y, prefix = PREFIX_NO_DIFFUSE, diffuse_vertex = 0;
  for (uint k = 0; k < length; ++k) prefix = prefix_after(prefix, bits >> k & 1u);
  layers[i].x = prefix_light_pass(prefix);
  while (diffuse_vertex < length && (bits >> diffuse_vertex & 1u)) ++diffuse_vertex;
  prefix = PREFIX_DIRECT;
  for (uint k = length; k > diffuse_vertex + 1; --k) prefix = prefix_after(prefix, bits >> (k - 1) & 1u);
  layers[i].y = prefix_light_pass(prefix);
}
)");
  std::vector<uint2> paths;
  for (uint length = 0; length <= 10; ++length)
    for (uint bits = 0; bits < 1u << length; ++bits) paths.push_back({bits, length});
  const auto in = test_device().upload(paths, "paths"),
             out = test_device().buffer(paths.size() * sizeof(uint2), "layers");
  run_kernel(program, "classify", paths.size(), in, out, static_cast<uint>(paths.size()));
  const auto layers = test_device().download<uint2>(out, paths.size());
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    std::string path = "E";
    for (uint k = 0; k < paths[i].y; ++k) path += paths[i].x >> k & 1u ? 'S' : 'D';
    const uint expected = layer_of(path + "L");
    wrong += layers[i].x != expected;
    if (path.find('D') != std::string::npos) wrong += layers[i].y != expected;
  }
  CHECK(wrong == 0);
}

TEST_CASE("photons of each layer are gathered as if there were no others") {
  RandomInputs random(241);
  auto program = build_test_program(R"(
#include "passes/pass_grid.cl"
#include "photons/gather.cl"
kernel void collect(global const float4 *points, global const uint *starts, global const PhotonBlock *sorted,
                    global ulong4 *sums, Grid grid, float radius2, uint in_medium, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  real3 up = (real3)(0, 1, 0), point = convert_real3(points[i].xyz);
  MediumSegment segment = {point, up, 0, 0, (real3)(0.1f, 0.2f, 0.3f), 0.4f};
  Gathered sum = in_medium ? gather_medium(grid, starts, sorted, segment, 0.5f, radius2)
                           : gather(grid, starts, sorted, point, normal_pack(up), radius2);
  sums[3 * i] = (ulong4)(sum.red, sum.green, sum.blue, sum.count);
  sums[3 * i + 1] = (ulong4)(sum.direct_red, sum.direct_green, sum.direct_blue, 0);
  sums[3 * i + 2] = (ulong4)(sum.caustic_red, sum.caustic_green, sum.caustic_blue, 0);
}
)",
                                    with_layers);
  struct Sums {
    std::uint64_t all[4], direct[4], caustic[4];
  };
  std::vector<float4> points(512);
  for (auto& p : points)
    p = {float(random.uniform(-1, 1)), float(random.uniform(-1, 1)), float(random.uniform(-1, 1)), 0};
  const auto in = test_device().upload(points, "points");
  const uint count = static_cast<uint>(points.size());
  const auto collect = [&](const std::vector<Photon>& photons, bool in_medium) {
    const Grid grid = make_grid({}, 0.2, 16, 16, 16);
    const SortedPhotons map = sort_photons(test_device(), program, photons, one_grid(grid, photons.size()));
    auto out = test_device().buffer(points.size() * sizeof(Sums), "sums");
    run_kernel(program, "collect", points.size(), in, map.starts, map.sorted, out, grid, 0.01f,
               cl_uint(in_medium), count);
    return test_device().download<Sums>(out, points.size());
  };
  for (const bool in_medium : {false, true}) {
    const auto photons = random_photons(random, 50000, in_medium);
    const auto sums = collect(photons, in_medium);
    const auto direct = collect(of_layer(photons, LIGHT_PASS_DIRECT), in_medium);
    const auto caustic = collect(of_layer(photons, LIGHT_PASS_CAUSTIC), in_medium);
    const auto indirect = collect(of_layer(photons, LIGHT_PASS_INDIRECT), in_medium);
    std::uint64_t found = 0;
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      found += sums[i].all[3];
      wrong += sums[i].all[3] != direct[i].all[3] + caustic[i].all[3] + indirect[i].all[3];
      for (int c = 0; c < 3; ++c) {
        wrong += sums[i].direct[c] != direct[i].all[c] || sums[i].caustic[c] != caustic[i].all[c];
        wrong += sums[i].all[c] - sums[i].direct[c] - sums[i].caustic[c] != indirect[i].all[c];
      }
    }
    CAPTURE(in_medium);
    CHECK(found > 5000);
    CHECK(wrong == 0);
  }
}

TEST_CASE("the film has the layers of visible points and of photons by their weights") {
  RandomInputs random(242);
  constexpr uint pixels = 300, first = 50, samples = 4;
  auto program = build_test_program(gather_source, with_layers);
  const auto photons = random_photons(random, 10000, false);
  const Grid grid = make_grid({}, 0.2, 8, 8, 8);
  const SortedPhotons map = sort_photons(test_device(), program, photons, one_grid(grid, photons.size()));

  // Of a launch: visible points, then their layers.
  std::vector<VisiblePoint> visible(pixels * samples);
  std::vector<VisibleLightPasses> layers(visible.size());
  for (std::size_t i = 0; i < visible.size(); ++i) {
    VisiblePoint& v = visible[i];
    v.normal = pack_normal({0, 1, 0}) | (random.uniform() < 0.3 ? BEYOND_DIFFUSE : 0u);
    for (int c = 0; c < 3; ++c) {
      v.position[c] = static_cast<float>(random.uniform(-1, 1));
      v.weight[c] = static_cast<float>(random.uniform());
      for (auto& layer : layers[i].radiance) {
        layer[c] = static_cast<float>(random.uniform());
        v.radiance[c] += layer[c];
      }
    }
  }
  constexpr uint broken = 17;
  visible[broken * samples].radiance[1] = NAN;
  const std::size_t bytes = visible.size() * sizeof(VisiblePoint);
  std::vector<unsigned char> launch(bytes + layers.size() * sizeof(VisibleLightPasses));
  std::memcpy(launch.data(), visible.data(), bytes);
  std::memcpy(launch.data() + bytes, layers.data(), launch.size() - bytes);

  Params params{};
  params.width = first + pixels;
  params.height = 1;
  params.first_pixel = first;
  params.pixel_count = pixels;
  params.visible_points = samples;
  params.photon_flux = 0.125f;
  params.indirect_radius = 1;
  params.radius2 = 0.0144f;
  auto in = test_device().upload(launch, "visible points");
  auto counter = test_device().upload(std::vector<Counters>{{}}, "counters");
  auto state = test_device().upload(std::vector<SppmPixel>(first + pixels), "pixels");
  const std::size_t film_bytes = (first + pixels) * (sizeof(FilmPixel) + sizeof(FilmLightPasses));
  auto film = test_device().buffer(film_bytes, "film");
  test_device().clear(film, film_bytes);
  run_kernel(program, "gather_photons", pixels, in, state, film, map.starts, map.sorted, counter,
             one_grid(grid, photons.size()), params,
             test_device().upload(std::vector<WallGrid>{{}}, "walls"));
  const auto sums =
      test_device().download<FilmLightPasses>(film, first + pixels, (first + pixels) * sizeof(FilmPixel));
  const auto whole = test_device().download<FilmPixel>(film, first + pixels);

  const std::vector<Photon> apart[] = {of_layer(photons, LIGHT_PASS_DIRECT),
                                       of_layer(photons, LIGHT_PASS_CAUSTIC),
                                       of_layer(photons, LIGHT_PASS_INDIRECT)};
  double worst = 0, worst_sum = 0;
  std::size_t wrong = 0;
  for (uint i = 0; i < pixels; ++i) {
    double expected[LIGHT_PASS_COUNT][3] = {};
    for (uint s = 0; s < samples; ++s) {
      const VisiblePoint& v = visible[i * samples + s];
      for (uint layer = 0; layer < LIGHT_PASS_COUNT; ++layer) {
        const auto found = gather_brute_force({v.position[0], v.position[1], v.position[2], v.normal},
                                              apart[layer], params.radius2);
        const std::uint64_t flux[3] = {found.red, found.green, found.blue};
        for (int c = 0; c < 3; ++c) {
          expected[layer][c] += layers[i * samples + s].radiance[layer][c] / samples;
          expected[v.normal & BEYOND_DIFFUSE ? LIGHT_PASS_INDIRECT : layer][c] +=
              v.weight[c] * 0.125 / PHOTON_FLUX_UNIT / (M_PI * params.radius2) * double(flux[c]) / samples;
        }
      }
    }
    for (int c = 0; c < 3; ++c) {
      double total = 0;
      for (uint layer = 0; layer < LIGHT_PASS_COUNT; ++layer) {
        const double value = mean_of(sums[first + i].radiance[layer][c], 1);
        if (i == broken)
          wrong += value != 0;
        else
          worst = std::max(worst, std::fabs(value / expected[layer][c] - 1));
        total += value;
      }
      if (i != broken)
        worst_sum = std::max(worst_sum, std::fabs(total / mean_of(whole[first + i].radiance[c], 1) - 1));
    }
  }
  for (uint i = 0; i < first; ++i) wrong += sums[i].radiance[0][0].high != 0;
  CHECK(wrong == 0);
  CHECK(worst < 2e-6);
  CHECK(worst_sum < 1e-6);
}

TEST_CASE("the film's sums of layers are exact over many passes, of those estimates that count") {
  RandomInputs random(243);
  auto program = build_test_program(R"(
#include "film/film.cl"
kernel void add_many(global const float *samples, global FilmPixel *film, volatile global Counters *counters,
                     uint pixels, uint passes) {
  uint i = get_global_id(0);
  if (i >= pixels) return;
  for (uint n = 0; n < passes; ++n) {
    Radiance radiance = radiance_none();
    global const float *s = samples + (i * passes + n) * 3 * LIGHT_PASS_COUNT;
    for (uint k = 0; k < LIGHT_PASS_COUNT; ++k) {
      radiance.layer[k] = convert_real3(vload3(k, s));
      radiance.sum += radiance.layer[k];
    }
    film_add_radiance(film, i, pixels, &radiance, 0, n, counters);
  }
}
)",
                                    with_layers);
  constexpr uint pixels = 16, passes = 20000, numbers = 3 * LIGHT_PASS_COUNT;
  std::vector<float> samples(std::size_t{pixels} * passes * numbers);
  std::vector<long double> expected(pixels * numbers);
  uint bad = 0;
  for (uint estimate = 0; estimate < pixels * passes; ++estimate) {
    float* sample = samples.data() + std::size_t{estimate} * numbers;
    for (uint k = 0; k < numbers; ++k) sample[k] = static_cast<float>(std::pow(10, random.uniform(-6, 3)));
    if (random.uniform() < 0.01) {
      sample[random.engine() % numbers] = std::numeric_limits<float>::infinity();
      ++bad;
      continue;
    }
    for (uint k = 0; k < numbers; ++k) expected[estimate / passes * numbers + k] += sample[k];
  }
  auto in = test_device().upload(samples, "samples");
  const std::size_t bytes = pixels * (sizeof(FilmPixel) + sizeof(FilmLightPasses));
  auto film = test_device().buffer(bytes, "film");
  test_device().clear(film, bytes);
  auto counter = test_device().upload(std::vector<Counters>{{}}, "counters");
  run_kernel(program, "add_many", pixels, in, film, counter, pixels, passes);
  CHECK(test_device().download<Counters>(counter, 1)[0].non_finite == bad);
  const auto layers = test_device().download<FilmLightPasses>(film, pixels, pixels * sizeof(FilmPixel));
  double worst = 0;
  for (uint i = 0; i < pixels * numbers; ++i) {
    const uint k = i % numbers;
    const long double sum = mean_of(layers[i / numbers].radiance[k / 3][k % 3], 1);
    worst = std::max(worst, static_cast<double>(std::fabs(sum / expected[i] - 1)));
  }
  CHECK(worst < 1e-7);
}
