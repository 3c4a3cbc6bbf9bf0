// Pixels whose error cannot be told: sums of flux by cells, and which pixels miss the light of photons around
// them.
#include <cmath>
#include <map>
#include <optional>

#include "catch2.hpp"
#include "device_fixture.hpp"
#include "kernels/film_samples.hpp"

using namespace causticl;

namespace {

const char* const source = R"(
#include "photons/unknown_error.cl"
kernel void pack(global const float4 *normals, global uint *packed, uint count) {
  uint i = get_global_id(0);
  if (i < count) packed[i] = normal_pack(normals[i].xyz);
}
)";

constexpr uint facings = 7;
constexpr float cell = 0.25f;

Grid test_cells() { return {{-1, -2, 0, 1 / cell}, 6, 8, 5, 0}; }

/// Where the sum of a point lies, in double; none outside.
std::optional<std::size_t> oracle(const Grid& cells, const float (&p)[3], const float4& n, bool in_medium) {
  const double place[3] = {std::floor((static_cast<double>(p[0]) - cells.origin.x) * cells.origin.w),
                           std::floor((static_cast<double>(p[1]) - cells.origin.y) * cells.origin.w),
                           std::floor((static_cast<double>(p[2]) - cells.origin.z) * cells.origin.w)};
  const uint size[3] = {cells.nx, cells.ny, cells.nz};
  for (int axis = 0; axis < 3; ++axis)
    if (place[axis] < 0 || place[axis] >= size[axis]) return {};
  const auto at = static_cast<std::size_t>((place[2] * size[1] + place[1]) * size[0] + place[0]);
  const float v[3] = {n.x, n.y, n.z};
  int largest = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (std::fabs(v[axis]) > std::fabs(v[largest])) largest = axis;
  return facings * at + (in_medium ? 6u : static_cast<uint>(2 * largest + (v[largest] < 0)));
}

float4 axis_normal(RandomInputs& random) {
  float v[3] = {0.1f, -0.2f, 0.15f};
  v[static_cast<int>(random.uniform(0, 3))] = random.uniform() < 0.5 ? -0.97f : 0.97f;
  return {v[0], v[1], v[2], 0};
}

std::vector<cl_uint> packed(cl::Program& program, const std::vector<float4>& normals) {
  const auto words = test_device().buffer(normals.size() * sizeof(cl_uint), "packed");
  run_kernel(program, "pack", normals.size(), test_device().upload(normals, "normals"), words,
             static_cast<cl_uint>(normals.size()));
  return test_device().download<cl_uint>(words, normals.size());
}

std::size_t sums_of(const Grid& cells) { return std::size_t{facings} * cells.nx * cells.ny * cells.nz; }

}  // namespace

TEST_CASE("the flux of photons is added up by cell and facing, and none of those outside wraps around") {
  auto program = build_test_program(source, EFFECT_MEDIUM);
  RandomInputs random(20261201);
  const Grid cells = test_cells();
  std::vector<float4> normals;
  std::vector<Photon> photons(5000);
  for (auto& photon : photons) {
    normals.push_back(axis_normal(random));
    for (float& x : photon.position) x = static_cast<float>(random.uniform(-3, 3));
    photon.flux_rg = static_cast<uint>(random.uniform(0, 65536)) | static_cast<uint>(random.uniform(0, 65536))
                                                                       << 16;
    photon.flux_b = static_cast<uint>(random.uniform(0, 65536));
  }
  const auto words = packed(program, normals);
  std::map<std::size_t, std::uint64_t> wanted;
  for (std::size_t i = 0; i < photons.size(); ++i) {
    const bool in_medium = i % 5 == 0;
    photons[i].normal = words[i] | (in_medium ? IN_MEDIUM : 0);
    const uint most = std::max({photons[i].flux_rg & 0xffffu, photons[i].flux_rg >> 16, photons[i].flux_b});
    if (const auto at = oracle(cells, photons[i].position, normals[i], in_medium))
      wanted[*at] += (most >> 6) + 1;
  }
  REQUIRE(wanted.size() > 50);
  const auto sums = test_device().buffer(sums_of(cells) * sizeof(cl_uint), "sums");
  test_device().clear(sums, sums_of(cells) * sizeof(cl_uint));
  run_kernel(program, "add_flux", photons.size(), test_device().upload(photons, "photons"), sums, cells,
             static_cast<cl_uint>(photons.size()));
  const auto found = test_device().download<cl_uint>(sums, sums_of(cells));
  for (std::size_t i = 0; i < found.size(); ++i) {
    INFO("sum " << i);
    const auto expected = wanted.find(i);
    REQUIRE(found[i] == (expected == wanted.end() ? 0 : expected->second));
  }
}

TEST_CASE("a pixel without photons is unknown where those around would add more than a hundredth to it") {
  auto program = build_test_program(source, EFFECT_MEDIUM);
  const Grid cells = test_cells();
  const float4 up{0, 1, 0, 0};
  const cl_uint word = packed(program, {up})[0];
  const float place[3] = {0.1f, -1.1f, 0.6f};
  std::vector<cl_uint> sums(sums_of(cells));
  sums[*oracle(cells, place, up, false)] = 1000;
  Params params{};
  params.pixel_count = 5;
  params.visible_points = 2;
  params.pass = 3;
  params.photon_flux = 1.5f;
  // weight * sum * flux of a unit over the area of a cell, in half of the points: what is missing.
  const double missing = 0.3 * 1000 * 64 * 1.5 / 4096 / (static_cast<double>(cell) * cell) / 2;
  std::vector<VisiblePoint> points(10);
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::copy(std::begin(place), std::end(place), points[i].position);
    points[i].normal = word;
    std::fill(std::begin(points[i].weight), std::end(points[i].weight), i % 2 == 0 ? 0.3f : 0.0f);
  }
  points[6].position[0] += 1;  // of pixel 3: another cell, where there is nothing
  std::vector<FilmPixel> film(5);
  const auto shine = [&](std::size_t pixel, double light) {
    for (ExactSum& sum : film[pixel].luminance) sum = exact_sum_add(sum, static_cast<float>(2 * light));
  };
  shine(1, 98 * missing);
  shine(2, 102 * missing);
  film[2].missed = 1e9f;  // no longer
  film[4].missed = -1;    // has found photons
  const auto device_film = test_device().upload(film, "film");
  // Whether their error is unknown, after four passes.
  const auto unknown_in = [&](const cl::Buffer& pixels) {
    std::vector<uint> unknown;
    for (const auto& pixel : statistics_of(test_device().download<FilmPixel>(pixels, 5), 4))
      unknown.push_back(pixel.unknown);
    return unknown;
  };
  const auto look = [&] {
    run_kernel(program, "find_unknown", 5, test_device().upload(points, "points"), device_film,
               test_device().upload(sums, "sums"), cells, params);
    return unknown_in(device_film);
  };
  auto after = look();
  const uint expected[5] = {1, 1, 0, 0, 0};
  for (std::size_t i = 0; i < 5; ++i) {
    INFO("pixel " << i);
    CHECK(after[i] == expected[i]);
  }
}
