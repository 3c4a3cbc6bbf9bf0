// `causticl study` as a user meets it: its files, a budget, being killed and going on, and what it refuses.
#include <nlohmann/json.hpp>

#include "base/temporary_file.hpp"
#include "catch2.hpp"
#include "image/image.hpp"
#include "small_render.hpp"

using namespace causticl;
using Catch::Contains;

namespace {

/// A study of small pictures, few photons and one parameter, with `more` in place of its own options or after
/// them.
Words small_study(const Words& more = {}) {
  Words words{"study",        cornell_box, "--size",   "12x9", "-D", "renderer.photon_sample=2000",
              "--parameters", "alpha",     "--budget", "20",   "-o", "out"};
  for (std::size_t i = 0; i + 1 < more.size(); i += 2) {
    const auto known = std::find(words.begin(), words.end(), more[i]);
    if (known != words.end() && more[i] != "-D") words.erase(known, known + 2);
  }
  if (const char* device = std::getenv("CAUSTICL_DEVICE")) words = words + Words{"--device", device};
  return words + more;
}

nlohmann::json study_in(const TemporaryFolder& folder) {
  return nlohmann::json::parse(bytes_of(folder.path("out/study.json")));
}

}  // namespace

TEST_CASE("a study writes its files, keeps its budget and recommends a command") {
  const TemporaryFolder folder;
  const Finished run = run_causticl(small_study(), folder.path(""));
  check_success(run);
  for (const char* name : {"study.json", "study.csv", "study.html", "reference.exr", "pictures/scene.exr"})
    CHECK(fs::exists(folder.path("out/" + std::string(name))));
  const auto study = study_in(folder);
  // The scene as it is, and three other values of alpha where a busy machine has time for them.
  REQUIRE(study.at("settings").size() + study.at("left_out").size() == 4);
  CHECK(study.at("runs").size() >= study.at("settings").size());
  CHECK(study.at("reference").at("relative_mse") > 0);
  // It may take less where all is known, and no more than a pass or two longer.
  CHECK(study.at("spent_seconds") < 30);
  for (const auto& one : study.at("runs")) CHECK(one.at("samples").size() >= 2);
  CHECK_THAT(run.output, Contains("wrote out/study.html"));

  // The last command it recommends for an error, pasted, renders.
  const auto from = run.output.find("  causticl render ");
  if (from == std::string::npos) return;  // a machine too slow for 10% has nothing to recommend
  const std::string line = run.output.substr(from + 2, run.output.find('\n', from) - from - 2);
  Words words;
  std::istringstream in(line);
  for (std::string word; in >> word;) words.push_back(word);
  words.erase(words.begin());
  const Words limited = words + Words{"--time", "2", "--quiet"};
  check_success(run_causticl(limited, folder.path("")));
  CHECK(read_picture(folder.path("cornell_box.exr")).width == 12);
}

TEST_CASE("a study that is killed at any point goes on and loses one render at most") {
  const TemporaryFolder folder;
  std::size_t runs = 0;
  for (const char* const line : {"reference, half 1", "reference: ", "settings, ", ", seed ", ", seed "}) {
    Process process(small_study({"--budget", "60"}), folder.path(""));
    process.wait_for(line);
    process.send(SIGKILL);
    CHECK(process.wait().signal == SIGKILL);
    // What is there is whole.
    const auto study = study_in(folder);
    CAPTURE(line, study.at("runs").size());
    CHECK(study.at("runs").size() >= runs);
    runs = study.at("runs").size();
  }
  CHECK(runs >= 2);
  const auto before = study_in(folder).at("runs");
  // It has spent some of its seconds already: a budget that is used up ends the study at once.
  const Finished finished = run_causticl(small_study({"--budget", "3"}), folder.path(""));
  check_success(finished);
  CHECK_THAT(finished.errors,
             Contains("continues the study in out, which has " + std::to_string(runs) + " renders"));
  const auto after = study_in(folder).at("runs");
  for (std::size_t i = 0; i < before.size(); ++i) CHECK(after.at(i) == before.at(i));
  CHECK(fs::exists(folder.path("out/study.html")));
  for (const auto& name : names_in(folder.path("out"))) CHECK_THAT(name, !Catch::EndsWith(".tmp"));
}

