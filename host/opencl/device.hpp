// OpenCL platforms, devices, queues, buffers and programs (CLHPP, RAII).
#pragma once

#include <CL/opencl.hpp>
#include <atomic>
#include <chrono>
#include <map>
#include <string>
#include <vector>

#include "opencl/kernel_cache.hpp"

namespace causticl {

/// A device as `causticl devices` lists it; the position in list_devices() is its index.
struct DeviceInfo {
  cl::Platform platform;
  cl::Device device;
  std::string platform_name, platform_version, name, vendor, driver, opencl_version, type;
  unsigned compute_units = 0;
  std::uint64_t global_memory = 0, largest_allocation = 0;
  std::size_t largest_work_group = 0;
  bool fp64 = false;
};

/// Every device of every platform; empty where there is none.
std::vector<DeviceInfo> list_devices();

/// The device that `spec` names: an index, "cpu", "gpu", or part of a device or platform name (any case). An
/// empty spec takes the first GPU, else the first device. Throws UserError for a spec that fits nothing, and
/// DeviceError where the machine has no device at all.
DeviceInfo find_device(const std::string& spec);

/// The devices that `spec` names: those that find_device() takes, with commas between them, or "all". Throws
/// what find_device() throws, and UserError for a device that is named twice.
std::vector<DeviceInfo> find_devices(const std::string& spec);

/// Milliseconds and launches of each kernel, by name.
struct KernelTime {
  double milliseconds = 0;
  std::uint64_t launches = 0;
};

/// A chosen device with its context and one in-order queue. Counts the memory it gives out.
class Device {
 public:
  /// `threads` > 0 limits a CPU device to that many of its compute units (by a sub-device). Programs are
  /// built through `cache`, where one is given, which must outlive the device.
  explicit Device(const DeviceInfo& info, unsigned threads = 0, KernelCache* cache = nullptr);

  const DeviceInfo& info() const { return info_; }
  const cl::Context& context() const { return context_; }
  const cl::Device& cl_device() const { return device_; }
  cl::CommandQueue& queue() { return queue_; }

  /// Whether programs that are built at the same time are: PoCL has one lock around its compiler.
  bool compiles_in_parallel() const { return !is_pocl_; }

  /// Whether one item of a work-group may do what all are to do: PoCL runs them one after the other
  /// (cl/photons/photon_stream.cl).
  bool has_serial_work_items() const { return is_pocl_; }

  /// Whether several threads may use the device, as OpenCL promises: under Oclgrind one alone.
  bool takes_threads() const { return !is_oclgrind_; }

  /// Compiles OpenCL C. Throws DeviceError with the compiler's log.
  cl::Program build(const std::string& source, const std::string& options = "");

  /// Lets the cache store what the driver has compiled up to now.
  void store_compiled() {
    if (cache_) cache_->store_compiled();
  }

  /// A buffer of `bytes` (at least 16, since OpenCL has no empty buffers), not initialised. Throws
  /// DeviceError that says what was asked for and what the device has.
  cl::Buffer buffer(std::size_t bytes, const std::string& what);

  /// A buffer with the contents of `data`.
  template <typename T>
  cl::Buffer upload(const std::vector<T>& data, const std::string& what) {
    cl::Buffer result = buffer(data.size() * sizeof(T), what);
    if (!data.empty()) queue_.enqueueWriteBuffer(result, CL_TRUE, 0, data.size() * sizeof(T), data.data());
    return result;
  }

  /// The first `count` elements of a buffer, or those from `offset` bytes on. Waits for the queue.
  template <typename T>
  std::vector<T> download(const cl::Buffer& from, std::size_t count, std::size_t offset = 0) {
    std::vector<T> result(count);
    if (count) queue_.enqueueReadBuffer(from, CL_TRUE, offset, count * sizeof(T), result.data());
    return result;
  }

  /// Fills the first `bytes` of a buffer with zero bits.
  void clear(const cl::Buffer& target, std::size_t bytes);

  /// Enqueues `kernel` over at least `items` work-items in groups of local_size(); the kernel must return at
  /// once for get_global_id(0) >= items. The time is added to kernel_times() under the kernel's name.
  void launch(cl::Kernel& kernel, std::size_t items);

  /// What a launch by launch_pass over `items` work-items takes: PoCL compiles a kernel once for launches of
  /// up to 65,535 items and again for larger ones, and idle items are cheap, so that there all are larger.
  std::size_t launch_size(std::size_t items) const;
  /// launch() over launch_size(items) work-items.
  void launch_pass(cl::Kernel& kernel, std::size_t items);

  /// Waits for the queue, then returns what has been launched so far.
  const std::map<std::string, KernelTime>& kernel_times();

  /// Programs that were built of what the cache held.
  std::size_t cached_programs() const { return cache_ ? cache_->reused() : 0; }

  double build_seconds() const { return build_seconds_; }
  std::uint64_t allocated_bytes() const { return allocated_bytes_; }

  /// Work-items of a group, one size for all kernels: PoCL compiles a kernel anew for each size.
  std::size_t local_size() const { return local_size_; }
  /// At most LARGEST_WORK_GROUP.
  void set_local_size(std::size_t size);

 private:
  DeviceInfo info_;
  cl::Device device_;
  cl::Context context_;
  cl::CommandQueue queue_;
  std::size_t local_size_ = 64;
  bool is_pocl_ = false, is_oclgrind_ = false;
  KernelCache* cache_ = nullptr;
  std::atomic<double> build_seconds_{0};
  std::uint64_t allocated_bytes_ = 0;
  std::vector<std::pair<std::string, cl::Event>> pending_;
  std::map<std::string, KernelTime> kernel_times_;
  void collect_events();
};

/// Sets all arguments of a kernel in order.
template <typename... Arguments>
void set_arguments(cl::Kernel& kernel, const Arguments&... arguments) {
  cl_uint index = 0;
  (kernel.setArg(index++, arguments), ...);
}

}  // namespace causticl
