// From the command line to what is rendered and where it goes.
#include <iterator>

#include "app/options.hpp"
#include "app/render_setup.hpp"
#include "catch2.hpp"
#include "report_fixture.hpp"

using namespace causticl;

TEST_CASE("limits of the command line replace the scene's where they apply, and say where they do not") {
  Scene scene = example_scene();
  const char* const words[] = {"causticl",  "render", "SCENE",    "--samples", "9",
                               "--photons", "5",      "--passes", "3"};
  const Options options = parse_options(std::size(words), words);
  apply_options(options, scene);
  CHECK(scene.renderer.passes == 3);
  CHECK(scene.renderer.photons == 5);
  CHECK(scene.renderer.samples == 64);
  REQUIRE(scene.notices.size() == 1);
  CHECK(scene.notices[0] == "--samples has no effect: it belongs to pt and this render uses sppm");
}

TEST_CASE("outputs are those of the command line, else the scene's, else named after it") {
  Scene scene = example_scene();
  Options options;
  options.scene = scene.file = "some/where/name.json";
  CHECK(output_files(options, scene) == std::vector<std::string>{"name.png"});
  scene.output = "of_scene.exr";
  CHECK(output_files(options, scene) == std::vector<std::string>{"of_scene.exr"});
  options.render.outputs = {"a.png", "b.pfm"};
  CHECK(output_files(options, scene) == options.render.outputs);
}

TEST_CASE("--threads says what it cannot do on a device") {
  Options options;
  DeviceInfo info;
  info.name = "Card";
  info.type = "gpu";
  info.compute_units = 4;
  CHECK(threads_notice(options, info).empty());
  options.render.threads = 2;
  CHECK(threads_notice(options, info) == "--threads has no effect: Card is not a CPU device");
  info.type = "cpu";
  CHECK(threads_notice(options, info).empty());
  options.render.threads = 5;
  CHECK(threads_notice(options, info) == "--threads 5: the device has 4 compute units, and all are used");
}
