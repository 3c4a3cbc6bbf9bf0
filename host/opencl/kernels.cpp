#include "opencl/kernels.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>

#include "base/error.hpp"
#include "opencl/kernel_sources.hpp"
#include "shared/effects.h"

namespace causticl {
namespace {

/// What the kernels of each pass ask for with HAS().
const std::map<std::string, unsigned> effects_read{
    {"photon", EFFECTS_READ(IN_PHOTON) | OUTPUT_LIGHT_PASSES},
    {"camera", EFFECTS_READ(IN_CAMERA) | OUTPUT_LIGHT_PASSES},
    {"grid", 0},
    {"gather", EFFECTS_READ(IN_GATHER) | OUTPUT_LIGHT_PASSES},
    {"film", 0},
    {"path", EFFECTS_READ(IN_PATH) | OUTPUT_LIGHT_PASSES},
};

void dump(const std::string& folder, const std::string& pass, const std::string& source) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw UserError("--dump-kernels " + folder + ": cannot be made a folder: " + error.message());
  const auto file = std::filesystem::path(folder) / ("pass_" + pass + ".cl");
  std::ofstream out(file);
  if (!(out << source).flush()) throw UserError("--dump-kernels: cannot write " + file.string());
}

}  // namespace

const char* name_of(Precision precision) { return precision == Precision::float64 ? "double" : "float"; }

unsigned effects_of_pass(const std::string& pass) { return effects_read.at(pass); }

cl::Program build_pass(Device& device, const std::string& pass, const KernelOptions& options) {
  const bool in_double = options.precision == Precision::float64;
  if (in_double && !device.info().fp64)
    throw DeviceError("--precision double: device " + device.info().name +
                      " has no double precision (cl_khr_fp64); use --precision float or another --device");
  const unsigned effects = options.effects & effects_of_pass(pass);
  char define[64];
  std::snprintf(define, sizeof define, "#define EFFECTS 0x%xu\n", effects);
  std::string defines = define;
  if (in_double) defines += "#define CAUSTICL_DOUBLE\n";
  if (options.triangle_test == TriangleTest::precomputed && (effects & EFFECT_TRIANGLES))
    defines += "#define TRIANGLES_PRECOMPUTED\n";
  if (options.camera_packets && (pass == "camera" || pass == "path")) defines += "#define CAMERA_PACKETS\n";
  if (options.brute_force && (pass == "photon" || pass == "camera")) defines += "#define BRUTE_FORCE\n";
  const std::string source =
      defines + flatten_kernel_source("passes/pass_" + pass + ".cl", options.kernel_dir);
  if (!options.dump_kernels.empty()) dump(options.dump_kernels, pass, source);
  // Names and types of arguments, for the first launch of each kernel (programs.cpp).
  return device.build(source, "-cl-kernel-arg-info");
}

}  // namespace causticl