TEST_CASE("Ctrl-C ends a study with its page") {
  const TemporaryFolder folder;
  Process process(small_study({"--budget", "60"}), folder.path(""));
  process.wait_for("alpha=0.5, seed 1");
  process.send(SIGINT);
  const Finished run = process.wait();
  CHECK(run.exit_code == 130);
  CHECK(run.seconds < 50);
  CHECK(fs::exists(folder.path("out/study.html")));
  CHECK(study_in(folder).at("runs").size() >= 2);
}

TEST_CASE("a folder with a study of something else is not touched, but by --restart") {
  const TemporaryFolder folder;
  Process process(small_study(), folder.path(""));
  process.wait_for("scene, seed 1");
  process.send(SIGKILL);
  process.wait();
  const std::string before = bytes_of(folder.path("out/study.json"));
  check_one_error(run_causticl(small_study({"-D", "renderer.alpha=0.6"}), folder.path("")), 2,
                  "out holds a study of something else: the options (");
  check_one_error(run_causticl(small_study({"--seed", "7"}), folder.path("")), 2,
                  "the seed (1 then, 7 now) differs");
  CHECK(bytes_of(folder.path("out/study.json")) == before);
  Process restarted(small_study({"--seed", "7", "--restart"}), folder.path(""));
  restarted.wait_for("scene, seed 7");
}

TEST_CASE("a second study in a folder is refused while the first runs, and not once it was killed") {
  const TemporaryFolder folder;
  Process first(small_study({"--budget", "60"}), folder.path(""));
  first.wait_for("reference, half 1");
  folder.write("out/.causticl-1-0.tmp", "of a killed process");
  const TemporaryFile live(folder.path("out"));
  check_one_error(run_causticl(small_study({"--restart"}) + Words{"--quiet"}, folder.path("")), 2,
                  "out: another study is at work in this folder");
  CHECK(fs::exists(folder.path("out/.causticl-1-0.tmp")));
  first.send(SIGKILL);
  first.wait();
  check_one_error(run_causticl(small_study({"--integrator", "pt"}) + Words{"--quiet"}, folder.path("")), 2,
                  "out holds a study of something else: the options or the kernels (");
  Process next(small_study(), folder.path(""));
  next.wait_for("continues the study in out");
  // What another process still writes is left alone.
  const auto names = names_in(folder.path("out"));
  CHECK(std::count_if(names.begin(), names.end(),
                      [](const std::string& name) { return name.ends_with(".tmp"); }) == 1);
}

TEST_CASE("what study cannot take gets one line and exit code 2") {
  const TemporaryFolder folder;
  write_picture(folder.path("small.pfm"), {8, 4, std::vector<float>(96, 0.5f)}, {});
  write_picture(folder.path("black.pfm"), {12, 9, std::vector<float>(324, 0.0f)}, {});
  folder.write("file", "");
  const std::vector<std::pair<Words, std::string>> cases{
      {{"--parameters", "alpah"},
       "--parameters: there is no parameter \"alpah\"; expected some of integrator, photons"},
      {{"--budget", "0"}, "expected a positive time in seconds, or as in 90s, 10m or 1h30m, found '0'"},
      {{"--seeds", "1"}, "expected a whole number from 2 to 16"},
      {{"--reference", "missing.exr"}, "missing.exr"},
      {{"--reference", "small.pfm"}, "has 8x4 pixels; expected 12x9"},
      {{"--reference", "black.pfm"}, "black or not finite"},
      {{"--passes", "3"}, "unknown option or argument --passes"},
      {{"-D", "renderer.alpha=2"}, "renderer/alpha"},
  };
  for (const auto& [words, part] : cases) {
    CAPTURE(part);
    check_one_error(run_causticl(small_study(words + Words{"--quiet", "--restart"}), folder.path("")), 2,
                    part);
  }
  check_one_error(run_causticl(small_study({"-o", "file", "--quiet"}), folder.path("")), 2,
                  "-o file: cannot be made a folder");
}
