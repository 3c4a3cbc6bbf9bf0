// What trace_photons stores.
#include <cstring>
#include <numbers>

#include "device_fixture.hpp"
#include "device_scene/params.hpp"
#include "effects/effects.hpp"
#include "photons/photon_map.hpp"
#include "render/render_fixture.hpp"

using namespace causticl;

namespace {

/// Photons of one pass, and the counters after it.
std::pair<std::vector<Photon>, Counters> traced(const Scene& scene, uint photons) {
  const DeviceScene device_scene = update_device_scene(scene, test_device());
  KernelOptions options;
  options.effects = effect_bits(find_effects(scene)) | OUTPUT_LIGHT_PASSES;
  Programs programs(test_device(), options, {"photon"});
  const auto counters = test_device().upload(std::vector<Counters>{{}}, "counters");
  MetropolisPhotons unguided(device_scene, test_device(), programs, photons, false);
  ProjectionMap aimless(test_device(), device_scene.emitter_count, photons, false);
  PhotonMap map(device_scene, test_device(), programs, counters, unguided, aimless);
  map.prepare(programs);
  Params params = scene_params(scene, device_scene, 7);
  begin_pass(params, 0);
  params.photon_count = photons;
  params.photon_flux = static_cast<float>(std::numbers::pi * device_scene.emitted_power / photons);
  const Counters after = map.trace(params);
  const auto bytes = map.records();
  std::vector<Photon> records(bytes.size() / sizeof(Photon));
  std::memcpy(records.data(), bytes.data(), bytes.size());
  return {records, after};
}

}  // namespace

TEST_CASE("photons that a diffuse surface has scattered are marked as indirect, and counted") {
  const Scene scene = scene_from_text(R"({
    "camera": {"position": [0, 1, 4], "target": [0, 1, 0], "fov": 40},
    "materials": {"white": {"type": "diffuse", "color": [0.8, 0.8, 0.8]},
                  "lamp": {"type": "diffuse", "color": [0, 0, 0], "emission": [9, 9, 9]},
                  "mirror": {"type": "mirror", "color": [0.9, 0.9, 0.9]},
                  "glass": {"type": "glass", "ior": 1.5}},
    "objects": [{"type": "box", "material": "white", "size": [4, 0.5, 4]},
                {"type": "sphere", "material": "lamp", "radius": 0.3,
                 "transform": [{"type": "shift", "x": 0, "y": 3, "z": 0}]},
                {"type": "sphere", "material": "mirror", "radius": 0.5,
                 "transform": [{"type": "shift", "x": -0.8, "y": 0.6, "z": 0}]},
                {"type": "sphere", "material": "glass", "radius": 0.5,
                 "transform": [{"type": "shift", "x": 0.8, "y": 0.6, "z": 0}]}]})");
  const auto [photons, counters] = traced(scene, 20000);
  // Without rough lobes and media, a photon's light is indirect in the sense of light_passes.cl after the
  // same events.
  std::size_t of_layer[LIGHT_PASS_COUNT] = {}, wrong = 0;
  for (const Photon& photon : photons) {
    const uint layer = photon.flux_b >> PHOTON_LIGHT_PASS_SHIFT;
    ++of_layer[layer];
    wrong += (layer == LIGHT_PASS_INDIRECT) != ((photon.normal & INDIRECT_PHOTON) != 0);
  }
  CHECK(wrong == 0);
  for (const std::size_t count : of_layer) CHECK(count > 100);
  CHECK(counters.photons == photons.size());
  CHECK(counters.indirect == of_layer[LIGHT_PASS_INDIRECT]);
}
