// Photons of the projection map: the table of cells and what it draws, and what whole passes bring.
#include <algorithm>
#include <cmath>
#include <set>

#include "catch2.hpp"
#include "chi_square_check.hpp"
#include "device_fixture.hpp"
#include "image/luminance.hpp"
#include "photons/projection_map.hpp"
#include "render/render_fixture.hpp"

using namespace causticl;

namespace {

const char* const source = R"(
#include "photons/projection_map.cl"
#include "sampling/rng.cl"
kernel void draw(global const ProjectionCell *cells, global float4 *drawn, uint square, uint count, uint seed) {
  uint i = get_global_id(0);
  if (i >= count) return;
  RandomStream stream = {seed, 0, i};
  real4 random = random4(stream, DIM_EMISSION);
  real u = random.x, v = random.y, weight = aim(cells, square, random.z, &u, &v);
  drawn[i] = (float4)(u, v, weight, projection_cell(u, v));
}
kernel void squares(global uint *found, uint emitters) {
  uint i = get_global_id(0);
  if (i < emitters) found[i] = projection_square(i, emitters);
}
)";

constexpr double aimed_fraction = 0.3;

/// Pilot paths that left by a few cells at a corner, at a border and within.
std::vector<cl_uint> landed_by(RandomInputs& random) {
  std::vector<cl_uint> deposited(PROJECTION_CELLS);
  for (const auto& [row, column] : {std::pair{0, 0}, {0, 17}, {20, 31}, {11, 9}, {12, 9}, {12, 10}})
    deposited[static_cast<std::size_t>(row * static_cast<int>(PROJECTION_SIDE) + column)] =
        static_cast<cl_uint>(random.uniform(20, 400));
  return deposited;
}

/// How likely each cell is to be, by what projection_map.hpp says.
std::vector<double> wanted(const std::vector<cl_uint>& deposited) {
  const int side = PROJECTION_SIDE;
  const double weights[] = {0.25, 0.5, 0.25};
  double sum = 0;
  std::vector<double> result(deposited.size());
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column)
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) {
          const int from_row = std::min(std::max(row + j - 1, 0), side - 1);
          const int from_column = std::min(std::max(column + i - 1, 0), side - 1);
          const double here =
              weights[i] * weights[j] * deposited[static_cast<std::size_t>(from_row * side + from_column)];
          result[static_cast<std::size_t>(row * side + column)] += here;
          sum += here;
        }
  for (double& cell : result)
    cell = sum > 0 ? (1 - aimed_fraction) / PROJECTION_CELLS + aimed_fraction * cell / sum
                   : 1.0 / PROJECTION_CELLS;
  return result;
}

/// How likely the table makes each.
std::vector<double> made(const std::vector<ProjectionCell>& cells) {
  std::vector<double> result(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    result[i] += static_cast<double>(cells[i].stay) / PROJECTION_CELLS;
    result[cells[i].other] += (1 - static_cast<double>(cells[i].stay)) / PROJECTION_CELLS;
  }
  return result;
}

/// A small strong lamp, or a sun, over a ball of glass on a floor: few photons meet the ball.
Scene ball_of_glass(bool sun, bool aimed) {
  const std::string light =
      sun ? R"("lights": [{"type": "directional", "direction": [0.3, -1, 0.2], "irradiance": [3, 3, 3]}],)"
          : R"("lights": [{"type": "point", "position": [1, 4, 1], "intensity": [30, 30, 30]}],)";
  Scene scene = scene_from_text("{" + light + R"("width": 24, "height": 16, "max_depth": 8,
    "renderer": {"type": "sppm", "view_point_sample": 2, "photon_sample": 4000, "radius": 0.3, "schedule": "global"},
    "camera": {"position": [0, 5, 6], "target": [0, 0, 0], "fov": 40},
    "objects": [
      {"type": "disk", "radius": 6, "material": {"type": "diffuse", "color": [0.7, 0.7, 0.7]},
       "transform": [{"type": "rotate", "axis": "x", "degree": -90}]},
      {"type": "sphere", "radius": 0.7, "material": {"type": "glass"},
       "transform": [{"type": "shift", "x": 0, "y": 0.75, "z": 0}]}]})");
  scene.renderer.aimed_photons = aimed;
  return scene;
}

/// Means and variances over seeds of the luminance of boxes of pixels.
struct Spread {
  std::vector<double> mean, variance;
};

constexpr int seeds = 10;

Spread spread_of(bool sun, bool aimed) {
  Spread spread;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    const Picture picture =
        box_filtered(render_with(ball_of_glass(sun, aimed), Integrator::sppm, 8, seed).picture, 2);
    spread.mean.resize(picture.rgb.size() / 3);
    spread.variance.resize(picture.rgb.size() / 3);
    for (std::size_t i = 0; i < spread.mean.size(); ++i) {
      const double value = luminance(&picture.rgb[3 * i]);
      spread.mean[i] += value / seeds;
      spread.variance[i] += value * value / seeds;
    }
  }
  for (std::size_t i = 0; i < spread.mean.size(); ++i)
    spread.variance[i] =
        std::max(0.0, spread.variance[i] - spread.mean[i] * spread.mean[i]) * seeds / (seeds - 1);
  return spread;
}

}  // namespace

