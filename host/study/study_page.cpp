#include "study/study_page.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/output_file.hpp"
#include "study/study_insets.hpp"
#include "study/study_parameters.hpp"

namespace causticl {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json json_of(const CurvePoint& point) {
  return {{"passes", point.passes},
          {"seconds", point.seconds},
          {"mse", number(point.mse)},
          {"mse_error", number(point.mse_error)},
          {"rmse", number(point.rmse())},
          {"error_90", number(point.error_90)},
          {"error_90_error", number(point.error_90_error)},
          {"seeds", point.seeds},
          {"limited", point.limited},
          {"limited_90", point.limited_90}};
}

Json json_of(const std::vector<Reach>& reaches) {
  Json result = Json::array();
  for (const Reach& reach : reaches)
    result.push_back({{"target", reach.target},
                      {"reached", reach.reached},
                      {"extrapolated", reach.extrapolated},
                      {"passes", reach.passes},
                      {"seconds", reach.seconds}});
  return result;
}

Json json_of(const SettingAnalysis& setting) {
  Json curve = Json::array(), kernels = Json::array();
  for (const CurvePoint& point : setting.curve) curve.push_back(json_of(point));
  for (const auto& [kernel, time] : setting.kernel_milliseconds)
    kernels.push_back({{"kernel", kernel}, {"milliseconds", time}});
  return {{"id", setting.setting.id()},
          {"knob", setting.setting.parameter},
          {"value", setting.setting.value},
          {"path_traced", setting.setting.path_traced},
          {"curve", curve},
          {"equal_time", setting.equal_time ? json_of(*setting.equal_time) : Json(nullptr)},
          {"slope", setting.slope},
          {"slope_error", setting.slope_error},
          {"rmse", json_of(setting.rmse)},
          {"error_90", json_of(setting.error_90)},
          {"setup_seconds", setting.setup_seconds},
          {"kernels", kernels}};
}

Json json_of(const std::vector<StudyAnalysis::OnFront>& front) {
  Json result = Json::array();
  for (const auto& [setting, point] : front) result.push_back({{"setting", setting}, {"point", point}});
  return result;
}

Json json_of(const StudyAnalysis& analysis) {
  Json settings = Json::array(), recommendations = Json::array();
  for (const auto& setting : analysis.settings) settings.push_back(json_of(setting));
  for (const auto& r : analysis.recommendations)
    recommendations.push_back({{"goal", r.goal},
                               {"metric", r.metric},
                               {"setting", r.setting},
                               {"error", r.error},
                               {"seconds", r.seconds},
                               {"passes", r.passes},
                               {"extrapolated", r.extrapolated},
                               {"command", r.command}});
  const Json fronts = {{"rmse", json_of(analysis.pareto_rmse)}, {"error_90", json_of(analysis.pareto_90)}};
  return {{"settings", settings}, {"pareto", fronts}, {"recommendations", recommendations}};
}

Json table_of_parameters(const Study& study) {
  Json parameters = Json::array();
  for (const StudyParameter& parameter : study_parameters())
    if (study.bases.contains(parameter.name))
      parameters.push_back({{"name", parameter.name},
                            {"title", parameter.title},
                            {"unit", parameter.unit},
                            {"meaning", parameter.meaning},
                            {"own", study.own_values.at(parameter.name)},
                            {"base", study.bases.at(parameter.name)}});
  if (study.bases.contains("combined"))
    parameters.push_back(
        {{"name", "combined"},
         {"title", "The best values together"},
         {"unit", ""},
         {"meaning", "Each value that beat the scene's own by more than its noise, all at once."},
         {"own", "as the scene says"},
         {"base", study.bases.at("combined")}});
  return parameters;
}

void replace(std::string& text, const std::string& mark, const std::string& by) {
  const auto at = text.find(mark);
  if (at != std::string::npos) text.replace(at, mark.size(), by);
}

std::string percent(double fraction) { return short_number(100 * fraction) + "%"; }

}  // namespace

std::string study_page_data(const Study& study, const StudyAnalysis& analysis, const std::string& insets) {
  Json measured = Json::parse(study_json(study));
  for (const auto& setting : study.settings) {
    const auto found = std::find_if(analysis.settings.begin(), analysis.settings.end(),
                                    [&](const auto& known) { return known.setting.id() == setting.id(); });
    if (found == analysis.settings.end())
      measured["left_out"].push_back(setting.id() + ": no time for it within the budget");
  }
  const Json data = {{"study", measured},
                     {"analysis", json_of(analysis)},
                     {"knobs", table_of_parameters(study)},
                     {"targets", study_targets},
                     {"insets", Json::parse(insets)}};
  std::string text = data.dump(-1, ' ', false, Json::error_handler_t::replace);
  // Inside a script element nothing may look like the end of it, nor like a comment.
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;) text.replace(at, 1, "\\u003c");
  return text;
}

void write_study_page(const std::string& folder, const Study& study, const StudyAnalysis& analysis) {
  std::string page = study_page_html;
  replace(page, "/* style */", study_page_css);
  replace(page, "/* plot */", study_page_plot_js);
  replace(page, "/* script */", study_page_js);
  replace(page, "/* data */", study_page_data(study, analysis, study_insets(folder, study)));
  write_file((std::filesystem::path(folder) / "study.html").string(), page);
}

std::string study_summary(const Study& study, const StudyAnalysis& analysis, const std::string& folder) {
  std::string text;
  for (const auto& r : analysis.recommendations) {
    if (r.metric != "error_90") continue;
    char line[256];
    std::snprintf(line, sizeof line, "%s: %s with %s after %.3g s%s\n", r.goal.c_str(),
                  ("90% of pixels within " + percent(r.error)).c_str(), r.setting.c_str(), r.seconds,
                  r.extrapolated ? " (extrapolated)" : "");
    text += line + ("  " + r.command) + "\n";
  }
  if (text.empty()) text = "no setting comes near an error of 10%; a larger --budget may show one\n";
  return text + "wrote " + folder +
         "/study.html, study.csv, study.json: " + std::to_string(study.runs.size()) + " renders in " +
         short_number(study.spent_seconds) + " s\n";
}

}  // namespace causticl
