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
  RendererSpec& renderer = scene.renderer;
  // Who asks for an error wants as many passes as it takes.
  if (options.render.wanted_error) renderer.passes = renderer.samples = endless_passes;
  const std::string own = name_of(renderer.integrator);
  for (const RendererOption& option : options.renderer_options)
    if (std::find(option.integrators.begin(), option.integrators.end(), own) != option.integrators.end())
      option.apply(renderer);
    else
      scene.notices.push_back(option.name + " has no effect: it belongs to " + listed(option.integrators) +
                              " and this render uses " + own);
}

std::vector<std::string> output_files(const Options& options, const Scene& scene) {
  if (!options.render.outputs.empty()) return options.render.outputs;
  return {scene_output(scene).file};
}

void check_outputs(const Options& options, const std::vector<std::string>& outputs) {
  if (options.render.outputs.empty())
    for (const auto& file : outputs) prepare_scene_output(file);
  for (const auto& file : outputs) check_output(file);
  if (options.render.layers && std::none_of(outputs.begin(), outputs.end(), holds_channels))
    throw UserError("--layers: no output can hold them; expected one that ends in .exr, as in -o " +
                    std::filesystem::path(outputs.front()).stem().string() + ".exr");
  if (!options.stats_json.empty()) check_writable(options.stats_json);
}

std::string threads_notice(const Options& options, const DeviceInfo& info) {
  if (options.render.threads == 0) return {};
  if (info.type != "cpu") return "--threads has no effect: " + info.name + " is not a CPU device";
  if (options.render.threads > info.compute_units)
    return "--threads " + std::to_string(options.render.threads) + ": the device has " +
           std::to_string(info.compute_units) + " compute units, and all are used";
  return {};
}

}  // namespace causticl
