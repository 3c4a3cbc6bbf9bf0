// The table of parameters, and how a budget is shared out.
#include "format/load_scene.hpp"
#include "format/renderer_keys.hpp"
#include "scene/integrators.hpp"
#include "study/study.hpp"
#include "study/study_plan.hpp"

#include <numeric>
#include <set>

#include "../temporary_folder.hpp"
#include "app/options.hpp"
#include "app/render_setup.hpp"
#include "catch2.hpp"
#include "study_fixture.hpp"

using namespace causticl;
using Catch::Contains;

namespace {

const std::string scenes = CAUSTICL_SOURCE_DIR "/scenes/";

/// The settings of a study of all parameters of a scene, with SPPM's first radius 0.5.
struct Planned {
  explicit Planned(const std::string& file, std::optional<Integrator> integrator = {},
                   const std::string& sppm_fault = "", bool fp64 = true)
      : context{scene, 0.5, fp64} {
    SceneOptions options;
    options.integrator = integrator;
    scene = load_scene(scenes + file, options);
    if (integrator) own = integrator_change(*integrator);
    plan_settings(study, wanted_parameters({}), context, own, sppm_fault);
  }
  Scene scene;
  ParameterContext context;
  RenderChange own;
  Study study;
};

/// What `causticl render` renders with these words.
RenderSetup setup_by_command_line(const std::string& file, const std::vector<std::string>& more) {
  std::vector<const char*> words{"causticl", "render", "SCENE"};
  for (const auto& word : more) words.push_back(word.c_str());
  const Options options = parse_options(static_cast<int>(words.size()), words.data());
  RenderSetup setup{load_scene(file, options.scene_options), options.render};
  apply_options(options, setup.scene);
  return setup;
}

/// What the steps of a change make of the scene.
RenderSetup setup_by_change(const std::string& file, const RenderChange& change) {
  SceneOptions options;
  options.integrator = change.integrator;
  RenderSetup setup{load_scene(file, options), {}};
  for (const auto& step : change.steps) step(setup.scene, setup.options);
  return setup;
}

bool is_same(const RendererKey& row, const RendererSpec& a, const RendererSpec& b) {
  return std::visit(
      [&](auto field) {
        if constexpr (std::is_same_v<decltype(field), std::monostate>)
          return true;
        else
          return a.*field == b.*field;
      },
      row.field);
}

void check_same(const RenderSetup& a, const RenderSetup& b) {
  for (const RendererKey& row : renderer_keys()) {
    INFO(row.key.name);
    CHECK(is_same(row, a.scene.renderer, b.scene.renderer));
  }
  CHECK(a.scene.max_depth == b.scene.max_depth);
  CHECK(a.options.precision == b.options.precision);
  CHECK(a.options.triangle_test == b.options.triangle_test);
  REQUIRE(a.scene.textures.size() == b.scene.textures.size());
  for (std::size_t i = 0; i < a.scene.textures.size(); ++i)
    CHECK(a.scene.textures[i].bilinear == b.scene.textures[i].bilinear);
}

}  // namespace

TEST_CASE("every row of the table of knobs says what it is") {
  std::set<std::string> names;
  for (const StudyParameter& parameter : study_parameters()) {
    CAPTURE(parameter.name);
    CHECK(names.insert(parameter.name).second);
    CHECK(std::string(parameter.name).find_first_not_of("abcdefghijklmnopqrstuvwxyz_0123456789") ==
          std::string::npos);
    CHECK(std::string(parameter.title).size() > 4);
    CHECK(std::string(parameter.meaning).back() == '.');
  }
  CHECK(wanted_parameters({"alpha", "integrator"}).size() == 2);
  CHECK(wanted_parameters({}).size() == study_parameters().size());
  CHECK_THAT(user_error_of([] { wanted_parameters({"alpah"}); }),
             Contains("--parameters: there is no parameter \"alpah\"; expected some of integrator, photons"));
}

TEST_CASE("every setting of every knob changes the scene as its command line does, and something") {
  for (const std::string file : {"cornell_box.json", "6_furnished_room.json", "1_textured_balls.json"})
    for (const auto own : {std::optional<Integrator>(), std::optional(Integrator::pt)}) {
      const Planned planned(file, own);
      CHECK(planned.study.settings.size() > 12);
      std::set<std::string> ids;
      for (const StudySetting& setting : planned.study.settings) {
        CAPTURE(file, setting.id());
        CHECK(ids.insert(setting.id()).second);
        const RenderSetup changed = setup_by_change(scenes + file, setting.change);
        check_same(changed, setup_by_command_line(scenes + file, setting.change.words));
        CHECK(passes_are_samples(changed.scene.renderer.integrator) == setting.path_traced);
        CHECK((setting.change.words != planned.own.words) == (setting.parameter != "scene"));
        if (setting.parameter == "alpha") CHECK(changed.scene.renderer.alpha == std::stod(setting.value));
        if (setting.parameter == "photons") {
          CHECK(changed.scene.renderer.photons == std::stoll(setting.value));
          CHECK(changed.scene.renderer.radius == 0.5);
        }
        if (setting.parameter == "max_depth") CHECK(changed.scene.max_depth == std::stoi(setting.value));
        if (setting.parameter == "precision") CHECK(changed.options.precision == Precision::float64);
        if (setting.parameter == "schedule")
          CHECK(changed.scene.renderer.schedule != planned.scene.renderer.schedule);
        if (setting.parameter == "texture_filter")
          CHECK(std::any_of(changed.scene.textures.begin(), changed.scene.textures.end(),
                            [](const TextureSpec& texture) { return texture.bilinear; }) !=
                std::any_of(planned.scene.textures.begin(), planned.scene.textures.end(),
                            [](const TextureSpec& texture) { return texture.bilinear; }));
      }
      for (const auto& [parameter, base] : planned.study.bases) CHECK(ids.contains(base));
    }
}

