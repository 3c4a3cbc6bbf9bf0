// From measurements to answers, on curves that are known.
#include "study/study_analysis.hpp"

#include <random>
#include <string_view>

#include "catch2.hpp"
#include "study_fixture.hpp"

using namespace causticl;

namespace {

const SettingAnalysis& setting_of(const StudyAnalysis& analysis, std::string_view id) {
  for (const auto& setting : analysis.settings)
    if (setting.setting.id() == id) return setting;
  throw std::runtime_error("no setting " + std::string(id));
}

}  // namespace

TEST_CASE("slopes, means and standard errors are those of the curves") {
  const StudyAnalysis analysis = analyse(made_study());
  REQUIRE(analysis.settings.size() == 3);
  const auto& scene = setting_of(analysis, "scene");
  CHECK(scene.slope == Approx(-2.0 / 3).margin(0.001));
  CHECK(setting_of(analysis, "integrator=pt").slope == Approx(-1).margin(0.001));
  REQUIRE(scene.curve.size() == 7);
  // Of 0.9 and 1.1 times the same, the mean is 1 and its standard error 0.1.
  CHECK(scene.curve[0].mse == Approx(0.04));
  CHECK(scene.curve[0].mse_error == Approx(0.004));
  CHECK(scene.curve[0].seeds == 2);
  REQUIRE(scene.equal_time);
  CHECK(scene.equal_time->seconds == Approx(6.4));
  CHECK(scene.setup_seconds == 0.25);
  REQUIRE(scene.kernel_milliseconds.size() == 2);
  CHECK(scene.kernel_milliseconds[0].first == "trace_photons");
  CHECK(scene.kernel_milliseconds[0].second == Approx(5));
}

TEST_CASE("the reference's own noise is taken off, and what is mostly noise is set aside") {
  Study study = made_study();
  study.reference->relative_mse = 0.01;
  study.reference->error_90 = 0.06;
  const StudyAnalysis analysis = analyse(study);
  for (const auto& setting : analysis.settings)
    for (const auto& point : setting.curve) {
      CAPTURE(setting.setting.id(), point.passes);
      const double measured =
          setting.setting.id() == "scene" ? 0.04 * std::pow(point.passes, -2.0 / 3) + 1e-6 : 0;
      if (measured == 0) continue;
      CHECK(point.mse == Approx(std::max(0.0, measured - 0.01)).margin(1e-5));
      CHECK(point.limited == (measured - 0.01 <= 0.25 * measured));
    }
}

TEST_CASE("the time to an error is found between measurements and beyond them") {
  std::mt19937_64 engine(20261122);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 1000; ++i) {
    const double slope = -0.15 - 0.35 * unit(engine), first = 0.05 + unit(engine), pass = unit(engine) + 0.01;
    std::vector<ErrorAt> curve;
    for (double passes = 1; passes <= 64; passes *= 2)
      curve.push_back({passes, pass * passes, first * std::pow(passes, slope)});
    const double passes = std::exp(unit(engine) * std::log(4000.0));
    const Reach reach = reach_of(curve, first * std::pow(passes, slope), -0.5);
    CAPTURE(slope, passes);
    REQUIRE(reach.reached);
    CHECK(reach.passes == Approx(passes).epsilon(1e-6));
    CHECK(reach.seconds == Approx(passes * pass).epsilon(1e-6));
    CHECK(reach.extrapolated == (passes > 64));
  }
}

