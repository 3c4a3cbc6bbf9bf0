// The table of parameters, and how a budget is shared out.
#include "format/load_scene.hpp"
#include "study/study_plan.hpp"

#include <numeric>
#include <set>

#include "../temporary_folder.hpp"
#include "app/options.hpp"
#include "catch2.hpp"
#include "study_fixture.hpp"

using namespace causticl;
using Catch::Contains;

namespace {

const std::string scenes = CAUSTICL_SOURCE_DIR "/scenes/";

/// The settings of a study of all parameters of a scene, with SPPM's first radius 0.5.
struct Planned {
  explicit Planned(const std::string& file, const std::vector<std::string>& own_words = {},
                   const std::string& sppm_fault = "", bool fp64 = true) {
    SceneOptions options;
    if (own_words == std::vector<std::string>{"--integrator", "pt"}) options.integrator = Integrator::pt;
    scene = load_scene(scenes + file, options);
    const JsonDocument document = json_read(scenes + file);
    plan_settings(study, wanted_parameters({}), {scene, document, 0.5, fp64}, own_words, sppm_fault);
  }
  Scene scene;
  Study study;
};

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

TEST_CASE("every setting of every knob is a command line that renders the scene so") {
  for (const std::string file : {"cornell_box.json", "6_furnished_room.json", "1_textured_balls.json"})
    for (const std::vector<std::string>& own : {std::vector<std::string>{}, {"--integrator", "pt"}}) {
      const Planned planned(file, own);
      CHECK(planned.study.settings.size() > 12);
      std::set<std::string> ids;
      for (const StudySetting& setting : planned.study.settings) {
        CAPTURE(file, setting.id());
        CHECK(ids.insert(setting.id()).second);
        std::vector<const char*> words{"causticl", "render", "SCENE"};
        for (const auto& word : setting.words) words.push_back(word.c_str());
        Options options = parse_options(static_cast<int>(words.size()), words.data());
        const Scene changed = load_scene(scenes + file, options.scene_options);
        CHECK((changed.renderer.integrator == Integrator::pt) == setting.path_traced);
        if (setting.parameter == "alpha") CHECK(changed.renderer.alpha == std::stod(setting.value));
        if (setting.parameter == "photons") {
          CHECK(*options.photons == std::stoll(setting.value));
          CHECK(changed.renderer.radius == 0.5);
        }
        if (setting.parameter == "radius") CHECK(changed.renderer.radius == std::stod(setting.value));
        if (setting.parameter == "max_depth") CHECK(changed.max_depth == std::stoi(setting.value));
        if (setting.parameter == "visible_points")
          CHECK(changed.renderer.visible_points == std::stoi(setting.value));
        if (setting.parameter == "precision") CHECK(options.precision == Precision::float64);
        if (setting.parameter == "triangle_test") CHECK(options.triangle_test == TriangleTest::precomputed);
        if (setting.parameter == "schedule")
          CHECK(changed.renderer.schedule != planned.scene.renderer.schedule);
        if (setting.parameter == "direct_light")
          CHECK(changed.renderer.direct_light != planned.scene.renderer.direct_light);
        if (setting.parameter == "texture_filter")
          CHECK(std::count_if(changed.textures.begin(), changed.textures.end(),
                              [](const TextureSpec& texture) { return texture.bilinear; }) !=
                std::count_if(planned.scene.textures.begin(), planned.scene.textures.end(),
                              [](const TextureSpec& texture) { return texture.bilinear; }));
      }
      for (const auto& [parameter, base] : planned.study.bases) CHECK(ids.contains(base));
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
  const Planned pt("cornell_box.json", {"--integrator", "pt"}, "an infinite light");
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
  CHECK(merged_words({"--integrator", "pt", "-D", "a=1"}, {"--integrator", "sppm", "-D", "b=2"}) ==
        std::vector<std::string>{"-D", "a=1", "--integrator", "sppm", "-D", "b=2"});
}
