// The map by which photons start: cells that fill the cube, drawn by the device as often as the host says.
#include <cmath>

#include "catch2.hpp"
#include "device_fixture.hpp"
#include "photons/emission_map.hpp"

using namespace causticl;

namespace {

const char* const source = R"(
#include "sampling/rng.cl"
#include "photons/emission_map.cl"
kernel void draw(global const EmissionCell *cells, uint count, global float *numbers, global float *weights, uint seed,
                 uint draws) {
  uint i = get_global_id(0);
  if (i >= draws) return;
  RandomStream stream = {seed, 0, i, 0, 0};
  real4 choice = random4(stream, DIM_EMITTER), random = random4(stream, DIM_EMISSION);
  real u = random.x, v = random.y;
  uint cell = emission_cell(cells, count, random4(stream, DIM_EMISSION_CELL).x);
  choice = emission_numbers(cells + cell, choice, &u, &v);
  weights[i] = cells[cell].weight;
  global float *point = numbers + START_NUMBERS * i;
  point[0] = choice.x, point[1] = choice.y, point[2] = choice.z, point[3] = u, point[4] = v;
}
)";

constexpr std::size_t pilot_paths = 1 << 15;

/// Whether a photon is of use: a thin slab across two numbers, in two pieces.
bool is_useful(const StartNumbers& x) {
  return std::fabs(x[1] - 0.31f) < 0.01f && (std::fabs(x[3] - 0.8f) < 0.1f || std::fabs(x[3] - 0.1f) < 0.05f);
}
constexpr double useful_volume = 0.02 * (0.2 + 0.1);

double volume(const EmissionCell& cell) {
  double product = 1;
  for (const float side : cell.size) product *= side;
  return product;
}

StartNumbers random_numbers(RandomInputs& random) {
  StartNumbers numbers;
  for (float& x : numbers) x = static_cast<float>(random.uniform(0, 1));
  return numbers;
}

/// The map that pilot paths learn which start evenly.
std::vector<EmissionCell> learned(RandomInputs& random) {
  std::vector<StartNumbers> useful;
  for (std::size_t i = 0; i < pilot_paths; ++i) {
    const StartNumbers numbers = random_numbers(random);
    if (is_useful(numbers)) useful.push_back(numbers);
  }
  return emission_map(useful, pilot_paths, {});
}

}  // namespace

TEST_CASE("the cells of an emission map fill the cube, and each weight of flux is over its density") {
  RandomInputs random(20261129);
  const auto cells = learned(random);
  CHECK(cells.size() > 10);
  double all = 0;
  uint before = 0;
  for (const auto& cell : cells) {
    REQUIRE(cell.end > before);
    all += volume(cell);
    CHECK(cell.weight * (cell.end - before) / static_cast<double>(EMISSION_NUMBERS) ==
          Approx(volume(cell)).epsilon(1e-5));
    CHECK(cell.weight < 4.01);  // a quarter of the photons starts evenly
    before = cell.end;
  }
  CHECK(all == Approx(1).epsilon(1e-6));
  CHECK(before == EMISSION_NUMBERS);
  // No two of them overlap: each point lies in one.
  for (int i = 0; i < 1000; ++i) {
    const StartNumbers x = random_numbers(random);
    int holding = 0;
    for (const auto& cell : cells) {
      bool inside = true;
      for (std::size_t axis = 0; axis < START_NUMBERS; ++axis)
        inside = inside && x[axis] >= cell.low[axis] && x[axis] < cell.low[axis] + cell.size[axis];
      holding += inside;
    }
    REQUIRE(holding == 1);
  }
}

TEST_CASE("photons by an emission map start where useful ones do, and carry the same flux in all") {
  RandomInputs random(20261130);
  const auto cells = learned(random);
  auto program = build_test_program(source, 0);
  constexpr std::size_t draws = 1 << 18;
  const auto numbers = test_device().buffer(draws * sizeof(StartNumbers), "numbers"),
             weights = test_device().buffer(draws * sizeof(float), "weights");
  run_kernel(program, "draw", draws, test_device().upload(cells, "cells"), static_cast<cl_uint>(cells.size()),
             numbers, weights, cl_uint{20261130}, static_cast<cl_uint>(draws));
  const auto x = test_device().download<StartNumbers>(numbers, draws);
  const auto weight = test_device().download<float>(weights, draws);
  double useful = 0, flux = 0, squares = 0, all = 0, moment = 0;
  for (std::size_t i = 0; i < draws; ++i) {
    for (const float number : x[i]) REQUIRE((number >= 0 && number < 1));
    REQUIRE(weight[i] == static_cast<float>(emission_map_weight(cells, x[i])));
    all += static_cast<double>(weight[i]) / draws;
    moment += static_cast<double>(weight[i]) * x[i][0] * x[i][4] / draws;
    if (!is_useful(x[i])) continue;
    useful += 1.0 / draws;
    flux += static_cast<double>(weight[i]) / draws;
    squares += static_cast<double>(weight[i]) * weight[i] / draws;
  }
  const double sigma = std::sqrt(squares / draws);
  INFO("useful: " << useful << " of the photons, evenly " << useful_volume);
  CHECK(useful > 20 * useful_volume);
  CHECK(std::fabs(flux - useful_volume) < 5 * sigma);
  CHECK(all == Approx(1).epsilon(0.02));
  CHECK(moment == Approx(0.25).epsilon(0.03));
}

TEST_CASE("an emission map of no useful photon starts all evenly") {
  const auto cells = emission_map({}, 1000, {});
  REQUIRE(cells.size() == 1);
  CHECK(cells[0].weight == 1);
}