TEST_CASE("a curve that does not come down is not said to") {
  std::vector<ErrorAt> flat, rising;
  for (double passes = 1; passes <= 64; passes *= 2) {
    flat.push_back({passes, passes, 0.2 * std::pow(passes, -0.05)});
    rising.push_back({passes, passes, passes < 32 ? 0.05 : 0.2});
  }
  CHECK_FALSE(reach_of(flat, 0.01, -0.5).reached);
  CHECK_FALSE(reach_of(rising, 0.1, -0.5).reached);
  CHECK_FALSE(reach_of({}, 0.1, -0.5).reached);
  CHECK_FALSE(reach_of({{1, 1, 0.5}}, 0.1, -0.5).reached);
  // Steeper than theory allows, it goes on as theory has it.
  const Reach slow = reach_of({{1, 1, 0.8}, {2, 2, 0.4}, {4, 4, 0.2}}, 0.1, -1.0 / 3);
  CHECK(slow.passes == Approx(4 * 8));
  CHECK(slow.extrapolated);
  const Reach at_once = reach_of({{1, 2, 0.05}, {2, 4, 0.04}}, 0.1, -0.5);
  CHECK(at_once.reached);
  CHECK(at_once.passes == 1);
}

TEST_CASE("no point of the front is beaten, and every other one is") {
  const StudyAnalysis analysis = analyse(made_study());
  for (const bool rmse : {true, false}) {
    const auto& front = rmse ? analysis.pareto_rmse : analysis.pareto_90;
    REQUIRE(front.size() > 2);
    const auto error_of = [&](const CurvePoint& p) { return rmse ? p.rmse() : p.error_90; };
    for (std::size_t s = 0; s < analysis.settings.size(); ++s)
      for (std::size_t p = 0; p < analysis.settings[s].curve.size(); ++p) {
        const CurvePoint& point = analysis.settings[s].curve[p];
        bool beaten = false;
        for (const auto& other : analysis.settings)
          for (const auto& q : other.curve)
            beaten |= q.seconds <= point.seconds && error_of(q) <= error_of(point) &&
                      (q.seconds < point.seconds || error_of(q) < error_of(point));
        const bool listed = std::any_of(front.begin(), front.end(),
                                        [&](const auto& f) { return f.setting == s && f.point == p; });
        CHECK(listed == !beaten);
      }
  }
}

TEST_CASE("the cheapest setting is recommended, as a command to paste") {
  const StudyAnalysis analysis = analyse(made_study());
  const auto found =
      std::find_if(analysis.recommendations.begin(), analysis.recommendations.end(),
                   [](const Recommendation& r) { return r.goal == "error 5%" && r.metric == "rmse"; });
  REQUIRE(found != analysis.recommendations.end());
  // 0.09 / n = 0.05^2 at n = 36; the scene as it is needs 64 passes for that, and the depth of 2 never has
  // it.
  CHECK(found->setting == "integrator=pt");
  CHECK(found->seconds == Approx(3.6).epsilon(0.01));
  CHECK(found->command ==
        "causticl render 'scenes/a \"b\".json' --size 40x30 -D 'objects.0.name=it'\\''s' --integrator pt "
        "--samples " +
            std::to_string(static_cast<int>(found->passes)) + " -o 'a \"b\".exr'");
  CHECK(found->passes >= 36);
  CHECK(found->passes <= 37);
  for (const auto& r : analysis.recommendations) CHECK(r.setting != "max_depth=2");
}

TEST_CASE("the best values are combined where two or more knobs improve") {
  Study study = made_study();
  study.settings.push_back({"alpha", "0.5", renderer_change("alpha", "0.5"), false});
  study.bases["alpha"] = study.bases["photons"] = "scene";
  for (const std::uint32_t seed : {1u, 2u})
    study.runs.push_back(made_run(study.settings.back(), seed, 0.01, -2.0 / 3, 0.1, 64));
  CHECK_FALSE(combined_setting(study, analyse(study)));
  study.settings.push_back({"photons", "9", photons_change(9), false});
  for (const std::uint32_t seed : {1u, 2u})
    study.runs.push_back(made_run(study.settings.back(), seed, 0.02, -2.0 / 3, 0.1, 64));
  const auto combined = combined_setting(study, analyse(study));
  REQUIRE(combined);
  CHECK(combined->id() == "combined=photons=9 + alpha=0.5");
  CHECK(combined->change.words == std::vector<std::string>{"--photons", "9", "-D", "renderer.alpha=0.5"});
}
