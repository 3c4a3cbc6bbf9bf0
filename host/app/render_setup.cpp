#include "app/render_setup.hpp"

#include <algorithm>
#include <filesystem>

#include "base/error.hpp"
#include "base/output_file.hpp"
#include "base/spelling.hpp"
#include "format/scene_output.hpp"
#include "image/image.hpp"
#include "scene/integrators.hpp"

namespace causticl {

void apply_options(const Options& options, Scene& scene) {
  auto& renderer = scene.renderer;
  // Who asks for an error wants as many passes as it takes.
  if (options.wanted_error) renderer.passes = renderer.samples = endless_passes;
  const auto apply = [&](const auto& value, auto& target, const std::string& option,
                         const std::vector<std::string>& owners) {
    if (!value) return;
    const std::string own = name_of(renderer.integrator);
    if (std::find(owners.begin(), owners.end(), own) == owners.end())
      scene.notices.push_back(option + " has no effect: it belongs to " + listed(owners) +
                              " and this render uses " + own);
    else
      target = *value;
  };
  const auto counted_by = [](int RendererSpec::*field) {
    return integrators_with([=](const IntegratorRow& row) { return row.passes == field; });
  };
  apply(options.passes, renderer.passes, "--passes", counted_by(&RendererSpec::passes));
  apply(options.photons, renderer.photons, "--photons",
        integrators_with([](const IntegratorRow& row) { return traces_photons(row.integrator); }));
  apply(options.samples, renderer.samples, "--samples", counted_by(&RendererSpec::samples));
}

std::vector<std::string> output_files(const Options& options, const Scene& scene) {
  if (!options.outputs.empty()) return options.outputs;
  return {scene_output(scene).file};
}

void check_outputs(const Options& options, const std::vector<std::string>& outputs) {
  if (options.outputs.empty())
    for (const auto& file : outputs) prepare_scene_output(file);
  for (const auto& file : outputs) check_output(file);
  if (options.layers && std::none_of(outputs.begin(), outputs.end(), holds_channels))
    throw UserError("--layers: no output can hold them; expected one that ends in .exr, as in -o " +
                    std::filesystem::path(outputs.front()).stem().string() + ".exr");
  if (!options.stats_json.empty()) check_writable(options.stats_json);
}

std::string threads_notice(const Options& options, const DeviceInfo& info) {
  if (options.threads == 0) return {};
  if (info.type != "cpu") return "--threads has no effect: " + info.name + " is not a CPU device";
  if (options.threads > info.compute_units)
    return "--threads " + std::to_string(options.threads) + ": the device has " +
           std::to_string(info.compute_units) + " compute units, and all are used";
  return {};
}

RenderOptions render_options(const Options& options, const std::vector<std::string>& outputs) {
  RenderOptions result;
  result.outputs = outputs;
  result.time_limit = options.time_limit;
  result.wanted_error = options.wanted_error;
  result.confidence = options.confidence;
  result.layers = options.layers;
  result.seed = options.seed;
  result.precision = options.precision;
  result.threads = options.threads;
  result.effects = options.effects;
  result.triangle_test = options.triangle_test;
  result.kernel_dir = options.kernel_dir;
  result.dump_kernels = options.dump_kernels;
  return result;
}

}  // namespace causticl
