#include "opencl/kernels.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "base/error.hpp"
#include "effects/passes.hpp"
#include "opencl/kernel_sources.hpp"
#include "shared/effects.h"

namespace causticl {
namespace {

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

unsigned effects_of_pass(const std::string& pass) {
  const PassRow& row = pass_row(pass);
  unsigned effects = (row.properties & HOLDS_LIGHT_PASSES) ? OUTPUT_LIGHT_PASSES : 0u;
#define EFFECT_OF_PASS(x, NAME, number, key, programs, ...) \
  if ((programs)&row.bit) effects |= EFFECT_##NAME;
  EFFECT_TABLE(EFFECT_OF_PASS, )
#undef EFFECT_OF_PASS
  return effects;
}

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
  const unsigned properties = pass_row(pass).properties;
  if (options.camera_packets && (properties & TRACES_CAMERA_RAYS)) defines += "#define CAMERA_PACKETS\n";
  if (options.brute_force && (properties & TRACES_BATCHES)) defines += "#define BRUTE_FORCE\n";
  const std::string source =
      defines + flatten_kernel_source("passes/pass_" + pass + ".cl", options.kernel_dir);
  if (!options.dump_kernels.empty()) dump(options.dump_kernels, pass, source);
  // Names and types of arguments, for the first launch of each kernel (programs.cpp).
  return device.build(source, "-cl-kernel-arg-info");
}

}  // namespace causticl
