#include "opencl/driver_needs.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "base/error.hpp"
#include "base/input_file.hpp"

namespace causticl {
namespace {

namespace fs = std::filesystem;

/// With less than that PoCL's compiler ends the process while it compiles the kernels of a small scene.
constexpr std::uint64_t address_space_of_pocl = std::uint64_t{600} << 20;

bool names_pocl(const fs::path& icd) {
  std::ifstream in(icd);
  std::string library;
  return in && std::getline(in, library) && library.find("pocl") != std::string::npos;
}

/// Whether the loader of drivers would load PoCL.
bool pocl_is_installed() {
  const char* chosen = std::getenv("OCL_ICD_VENDORS");
  const fs::path vendors = chosen && *chosen ? chosen : "/etc/OpenCL/vendors";
  std::error_code error;
  if (!fs::is_directory(vendors, error)) return vendors.string().find("pocl") != std::string::npos;
  for (const auto& entry : fs::directory_iterator(vendors, error))
    if (entry.path().extension() == ".icd" && names_pocl(entry.path())) return true;
  return false;
}

}  // namespace

void check_driver_needs() {
  if (!pocl_is_installed()) return;
  if (access("/sys/devices/system/cpu", R_OK) != 0)
    throw DeviceError(
        "/sys is missing, and PoCL, the OpenCL driver for CPUs, finds neither processors nor memory without "
        "it; mount it, as by mount -t sysfs sysfs /sys");
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY &&
      limit.rlim_cur < address_space_of_pocl)
    throw DeviceError("the address space is limited to " + bytes_text(limit.rlim_cur) +
                      ", and PoCL, the OpenCL driver for CPUs, compiles within " +
                      bytes_text(address_space_of_pocl) + "; raise the limit, as by ulimit -v unlimited");
}

}  // namespace causticl
