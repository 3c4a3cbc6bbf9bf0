#include "opencl/device.hpp"

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "base/error.hpp"
#include "base/leftovers.hpp"
#include "base/printable.hpp"
#include "base/spelling.hpp"
#include "opencl/driver_needs.hpp"
#include "shared/types.h"

namespace causticl {
namespace {

std::string trimmed(std::string text) {
  while (!text.empty() && (text.back() == '\0' || std::isspace(static_cast<unsigned char>(text.back()))))
    text.pop_back();
  const auto first = std::find_if(text.begin(), text.end(), [](unsigned char c) { return !std::isspace(c); });
  return {first, text.end()};
}

std::string lowered(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

std::string type_name(cl_device_type type) {
  if (type & CL_DEVICE_TYPE_GPU) return "gpu";
  if (type & CL_DEVICE_TYPE_CPU) return "cpu";
  return "accelerator";
}

DeviceInfo describe(const cl::Platform& platform, const cl::Device& device) {
  const auto text = [](const std::string& of_driver) { return printable_line(trimmed(of_driver)); };
  DeviceInfo info;
  info.platform = platform;
  info.device = device;
  info.platform_name = text(platform.getInfo<CL_PLATFORM_NAME>());
  info.platform_version = text(platform.getInfo<CL_PLATFORM_VERSION>());
  info.name = text(device.getInfo<CL_DEVICE_NAME>());
  info.vendor = text(device.getInfo<CL_DEVICE_VENDOR>());
  info.driver = text(device.getInfo<CL_DRIVER_VERSION>());
  info.opencl_version = text(device.getInfo<CL_DEVICE_VERSION>());
  info.type = type_name(device.getInfo<CL_DEVICE_TYPE>());
  info.compute_units = device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
  info.global_memory = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
  info.largest_allocation = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
  info.largest_work_group = device.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>();
  info.fp64 = device.getInfo<CL_DEVICE_EXTENSIONS>().find("cl_khr_fp64") != std::string::npos;
  return info;
}

}  // namespace

std::vector<DeviceInfo> list_devices() {
  check_driver_needs();
  expect_driver_to_abort();
  std::vector<DeviceInfo> result;
  std::vector<cl::Platform> platforms;
  try {
    cl::Platform::get(&platforms);
  } catch (const cl::Error&) {
    return result;  // the loader reports "no platform" as an error
  }
  for (const auto& platform : platforms) {
    std::vector<cl::Device> devices;
    try {
      platform.getDevices(CL_DEVICE_TYPE_ALL, &devices);
    } catch (const cl::Error&) {
      continue;  // a platform without devices
    }
    for (const auto& device : devices) result.push_back(describe(platform, device));
  }
  return result;
}

DeviceInfo find_device(const std::string& spec) {
  const auto devices = list_devices();
  if (devices.empty())
    throw DeviceError(
        "no OpenCL device found; install a driver for your GPU, or Debian's pocl-opencl-icd to run on the "
        "CPU");
  const std::string wanted = lowered(spec);
  if (wanted.empty()) {
    for (const auto& device : devices)
      if (device.type == "gpu") return device;
    return devices.front();
  }
  if (std::all_of(wanted.begin(), wanted.end(), [](unsigned char c) { return std::isdigit(c); })) {
    if (wanted.size() < 6 && std::stoul(wanted) < devices.size()) return devices[std::stoul(wanted)];
  } else {
    for (const auto& device : devices)
      if (device.type == wanted) return device;
    for (const auto& device : devices)
      if (lowered(device.name + " " + device.platform_name).find(wanted) != std::string::npos) return device;
  }
  throw UserError("--device " + spec + ": no such device among the " + std::to_string(devices.size()) +
                  " found; expected an index, cpu, gpu or part of a name (see `causticl devices`)" +
                  did_you_mean(spec, {"cpu", "gpu", "all"}));
}

std::vector<DeviceInfo> find_devices(const std::string& spec) {
  if (lowered(spec) == "all") {
    auto all = list_devices();
    if (all.empty()) find_device("");  // throws the message that says what to install
    return all;
  }
  std::vector<DeviceInfo> result;
  for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + 1) {
    end = spec.find(',', begin);
    result.push_back(find_device(spec.substr(begin, end - begin)));
    for (std::size_t i = 0; i + 1 < result.size(); ++i)
      if (result[i].device() == result.back().device())
        throw UserError("--device " + spec + ": " + result.back().name + " is named twice");
  }
  return result;
}

Device::Device(const DeviceInfo& info, unsigned threads, KernelCache* cache)
    : info_(info),
      device_(info.device),
      is_pocl_(info.platform_name.find("Portable Computing Language") != std::string::npos),
      is_oclgrind_(info.platform_name.find("Oclgrind") != std::string::npos),
      cache_(cache) {
  try {
    if (threads > 0 && threads < info.compute_units && info.type == "cpu") {
      const cl_device_partition_property counts[] = {CL_DEVICE_PARTITION_BY_COUNTS,
                                                     static_cast<cl_device_partition_property>(threads),
                                                     CL_DEVICE_PARTITION_BY_COUNTS_LIST_END, 0};
      std::vector<cl::Device> parts;
      device_.createSubDevices(counts, &parts);
      device_ = parts.at(0);
    }
    context_ = cl::Context(device_);
    queue_ = cl::CommandQueue(context_, device_, CL_QUEUE_PROFILING_ENABLE);
  } catch (const cl::Error& error) {
    throw DeviceError("device " + info.name + " cannot be opened: " + error.what() + " failed with " +
                      std::to_string(error.err()));
  }
}

cl::Program Device::build(const std::string& source, const std::string& options) {
  const auto start = std::chrono::steady_clock::now();
  const ProgramText text{
      info_.platform_name + ", " + info_.platform_version + ", " + info_.name + ", " + info_.driver,
      "-cl-std=CL1.2 " + options, source};
  cl::Program program;
  try {
    program = cache_ ? cache_->build(context_, device_, text,
                                     is_pocl_ ? KernelForm::pocl_files : KernelForm::binary)
                     : build_from_source(context_, device_, text);
  } catch (const cl::BuildError& error) {
    std::string log;
    for (const auto& [device, its] : error.getBuildLog()) log += its;
    throw DeviceError("device " + info_.name + " cannot build a kernel program (error " +
                      std::to_string(error.err()) + "):\n" + log);
  }
  build_seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return program;
}

cl::Buffer Device::buffer(std::size_t bytes, const std::string& what) {
  const std::size_t size = std::max<std::size_t>(bytes, 16);
  const std::string refusal =
      "device " + info_.name + " has no room for " + what + ": " + std::to_string(size >> 20) +
      " MiB asked for, " + std::to_string(info_.largest_allocation >> 20) + " MiB is its largest allocation";
  if (size > info_.largest_allocation) throw DeviceError(refusal);
  try {
    cl::Buffer result(context_, CL_MEM_READ_WRITE, size);
    allocated_bytes_ += size;
    return result;
  } catch (const cl::Error& error) {
    throw DeviceError(refusal + " (error " + std::to_string(error.err()) + ")");
  }
}

void Device::clear(const cl::Buffer& target, std::size_t bytes) {
  if (bytes) queue_.enqueueFillBuffer(target, cl_uchar(0), 0, bytes);
}

void Device::launch(cl::Kernel& kernel, std::size_t items) {
  if (items == 0) return;
  cl::Event event;
  const std::size_t groups = (items + local_size_ - 1) / local_size_;
  queue_.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(groups * local_size_),
                              cl::NDRange(local_size_), nullptr, &event);
  pending_.emplace_back(kernel.getInfo<CL_KERNEL_FUNCTION_NAME>(), event);
  // Events hold driver memory: drop those that are done before many gather.
  if (pending_.size() >= 4096) collect_events();
}

void Device::set_local_size(std::size_t size) {
  if (size < 1 || size > LARGEST_WORK_GROUP)
    throw std::logic_error("a work-group has 1 to " + std::to_string(LARGEST_WORK_GROUP) + " items");
  local_size_ = size;
}

std::size_t Device::launch_size(std::size_t items) const {
  constexpr std::size_t pocl_large = 65536;
  const std::size_t at_least = is_pocl_ ? std::max(items, pocl_large) : items;
  return (at_least + local_size_ - 1) / local_size_ * local_size_;
}

void Device::launch_pass(cl::Kernel& kernel, std::size_t items) {
  if (items > 0) launch(kernel, launch_size(items));
}

void Device::collect_events() {
  queue_.finish();
  for (auto& [name, event] : pending_) {
    auto& time = kernel_times_[trimmed(name)];
    time.milliseconds += 1e-6 * static_cast<double>(event.getProfilingInfo<CL_PROFILING_COMMAND_END>() -
                                                    event.getProfilingInfo<CL_PROFILING_COMMAND_START>());
    ++time.launches;
  }
  pending_.clear();
}

const std::map<std::string, KernelTime>& Device::kernel_times() {
  collect_events();
  return kernel_times_;
}

}  // namespace causticl
