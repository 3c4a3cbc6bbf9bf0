#include "app/report.hpp"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/progress.hpp"

namespace causticl {
namespace {

using Number = unsigned long long;

[[gnu::format(printf, 2, 3)]] void append(std::string& text, const char* format, ...) {
  va_list arguments, again;
  va_start(arguments, format);
  va_copy(again, arguments);
  const auto length = static_cast<std::size_t>(std::vsnprintf(nullptr, 0, format, arguments));
  std::string line(length + 1, '\0');
  std::vsnprintf(line.data(), line.size(), format, again);
  va_end(again);
  va_end(arguments);
  text.append(line, 0, length);
}

const char* name(StopReason stop) {
  switch (stop) {
    case StopReason::time:
      return "time";
    case StopReason::error:
      return "error";
    case StopReason::interrupted:
      return "interrupted";
    case StopReason::passes:
      break;
  }
  return "passes";
}

std::string kernel_table(const std::map<std::string, KernelTime>& kernels) {
  std::vector<std::pair<std::string, KernelTime>> rows(kernels.begin(), kernels.end());
  std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) {
    return a.second.milliseconds > b.second.milliseconds;
  });
  double total = 0;
  for (const auto& row : rows) total += row.second.milliseconds;

  std::string text;
  append(text, "  %-28s %12s %9s %7s\n", "kernel", "ms", "launches", "share");
  for (const auto& [kernel, time] : rows)
    append(text, "  %-28s %12.2f %9llu %6.1f%%\n", kernel.c_str(), time.milliseconds, Number(time.launches),
           total > 0 ? 100 * time.milliseconds / total : 0);
  append(text, "  %-28s %12.2f\n", "all kernels", total);
  return text;
}

/// Passes that ran, of which each has a program.
std::size_t built_programs(const Statistics& s) {
  return static_cast<std::size_t>(
      std::count_if(s.pass_programs.begin(), s.pass_programs.end(),
                    [](const PassStatistics& pass) { return pass.skipped.empty(); }));
}

std::string pass_table(const std::vector<PassStatistics>& passes) {
  std::string text;
  append(text, "  %-28s %12s %9s  %s\n", "pass", "build s", "launches", "built for");
  for (const auto& pass : passes)
    if (pass.skipped.empty())
      append(text, "  %-28s %12.3f %9llu  %s\n", pass.name.c_str(), pass.build_seconds, Number(pass.launches),
             pass.effects.empty() ? "every scene" : pass.effects.c_str());
    else
      append(text, "  %-28s %12s %9llu  %s\n", pass.name.c_str(), "skipped", Number(pass.launches),
             pass.skipped.c_str());
  return text;
}

/// The key of a kernel: scripts know those that have another name now by their old one.
std::string json_key(const std::string& kernel) {
  if (kernel == "primary_hits") return "first_hits";
  if (kernel == "count_visible") return "count_marked";
  return kernel;
}

}  // namespace

std::string byte_size(double bytes) {
  const char* const units[] = {"B", "KiB", "MiB", "GiB", "TiB"};
  std::size_t unit = 0;
  for (; bytes >= 1024 && unit + 1 < std::size(units); ++unit) bytes /= 1024;
  std::string text;
  append(text, unit == 0 ? "%.0f %s" : "%.2f %s", bytes, units[unit]);
  return text;
}

std::string statistics_table(const Statistics& s) {
  std::string text;
  append(text, "  %-28s %s\n", "device", s.device.c_str());
  append(text, "  %-28s %s\n", "precision", name_of(s.precision));
  append(text, "  %-28s %llu (stopped by: %s)\n", "passes", Number(s.passes), name(s.stop));
  if (s.error)
    append(text, "  %-28s %s in %s of the pixels (noise alone %s, bias alone %s)\n", "error, at most",
           percentage(s.error->error).c_str(), percentage(s.confidence).c_str(),
           percentage(s.error->noise).c_str(), percentage(s.error->bias).c_str());
  append(text, "  %-28s %.3f s\n", "time", s.seconds);
  append(text, "  %-28s %.3f s\n", "  to the first pass", s.first_pass_seconds);
  append(text, "  %-28s %.3f s\n", "  until it was done", s.first_pass_done_seconds);
  append(text, "  %-28s %.3f s, %llu of %zu programs kept from an earlier run\n", "  building kernels",
         s.kernel_build_seconds, Number(s.cached_programs), built_programs(s));
  append(text, "  %-28s %.3f s\n", "  building the tree", s.tree_build_seconds);
  append(text, "  %-28s %llu triangles, %llu other shapes, %llu emitters\n", "scene", Number(s.triangles),
         Number(s.shapes), Number(s.emitters));
  append(text, "  %-28s %s\n", "camera rays", s.camera_rays.c_str());
  append(text, "  %-28s %llu (%s/s)\n", "rays", Number(s.rays), si_number(s.rays_per_second).c_str());
  if (s.photons) {
    append(text, "  %-28s %llu (%s/s)\n", "photons", Number(s.photons),
           si_number(s.photons_per_second).c_str());
    append(text, "  %-28s %s\n", "  photon rays", s.photon_rays.c_str());
    append(text, "  %-28s %llu\n", "  stored in the last pass", Number(s.stored_photons));
    if (s.seeds)
      append(text, "  %-28s %.2g%% of the pilot paths land where the camera sees; %s\n", "  guided",
             100 * s.seeds->fraction,
             s.seeds->copies         ? (std::to_string(s.seeds->copies) + " copies of each").c_str()
             : s.seeds->fraction > 0 ? "too many to copy: most passes are as without"
                                     : "nothing to copy");
    append(text, "  %-28s %g (%s)\n", "first radius", s.first_radius,
           s.first_radius_chosen ? "chosen from the scene" : "of the scene file");
  }
  append(text, "  %-28s %s, %.1f bytes a pixel\n", "device memory",
         byte_size(static_cast<double>(s.device_bytes)).c_str(), s.bytes_per_pixel);
  append(text, "  %-28s %s\n", "peak memory of the process",
         byte_size(static_cast<double>(s.peak_memory_bytes)).c_str());
  append(text, "  %-28s", "faults");
  for (const auto& kind : diagnostic_kinds)
    append(text, " %s %llu", kind.key, Number(s.diagnostics.*kind.count));
  text += "\n\n" + pass_table(s.pass_programs) + "\n" + kernel_table(s.kernels);

  if (s.skipped_triangles)
    append(text, "warning: %llu triangles without area were left out\n", Number(s.skipped_triangles));
  return text;
}

