#include "render/start_integrators.hpp"

#include "integrators/integrators.hpp"

namespace causticl {

std::optional<Pilot> start_integrators(const std::vector<std::unique_ptr<RenderDevice>>& parts,
                                       const Scene& scene, std::uint32_t seed, bool with_photons,
                                       const std::function<void(const std::string&)>& notice) {
  std::optional<Pilot> pilot;
  const auto start = [&](RenderDevice& on) {
    on.integrator = make_integrator(
        {scene, on.scene, on.device, on.film, on.programs, seed, with_photons, pilot ? &*pilot : nullptr});
    if (const Pilot* decided = on.integrator->pilot()) pilot = *decided;
  };
  for (const auto& part : parts) start(*part);
  if (pilot && pilot->copies && parts.size() > 1) {
    pilot->copies = false;
    for (const auto& part : parts) start(*part);
    if (notice) notice("useful photons are not copied: copies cannot be shared between devices");
  }
  if (pilot && with_photons && notice)
    for (const auto& line : pilot_lines(*pilot, scene.renderer)) notice(line);
  return pilot;
}

}  // namespace causticl
