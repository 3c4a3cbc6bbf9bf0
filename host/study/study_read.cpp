// Reads study.json back. The file may be damaged, or another's: what does not fit together is refused, for
// the analysis divides by its numbers and the renders take its words for options.
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "base/error.hpp"
#include "study/study_parameters.hpp"
#include "study/study_store.hpp"

namespace causticl {
namespace {

using Json = nlohmann::ordered_json;
using Words = std::vector<std::string>;

// Beyond these a number is no measurement. Products of them stay finite.
constexpr double largest_number = 1e150;
constexpr std::uint64_t most_passes = std::uint64_t{1} << 53;

[[noreturn]] void fail(const std::string& fault) { throw std::runtime_error(fault); }

void require(bool holds, const std::string& fault) {
  if (!holds) fail(fault);
}

/// The whole number of a key, from `low` to what T and `high` hold.
template <typename T>
T whole(const Json& json, const char* key, std::uint64_t low = 0,
        std::uint64_t high = std::numeric_limits<T>::max()) {
  const Json& value = json.at(key);
  const std::uint64_t number = value.is_number_unsigned() ? value.get<std::uint64_t>() : 0;
  require(
      value.is_number_unsigned() && number >= low && number <= high,
      std::string(key) + " is no whole number from " + std::to_string(low) + " to " + std::to_string(high));
  return static_cast<T>(number);
}

/// A number of seconds, a radius, an error: never negative.
double measured_value(const Json& value, const std::string& name) {
  const double number = value.is_number() ? value.get<double>() : -1;
  require(number >= 0 && number <= largest_number, name + " is no number from 0 to 1e150");
  return number;
}
double measured(const Json& json, const char* key) { return measured_value(json.at(key), key); }

/// The same for what a picture with pixels that are not finite has: JSON knows no infinity, and null stands
/// for it.
double measured_or_infinite(const Json& json, const char* key) {
  return json.at(key).is_null() ? std::numeric_limits<double>::infinity() : measured(json, key);
}

StudySample sample_of(const Json& json) {
  StudySample sample;
  sample.passes = whole<std::uint64_t>(json, "passes", 1, most_passes);
  sample.photons = whole<std::uint64_t>(json, "photons");
  sample.seconds = measured(json, "seconds");
  sample.relative_mse = measured_or_infinite(json, "relative_mse");
  sample.error_90 = measured_or_infinite(json, "error_90");
  sample.flip = measured_or_infinite(json, "flip");
  const Json& mean = json.at("mean");  // of pixels that a picture may have below 0, too
  sample.mean = mean.is_null() ? std::numeric_limits<double>::infinity() : mean.get<double>();
  return sample;
}

StudyRun run_of(const Json& json) {
  StudyRun run;
  run.parameter = json.at("knob").get<std::string>();
  run.value = json.at("value").get<std::string>();
  run.seed = whole<std::uint32_t>(json, "seed");
  run.is_long = json.at("long").get<bool>();
  run.setup_seconds = measured(json, "setup_seconds");
  for (const auto& [kernel, time] : json.at("kernel_milliseconds").items())
    run.kernel_milliseconds[kernel] = measured_value(time, "the time of a kernel");
  for (const auto& sample : json.at("samples")) run.samples.push_back(sample_of(sample));
  return run;
}

/// Options with a value each, all of them `known`.
Words words_of(const Json& json, const Words& known) {
  Words words = json.get<Words>();
  require(words.size() % 2 == 0, "an option lacks its value");
  for (std::size_t i = 0; i < words.size(); i += 2)
    require(std::find(known.begin(), known.end(), words[i]) != known.end(),
            "an option is none that a study sets");
  for (const auto& word : words)
    require(word.find('\0') == std::string::npos, "an option holds the character U+0000");
  return words;
}

bool is_parameter(const std::string& name) {
  return name == "scene" || name == "combined" ||
         std::any_of(study_parameters().begin(), study_parameters().end(),
                     [&](const StudyParameter& parameter) { return name == parameter.name; });
}

/// Throws where the parts of a study do not belong together.
void check_parts(const Study& study) {
  for (const auto& setting : study.settings)
    require(is_parameter(setting.parameter), "a setting is of an unknown knob");
  for (const auto& run : study.runs) require(is_parameter(run.parameter), "a run is of an unknown knob");
  for (const auto& [parameter, base] : study.bases)
    require(parameter == "combined" || study.own_values.contains(parameter),
            "a knob lacks the scene's own value");
  require(study.runs.empty() || study.reference, "there are runs without a reference");
  require(study.runs.empty() || !study.settings.empty(), "there are runs without a setting");
}

StudyReference reference_of(const Json& json) {
  return {json.at("how").get<std::string>(), measured(json, "relative_mse"), measured(json, "error_90"),
          json.at("mean").get<double>(), measured(json, "seconds")};
}

Study study_of(const Json& json) {
  Study study;
  study.scene = json.at("scene").get<std::string>();
  study.scene_hash = json.at("scene_hash").get<std::string>();
  study.version = json.at("version").get<std::string>();
  study.device = json.at("device").get<std::string>();
  study.words = words_of(json.at("words"), {"--size", "-D"});
  study.options = json.value("options", Words());
  study.width = whole<int>(json, "width", 1, 1 << 28);
  study.height = whole<int>(json, "height", 1, 1 << 28);
  study.seed = whole<std::uint32_t>(json, "seed");
  study.threads = whole<unsigned>(json, "threads");
  study.given_reference = json.at("given_reference").get<std::string>();
  study.date = json.at("date").get<std::string>();
  study.first_radius = measured(json, "first_radius");
  study.run_seconds = measured(json, "run_seconds");
  study.seeds = whole<int>(json, "seeds", 0, 1000);
  const Words options{"-D", "--integrator", "--photons", "--triangle-test", "--precision"};
  for (const auto& setting : json.at("settings"))
    study.settings.push_back({setting.at("knob").get<std::string>(),
                              setting.at("value").get<std::string>(),
                              {words_of(setting.at("words"), options), {}, {}},
                              setting.at("path_traced").get<bool>()});
  study.own_values = json.at("own_values").get<std::map<std::string, std::string>>();
  study.bases = json.at("bases").get<std::map<std::string, std::string>>();
  study.left_out = json.at("left_out").get<Words>();
  study.spent_seconds = measured(json, "spent_seconds");
  if (const auto& reference = json.at("reference"); !reference.is_null())
    study.reference = reference_of(reference);
  for (const auto& run : json.at("runs")) study.runs.push_back(run_of(run));
  check_parts(study);
  return study;
}

}  // namespace

Study study_from_json(const std::string& file, const std::string& text) {
  std::string fault;
  try {
    return study_of(Json::parse(text));
  } catch (const Json::parse_error& error) {
    // The parser's own message quotes the file.
    fault = "it is no JSON from byte " + std::to_string(error.byte) + " on";
  } catch (const std::exception& error) {
    fault = error.what();
  }
  throw UserError(file + ": not a study that this version wrote (" + fault + "); --restart begins it anew");
}

}  // namespace causticl
