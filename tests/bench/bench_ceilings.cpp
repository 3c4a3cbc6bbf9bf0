#include "bench/bench_ceilings.hpp"

#include <algorithm>
#include <cstdio>
#include <vector>

namespace causticl {
namespace {

constexpr int repetitions = 8;

// Eight chains hide the latency of an addition; their sum is stored, so that none is left out. VECTOR is a
// float of as many lanes as the device's registers hold: CPUs' compilers make no vectors of these loops by
// themselves.
const char* const source = R"(
kernel void copy(global const float4 *from, global float4 *to, uint count) {
  uint i = get_global_id(0);
  if (i < count) to[i] = from[i];
}
kernel void multiply_add(global VECTOR *out, float factor, uint steps) {
  uint i = get_global_id(0);
  VECTOR a = i, b = i + 1, c = i + 2, d = i + 3, e = i + 4, f = i + 5, g = i + 6, h = i + 7;
  for (uint step = 0; step < steps; ++step) {
    a = fma(a, (VECTOR)(factor), (VECTOR)(1.0f));
    b = fma(b, (VECTOR)(factor), (VECTOR)(1.0f));
    c = fma(c, (VECTOR)(factor), (VECTOR)(1.0f));
    d = fma(d, (VECTOR)(factor), (VECTOR)(1.0f));
    e = fma(e, (VECTOR)(factor), (VECTOR)(1.0f));
    f = fma(f, (VECTOR)(factor), (VECTOR)(1.0f));
    g = fma(g, (VECTOR)(factor), (VECTOR)(1.0f));
    h = fma(h, (VECTOR)(factor), (VECTOR)(1.0f));
  }
  out[i] = a + b + c + d + e + f + g + h;
}
)";

/// Seconds of the fastest of several launches, by the device's own clock.
double fastest(Device& device, cl::Kernel& kernel, std::size_t items) {
  double best = 0;
  for (int i = 0; i < repetitions; ++i) {
    cl::Event event;
    device.queue().enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(items), cl::NDRange(256), nullptr,
                                        &event);
    event.wait();
    const double seconds = 1e-9 * static_cast<double>(event.getProfilingInfo<CL_PROFILING_COMMAND_END>() -
                                                      event.getProfilingInfo<CL_PROFILING_COMMAND_START>());
    best = i == 0 ? seconds : std::min(best, seconds);
  }
  return best;
}

}  // namespace

Ceilings bench_ceilings(Device& device) {
  const bool cpu = device.info().type == "cpu";
  const auto lanes = std::max(1u, device.info().device.getInfo<CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT>());
  const std::string vector = lanes == 1 ? "float" : "float" + std::to_string(lanes);
  cl::Program program = device.build(source, "-DVECTOR=" + vector);
  Ceilings result;

  const std::size_t bytes =
      std::min<std::uint64_t>(cpu ? 256u << 20 : 1u << 30, device.info().largest_allocation);
  const auto count = static_cast<cl_uint>(bytes / sizeof(cl_float4));
  cl::Buffer from = device.buffer(bytes, "a copy"), to = device.buffer(bytes, "a copy");
  device.clear(from, bytes);
  cl::Kernel copy(program, "copy");
  copy.setArg(0, from);
  copy.setArg(1, to);
  copy.setArg(2, count);
  result.copied = 2.0 * static_cast<double>(bytes) / fastest(device, copy, count);

  const std::size_t items = cpu ? 1u << 16 : 1u << 22;
  const cl_uint steps = 1024;
  cl::Kernel multiply_add(program, "multiply_add");
  multiply_add.setArg(0, to);
  multiply_add.setArg(1, 0.999f);
  multiply_add.setArg(2, steps);
  result.operations =
      16.0 * steps * lanes * static_cast<double>(items) / fastest(device, multiply_add, items);
  return result;
}

std::string ceilings_text(const Ceilings& ceilings) {
  char text[160];
  std::snprintf(text, sizeof text,
                "ceilings  %.1f GB/s copied (read and written), %.2f TFLOP/s of fused multiply-adds\n",
                1e-9 * ceilings.copied, 1e-12 * ceilings.operations);
  return text;
}

}  // namespace causticl
