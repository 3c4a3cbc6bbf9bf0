#include "study/study_store.hpp"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/error.hpp"
#include "base/input_file.hpp"
#include "base/output_file.hpp"
#include "base/spelling.hpp"

namespace causticl {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// The shortest text that reads back as the same number.
std::string exact(double value) {
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof text, value);
  return error == std::errc() ? std::string(text, end) : std::string("nan");
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + "\"";
}

/// JSON has no infinity: a picture with pixels that are not finite has the error null.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json json_of(const StudySample& sample) {
  return {{"passes", sample.passes},
          {"photons", sample.photons},
          {"seconds", sample.seconds},
          {"relative_mse", number(sample.relative_mse)},
          {"error_90", number(sample.error_90)},
          {"flip", number(sample.flip)},
          {"mean", number(sample.mean)}};
}

Json json_of(const StudyRun& run) {
  Json samples = Json::array();
  for (const auto& sample : run.samples) samples.push_back(json_of(sample));
  return {{"knob", run.parameter},
          {"value", run.value},
          {"seed", run.seed},
          {"long", run.is_long},
          {"setup_seconds", run.setup_seconds},
          {"kernel_milliseconds", run.kernel_milliseconds},
          {"samples", samples}};
}

std::string words_text(const std::vector<std::string>& words) {
  return words.empty() ? "none" : joined(words, " ");
}

}  // namespace

const StudySetting* Study::setting(const std::string& parameter, const std::string& value) const {
  for (const auto& candidate : settings)
    if (candidate.parameter == parameter && candidate.value == value) return &candidate;
  return nullptr;
}

const StudyRun* Study::run(const StudySetting& of, std::uint32_t with_seed, bool is_long) const {
  for (const auto& candidate : runs)
    if (candidate.parameter == of.parameter && candidate.value == of.value && candidate.seed == with_seed &&
        candidate.is_long == is_long)
      return &candidate;
  return nullptr;
}

std::string study_csv(const Study& study) {
  std::ostringstream text;
  text << "knob,value,seed,long,passes,photons,seconds,relative_mse,relative_rmse,error_90,flip,mean\n";
  for (const auto& run : study.runs)
    for (const auto& sample : run.samples) {
      text << quoted(run.parameter) << "," << quoted(run.value) << "," << run.seed << "," << run.is_long
           << "," << sample.passes << "," << sample.photons;
      for (const double value : {sample.seconds, sample.relative_mse, std::sqrt(sample.relative_mse),
                                 sample.error_90, sample.flip, sample.mean})
        text << "," << exact(value);
      text << "\n";
    }
  return text.str();
}

std::string study_json(const Study& study) {
  Json settings = Json::array(), runs = Json::array(), reference = nullptr;
  for (const auto& setting : study.settings)
    settings.push_back({{"knob", setting.parameter},
                        {"value", setting.value},
                        {"words", setting.change.words},
                        {"path_traced", setting.path_traced}});
  for (const auto& run : study.runs) runs.push_back(json_of(run));
  if (study.reference)
    reference = {{"how", study.reference->how},
                 {"relative_mse", study.reference->relative_mse},
                 {"error_90", study.reference->error_90},
                 {"mean", study.reference->mean},
                 {"seconds", study.reference->seconds}};
  const Json json = {{"scene", study.scene},
                     {"scene_hash", study.scene_hash},
                     {"version", study.version},
                     {"device", study.device},
                     {"words", study.words},
                     {"options", study.options},
                     {"width", study.width},
                     {"height", study.height},
                     {"seed", study.seed},
                     {"threads", study.threads},
                     {"given_reference", study.given_reference},
                     {"date", study.date},
                     {"first_radius", study.first_radius},
                     {"run_seconds", study.run_seconds},
                     {"seeds", study.seeds},
                     {"settings", settings},
                     {"own_values", study.own_values},
                     {"bases", study.bases},
                     {"left_out", study.left_out},
                     {"spent_seconds", study.spent_seconds},
                     {"reference", reference},
                     {"runs", runs}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string difference_of(const Study& found, const Study& wanted) {
  const auto differs = [](const std::string& what, const std::string& was, const std::string& is) {
    return what + " (" + was + " then, " + is + " now)";
  };
  if (found.scene != wanted.scene) return differs("the scene", found.scene, wanted.scene);
  if (found.scene_hash != wanted.scene_hash) return "what " + wanted.scene + " or its meshes and images hold";
  if (found.version != wanted.version) return differs("the version", found.version, wanted.version);
  if (found.device != wanted.device) return differs("the device", found.device, wanted.device);
  if (found.words != wanted.words)
    return differs("the options", words_text(found.words), words_text(wanted.words));
  if (found.options != wanted.options)
    return differs("the options or the kernels", words_text(found.options), words_text(wanted.options));
  if (found.seed != wanted.seed)
    return differs("the seed", std::to_string(found.seed), std::to_string(wanted.seed));
  if (found.threads != wanted.threads)
    return differs("the threads", std::to_string(found.threads), std::to_string(wanted.threads));
  if (found.given_reference != wanted.given_reference)
    return differs("the reference", found.given_reference.empty() ? "its own" : found.given_reference,
                   wanted.given_reference.empty() ? "its own" : wanted.given_reference);
  return "";
}

void write_study(const std::string& folder, const Study& study) {
  write_file((fs::path(folder) / "study.json").string(), study_json(study));
  write_file((fs::path(folder) / "study.csv").string(), study_csv(study));
}

std::optional<Study> read_study(const std::string& folder) {
  const std::string file = (fs::path(folder) / "study.json").string();
  if (!fs::exists(file)) return {};
  return study_from_json(file, read_input(file, "a study", 64u << 20));
}

}  // namespace causticl
