// The pilot of SPPM: see pilot.hpp.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "device_scene/params.hpp"
#include "device_scene/space_grid.hpp"
#include "integrators/sppm.hpp"
#include "shared/effects.h"

namespace causticl {
namespace {

constexpr uint longest_side = 64;  // pixels of the coarse picture

// Photons are guided where fewer than this fraction of the plain ones land near what the camera sees, and
// where that makes them this many times as many.
constexpr double worth_guiding = 1.0 / 16, worthwhile_gain = 2;

// With fewer photons a pass than this, learning where they should start would take longer than the render.
constexpr std::int64_t fewest_photons = 1 << 14;

// The map is learned in steps, each by pilot paths that start by the last one, until so many are of use.
constexpr std::uint32_t pilot_paths = 1 << 15;
constexpr int most_steps = 6;
constexpr double useful_enough = 0.4;
constexpr std::uint32_t beyond_passes = 0xffffff00;  // random numbers of their own
// Where so few are of use, more batches of pilot paths are traced, but no more than this.
constexpr std::size_t fewest_useful = 64;
constexpr std::uint32_t most_batches = 8;

// Cells around points in view, by which the use of photons is told, are as wide as this fraction of the room:
// about as far as the points of the coarse picture lie apart.
constexpr double visible_cell_fraction = 1.0 / 24;
constexpr uint visible_cells_across = 128;  // cells: five times the room

/// Which fraction of the photons that start by a map are of use.
struct Useful {
  double by_number = 0;
  // The fraction of photons of equal flux whose sums vary as little: a map that its samples fit too well
  // makes many photons useful that bring little, and leaves much flux to the few that start elsewhere (Kong's
  // effective sample size).
  double by_variance = 0;
};

Useful useful_by(const std::vector<EmissionCell>& map, std::vector<StartNumbers> useful,
                 std::uint32_t traced) {
  // In an order that execution does not give, for a sum of the same bits.
  std::sort(useful.begin(), useful.end());
  double sum = 0, squares = 0;
  for (const auto& numbers : useful) {
    const double weight = emission_map_weight(map, numbers);
    sum += weight;
    squares += weight * weight;
  }
  return {static_cast<double>(useful.size()) / traced, squares > 0 ? sum * sum / squares / traced : 0};
}

/// Where a point of view lies; none where there is nothing.
std::optional<Vec3> position_of(const std::byte* record, bool in_double) {
  const auto read = [&](std::size_t offset) {
    if (in_double) {
      double value;
      std::memcpy(&value, record + offset * sizeof(double), sizeof value);
      return value;
    }
    float value;
    std::memcpy(&value, record + offset * sizeof(float), sizeof value);
    return static_cast<double>(value);
  };
  // VisiblePoint: position, a word that is padded to a real, weight.
  if (!(read(4) + read(5) + read(6) > 0)) return {};
  return Vec3{read(0), read(1), read(2)};
}

}  // namespace

/// Of the coarse picture: one path a pixel, of the whole also where the film holds a crop.
Params Sppm::pilot_params() const {
  Params params = params_;
  params.coverage = 0;  // pixels have no radius yet
  const uint longer = std::max(params.width, params.height);
  params.width = std::max(1u, std::min(longest_side, longer) * params.width / longer);
  params.height = std::max(1u, std::min(longest_side, longer) * params.height / longer);
  params.crop_x = params.crop_y = params.crop_width = params.crop_height = 0;
  params.visible_points = 1;
  params.first_pixel = 0;
  params.pixel_count = params.width * params.height;
  return params;
}

Surroundings Sppm::look_around(const cl::Buffer& points, const Params& params) {
  const cl::Buffer distances = device_.buffer(params.pixel_count * sizeof(cl_float), "distances");
  cl::Kernel kernel = programs_.kernel("camera", "surroundings");
  const cl_uint first = set_scene_arguments(kernel, device_scene_);
  kernel.setArg(first, points);
  kernel.setArg(first + 1, counters_);
  kernel.setArg(first + 2, params);
  kernel.setArg(first + 3, distances);
  device_.launch_pass(kernel, params.pixel_count);
  const auto far = device_.download<cl_float>(distances, params.pixel_count);
  const auto records = device_.download<std::byte>(points, params.pixel_count * visible_point_bytes_);
  const bool in_double = programs_.options().precision == Precision::float64;
  const std::size_t stride = in_double ? 2 * sizeof(VisiblePoint) : sizeof(VisiblePoint);
  std::vector<Vec3> positions;
  std::vector<float> lengths;
  for (std::size_t i = 0; i < far.size(); ++i) {
    const auto position = position_of(records.data() + i * stride, in_double);
    if (!position) continue;
    positions.push_back(*position);
    lengths.push_back(far[i]);
  }
  return surroundings_of(positions, lengths);
}

/// The radius within which the median visible point of the coarse picture finds a dozen photons of the first
/// pass. In the Cornell box the error of 90% of the pixels is then smallest after 32 to 128 passes; with
/// forty it takes twice as many passes to the same error, since corners stay dark for long. A larger one than
/// the room allows is not looked for.
void Sppm::choose_first_radius(const cl::Buffer& points, Params params, Pilot& pilot) {
  constexpr double wanted = 12;
  const double largest = largest_radius_fraction * pilot.around.room;
  double radius = std::clamp(0.01 * device_scene_.extent, 0.01 * largest, largest);
  cl::Kernel count_around = programs_.kernel("gather", "count_around");
  const cl::Buffer counts = device_.buffer(params.pixel_count * sizeof(cl_uint), "photon counts");
  pilot.radius_at_limit = pilot.photons_found = false;
  for (int step = 0; step < 16 && photon_map_.stored() > 0; ++step) {
    params.radius2 = static_cast<float>(radius * radius);
    photon_map_.sort(radius, radius * indirect_radius(spec_));
    set_arguments(count_around, points, photon_map_.starts(), photon_map_.sorted(), counts,
                  photon_map_.grids(), params);
    device_.launch_pass(count_around, params.pixel_count);
    auto found = device_.download<cl_uint>(counts, params.pixel_count);
    std::erase(found, 0xffffffffu);  // COUNT_NOTHING of cl/passes/pass_gather.cl
    // Photons may light a small part of the picture alone, as caustics on a floor: that part decides.
    const bool dark = std::count(found.begin(), found.end(), 0u) == static_cast<std::ptrdiff_t>(found.size());
    pilot.photons_found = !dark;
    if (!dark) std::erase(found, 0u);
    const auto middle = found.begin() + static_cast<std::ptrdiff_t>(found.size() / 2);
    std::nth_element(found.begin(), middle, found.end());
    const double ratio = std::clamp(std::sqrt(wanted / std::max<double>(*middle, 0.5)), 0.25, 4.0);
    pilot.radius_at_limit = radius * ratio >= largest && ratio >= 1.1;
    if ((ratio > 0.9 && ratio < 1.1) || (radius == largest && ratio > 1)) break;
    radius = std::min(radius * ratio, largest);
  }
  pilot.first_radius = radius;
}

/// Decides by which map photons start, if by any, and lets them.
void Sppm::learn_emission(const cl::Buffer& points, const Params& params, Pilot& pilot) {
  const double cell = visible_cell_fraction * pilot.around.room;
  const auto low = [&](int axis) {  // what is seen lies in the middle
    return static_cast<float>(
        0.5 * (pilot.around.low[axis] + pilot.around.high[axis] - visible_cells_across * cell));
  };
  const Grid cells{{low(0), low(1), low(2), static_cast<float>(1 / cell)},
                   visible_cells_across,
                   visible_cells_across,
                   visible_cells_across,
                   0};
  const std::size_t bytes = (buckets_of(cells) + 3) / 4 * sizeof(cl_uint);
  if (bytes > device_.info().largest_allocation) return;  // a device this small renders without a map
  const cl::Buffer visibility = device_.buffer(bytes, "visibility grid");
  device_.clear(visibility, visibility.getInfo<CL_MEM_SIZE>());
  cl::Kernel mark = programs_.kernel("gather", "mark_in_view");
  set_arguments(mark, points, visibility, cells, static_cast<cl_float>(0.49 * cell),
                static_cast<cl_uint>(params.pixel_count));
  device_.launch_pass(mark, params.pixel_count);

  const cl::Buffer count = device_.buffer(sizeof(cl_uint), "marked photons");
  device_.clear(count, sizeof(cl_uint));
  if (photon_map_.stored() > 0) {
    cl::Kernel count_visible = programs_.kernel("gather", "count_visible");
    set_arguments(count_visible, photon_map_.records_buffer(), visibility, count, cells,
                  static_cast<cl_uint>(photon_map_.stored()));
    device_.launch_pass(count_visible, photon_map_.stored());
  }
  pilot.useful = device_.download<cl_uint>(count, 1)[0] / static_cast<double>(params_.photon_count);
  if (pilot.useful >= worth_guiding) return;

  start_by({});
  Useful plain, best;
  std::vector<EmissionCell> map;
  std::uint32_t batches = 0;  // of pilot paths so far
  for (int step = 0; step < most_steps && best.by_number < useful_enough; ++step) {
    std::vector<StartNumbers> useful;
    std::uint32_t traced = 0;
    do {
      const auto more = photon_map_.useful_pilot_paths(params_, pilot_paths, beyond_passes + batches++,
                                                       {visibility, cells});
      useful.insert(useful.end(), more.begin(), more.end());
      traced += pilot_paths;
    } while (useful.size() < fewest_useful && traced < most_batches * pilot_paths);
    const Useful found = useful_by(map, useful, traced);
    if (step == 0) plain = best = found;
    if (found.by_variance > best.by_variance) {
      best = found;
      pilot.emission = map;
    }
    if (useful.empty()) break;
    map = emission_map(useful, traced, map);
    guide_.set_emission(map);
  }
  pilot.useful = plain.by_number;
  if (!(best.by_variance > worthwhile_gain * plain.by_variance)) {
    best = plain;
    pilot.emission.clear();
  }
  pilot.useful_by_map = best.by_number;
  guide_.set_emission(pilot.emission);
  pilot.copies = plain.by_number > 0 && best.by_number < worth_guiding;
  if (pilot.copies) guide_.guide();
}

/// Lets photons start by `emission`, with kernels that can.
void Sppm::start_by(const std::vector<EmissionCell>& emission) {
  if (!(programs_.options().effects & EFFECT_GUIDED_PHOTONS) && !guided_programs_) {
    KernelOptions options = programs_.options();
    options.effects |= EFFECT_GUIDED_PHOTONS;
    guided_programs_ = std::make_unique<Programs>(device_, options, std::vector<std::string>{"photon"});
    photon_map_.prepare(*guided_programs_);
  }
  guide_.set_emission(emission);
}

void Sppm::adopt(const Pilot& pilot) {
  pilot_ = pilot;
  device_scene_.least_scale = pilot.around.room / 2;
  if (pilot.emission.empty() && !pilot.copies) return;
  start_by(pilot.emission);
  if (pilot.copies) guide_.guide();
  trace_photons(0);
}

Pilot Sppm::run_pilot() {
  Pilot pilot;
  pilot.first_radius = spec_.radius.value_or(0.01 * device_scene_.extent);
  Params params = pilot_params();
  if (!with_photons_) return pilot;
  // Beside the photons as traced, which are sorted anew for every radius.
  const cl::Buffer points = device_.buffer(params.pixel_count * visible_point_bytes_, "visible points");
  params.segment = segment(INFINITY);
  trace_visible_points(points, params);
  pilot.around = look_around(points, params);
  if (!pilot.around.sees_surface) return pilot;
  device_scene_.least_scale = pilot.around.room / 2;
  if (params.segment != segment(INFINITY)) {
    params.segment = segment(INFINITY);
    trace_visible_points(points, params);
  }
  if (!spec_.radius) choose_first_radius(points, params, pilot);
  const bool in_medium = params_.extinction.x > 0 || params_.extinction.y > 0 || params_.extinction.z > 0;
  if (spec_.guided_photons || in_medium || spec_.photons < fewest_photons) return pilot;
  learn_emission(points, params, pilot);
  if (pilot.emission.empty() && !pilot.copies) return pilot;
  trace_photons(0);
  if (!spec_.radius) choose_first_radius(points, params, pilot);
  return pilot;
}

}  // namespace causticl
