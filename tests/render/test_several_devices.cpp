// Several devices at one picture: the same device, opened several times.
#include <memory>

#include "catch2.hpp"
#include "device_fixture.hpp"
#include "render_fixture.hpp"
#include "temporary_folder.hpp"

using namespace causticl;
using Catch::Contains;

namespace {

RenderResult render_on(std::size_t count, const Scene& scene, const RenderOptions& options,
                       std::vector<std::string>* notices = nullptr) {
  std::vector<std::unique_ptr<Device>> opened;
  std::vector<Device*> devices;
  for (std::size_t i = 0; i < count; ++i) {
    opened.push_back(std::make_unique<Device>(test_device().info()));
    devices.push_back(opened.back().get());
  }
  return render_scene(scene, devices, options, {}, [&](const std::string& text) {
    if (notices) notices->push_back(text);
  });
}

/// The picture and all its channels are those of one device.
void check_same(const Scene& scene, std::size_t devices, RenderOptions options = {}) {
  // Something must be there that holds channels, or none are made.
  TemporaryFolder folder;
  options.outputs = {folder.path("picture.exr")};
  const RenderResult one = render_on(1, scene, options), several = render_on(devices, scene, options);
  CHECK(several.picture.rgb == one.picture.rgb);
  CHECK(mean_luminance(one.picture) > 0);
  REQUIRE(several.picture.channels.size() == one.picture.channels.size());
  CHECK(one.picture.channels.size() >= 3);
  for (std::size_t i = 0; i < one.picture.channels.size(); ++i) {
    INFO(one.picture.channels[i].name);
    CHECK(several.picture.channels[i].name == one.picture.channels[i].name);
    CHECK(several.picture.channels[i].values == one.picture.channels[i].values);
  }
  CHECK(several.statistics.photons == one.statistics.photons);
  CHECK(several.statistics.stored_photons == one.statistics.stored_photons);
  CHECK(several.statistics.first_radius == one.statistics.first_radius);
  REQUIRE(several.statistics.error.has_value() == one.statistics.error.has_value());
  if (one.statistics.error) CHECK(several.statistics.error->error == one.statistics.error->error);
}

Scene small(const std::string& name, Integrator integrator = Integrator::sppm) {
  Scene scene = shipped_scene(name, 24, 18);
  scene.renderer.integrator = integrator;
  scene.renderer.passes = scene.renderer.samples = 5;
  scene.renderer.photons = 3000;
  return scene;
}

}  // namespace

TEST_CASE("several devices make the picture of one to the bit: radii of each pixel's own, and layers") {
  RenderOptions options;
  options.layers = true;
  check_same(small("cornell_box.json"), 2, options);
}

TEST_CASE("several devices make the picture of one to the bit: one radius, direct light by photons") {
  Scene scene = small("glass_caustic.json");
  scene.renderer.schedule = Schedule::global;
  scene.renderer.direct_light = DirectLight::photons;
  check_same(scene, 3);
}

TEST_CASE("several devices make the picture of one to the bit: a medium, and things that move") {
  check_same(small("effects/fog.json"), 2);
  check_same(small("effects/moving_balls.json"), 2);
}

TEST_CASE("several devices make the picture of one to the bit: photons by the projection map") {
  check_same(small("effects/sun.json"), 2);
}

TEST_CASE("several devices make the picture of one to the bit: path tracing, with layers") {
  RenderOptions options;
  options.layers = true;
  check_same(small("7_sppm_room.json", Integrator::pt), 2, options);
}

TEST_CASE("several devices make the picture of one to the bit: in double") {
  if (!test_device().info().fp64) return;
  RenderOptions options;
  options.precision = Precision::float64;
  check_same(small("cornell_box.json"), 2, options);
}

TEST_CASE("more devices than pixels and photons: some have nothing to do") {
  Scene scene = small("cornell_box.json");
  scene.width = 3;
  scene.height = 1;
  scene.renderer.photons = 2;
  check_same(scene, 4);
}

TEST_CASE("several devices say how they share the passes") {
  std::vector<std::string> notices;
  const RenderResult result = render_on(2, small("cornell_box.json"), {}, &notices);
  const std::string name = test_device().info().name;
  CHECK(result.statistics.device == name + " + " + name);
  REQUIRE_FALSE(notices.empty());
  CHECK_THAT(notices.back(), Contains("each pass is shared: ") && Contains("% on " + name + ", "));
}

TEST_CASE("devices are named with commas between them, or all at once") {
  CHECK(find_devices("all").size() == list_devices().size());
  CHECK(find_devices("0").size() == 1);
  CHECK(find_devices("").size() == 1);
  REQUIRE_THROWS_WITH(find_devices("0,0"), Contains("--device 0,0: ") && Contains(" is named twice"));
  REQUIRE_THROWS_WITH(find_devices("0,99"), Contains("--device 99: no such device"));
}
