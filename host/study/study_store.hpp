// What a study has measured, and the files that it is kept in.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "study/render_change.hpp"

namespace causticl {

/// One position of one parameter; all others are as the scene says.
struct StudySetting {
  std::string parameter, value;  // "scene", "" for the scene as it is
  RenderChange change;           // besides what the study was told; read back from a file, its words alone
  bool path_traced = false;      // by an integrator whose passes are samples
  std::string id() const { return value.empty() ? parameter : parameter + "=" + value; }
};

/// How far a render was from the reference after so many passes.
struct StudySample {
  std::uint64_t passes = 0, photons = 0;
  double seconds = 0;                                         // of the passes alone
  double relative_mse = 0, error_90 = 0, flip = 0, mean = 0;  // as compare_pictures has them
};

/// One render: a setting and a seed, measured as it went.
struct StudyRun {
  std::string parameter, value;
  std::uint32_t seed = 1;
  bool is_long = false;  // continued beyond the time that all settings get, to see how it goes on
  std::vector<StudySample> samples;
  std::map<std::string, double> kernel_milliseconds;
  double setup_seconds = 0;  // before the first pass
};

/// The picture that errors are measured against.
struct StudyReference {
  std::string how;                        // in words
  double relative_mse = 0, error_90 = 0;  // its own noise, from two halves; 0 where it is not known
  double mean = 0;                        // over pixels and channels
  double seconds = 0;
};

struct Study {
  // What must be the same for measurements to belong together.
  std::string scene, scene_hash, version, device;
  std::vector<std::string> words;    // size and overrides of the command line, for every render
  std::vector<std::string> options;  // all others that decide what is rendered: see deciding_options()
  int width = 0, height = 0;
  std::uint32_t seed = 1;
  unsigned threads = 0;
  std::string given_reference;  // file, with a hash of its bytes; empty: the study's own

  // The plan.
  std::string date;
  double first_radius = 0;  // of photon mapping; 0 where it cannot render the scene
  double run_seconds = 0;   // passes of each render take this long; 0: not planned yet
  int seeds = 0;
  std::vector<StudySetting> settings;
  std::map<std::string, std::string> own_values;  // of each parameter, what the scene itself says
  std::map<std::string, std::string> bases;  // of each parameter, the id of the setting with its own value
  std::vector<std::string> left_out;         // what did not fit or makes no sense here, and why

  // What came of it.
  double spent_seconds = 0;  // of the budget
  std::optional<StudyReference> reference;
  std::vector<StudyRun> runs;

  const StudySetting* setting(const std::string& parameter, const std::string& value) const;
  const StudyRun* run(const StudySetting& setting, std::uint32_t seed, bool is_long) const;
};

/// Every measurement as one line under a line of names.
std::string study_csv(const Study& study);
/// Everything, to be read back by study_from_json.
std::string study_json(const Study& study);
/// Throws UserError, naming `file`, for a text that study_json did not write.
Study study_from_json(const std::string& file, const std::string& text);

/// What of the two differs that must be the same, in words; empty where nothing does.
std::string difference_of(const Study& found, const Study& wanted);

/// Writes study.json, then study.csv, into `folder`, each whole or not at all. Throws UserError.
void write_study(const std::string& folder, const Study& study);
/// The study in `folder`, if there is one.
std::optional<Study> read_study(const std::string& folder);

}  // namespace causticl
