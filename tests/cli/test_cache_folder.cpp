// Kernels that are kept between runs of `causticl`: the picture is the same to the bit, whatever happened to
// the folder, and a line says what.
#include <thread>

#include "catch2.hpp"
#include "device_fixture.hpp"
#include "small_render.hpp"

using namespace causticl;
using Catch::Contains;

namespace {

using Environment = std::vector<std::pair<std::string, std::string>>;

/// Kernels are kept in `cache` of the folder; the tests' own POCL_CACHE_DIR is nobody's.
Environment kept_in(const TemporaryFolder& folder, const std::string& cache = "cache") {
  return {{"CAUSTICL_CACHE_DIR", folder.path(cache)}, {"POCL_CACHE_DIR", ""}};
}

Words render_to(const std::string& name) { return small_render({"--passes", "2", "--stats", "-o", name}); }

Finished render(const TemporaryFolder& folder, const std::string& name, const std::string& cache = "cache") {
  Finished run = run_causticl(render_to(name), folder.path(""), kept_in(folder, cache));
  check_success(run);
  return run;
}

constexpr const char* none_kept = "0 of 5 programs kept";
constexpr const char* all_kept = "5 of 5 programs kept";

/// Entries, and nothing else: no folder of a run, no half file.
std::vector<std::string> entries(const TemporaryFolder& folder) {
  auto names = names_in(folder.path("cache"));
  for (const auto& name : names) CHECK(fs::path(name).extension() == ".kernels");
  return names;
}

}  // namespace

TEST_CASE("the second run takes its kernels from the first; damaged ones are built anew") {
  const TemporaryFolder folder;
  CHECK_THAT(render(folder, "a.pfm").output, Contains(none_kept));
  REQUIRE(entries(folder).size() == 5);
  CHECK_THAT(render(folder, "b.pfm").output, Contains(all_kept));
  CHECK(bytes_of(folder.path("a.pfm")) == bytes_of(folder.path("b.pfm")));

  const auto names = entries(folder);
  fs::resize_file(folder.path("cache/" + names[0]), 5000);
  fs::resize_file(folder.path("cache/" + names[1]), 0);
  const Finished damaged = render(folder, "c.pfm");
  CHECK_THAT(damaged.errors, Contains(names[0] + " is damaged") && Contains(names[1] + " is damaged"));
  CHECK_THAT(damaged.output, Contains("3 of 5 programs kept"));
  CHECK_THAT(render(folder, "d.pfm").output, Contains(all_kept));
  for (const char* name : {"c.pfm", "d.pfm"})
    CHECK(bytes_of(folder.path("a.pfm")) == bytes_of(folder.path(name)));

  // Another source is another program: the others stay.
  const std::string path = folder.path("");
  const Environment environment = kept_in(folder);
  fs::copy(CAUSTICL_SOURCE_DIR "/cl", folder.path("cl"), fs::copy_options::recursive);
  std::ofstream(folder.path("cl/passes/pass_film.cl"), std::ios::app) << "\n// another\n";
  Finished changed = run_causticl(render_to("e.pfm") + Words{"--kernel-dir", "cl"}, path, environment);
  check_success(changed);
  CHECK_THAT(changed.output, Contains("4 of 5 programs kept"));
  // Nothing is taken and nothing stored where none are wanted.
  const auto before = entries(folder);
  CHECK_THAT(run_causticl(render_to("f.pfm") + Words{"--no-cache"}, path, environment).output,
             Contains(none_kept));
  CHECK(entries(folder) == before);
  CHECK(bytes_of(folder.path("a.pfm")) == bytes_of(folder.path("f.pfm")));
}

TEST_CASE("two processes with one folder, and some that were killed") {
  const TemporaryFolder folder;
  const std::string path = folder.path("");
  const Environment environment = kept_in(folder);
  // Killed while kernels are compiled and stored: at some time, which is not the same in any two runs.
  int hit = 0;
  for (const int milliseconds : {300, 900, 2000, 3500}) {
    Process process(render_to("killed.pfm"), path, Process::Stream::pipe, environment);
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    process.send(SIGKILL);
    const Finished killed = process.wait();
    hit += killed.signal == SIGKILL;
  }
  CHECK(hit >= 2);
  Process one(render_to("one.pfm"), path, Process::Stream::pipe, environment);
  Process two(render_to("two.pfm"), path, Process::Stream::pipe, environment);
  for (Process* process : {&one, &two}) {
    const Finished run = process->wait();
    check_success(run);
    CHECK_THAT(run.errors, !Contains("damaged"));
  }
  const Finished third = render(folder, "three.pfm");
  CHECK_THAT(third.output, Contains(all_kept));
  CHECK_THAT(third.errors, !Contains("damaged"));
  CHECK(bytes_of(folder.path("one.pfm")) == bytes_of(folder.path("two.pfm")));
  CHECK(bytes_of(folder.path("one.pfm")) == bytes_of(folder.path("three.pfm")));
}

TEST_CASE("kernels are kept where the environment says") {
  const TemporaryFolder folder;
  const std::string path = folder.path("");
  const auto run = [&](const Environment& environment) {
    check_success(run_causticl(render_to("a.pfm"), path, environment));
  };
  run({{"CAUSTICL_CACHE_DIR", ""}, {"XDG_CACHE_HOME", folder.path("xdg")}, {"POCL_CACHE_DIR", ""}});
  CHECK(names_in(folder.path("xdg/causticl")).size() == 5);
  run({{"CAUSTICL_CACHE_DIR", ""},
       {"XDG_CACHE_HOME", "xdg"},
       {"HOME", folder.path("home")},
       {"POCL_CACHE_DIR", ""}});
  CHECK(names_in(folder.path("home/.cache/causticl")).size() == 5);
  run({{"CAUSTICL_CACHE_DIR", "relative"}, {"POCL_CACHE_DIR", ""}});
  CHECK(names_in(folder.path("relative")).size() == 5);
  // A user who has a folder for PoCL has it filled, and nothing else; to other drivers it means nothing.
  run({{"CAUSTICL_CACHE_DIR", folder.path("own")}, {"POCL_CACHE_DIR", folder.path("pocl")}});
  const bool pocl = test_device().info().platform_name == "Portable Computing Language";
  CHECK(names_in(folder.path("own")).empty() == pocl);
  if (pocl) CHECK(!names_in(folder.path("pocl")).empty());
}

TEST_CASE("a folder that cannot be written to is a note, not an end") {
  const TemporaryFolder folder;
  folder.write("file", "");
  const Finished run = render(folder, "a.pfm", "file/cache");
  CHECK_THAT(run.errors, Contains("note: kernels are not kept for the next run: ") &&
                             Contains("file: cannot be made a folder: there is a file of this name"));
  CHECK_THAT(run.output, Contains(none_kept));
  const std::string path = folder.path("");
  const Environment environment = kept_in(folder);
  Finished quiet = run_causticl(render_to("b.pfm") + Words{"--no-cache"}, path, environment);
  check_success(quiet);
  CHECK_THAT(quiet.errors, !Contains("kept"));
  CHECK(!fs::exists(folder.path("cache")));
}
