// From measurements to answers: error curves, their slopes, times to an error, and what to recommend.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "study/study_store.hpp"

namespace causticl {

/// The mean over seeds of the error after so many passes, the reference's own noise taken off.
struct CurvePoint {
  double passes = 0, seconds = 0;
  double mse = 0, mse_error = 0;  // relative MSE, and the standard error of its mean over seeds
  double error_90 = 0,
         error_90_error = 0;  // relative error that 90% of the pixels stay under; the same of it
  int seeds = 0;
  // Most of what was measured is the reference's own noise.
  bool limited = false, limited_90 = false;
  double rmse() const;
};

/// When a curve comes down to an error.
struct Reach {
  double target = 0;
  double passes = 0, seconds = 0;
  bool reached = false;       // false: it does not come down, or too slowly to tell when
  bool extrapolated = false;  // beyond what was measured, by the slope at the end of the curve
};

struct SettingAnalysis {
  StudySetting setting;
  std::vector<CurvePoint> curve;
  std::optional<CurvePoint> equal_time;  // when all settings had had the same time
  double slope = 0, slope_error = 0;     // d log MSE / d log passes, over the last four doublings; 0: unknown
  std::vector<Reach> rmse, error_90;     // for each of study_targets
  double setup_seconds = 0;
  std::vector<std::pair<std::string, double>> kernel_milliseconds;  // of a pass, the longest first
};

struct Recommendation {
  std::string goal;     // "error 2%", "time 60 s"
  std::string metric;   // "rmse" or "error_90"
  std::string setting;  // its id
  double error = 0, seconds = 0, passes = 0;
  bool extrapolated = false;
  std::string command;
};

struct StudyAnalysis {
  std::vector<SettingAnalysis> settings;
  struct OnFront {
    std::size_t setting, point;
  };
  // Points of curves that no other beats in both time and error, by time; for either measure of error.
  std::vector<OnFront> pareto_rmse, pareto_90;
  std::vector<Recommendation> recommendations;
};

/// Errors that a study says the time to: 10%, 5%, 2%, 1%.
extern const std::vector<double> study_targets;

StudyAnalysis analyse(const Study& study);

/// The cheapest settings for study_targets, by either measure of error, and the best ones for 10, 60 and 600
/// seconds by error_90.
std::vector<Recommendation> recommend(const Study& study, const StudyAnalysis& analysis);

/// When a curve of (passes, seconds, error) first stays under `target`: between two points by a straight
/// line in logarithms, beyond the last by the line fitted through the last few, but no steeper than
/// `steepest` and not too far.
struct ErrorAt {
  double passes, seconds, error;
};
/// The slope of log error over log passes that no extrapolation exceeds: what theory promises in the long run
/// (-1/2 for path tracing, half of -2/3 for photon mapping; Knaus & Zwicker 2011).
double steepest_slope(const StudySetting& setting);
/// The points of a curve that say more than the reference's noise, by RMSE or by error_90.
std::vector<ErrorAt> errors_of(const SettingAnalysis& setting, bool rmse);
Reach reach_of(const std::vector<ErrorAt>& curve, double target, double steepest);

/// The least-squares slope of log y over log x, of two points or more.
double log_slope(const std::vector<std::pair<double, double>>& points);

/// The best values of the parameters of SPPM that beat the scene's own by more than their noise, together;
/// none where fewer than two do.
std::optional<StudySetting> combined_setting(const Study& study, const StudyAnalysis& analysis);

/// The parameters and values of the settings that make up a combined one, from its value.
std::vector<std::pair<std::string, std::string>> parts_of_combined(const std::string& value);

/// The command line that renders a setting for so many passes; a word with special characters is quoted.
std::string study_command(const Study& study, const StudySetting& setting, double passes,
                          const std::string& limit = "");

}  // namespace causticl
