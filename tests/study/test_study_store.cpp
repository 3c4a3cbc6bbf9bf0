// What a study measured, to files and back.
#include <fstream>
#include <limits>
#include <sstream>

#include "../temporary_folder.hpp"
#include "catch2.hpp"
#include "study_fixture.hpp"

using namespace causticl;
using Catch::Contains;

namespace {

/// The cells of CSV, with quotes undone.
std::vector<std::vector<std::string>> cells_of(const std::string& csv) {
  std::vector<std::vector<std::string>> rows{{""}};
  bool quoted = false;
  for (std::size_t i = 0; i < csv.size(); ++i) {
    if (csv[i] == '"' && quoted && i + 1 < csv.size() && csv[i + 1] == '"')
      rows.back().back() += csv[i++];
    else if (csv[i] == '"')
      quoted = !quoted;
    else if (csv[i] == ',' && !quoted)
      rows.back().emplace_back();
    else if (csv[i] == '\n' && !quoted)
      rows.push_back({""});
    else
      rows.back().back() += csv[i];
  }
  rows.pop_back();
  return rows;
}

}  // namespace

TEST_CASE("a study is the same after it was written and read") {
  Study study = made_study();
  study.runs[0].samples[0].relative_mse = std::numeric_limits<double>::infinity();
  study.runs[1].is_long = true;
  const std::string json = study_json(study);
  const Study read = study_from_json("study.json", json);
  CHECK(study_json(read) == json);
  CHECK(study_csv(read) == study_csv(study));
  CHECK(read.runs.size() == study.runs.size());
  CHECK(std::isinf(read.runs[0].samples[0].relative_mse));
  CHECK(read.runs[2].samples[3].relative_mse == study.runs[2].samples[3].relative_mse);
  CHECK(read.settings[1].change.words == study.settings[1].change.words);
  CHECK(difference_of(read, study).empty());
}

TEST_CASE("CSV has every measurement, exactly") {
  Study study = made_study();
  study.runs[0].value = "a, \"b\"";
  const auto rows = cells_of(study_csv(study));
  std::size_t samples = 0;
  for (const auto& run : study.runs) samples += run.samples.size();
  REQUIRE(rows.size() == samples + 1);
  CHECK(rows[0].front() == "knob");
  std::size_t row = 0;
  for (const auto& run : study.runs)
    for (const auto& sample : run.samples) {
      const auto& cells = rows[++row];
      REQUIRE(cells.size() == rows[0].size());
      CHECK(cells[0] == run.parameter);
      CHECK(cells[1] == run.value);
      CHECK(std::stoull(cells[2]) == run.seed);
      CHECK(std::stoull(cells[4]) == sample.passes);
      CHECK(std::stod(cells[6]) == sample.seconds);
      CHECK(std::stod(cells[7]) == sample.relative_mse);
      CHECK(std::stod(cells[8]) == std::sqrt(sample.relative_mse));
      CHECK(std::stod(cells[9]) == sample.error_90);
    }
}

TEST_CASE("a folder is read as it was written last") {
  const TemporaryFolder folder;
  CHECK_FALSE(read_study(folder.path("")));
  write_study(folder.path(""), made_study());
  // A write that was cut off leaves a temporary file, and the files of before.
  folder.write(".causticl-123-0.tmp", "{\"scene\": \"half");
  const auto read = read_study(folder.path(""));
  REQUIRE(read);
  CHECK(study_json(*read) == study_json(made_study()));
}

TEST_CASE("what is no study is refused") {
  const TemporaryFolder folder;
  const std::string whole = study_json(made_study());
  for (const std::string& text :
       {std::string("[]"), whole.substr(0, whole.size() / 2), std::string("{\"scene\": 3}")}) {
    folder.write("study.json", text);
    CHECK_THAT(user_error_of([&] { read_study(folder.path("")); }),
               Contains("study.json: not a study that this version wrote") && Contains("--restart"));
  }
}

TEST_CASE("a study whose parts do not fit together is refused, and the message says which") {
  const auto message_after = [](const std::string& from, const std::string& to) {
    std::string text = study_json(made_study());
    const auto at = text.find(from);
    REQUIRE(at != text.npos);
    text.replace(at, from.size(), to);
    return user_error_of([&] { study_from_json("study.json", text); });
  };
  CHECK(message_after("\"seed\": 1", "\"seed\": 2").empty());
  CHECK_THAT(message_after("\"width\": 40", "\"width\": 1e300"), Contains("width is no whole number"));
  CHECK_THAT(message_after("\"width\": 40", "\"width\": 0"), Contains("width is no whole number from 1"));
  CHECK_THAT(message_after("\"seed\": 1", "\"seed\": -1"), Contains("seed is no whole number"));
  CHECK_THAT(message_after("\"seed\": 1", "\"seed\": 4294967296"), Contains("4294967295"));
  CHECK_THAT(message_after("\"passes\": 1,", "\"passes\": 0,"), Contains("passes is no whole number from 1"));
  CHECK_THAT(message_after("\"run_seconds\": 6.4", "\"run_seconds\": -1"),
             Contains("run_seconds is no number"));
  CHECK_THAT(message_after("\"run_seconds\": 6.4", "\"run_seconds\": 1e200"),
             Contains("run_seconds is no number"));
  CHECK_THAT(message_after("\"--integrator\"", "\"-o\""), Contains("an option is none that a study sets"));
  CHECK_THAT(message_after("\"--size\",", ""), Contains("an option lacks its value"));
  CHECK_THAT(message_after("\"40x30\"", "\"40\\u0000\""), Contains("U+0000"));
  CHECK_THAT(message_after("\"knob\": \"max_depth\"", "\"knob\": \"no such\""), Contains("unknown knob"));
  CHECK_THAT(message_after("\"own_values\"", "\"own_values\": {}, \"others\""),
             Contains("scene's own value"));
  CHECK_THAT(message_after("\"reference\"", "\"reference\": null, \"other\""),
             Contains("without a reference"));
  CHECK_THAT(message_after("\"settings\"", "\"settings\": [], \"others\""), Contains("without a setting"));
  // The parser's message would quote this.
  CHECK_THAT(message_after("\"width\"", "\x1b[31m"), Contains("no JSON from byte") && !Contains("\x1b"));
}

TEST_CASE("a study of other things is told from this one") {
  const Study study = made_study();
  const auto differs = [&](auto change) {
    Study other = study;
    change(other);
    return difference_of(study, other);
  };
  CHECK_THAT(differs([](Study& s) { s.scene = "c.json"; }), Contains("c.json"));
  CHECK_THAT(differs([](Study& s) { s.scene_hash = "4"; }), Contains("meshes and images"));
  CHECK_THAT(differs([](Study& s) { s.device = "another"; }), Contains("another"));
  CHECK_THAT(differs([](Study& s) { s.words[1] = "50x50"; }), Contains("50x50"));
  CHECK_THAT(differs([](Study& s) {
               s.options = {"--integrator", "pt"};
             }),
             Contains("none then, --integrator pt now"));
  CHECK_THAT(differs([](Study& s) { s.seed = 9; }), Contains("9 now"));
  CHECK_THAT(differs([](Study& s) { s.threads = 3; }), Contains("threads"));
  CHECK_THAT(differs([](Study& s) { s.given_reference = "r.exr 12"; }), Contains("its own then, r.exr 12"));
  CHECK_THAT(differs([](Study& s) { s.version = "9.9"; }), Contains("9.9"));
}