TEST_CASE("settings that were read back change what they changed, and others are refused") {
  for (const auto own : {std::optional<Integrator>(), std::optional(Integrator::pt)}) {
    const std::string file = scenes + "6_furnished_room.json";
    const Planned planned("6_furnished_room.json", own);
    Study study = planned.study;
    const auto& settings = planned.study.settings;
    const auto alpha = *study.setting("alpha", "0.5"), depth = *study.setting("schedule", "global");
    study.settings.push_back(
        {"combined", alpha.id() + " + " + depth.id(), merged(alpha.change, depth.change), false});
    for (StudySetting& setting : study.settings) setting.change = {setting.change.words};
    restore_settings(study, planned.context, planned.own);
    for (std::size_t i = 0; i < settings.size(); ++i) {
      CAPTURE(settings[i].id());
      check_same(setup_by_change(file, study.settings[i].change), setup_by_change(file, settings[i].change));
    }
    const RendererSpec both = setup_by_change(file, study.settings.back().change).scene.renderer;
    CHECK(both.alpha == 0.5);
    CHECK(both.schedule == Schedule::global);
    CHECK(both.integrator == Integrator::sppm);

    Study changed = study;
    changed.settings.back().change.words.back() = "renderer.schedule=pixel";
    CHECK_THROWS_WITH(restore_settings(changed, planned.context, planned.own),
                      Contains("are not those that it has now"));
    changed.settings.back() = {"alpha", "0.51", {}, false};
    CHECK_THROWS_WITH(restore_settings(changed, planned.context, planned.own),
                      "no setting is called alpha=0.51");
  }
}

TEST_CASE("knobs that a scene or a device lacks are left out, with the reason") {
  const Planned planned("analytic_sphere.json", {}, "", false);
  const auto& left_out = planned.study.left_out;
  const auto says = [&](const std::string& start) {
    return std::any_of(left_out.begin(), left_out.end(),
                       [&](const std::string& text) { return text.starts_with(start); });
  };
  CHECK(says("precision: there is nothing to choose"));
  CHECK(says("triangle_test: "));
  CHECK(says("texture_filter: "));
  const Planned pt("cornell_box.json", Integrator::pt, "an infinite light");
  for (const StudySetting& setting : pt.study.settings) CHECK(setting.path_traced);
  CHECK(std::any_of(pt.study.left_out.begin(), pt.study.left_out.end(), [](const std::string& text) {
    return text == "alpha: photon mapping cannot render this scene: an infinite light";
  }));
}

TEST_CASE("runs are planned to fit, and what does not fit is said") {
  for (const double seconds : {0.5, 3.0, 10.0, 40.0, 100.0, 1000.0})
    for (const double pass : {0.001, 0.1, 1.0}) {
      Study study = Planned("cornell_box.json").study;
      const std::size_t all = study.settings.size(), left_out = study.left_out.size();
      const double overhead = 0.1 + pass;
      plan_runs(study, seconds, pass, overhead, 3);
      CAPTURE(seconds, pass, study.settings.size(), study.seeds, study.run_seconds);
      REQUIRE(study.settings.size() >= 1);
      CHECK(study.settings[0].id() == "scene");
      CHECK(study.settings.size() + study.left_out.size() == all + left_out);
      CHECK(study.seeds >= 2);
      CHECK(study.seeds <= 3);
      CHECK(study.run_seconds >= pass);
      const double needed =
          static_cast<double>(study.settings.size()) * study.seeds * (study.run_seconds + overhead);
      if (study.settings.size() > 1) {
        CHECK(needed <= seconds * 1.0001);
        CHECK(study.run_seconds >= 3 * pass);
      }
    }
}

TEST_CASE("options that are joined keep their last value, and all that -D sets") {
  const RenderChange change =
      merged(merged(integrator_change(Integrator::pt), renderer_change("alpha", "0.5")),
             merged(integrator_change(Integrator::sppm), renderer_change("radius", "2")));
  CHECK(change.words == std::vector<std::string>{"-D", "renderer.alpha=0.5", "--integrator", "sppm", "-D",
                                                 "renderer.radius=2"});
  CHECK(change.integrator == Integrator::sppm);
  CHECK_THROWS_AS(renderer_change("alpha", "half"), std::logic_error);
  CHECK_THROWS_AS(renderer_change("alpah", "0.5"), std::logic_error);
}
