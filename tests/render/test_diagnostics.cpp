// What a render does where something runs out or goes wrong: it goes on, counts and says so.
#include "catch2.hpp"

#include "device_fixture.hpp"
#include "render_fixture.hpp"

using namespace causticl;

namespace {

// Photons bounce on and on in a white box: each is stored many times.
const char* const white_box = R"({
  "width": 16, "height": 16, "max_depth": 20,
  "renderer": {"type": "sppm", "photon_sample": 20000, "rounds": 3, "radius": 0.2},
  "camera": {"position": [0, 0, 0.9], "target": [0, 0, 0], "fov": 60},
  "materials": {"white": {"type": "diffuse", "color": [0.95, 0.95, 0.95]},
                "lamp": {"type": "diffuse", "color": [0, 0, 0], "emission": [3, 3, 3]}},
  "objects": [{"type": "box", "size": [2, 2, 2], "material": "white"},
              {"type": "sphere", "radius": 0.2, "material": "lamp"}]
})";

Statistics statistics_with(std::uint64_t largest_allocation) {
  DeviceInfo info = test_device().info();
  if (largest_allocation) info.largest_allocation = largest_allocation;
  Device device(info);
  return render_scene(scene_from_text(white_box), device, {}).statistics;
}

}  // namespace

TEST_CASE("photons beyond the device's memory are dropped and counted, and the render goes on") {
  const Statistics roomy = statistics_with(0), tight = statistics_with(50000 * sizeof(Photon));
  CHECK(roomy.diagnostics.dropped == 0);
  CHECK(diagnostic_warnings(roomy.diagnostics).empty());
  REQUIRE(roomy.stored_photons > 50000);
  CHECK(tight.passes == 3);
  CHECK(tight.stored_photons >= 40000);
  CHECK(tight.stored_photons <= 50000);
  // Every pass has about the photons of the last.
  CHECK(static_cast<double>(tight.diagnostics.dropped) ==
        Approx(3.0 * static_cast<double>(roomy.stored_photons - tight.stored_photons)).epsilon(0.02));
  CHECK(diagnostic_warnings(tight.diagnostics).size() == 1);
}

TEST_CASE("less memory than a pass emits photons is an error that says what to do") {
  REQUIRE_THROWS_WITH(statistics_with(20000 * sizeof(Photon)),
                      Catch::Contains("use fewer a pass and more passes"));
}
