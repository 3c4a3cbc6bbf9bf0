// What a pilot decides of a scene.
#include "integrators/integrators.hpp"
#include "render/explain.hpp"
#include "render/several_devices.hpp"
#include "shared/effects.h"

namespace causticl {

void explain_pilot(Explanation& explanation, const Scene& scene, Device& device,
                   const RenderOptions& options) {
  if (!why_skipped(explanation.passes, "photon").empty()) return;
  const unsigned compiled = chosen_effects(find_effects(scene), options.effects);
  const KernelOptions kernels{
      compiled, options.precision,
      (compiled & EFFECT_TRIANGLES) != 0 ? options.triangle_test : TriangleTest::watertight,
      options.kernel_dir, options.dump_kernels};
  RenderDevice on(device, scene, crop_of(scene, options), kernels,
                  RayChoice{options.camera_rays, options.photon_rays}, passes_to_run(explanation.passes),
                  options.threads);
  const auto integrator =
      make_integrator({scene, on.scene, on.device, on.film, on.programs, options.seed, true});
  if (const Pilot* pilot = integrator->pilot())
    for (const auto& line : pilot_lines(*pilot, scene.renderer)) explanation.decided.push_back(line);
}

}  // namespace causticl
