#include "integrators/unknown_error.hpp"

#include <algorithm>
#include <cmath>

namespace causticl {
namespace {

constexpr double cells_across = 24;        // of the widest side of what is seen
constexpr std::size_t sums_of_a_cell = 7;  // FACINGS of cl/photons/unknown_error.cl

}  // namespace

void UnknownError::set_view(const Surroundings& around) {
  if (!around.sees_surface) return;
  double widest = 0;
  for (int axis = 0; axis < 3; ++axis) widest = std::max(widest, around.high[axis] - around.low[axis]);
  const double cell = (widest > 0 ? widest : around.room) / cells_across;
  if (!(cell > 0)) return;
  const auto count = [&](int axis) {  // one more at each end
    return static_cast<uint>(std::floor((around.high[axis] - around.low[axis]) / cell)) + 3;
  };
  const auto low = [&](int axis) { return static_cast<float>(around.low[axis] - cell); };
  cells_ = {{low(0), low(1), low(2), static_cast<float>(1 / cell)}, count(0), count(1), count(2), 0};
  sums_ =
      device_.buffer(sums_of_a_cell * cells_.nx * cells_.ny * cells_.nz * sizeof(cl_uint), "sums of flux");
}

void UnknownError::begin(const cl::Buffer& photons, std::uint32_t count) {
  if (!add_flux_()) {
    add_flux_ = programs_.kernel("gather", "add_flux");
    find_unknown_ = programs_.kernel("gather", "find_unknown");
  }
  device_.clear(sums_, sums_.getInfo<CL_MEM_SIZE>());
  if (count == 0) return;
  set_arguments(add_flux_, photons, sums_, cells_, static_cast<cl_uint>(count));
  device_.launch_pass(add_flux_, count);
}

void UnknownError::find(const cl::Buffer& points, const cl::Buffer& film, const Params& params) {
  set_arguments(find_unknown_, points, film, sums_, cells_, params);
  device_.launch_pass(find_unknown_, params.pixel_count);
}

}  // namespace causticl
