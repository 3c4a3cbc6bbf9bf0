#include "study/study_analysis.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "scene/integrators.hpp"

namespace causticl {

const std::vector<double> study_targets{0.1, 0.05, 0.02, 0.01};

namespace {

struct Spread {
  double mean = 0, error = 0;  // standard error of the mean; 0 for a single value
};

Spread spread_of(const std::vector<double>& values) {
  Spread result;
  const auto count = static_cast<double>(values.size());
  for (const double value : values) result.mean += value / count;
  double squares = 0;
  for (const double value : values) squares += (value - result.mean) * (value - result.mean);
  if (values.size() > 1) result.error = std::sqrt(squares / (count - 1) / count);
  return result;
}

/// The mean of samples of one setting, without what the noise of the reference adds: errors of independent
/// pictures add up as squares.
CurvePoint point_of(const std::vector<StudySample>& samples, const StudyReference& reference) {
  CurvePoint point;
  std::vector<double> mse, error_90;
  const auto count = static_cast<double>(samples.size());
  for (const auto& sample : samples) {
    point.passes += static_cast<double>(sample.passes) / count;
    point.seconds += sample.seconds / count;
    mse.push_back(sample.relative_mse);
    error_90.push_back(sample.error_90);
  }
  const Spread spread = spread_of(mse), spread_90 = spread_of(error_90);
  point.mse = std::max(0.0, spread.mean - reference.relative_mse);
  point.mse_error = spread.error;
  point.error_90 =
      std::sqrt(std::max(0.0, spread_90.mean * spread_90.mean - reference.error_90 * reference.error_90));
  point.error_90_error = spread_90.error;
  point.seeds = static_cast<int>(samples.size());
  point.limited = !(point.mse > 0.25 * spread.mean) || !std::isfinite(point.mse);
  point.limited_90 = !(point.error_90 > 0.5 * spread_90.mean) || !std::isfinite(point.error_90);
  return point;
}

bool is_on_grid(std::uint64_t passes) {  // 1, 2, 3, 4, 6, 8, 12, ...: those that all seeds share
  while (passes > 3 && passes % 2 == 0) passes /= 2;
  return passes <= 3;
}

/// Short runs, averaged, up to their common end; then what a long run goes on with.
void make_curve(const Study& study, SettingAnalysis& result) {
  std::map<std::uint64_t, std::vector<StudySample>> shared;
  std::vector<StudySample> ends, beyond;
  std::size_t short_runs = 0;
  for (const StudyRun& run : study.runs) {
    if (run.parameter != result.setting.parameter || run.value != result.setting.value || run.samples.empty())
      continue;
    if (run.is_long) {
      beyond.insert(beyond.end(), run.samples.begin(), run.samples.end());
      continue;
    }
    ++short_runs;
    ends.push_back(run.samples.back());
    for (const auto& sample : run.samples)
      if (is_on_grid(sample.passes)) shared[sample.passes].push_back(sample);
  }
  for (const auto& [passes, samples] : shared)
    if (samples.size() == short_runs) result.curve.push_back(point_of(samples, *study.reference));
  if (!ends.empty()) {
    result.equal_time = point_of(ends, *study.reference);
    if (result.curve.empty() || result.equal_time->passes > result.curve.back().passes * 1.1)
      result.curve.push_back(*result.equal_time);
  }
  std::stable_sort(beyond.begin(), beyond.end(),
                   [](const StudySample& a, const StudySample& b) { return a.passes < b.passes; });
  for (const auto& sample : beyond)
    if (result.curve.empty() || static_cast<double>(sample.passes) > result.curve.back().passes * 1.1)
      result.curve.push_back(point_of({sample}, *study.reference));
}

void measure_slope(const Study& study, SettingAnalysis& result) {
  double last = 0;
  for (const auto& point : result.curve)
    if (!point.limited) last = std::max(last, point.passes);
  // The first passes are left out where there are later ones: their radius is far from its final rate.
  const double first = std::max(last / 16, last >= 16 ? 2.0 : 1.0);
  std::vector<std::pair<double, double>> points;
  for (const auto& point : result.curve)
    if (!point.limited && point.passes >= first) points.emplace_back(point.passes, point.mse);
  if (points.size() < 3) return;
  result.slope = log_slope(points);
  std::vector<double> of_current_paths;
  for (const StudyRun& run : study.runs) {
    if (run.parameter != result.setting.parameter || run.value != result.setting.value || run.is_long)
      continue;
    points.clear();
    for (const auto& sample : run.samples) {
      const double mse = sample.relative_mse - study.reference->relative_mse;
      if (static_cast<double>(sample.passes) >= first && mse > 0.25 * sample.relative_mse &&
          std::isfinite(mse))
        points.emplace_back(static_cast<double>(sample.passes), mse);
    }
    if (points.size() >= 3) of_current_paths.push_back(log_slope(points));
  }
  result.slope_error = spread_of(of_current_paths).error;
}

void add_costs(const Study& study, SettingAnalysis& result) {
  std::map<std::string, double> milliseconds;
  double passes = 0, setup = 0, runs = 0;
  for (const StudyRun& run : study.runs) {
    if (run.parameter != result.setting.parameter || run.value != result.setting.value || run.samples.empty())
      continue;
    for (const auto& [kernel, time] : run.kernel_milliseconds) milliseconds[kernel] += time;
    passes += static_cast<double>(run.samples.back().passes);
    setup += run.setup_seconds;
    ++runs;
  }
  if (runs == 0) return;
  result.setup_seconds = setup / runs;
  for (const auto& [kernel, time] : milliseconds)
    result.kernel_milliseconds.emplace_back(kernel, time / passes);
  std::stable_sort(result.kernel_milliseconds.begin(), result.kernel_milliseconds.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
}

std::vector<StudyAnalysis::OnFront> pareto_front(const std::vector<SettingAnalysis>& settings, bool rmse) {
  std::vector<StudyAnalysis::OnFront> points, front;
  for (std::size_t s = 0; s < settings.size(); ++s)
    for (std::size_t p = 0; p < settings[s].curve.size(); ++p)
      if (const CurvePoint& point = settings[s].curve[p]; !(rmse ? point.limited : point.limited_90))
        points.push_back({s, p});
  const auto at = [&](const StudyAnalysis::OnFront& of) -> const CurvePoint& {
    return settings[of.setting].curve[of.point];
  };
  const auto error_of = [&](const StudyAnalysis::OnFront& of) {
    return rmse ? at(of).rmse() : at(of).error_90;
  };
  std::stable_sort(points.begin(), points.end(), [&](const auto& a, const auto& b) {
    return std::pair(at(a).seconds, error_of(a)) < std::pair(at(b).seconds, error_of(b));
  });
  double best = HUGE_VAL;
  for (const auto& point : points)
    if (error_of(point) < best) {
      best = error_of(point);
      front.push_back(point);
    }
  return front;
}

}  // namespace

std::vector<ErrorAt> errors_of(const SettingAnalysis& setting, bool rmse) {
  std::vector<ErrorAt> curve;
  for (const auto& point : setting.curve)
    if (!(rmse ? point.limited : point.limited_90))
      curve.push_back({point.passes, point.seconds, rmse ? point.rmse() : point.error_90});
  return curve;
}

double CurvePoint::rmse() const { return std::sqrt(mse); }

double log_slope(const std::vector<std::pair<double, double>>& points) {
  double x_mean = 0, y_mean = 0, xx = 0, xy = 0;
  const auto count = static_cast<double>(points.size());
  for (const auto& [x, y] : points) {
    x_mean += std::log(x) / count;
    y_mean += std::log(y) / count;
  }
  for (const auto& [x, y] : points) {
    xx += (std::log(x) - x_mean) * (std::log(x) - x_mean);
    xy += (std::log(x) - x_mean) * (std::log(y) - y_mean);
  }
  return xx > 0 ? xy / xx : 0;
}

double steepest_slope(const StudySetting& setting) {
  return row_of(setting.path_traced ? Integrator::pt : Integrator::sppm).mse_slope / 2;
}

Reach reach_of(const std::vector<ErrorAt>& curve, double target, double steepest) {
  Reach reach;
  reach.target = target;
  if (curve.empty()) return reach;
  std::size_t above = curve.size();  // the last point that is still above the target
  for (std::size_t i = 0; i < curve.size(); ++i)
    if (!(curve[i].error <= target)) above = i;
  if (above == curve.size()) return {target, curve.front().passes, curve.front().seconds, true, false};
  if (above + 1 < curve.size()) {
    const ErrorAt &a = curve[above], &b = curve[above + 1];
    const double part = b.error > 0 && a.error > b.error && std::isfinite(a.error)
                            ? std::log(a.error / target) / std::log(a.error / b.error)
                            : 1;
    const auto between = [&](double from, double to) { return from * std::pow(to / from, part); };
    return {target, between(a.passes, b.passes), between(a.seconds, b.seconds), true, false};
  }
  constexpr std::size_t few = 5;
  constexpr double flattest = -0.12;  // half of the slope of the MSE
  constexpr double farthest = 64;     // times the passes that were measured
  std::vector<std::pair<double, double>> tail;
  for (std::size_t i = curve.size() > few ? curve.size() - few : 0; i < curve.size(); ++i)
    if (std::isfinite(curve[i].error)) tail.emplace_back(curve[i].passes, curve[i].error);
  if (tail.size() < 3) return reach;
  const double slope = std::max(log_slope(tail), steepest);
  if (slope > flattest) return reach;
  const double factor = std::pow(target / curve.back().error, 1 / slope);
  if (factor > farthest) return reach;
  return {target, curve.back().passes * factor, curve.back().seconds * factor, true, true};
}

StudyAnalysis analyse(const Study& study) {
  StudyAnalysis analysis;
  if (!study.reference) return analysis;
  for (const auto& setting : study.settings) {
    SettingAnalysis result;
    result.setting = setting;
    make_curve(study, result);
    if (result.curve.empty()) continue;
    measure_slope(study, result);
    add_costs(study, result);
    for (const double target : study_targets) {
      result.rmse.push_back(reach_of(errors_of(result, true), target, steepest_slope(setting)));
      result.error_90.push_back(reach_of(errors_of(result, false), target, steepest_slope(setting)));
    }
    analysis.settings.push_back(std::move(result));
  }
  analysis.pareto_rmse = pareto_front(analysis.settings, true);
  analysis.pareto_90 = pareto_front(analysis.settings, false);
  analysis.recommendations = recommend(study, analysis);
  return analysis;
}

}  // namespace causticl
