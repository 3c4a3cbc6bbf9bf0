// Passes that cannot change the picture do not run: by the counters of launches, and by the picture.
#include <algorithm>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "catch2.hpp"
#include "device_fixture.hpp"
#include "effect_scenes.hpp"
#include "effects/passes.hpp"
#include "opencl/kernel_sources.hpp"
#include "render/render_fixture.hpp"
#include "scene/integrators.hpp"
#include "temporary_folder.hpp"

using namespace causticl;
using Catch::Contains;

namespace {

RenderResult render(const Scene& scene, bool skip_passes = true,
                    const std::vector<std::string>& outputs = {}) {
  RenderOptions options;
  options.skip_passes = skip_passes;
  options.outputs = outputs;
  return render_scene(scene, test_device(), options);
}

const PassStatistics& pass_of(const RenderResult& result, const std::string& name) {
  const auto& passes = result.statistics.pass_programs;
  const auto found = std::find_if(passes.begin(), passes.end(),
                                  [&](const PassStatistics& pass) { return pass.name == name; });
  REQUIRE(found != passes.end());
  return *found;
}

Scene small_scene(int max_depth, const std::string& object = "", const std::string& renderer = "") {
  Scene scene = scene_from_text(effect_scene(object, "", renderer));
  scene.max_depth = max_depth;
  scene.renderer.passes = 3;
  return scene;
}

/// Photons and their grid did not run, and the picture is that of a render in which they do.
void check_no_photons(const Scene& scene, const std::string& reason) {
  const RenderResult skipped = render(scene), all = render(scene, false);
  for (const char* name : {"photon", "grid"}) {
    INFO(name);
    CHECK_THAT(pass_of(skipped, name).skipped, Contains(reason));
    CHECK(pass_of(skipped, name).launches == 0);
    CHECK(pass_of(skipped, name).build_seconds == 0);
  }
  for (const char* kernel : {"trace_photons", "count_photons", "move_photons"})
    CHECK(skipped.statistics.kernels.count(kernel) == 0);
  CHECK(pass_of(skipped, "camera").launches == 3);
  CHECK(pass_of(skipped, "gather").launches == 3);
  CHECK(pass_of(all, "photon").launches > 0);
  CHECK(skipped.statistics.photons == 0);
  CHECK(all.statistics.stored_photons == 0);
  CHECK(skipped.picture.rgb == all.picture.rgb);
  CHECK(mean_luminance(skipped.picture) > 0);
}

}  // namespace

TEST_CASE("every program of an integrator is a pass, with its kernel") {
  for (const IntegratorRow& row : integrator_rows) {
    INFO(row.name);
    CHECK(std::string(row.text).size() > 4);
    CHECK(row.mse_slope < 0);
    const auto programs = programs_of(row.integrator);
    CHECK(std::set<std::string>(programs.begin(), programs.end()).size() == programs.size());
    CHECK(programs.back() == "film");
    for (const std::string& program : programs) {
      INFO(program);
      const std::string kernel = pass_row(program).main_kernel;
      CHECK_THAT(embedded_kernel_sources().at("passes/pass_" + program + ".cl"),
                 Contains(" " + kernel + "("));
    }
  }
  CHECK_THROWS_AS(pass_row("nothing"), std::logic_error);
}

TEST_CASE("no photon is traced where shadow rays bring all light") {
  check_no_photons(small_scene(1), "max_depth is 1");
}

TEST_CASE("no photon is traced where none could land") {
  Scene scene = small_scene(6, ball_of(R"({"type": "mirror"})"));
  for (auto& material : scene.materials)
    if (max_component(material.emission) > 0)
      material.color = {0, 0, 0};
    else
      material.kind = MaterialSpec::Kind::mirror;
  scene.width = 64, scene.height = 48;  // so that some pixels see the lamp
  check_no_photons(scene, "no surface is diffuse");
}

TEST_CASE("photons are traced where they may change the picture") {
  const Scene scenes[] = {small_scene(2), small_scene(1, "", R"(, "direct_light": "photons")"),
                          small_scene(2, ball_of(R"({"type": "plastic"})"))};
  for (const Scene& scene : scenes) {
    const RenderResult result = render(scene);
    for (const auto& pass : result.statistics.pass_programs) {
      INFO(pass.name);
      CHECK(pass.skipped == "");
      CHECK(pass.launches >=
            (pass.name == "photon" || pass.name == "camera" || pass.name == "gather" ? 3 : 1));
      CHECK(pass.build_seconds > 0);
    }
    CHECK(pass_of(result, "photon").launches == 3);  // the radius is chosen by the first pass's
    CHECK(result.statistics.stored_photons > 0);
    CHECK(result.picture.rgb == render(scene, false).picture.rgb);
  }
}

TEST_CASE("a texture on a mirror of the base format can make texels diffuse") {
  Scene scene = small_scene(6);
  for (auto& material : scene.materials) material.kind = MaterialSpec::Kind::mirror;
  scene.materials[0].color_texture = 0;
  scene.materials[0].alpha_diffuse = true;
  CHECK(why_skipped(plan_passes(scene), "photon") == "");
  scene.materials[0].alpha_diffuse = false;
  CHECK(why_skipped(plan_passes(scene), "photon") != "");
}

TEST_CASE("a scene without light is black by no launch at all") {
  Scene scene = small_scene(6);
  for (auto& material : scene.materials) material.emission = {0, 0, 0};
  const TemporaryFolder folder;
  for (const Integrator integrator : {Integrator::sppm, Integrator::pt}) {
    scene.renderer.integrator = integrator;
    const RenderResult result = render(scene, true, {folder.path("black.pfm")});
    CHECK(result.statistics.kernels.empty());
    CHECK(result.statistics.passes == 0);
    CHECK(result.statistics.kernel_build_seconds == 0);
    for (const auto& pass : result.statistics.pass_programs)
      CHECK_THAT(pass.skipped, Contains("nothing emits"));
    CHECK(result.picture.rgb == std::vector<float>(16 * 12 * 3, 0.0f));
    CHECK(result.picture.rgb == render(scene, false).picture.rgb);
    CHECK(read_picture(folder.path("black.pfm")).rgb == result.picture.rgb);
  }
}

TEST_CASE("an infinite plane that emits is light for path tracing") {
  Scene scene = scene_from_text(effect_scene(R"({"type": "plane", "material": {"type": "diffuse"}})"));
  for (auto& material : scene.materials) material.emission = {0, 0, 0};
  scene.materials.back().emission = {1, 1, 1};
  scene.renderer.integrator = Integrator::pt;
  scene.renderer.samples = 2;
  const RenderResult result = render(scene);
  CHECK(pass_of(result, "path").launches == 2);
  CHECK(mean_luminance(result.picture) > 0);
}
