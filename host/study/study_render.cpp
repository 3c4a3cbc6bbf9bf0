#include "study/study_render.hpp"

#include <algorithm>
#include <chrono>

#include "accuracy/compare.hpp"
#include "scene/integrators.hpp"

namespace causticl {
namespace {

constexpr int endless = 1 << 30;  // passes

StudySample sample_of(std::uint64_t passes, std::uint64_t photons, double seconds, const Picture& picture,
                      const Picture& reference) {
  const Comparison comparison = compare_pictures(picture, reference);
  StudySample sample;
  sample.passes = passes;
  sample.photons = photons;
  sample.seconds = seconds;
  sample.relative_mse = comparison.relative_mse;
  sample.error_90 = comparison.error_90;
  sample.flip = comparison.flip;
  sample.mean = comparison.mean;
  return sample;
}

/// What decides which kernels a render compiles, besides the scene's objects and materials. PoCL compiles
/// them anew for launches of more than 65,535 work-items.
std::string kernels_of(const Scene& scene, const RenderOptions& options) {
  const RendererSpec& renderer = scene.renderer;
  std::string kernels = name_of(options.precision);
  kernels += options.triangle_test == TriangleTest::precomputed ? " precomputed" : " watertight";
  if (!traces_photons(renderer.integrator)) return kernels + " " + name_of(renderer.integrator);
  kernels += renderer.direct_light == DirectLight::photons ? " photons" : " shadow_rays";
  return kernels + (renderer.photons > 65535 ? " many" : " few");
}

}  // namespace

StudyRenderer::StudyRenderer(const StudyRequest& request, KernelCache& kernels, std::pair<int, int> size)
    : request_(request), kernels_(kernels), scene_options_(request.scene_options) {
  scene_options_.size = size;
}

RenderSetup StudyRenderer::setup_of(const RenderChange& change) {
  auto found = scenes_.find(change.integrator);
  if (found == scenes_.end()) {
    SceneOptions options = scene_options_;
    options.integrator = change.integrator;
    found = scenes_.emplace(change.integrator, load_scene(request_.scene, options)).first;
  }
  RenderSetup setup{found->second, request_.render};
  for (const auto& step : change.steps) step(setup.scene, setup.options);
  return setup;
}

MeasuredRender StudyRenderer::render(const StudySetting& setting, std::uint32_t seed,
                                     const Picture* reference, const StopAsked& stop) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  RenderSetup setup = setup_of(setting.change);
  Scene& scene = setup.scene;
  RenderOptions& render = setup.options;
  render.seed = seed;
  const DeviceInfo device_info = find_device(request_.device);

  const std::string kernels = kernels_of(scene, render);
  if (std::find(warm_.begin(), warm_.end(), kernels) == warm_.end()) {
    Device device(device_info, request_.render.threads, &kernels_);
    Scene brief = scene;
    brief.renderer.passes = brief.renderer.samples = 1;
    render_scene(brief, device, render);
    warm_.push_back(kernels);
  }

  MeasuredRender result;
  result.run.parameter = setting.parameter;
  result.run.value = setting.value;
  result.run.seed = seed;
  scene.renderer.passes = scene.renderer.samples = endless;
  Device device(device_info, request_.render.threads, &kernels_);
  if (reference)
    render.snapshot = [&](const Snapshot& now) {
      result.run.samples.push_back(sample_of(now.passes, now.photons, now.seconds, now.picture, *reference));
    };
  double before = 0;
  bool stopping = false;
  const auto look = [&](const Progress& now) {
    stopping = stop({now.pass_seconds, now.pass_seconds - before, result.run});
    before = now.pass_seconds;
  };
  RenderResult rendered = render_scene(scene, device, render, look, {}, [&] { return stopping; });
  const Statistics& statistics = rendered.statistics;
  if (reference && (result.run.samples.empty() || result.run.samples.back().passes != statistics.passes))
    result.run.samples.push_back(sample_of(statistics.passes, statistics.photons, statistics.pass_seconds,
                                           rendered.picture, *reference));
  for (const auto& [kernel, time] : statistics.kernels)
    result.run.kernel_milliseconds[kernel] = time.milliseconds;
  result.run.setup_seconds = statistics.first_pass_seconds;
  result.picture = std::move(rendered.picture);
  result.first_radius = statistics.first_radius;
  result.pass_seconds = statistics.pass_seconds;
  result.passes = statistics.passes;
  result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return result;
}

}  // namespace causticl