std::string statistics_json(const Statistics& s) {
  nlohmann::ordered_json milliseconds = nlohmann::ordered_json::object(), launches = milliseconds;
  for (const auto& [kernel, time] : s.kernels) {
    milliseconds[json_key(kernel)] = time.milliseconds;
    launches[json_key(kernel)] = time.launches;
  }
  nlohmann::ordered_json passes = nlohmann::ordered_json::array();
  for (const auto& pass : s.pass_programs)
    passes.push_back({{"name", pass.name},
                      {"skipped", pass.skipped},
                      {"effects", pass.effects},
                      {"build_seconds", pass.build_seconds},
                      {"launches", pass.launches}});
  nlohmann::ordered_json object = {{"version", CAUSTICL_VERSION},
                                   {"device", s.device},
                                   {"precision", name_of(s.precision)},
                                   {"stop", name(s.stop)},
                                   {"error", nullptr},
                                   {"error_noise", nullptr},
                                   {"error_bias", nullptr},
                                   {"confidence", s.confidence},
                                   {"seconds", s.seconds},
                                   {"first_pass_seconds", s.first_pass_seconds},
                                   {"first_pass_done_seconds", s.first_pass_done_seconds},
                                   {"kernel_build_seconds", s.kernel_build_seconds},
                                   {"kept_programs", s.cached_programs},
                                   {"pass_seconds", s.pass_seconds},
                                   {"error_seconds", s.error_seconds},
                                   {"film_stop_seconds", s.film_stop_seconds},
                                   {"tree_build_seconds", s.tree_build_seconds},
                                   {"camera_rays", s.camera_rays},
                                   {"photon_rays", s.photon_rays},
                                   {"passes", s.passes},
                                   {"photons", s.photons},
                                   {"photons_per_second", s.photons_per_second},
                                   {"rays", s.rays},
                                   {"rays_per_second", s.rays_per_second},
                                   {"triangles", s.triangles},
                                   {"shapes", s.shapes},
                                   {"skipped_triangles", s.skipped_triangles},
                                   {"emitters", s.emitters},
                                   {"stored_photons", s.stored_photons},
                                   {"first_radius", s.first_radius},
                                   {"first_radius_chosen", s.first_radius_chosen},
                                   {"device_bytes", s.device_bytes},
                                   {"peak_memory_bytes", s.peak_memory_bytes},
                                   {"bytes_per_pixel", s.bytes_per_pixel},
                                   {"programs", passes},
                                   {"kernels", milliseconds},
                                   {"kernel_launches", launches}};
  if (s.seeds) object["guided"] = {{"share", s.seeds->fraction}, {"copies", s.seeds->copies}};
  if (s.error) {
    object["error"] = s.error->error;
    object["error_noise"] = s.error->noise;
    object["error_bias"] = s.error->bias;
    object["error_unknown"] = s.error->unknown;
    if (s.passes_to_half_error) object["passes_to_half_error"] = *s.passes_to_half_error;
  }
  for (const auto& kind : diagnostic_kinds) object[kind.key] = s.diagnostics.*kind.count;
  // A device may name itself in any encoding: what is not UTF-8 is replaced rather than thrown at.
  return object.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string device_list(const std::vector<DeviceInfo>& devices) {
  if (devices.empty()) find_device("");  // throws the message that says what to install
  std::string text;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const DeviceInfo& d = devices[i];
    append(text, "%zu: %s\n", i, d.name.c_str());
    append(text, "   type            %s\n", d.type.c_str());
    append(text, "   platform        %s\n", d.platform_name.c_str());
    append(text, "   vendor          %s\n", d.vendor.c_str());
    append(text, "   driver          %s\n", d.driver.c_str());
    append(text, "   version         %s\n", d.opencl_version.c_str());
    append(text, "   compute units   %u\n", d.compute_units);
    append(text, "   memory          %s\n", byte_size(static_cast<double>(d.global_memory)).c_str());
    append(text, "   max allocation  %s\n", byte_size(static_cast<double>(d.largest_allocation)).c_str());
    append(text, "   max work-group  %zu\n", d.largest_work_group);
    append(text, "   fp64            %s\n", d.fp64 ? "yes" : "no");
  }
  return text;
}

}  // namespace causticl
