// What a user sees and may do while a render runs: progress, signals, limits of time.
#include <nlohmann/json.hpp>

#include "catch2.hpp"
#include "image/image.hpp"
#include "small_render.hpp"

using namespace causticl;
using Catch::Contains;

TEST_CASE("progress on a pipe is plain lines at powers of two") {
  const TemporaryFolder folder;
  const Finished run = run_causticl(small_render({"--passes", "6"}), folder.path(""));
  check_success(run);
  for (const char* line : {"causticl: pass 1/6, ", "causticl: pass 2/6, ", "causticl: pass 4/6, ",
                           "causticl: pass 6/6, ", " elapsed, ", " left, ", " photons/s, ", " rays/s\n"})
    CHECK_THAT(run.errors, Contains(line));
  CHECK_THAT(run.errors, !Contains("pass 3/6") && !Contains("pass 5/6"));
  CHECK_THAT(run.errors, !Contains("\r") && !Contains("\033"));
}

TEST_CASE("progress on a terminal is one bar within its width, cleared at the end") {
  const TemporaryFolder folder;
  for (const unsigned columns : {120u, 30u}) {
    Process process(small_render({"--passes", "4"}), folder.path(""), Process::Stream::terminal, {}, columns);
    const Finished run = process.wait();
    CAPTURE(run.errors);
    CHECK(run.exit_code == 0);
    const auto bar = run.errors.rfind("pass 4/4");
    REQUIRE(bar != std::string::npos);
    const auto start = run.errors.rfind('\r', bar), end = run.errors.find("\033[K", bar);
    REQUIRE(end != std::string::npos);
    CHECK(end - start - 1 < columns);
    CHECK((run.errors[start + 1] == '[') == (columns == 120));
    CHECK_THAT(run.errors, Contains("\033[K\r\033[Kcausticl: wrote cornell_box.png"));
  }
}

TEST_CASE("--quiet prints nothing at all") {
  const TemporaryFolder folder;
  const Finished run =
      run_causticl(small_render({"--passes", "2", "--quiet", "--threads", "9999"}), folder.path(""));
  check_success(run);
  CHECK(run.errors.empty());
  CHECK(run.output.empty());
}

TEST_CASE("SIGINT and SIGTERM finish the pass, write the image and exit with 130") {
  const TemporaryFolder folder;
  for (const int signal_number : {SIGINT, SIGTERM}) {
    Process process(small_render(endless + Words{"-o", "a.pfm", "-o", "b.png", "--stats-json", "stats.json"}),
                    folder.path(""));
    process.wait_for("pass 2/");
    process.send(signal_number);
    const Finished run = process.wait();
    CAPTURE(run.errors);
    CHECK(run.exit_code == 130);
    CHECK_THAT(run.errors, Contains("causticl: interrupted: finishing the pass") &&
                               Contains("causticl: wrote a.pfm, b.png: ") &&
                               Contains("(interrupted)\ncausticl: error "));
    CHECK(names_in(folder.path("")) == Words{"a.pfm", "b.png", "stats.json"});
    CHECK(read_picture(folder.path("a.pfm")).width == 16);
    CHECK(read_image(folder.path("b.png"), false).width == 16);
    CHECK(nlohmann::json::parse(bytes_of(folder.path("stats.json"))).at("stop") == "interrupted");
    fs::remove(folder.path("a.pfm"));
  }
}

TEST_CASE("an interrupted render is the same as one with as many passes") {
  const TemporaryFolder folder;
  Process process(small_render(endless + Words{"-o", "a.pfm", "--stats-json", "stats.json"}),
                  folder.path(""));
  process.wait_for("pass 2/");
  process.send(SIGINT);
  CHECK(process.wait().exit_code == 130);
  const int passes = nlohmann::json::parse(bytes_of(folder.path("stats.json"))).at("passes");
  check_success(
      run_causticl(small_render({"-o", "b.pfm", "--passes", std::to_string(passes)}), folder.path("")));
  CHECK(bytes_of(folder.path("a.pfm")) == bytes_of(folder.path("b.pfm")));
}