TEST_CASE("cells are as likely as what landed in and beside them asks, and carry the rest of the flux") {
  RandomInputs random(20261127);
  for (const auto& deposited : {landed_by(random), std::vector<cl_uint>(PROJECTION_CELLS)}) {
    const auto cells = projection_cells(deposited, aimed_fraction);
    const auto expected = wanted(deposited), table = made(cells);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      CAPTURE(i, random.seed);
      CHECK(table[i] == Approx(expected[i]).epsilon(1e-4));
      CHECK(static_cast<double>(cells[i].weight) * expected[i] * PROJECTION_CELLS == Approx(1).epsilon(1e-5));
    }
  }
}

TEST_CASE("what is drawn follows the cells, is even within each, and bears the flux of all on average") {
  RandomInputs random(7);
  const auto deposited = landed_by(random);
  std::vector<ProjectionCell> cells =
      projection_cells(std::vector<cl_uint>(PROJECTION_CELLS), aimed_fraction);
  const auto second = projection_cells(deposited, aimed_fraction);
  cells.insert(cells.end(), second.begin(), second.end());
  auto program = build_test_program(source);
  const cl_uint count = 1 << 20;
  const auto drawn = test_device().buffer(count * sizeof(float4), "drawn");
  run_kernel(program, "draw", count, test_device().upload(cells, "cells"), drawn, PROJECTION_CELLS, count,
             cl_uint{random.seed});
  Histogram by_cell(PROJECTION_CELLS), within(16);
  by_cell.probabilities = wanted(deposited);
  within.probabilities.assign(16, 1.0 / 16);
  double flux = 0;
  for (const float4& d : test_device().download<float4>(drawn, count)) {
    REQUIRE((d.x >= 0 && d.x < 1 && d.y >= 0 && d.y < 1));
    const auto cell = static_cast<std::size_t>(d.w);
    REQUIRE(cell < PROJECTION_CELLS);
    by_cell.add(cell);
    const double across = static_cast<double>(d.x) * PROJECTION_SIDE,
                 up = static_cast<double>(d.y) * PROJECTION_SIDE;
    within.add(static_cast<std::size_t>(4 * (up - std::floor(up))) * 4 +
               static_cast<std::size_t>(4 * (across - std::floor(across))));
    flux += static_cast<double>(d.z);
  }
  check_chi_square(by_cell, 2, "cells");
  check_chi_square(within, 2, "places in them");
  CHECK(flux / count == Approx(1).epsilon(0.002));
}

TEST_CASE("up to sixteen emitters have a square of their own, more share as many evenly") {
  auto program = build_test_program(source);
  for (const cl_uint emitters : {1u, 2u, 15u, 16u, 17u, 1000u, 100003u}) {
    const auto buffer = test_device().buffer(emitters * sizeof(cl_uint), "squares");
    run_kernel(program, "squares", emitters, buffer, emitters);
    const auto squares = test_device().download<cl_uint>(buffer, emitters);
    CAPTURE(emitters);
    const std::set<cl_uint> different(squares.begin(), squares.end());
    CHECK(different.size() == std::min(emitters, PROJECTION_SQUARES));
    CHECK(*different.rbegin() == (std::min(emitters, PROJECTION_SQUARES) - 1) * PROJECTION_CELLS);
    for (const cl_uint square : different) {
      const auto sharing = std::count(squares.begin(), squares.end(), square);
      CHECK(std::abs(static_cast<double>(sharing) - emitters / static_cast<double>(different.size())) <= 1);
    }
  }
}

TEST_CASE("photons by the projection map make the same picture with less noise where light is focused") {
  for (const bool sun : {true, false}) {
    CAPTURE(sun);
    const Spread with = spread_of(sun, true), without = spread_of(sun, false);
    double squares = 0, mean_with = 0, mean_without = 0, of_mean = 0;
    int lit = 0;
    std::vector<double> ratios;
    for (std::size_t i = 0; i < with.mean.size(); ++i) {
      mean_with += with.mean[i];
      mean_without += without.mean[i];
      const double of_difference = (with.variance[i] + without.variance[i]) / seeds;
      of_mean += of_difference;
      if (!(of_difference > 0)) continue;
      ++lit;
      ratios.push_back(with.variance[i] / without.variance[i]);
      squares += std::pow(with.mean[i] - without.mean[i], 2) / of_difference;
    }
    CHECK(lit > 60);
    // With ten seeds each the square of such a quotient is 9/7 on average.
    CHECK(squares / lit < 1.8);
    CHECK(std::fabs(mean_with - mean_without) < 4 * std::sqrt(of_mean));
    // A fifth of the boxes, those with the caustic, has a sixth of the variance; of equal variances a fifth
    // would seem to differ by more than 0.56.
    const auto fifth = ratios.begin() + lit / 5;
    std::nth_element(ratios.begin(), fifth, ratios.end());
    CHECK(*fifth < 0.3);
  }
}

TEST_CASE("pilot paths are no part of what the passes are reported to have traced") {
  const auto rays = [](int passes) {
    return static_cast<double>(
        render_with(ball_of_glass(true, true), Integrator::sppm, passes).statistics.rays);
  };
  // As many each pass, but for chance.
  CHECK(rays(4) == Approx(4 * rays(1)).epsilon(0.1));
}
