// What a study recommends, as command lines to paste.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "study/study_analysis.hpp"
#include "study/study_parameters.hpp"
#include "study/study_plan.hpp"

namespace causticl {
namespace {

/// A setting must beat a measured one by this factor in time where its own time is extrapolated.
constexpr double trust_in_measurements = 1.5;

/// Between the ids of the settings that a combined one is made of.
constexpr const char* between_parts = " + ";

void recommend_for_errors(const Study& study, const StudyAnalysis& analysis,
                          std::vector<Recommendation>& recommendations) {
  for (const bool rmse : {false, true})
    for (std::size_t t = 0; t < study_targets.size(); ++t) {
      const SettingAnalysis* best = nullptr;
      double least = HUGE_VAL;
      for (const auto& setting : analysis.settings) {
        const Reach& reach = (rmse ? setting.rmse : setting.error_90)[t];
        const double cost = reach.seconds * (reach.extrapolated ? trust_in_measurements : 1);
        if (!reach.reached || cost >= least) continue;
        least = cost;
        best = &setting;
      }
      if (!best) continue;
      const Reach& reach = (rmse ? best->rmse : best->error_90)[t];
      recommendations.push_back({std::string("error ") + short_number(100 * study_targets[t]) + "%",
                                 rmse ? "rmse" : "error_90", best->setting.id(), study_targets[t],
                                 reach.seconds, std::ceil(reach.passes - 1e-9), reach.extrapolated,
                                 study_command(study, best->setting, reach.passes)});
    }
}

/// The error of a curve at a time: between points, or beyond the last, by straight lines in logarithms.
std::optional<ErrorAt> error_at(const std::vector<ErrorAt>& curve, double seconds, double steepest) {
  if (curve.size() < 2 || curve.front().seconds > seconds) return {};
  std::size_t next = 1;
  while (next + 1 < curve.size() && curve[next].seconds < seconds) ++next;
  const ErrorAt &a = curve[next - 1], &b = curve[next];
  if (!(b.seconds > a.seconds) || b.error <= 0) return {};
  double slope = std::log(b.error / a.error) / std::log(b.seconds / a.seconds);
  if (seconds > b.seconds) {
    std::vector<std::pair<double, double>> tail;
    for (std::size_t i = curve.size() > 5 ? curve.size() - 5 : 0; i < curve.size(); ++i)
      tail.emplace_back(curve[i].seconds, curve[i].error);
    slope = std::clamp(log_slope(tail), steepest, 0.0);
  }
  return ErrorAt{b.passes * seconds / b.seconds, seconds, b.error * std::pow(seconds / b.seconds, slope)};
}

void recommend_for_times(const Study& study, const StudyAnalysis& analysis,
                         std::vector<Recommendation>& recommendations) {
  for (const double seconds : {10.0, 60.0, 600.0}) {
    const SettingAnalysis* best = nullptr;
    ErrorAt least{0, 0, HUGE_VAL};
    for (const auto& setting : analysis.settings) {
      const auto found = error_at(errors_of(setting, false), seconds, steepest_slope(setting.setting));
      if (!found || found->error >= least.error) continue;
      least = *found;
      best = &setting;
    }
    if (!best) continue;
    const bool beyond = best->curve.back().seconds < seconds;
    recommendations.push_back({std::string("time ") + short_number(seconds) + " s", "error_90",
                               best->setting.id(), least.error, seconds, least.passes, beyond,
                               study_command(study, best->setting, 1000000, short_number(seconds))});
  }
}

std::string shell_word(const std::string& word) {
  const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return std::isalnum(c) || std::string("-_=./:,+@%").find(static_cast<char>(c)) != std::string::npos;
  });
  if (plain) return word;
  std::string quoted(1, '\'');
  for (const char c : word) {
    if (c == '\'') quoted += "'\\'";
    quoted += c;
  }
  quoted += '\'';
  return quoted;
}

}  // namespace

std::vector<Recommendation> recommend(const Study& study, const StudyAnalysis& analysis) {
  std::vector<Recommendation> recommendations;
  recommend_for_errors(study, analysis, recommendations);
  recommend_for_times(study, analysis, recommendations);
  return recommendations;
}

std::vector<std::pair<std::string, std::string>> parts_of_combined(const std::string& value) {
  std::vector<std::pair<std::string, std::string>> parts;
  for (std::size_t begin = 0; begin < value.size();) {
    const std::size_t end = std::min(value.find(between_parts, begin), value.size());
    const std::string id = value.substr(begin, end - begin);
    const std::size_t equals = std::min(id.find('='), id.size());
    parts.emplace_back(id.substr(0, equals), equals < id.size() ? id.substr(equals + 1) : "");
    begin = end + std::string(between_parts).size();
  }
  return parts;
}

std::optional<StudySetting> combined_setting(const Study& study, const StudyAnalysis& analysis) {
  StudySetting combined{"combined", "", {}, false};
  int improving = 0;
  for (const StudyParameter& parameter : study_parameters()) {
    if (!parameter.sppm_only || !study.bases.contains(parameter.name)) continue;
    const SettingAnalysis *best = nullptr, *base = nullptr;
    for (const auto& setting : analysis.settings) {
      if (!setting.equal_time) continue;
      if (setting.setting.id() == study.bases.at(parameter.name)) base = &setting;
      if (setting.setting.parameter == parameter.name &&
          (!best || setting.equal_time->error_90 < best->equal_time->error_90))
        best = &setting;
    }
    if (!best || !base || best->setting.path_traced) continue;
    const double noise = std::hypot(best->equal_time->error_90_error, base->equal_time->error_90_error);
    if (best->equal_time->error_90 + noise >= base->equal_time->error_90) continue;
    if (improving > 0) combined.value += between_parts;
    combined.value += best->setting.id();
    combined.change = merged(combined.change, best->setting.change);
    ++improving;
  }
  if (improving < 2) return {};
  return combined;
}

std::string study_command(const Study& study, const StudySetting& setting, double passes,
                          const std::string& limit) {
  std::vector<std::string> words{"causticl", "render", study.scene};
  words.insert(words.end(), study.words.begin(), study.words.end());
  words.insert(words.end(), setting.change.words.begin(), setting.change.words.end());
  words.push_back(setting.path_traced ? "--samples" : "--passes");
  constexpr double most = 1 << 30;  // that the option takes
  words.push_back(std::to_string(static_cast<long long>(std::ceil(passes < most ? passes - 1e-9 : most))));
  if (!limit.empty()) words.insert(words.end(), {"--time", limit});
  words.insert(words.end(), {"-o", std::filesystem::path(study.scene).stem().string() + ".exr"});
  std::string command;
  for (const auto& word : words) {
    if (!command.empty()) command += ' ';
    command += shell_word(word);
  }
  return command;
}

}  // namespace causticl
