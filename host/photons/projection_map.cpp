#include "photons/projection_map.hpp"

#include <algorithm>
#include <numeric>

namespace causticl {
namespace {

// Of all photons, those that are drawn where pilot paths became caustics. A tenth to a third are alike within
// noise; larger fractions take too much from all else (docs/performance-log.md).
constexpr double aimed_fraction = 0.2;

// As many as a pass has photons, within limits: a few hundred must land in the cells of a caustic, and a pass
// of millions need not be taken twice.
constexpr std::uint32_t least_pilot_paths = 1 << 14, most_pilot_paths = 1 << 16;

constexpr std::size_t cells_of_square = std::size_t{PROJECTION_SIDE} * PROJECTION_SIDE;

/// Each cell with the eight beside it, by weights 1 2 1: what pilot paths just missed is not left to the few
/// photons that carry much. Cells beyond the border are those at it.
std::vector<double> blurred(std::span<const cl_uint> deposited) {
  constexpr int side = PROJECTION_SIDE;
  const auto index = [](int row, int column) {
    return static_cast<std::size_t>(row) * PROJECTION_SIDE + static_cast<std::size_t>(column);
  };
  std::vector<double> result(deposited.size());
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column)
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
          const std::size_t from =
              index(std::clamp(row + j, 0, side - 1), std::clamp(column + i, 0, side - 1));
          result[index(row, column)] += (j == 0 ? 2 : 1) * (i == 0 ? 2 : 1) * deposited[from] / 16.0;
        }
  return result;
}

}  // namespace

std::vector<ProjectionCell> projection_cells(std::span<const cl_uint> deposited, double fraction) {
  const auto wanted = blurred(deposited);
  const double sum = std::accumulate(wanted.begin(), wanted.end(), 0.0);
  std::vector<ProjectionCell> cells(deposited.size());
  std::vector<double> left(
      deposited.size());  // of the probability of a cell, times their number, not yet placed
  std::vector<cl_uint> below, above;
  for (cl_uint i = 0; i < cells.size(); ++i) {
    left[i] = sum > 0 ? 1 - fraction + fraction * wanted[i] / sum * static_cast<double>(cells.size()) : 1;
    cells[i] = {1, i, static_cast<float>(1 / left[i])};
    (left[i] < 1 ? below : above).push_back(i);
  }
  // Vose, "A linear algorithm for generating random numbers with a given distribution", 1991.
  while (!below.empty() && !above.empty()) {
    const cl_uint low = below.back(), high = above.back();
    below.pop_back();
    cells[low].stay = static_cast<float>(left[low]);
    cells[low].other = high;
    left[high] -= 1 - left[low];
    if (left[high] >= 1) continue;
    above.pop_back();
    below.push_back(high);
  }
  return cells;
}

ProjectionMap::ProjectionMap(Device& device, std::uint32_t emitters, std::uint32_t photons, bool aimed)
    : device_(device),
      squares_(std::min(emitters, PROJECTION_SQUARES)),
      pilot_paths_(aimed && emitters > 0 ? std::clamp(photons, least_pilot_paths, most_pilot_paths) : 0),
      deposited_(device.buffer(sizeof(cl_uint) * squares_ * cells_of_square, "aim of photons")) {
  device_.clear(deposited_, sizeof(cl_uint) * squares_ * cells_of_square);
  learn();
}

void ProjectionMap::learn() {
  const auto deposited = device_.download<cl_uint>(deposited_, squares_ * cells_of_square);
  std::vector<ProjectionCell> cells;
  for (std::size_t square = 0; square < squares_; ++square) {
    const auto one =
        projection_cells({deposited.data() + square * cells_of_square, cells_of_square}, aimed_fraction);
    cells.insert(cells.end(), one.begin(), one.end());
  }
  cells_ = device_.upload(cells, "aim of photons");
}

void ProjectionMap::add_arguments(cl::Kernel& trace_photons, cl_uint first) const {
  trace_photons.setArg(first, cells_);
  trace_photons.setArg(first + 1, deposited_);
}

}  // namespace causticl