TEST_CASE("a second signal ends the process at once") {
  const TemporaryFolder folder;
  Process process(small_render({}, cornell_box, 500000), folder.path(""));
  process.wait_for("pass 1/");
  process.send(SIGINT);
  process.wait_for("interrupted");
  process.send(SIGINT);
  const Finished run = process.wait();
  // A fast device may be done with the pass before the second signal is there.
  if (run.exit_code == 130)
    WARN("the pass was too short to be stopped");
  else
    CHECK(run.signal == SIGINT);
}

TEST_CASE("--time ends the render in time") {
  const TemporaryFolder folder;
  // Once without a limit that counts, so that the kernels are compiled and cached.
  check_success(run_causticl(small_render({"--passes", "1"}), folder.path("")));
  const Finished run = run_causticl(
      small_render(endless + Words{"--time", "1.5", "--stats-json", "stats.json"}), folder.path(""));
  check_success(run);
  CHECK_THAT(run.errors, Contains("(time limit reached)\n"));
  const auto stats = nlohmann::json::parse(bytes_of(folder.path("stats.json")));
  CHECK(stats.at("stop") == "time");
  CHECK(stats.at("passes") >= 1);
  // Loosely: the machine may have other work to do, but all the passes would take a day.
  CHECK(stats.at("seconds") < 15);
}

TEST_CASE("the time to half the error is told from the sixteenth pass on") {
  const TemporaryFolder folder;
  const auto render = [&](const char* passes) {
    const Finished run = run_causticl(
        small_render({"--passes", passes, "-o", "a.pfm", "--stats-json", "stats.json"}), folder.path(""));
    check_success(run);
    const auto stats = nlohmann::json::parse(bytes_of(folder.path("stats.json")));
    CHECK(stats.contains("passes_to_half_error") ==
          (run.errors.find(", half of it in ") != std::string::npos));
    return stats.contains("passes_to_half_error");
  };
  CHECK(!render("15"));
  CHECK(render("16"));
}

TEST_CASE("--error stops when the estimate is small enough, at the same pass every time") {
  const TemporaryFolder folder;
  const auto stats_of = [&](const Words& more) {
    const Finished run = run_causticl(small_render(more + Words{"-o", "a.pfm", "--stats-json", "stats.json"}),
                                      folder.path(""));
    check_success(run);
    CHECK_THAT(run.errors, Contains("(error reached)\n"));
    CHECK_THAT(run.errors, Contains(", error "));
    return nlohmann::json::parse(bytes_of(folder.path("stats.json")));
  };
  const auto first = stats_of({"--error", "30%"}), second = stats_of({"--error", "0.3", "-o", "b.exr"});
  CHECK(first["error"] <= 0.3);
  // No number of passes is known, and none is shown.
  const Finished run = run_causticl(small_render({"--error", "30%", "-o", "a.pfm"}), folder.path(""));
  CHECK_THAT(run.errors, Contains("causticl: pass 1, ") && Contains(" → 30%, ") && Contains("about ") &&
                             !Contains("pass 1/") && !Contains("2147483647"));
  CHECK(first["stop"] == "error");
  // More passes than the scene's own, if that is what it takes.
  CHECK(first["passes"] >= 8);
  CHECK(first["passes"] == second["passes"]);
  CHECK(first["error"] == second["error"]);
  // More confidence is a larger error, so more passes.
  CHECK(stats_of({"--error", "30%", "--confidence", "99%"})["passes"] > first["passes"]);
  const auto paths = stats_of({"--error", "60%", "--integrator", "pt"});
  CHECK(paths["error_bias"] == 0);
  CHECK(paths["error"] == paths["error_noise"]);
}

TEST_CASE("other limits end a render whose error is not reached") {
  const TemporaryFolder folder;
  const Finished run = run_causticl(small_render({"--error", "0.01%", "--passes", "3"}), folder.path(""));
  check_success(run);
  CHECK_THAT(run.errors, Contains("pass 3/3, ") && Contains("(done)\n"));
}
