#include "photons/emission_map.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace causticl {
namespace {

constexpr double guided_fraction = 0.75;  // of photons that the map draws; the others start evenly
constexpr std::size_t most_cells = 2048;  // of the numbers of 24 bits, thousands for each
constexpr std::size_t fewest_useful = 4;  // in a cell that is cut
constexpr std::size_t bins = 8;           // of the histogram by which a cut is chosen
constexpr double uneven = 3;              // times what chance makes of a histogram, before a cell is cut
constexpr double smallest_side = 1.0 / 4096;

struct Sample {
  StartNumbers numbers;
  double weight;  // of the evenly drawn photons that it stands for
};

/// A cell that may still be cut, and its samples.
struct Box {
  EmissionCell cell;
  std::size_t first, end;
};

double volume(const EmissionCell& cell) {
  return std::accumulate(std::begin(cell.size), std::end(cell.size), 1.0,
                         [](double product, float side) { return product * side; });
}

/// How much less even the samples of the box are along `axis` than chance alone makes them: chi-square of a
/// histogram over its degrees of freedom.
double unevenness(const Box& box, std::span<const Sample> samples, std::size_t axis) {
  std::array<double, bins> sums{};
  double all = 0, squares = 0;
  for (std::size_t i = box.first; i < box.end; ++i) {
    const double place =
        (static_cast<double>(samples[i].numbers[axis]) - box.cell.low[axis]) / box.cell.size[axis];
    sums[std::min(static_cast<std::size_t>(std::max(place, 0.0) * bins), bins - 1)] += samples[i].weight;
    all += samples[i].weight;
    squares += samples[i].weight * samples[i].weight;
  }
  double deviation = 0;
  for (const double sum : sums) deviation += (sum - all / bins) * (sum - all / bins);
  // The variance of a bin's sum, were all as likely: that of the weights, spread over the bins.
  return squares > 0 ? deviation / (squares / bins) / (bins - 1) : 0;
}

/// The axis across which the box is cut, or START_NUMBERS where it stays whole.
std::size_t axis_of_cut(const Box& box, std::span<const Sample> samples) {
  if (box.end - box.first < fewest_useful) return START_NUMBERS;
  std::size_t best = START_NUMBERS;
  double most = uneven;
  for (std::size_t axis = 0; axis < START_NUMBERS; ++axis) {
    if (box.cell.size[axis] <= smallest_side) continue;
    const double now = unevenness(box, samples, axis);
    if (now > most) {
      most = now;
      best = axis;
    }
  }
  return best;
}

/// Cells that fill the cube, each with its samples; the largest numbers of samples are cut first.
std::vector<Box> boxes_of(std::vector<Sample>& samples) {
  EmissionCell whole{};
  std::fill(std::begin(whole.size), std::end(whole.size), 1.0f);
  std::vector<Box> open{{whole, 0, samples.size()}}, done;
  const auto fewer = [](const Box& a, const Box& b) { return a.end - a.first < b.end - b.first; };
  while (!open.empty()) {
    std::pop_heap(open.begin(), open.end(), fewer);
    Box box = open.back();
    open.pop_back();
    const std::size_t axis =
        open.size() + done.size() + 2 > most_cells ? START_NUMBERS : axis_of_cut(box, samples);
    if (axis == START_NUMBERS) {
      done.push_back(box);
      continue;
    }
    Box lower = box, upper = box;
    lower.cell.size[axis] = upper.cell.size[axis] = box.cell.size[axis] / 2;
    upper.cell.low[axis] += upper.cell.size[axis];
    const auto begin = samples.begin();
    const auto middle = std::partition(
        begin + static_cast<std::ptrdiff_t>(box.first), begin + static_cast<std::ptrdiff_t>(box.end),
        [&](const Sample& sample) { return sample.numbers[axis] < upper.cell.low[axis]; });
    lower.end = upper.first = static_cast<std::size_t>(middle - begin);
    for (const Box& half : {lower, upper}) {
      open.push_back(half);
      std::push_heap(open.begin(), open.end(), fewer);
    }
  }
  return done;
}

/// Gives each cell its part of the random numbers, and the weight of its flux by what that is exactly.
std::vector<EmissionCell> with_numbers(const std::vector<Box>& boxes,
                                       const std::vector<double>& probabilities) {
  std::vector<EmissionCell> cells;
  const double spare = EMISSION_NUMBERS - static_cast<double>(boxes.size());  // each owns one at least
  double sum = 0;
  uint before = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    EmissionCell cell = boxes[i].cell;
    sum += probabilities[i];
    cell.end = i + 1 == boxes.size()
                   ? EMISSION_NUMBERS
                   : static_cast<uint>(std::floor(std::min(sum, 1.0) * spare)) + static_cast<uint>(i + 1);
    cell.weight = static_cast<float>(volume(cell) * EMISSION_NUMBERS / (cell.end - before));
    before = cell.end;
    cells.push_back(cell);
  }
  return cells;
}

}  // namespace

double emission_map_weight(std::span<const EmissionCell> cells, const StartNumbers& numbers) {
  for (const auto& cell : cells) {
    bool inside = true;
    for (std::size_t axis = 0; axis < START_NUMBERS && inside; ++axis)
      inside = numbers[axis] >= cell.low[axis] && numbers[axis] < cell.low[axis] + cell.size[axis];
    if (inside) return cell.weight;
  }
  return 1;
}

std::vector<EmissionCell> emission_map(std::span<const StartNumbers> useful, std::size_t photons,
                                       std::span<const EmissionCell> drawn_by) {
  std::vector<Sample> samples;
  samples.reserve(useful.size());
  for (const auto& numbers : useful) samples.push_back({numbers, emission_map_weight(drawn_by, numbers)});
  // In an order that execution does not give, for sums of the same bits.
  std::sort(samples.begin(), samples.end(),
            [](const Sample& a, const Sample& b) { return a.numbers < b.numbers; });
  const auto boxes = boxes_of(samples);
  std::vector<double> mass, deviation;
  for (const Box& box : boxes) {
    double sum = 0;
    for (std::size_t i = box.first; i < box.end; ++i) sum += samples[i].weight;
    mass.push_back(std::min(sum / static_cast<double>(photons), volume(box.cell)));
    deviation.push_back(std::sqrt(volume(box.cell) * mass.back()));
  }
  const double masses = std::accumulate(mass.begin(), mass.end(), 0.0);
  const double deviations = std::accumulate(deviation.begin(), deviation.end(), 0.0);
  std::vector<double> probabilities;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const double even = volume(boxes[i].cell);
    const double wanted = masses > 0 ? 0.5 * (mass[i] / masses + deviation[i] / deviations) : even;
    probabilities.push_back((1 - guided_fraction) * even + guided_fraction * wanted);
  }
  return with_numbers(boxes, probabilities);
}

}  // namespace causticl
