// Files that a run leaves: whole or not at all, under the names that were asked for, whatever fails beside.
#include <sys/file.h>
#include <sys/stat.h>

#include <csignal>
#include <cstdlib>

#include "base/console.hpp"
#include "base/output_file.hpp"
#include "base/temporary_file.hpp"
#include "catch2.hpp"
#include "image/image.hpp"
#include "small_render.hpp"

using namespace causticl;
using Catch::Contains;

namespace {

/// The name in the folder that begins and ends so; empty where there is not exactly one.
std::string name_like(const std::string& folder, const std::string& begin, const std::string& end) {
  std::string found;
  for (const auto& name : names_in(folder))
    if (name.starts_with(begin) && name.ends_with(end)) {
      if (!found.empty()) return "";
      found = name;
    }
  return found;
}

const Picture grey{4, 2, std::vector<float>(24, 0.5f)};

}  // namespace

TEST_CASE("what a killed process left is removed, and what a live one writes is not") {
  const TemporaryFolder folder;
  folder.write(".causticl-1-0.tmp", "half of a picture");
  folder.write(".causticl-" + std::to_string(getpid()) + "-0.tmp", "half of another");
  folder.write("other.tmp", "of another program");
  const TemporaryFile live(folder.path(""));
  CHECK(names_in(folder.path("")).size() == 4);
  check_writable(folder.path("a.pfm"));
  write_file(folder.path("a.pfm"), "bytes");
  const auto names = names_in(folder.path(""));
  REQUIRE(names.size() == 3);
  CHECK(names[0].starts_with(".causticl-"));
  CHECK_THAT(names[0], !Contains("-0.tmp"));
  CHECK(Words(names.begin() + 1, names.end()) == Words{"a.pfm", "other.tmp"});
}

TEST_CASE("no name of a temporary file is used twice") {
  const TemporaryFolder folder;
  std::vector<std::unique_ptr<TemporaryFile>> files;
  for (int i = 0; i < 100; ++i) files.push_back(std::make_unique<TemporaryFile>(folder.path("")));
  CHECK(names_in(folder.path("")).size() == 100);
  files.clear();
  CHECK(names_in(folder.path("")).empty());
}

TEST_CASE("links stay links, also those to files that do not exist yet") {
  const TemporaryFolder folder;
  fs::create_directory(folder.path("pictures"));
  fs::create_symlink("pictures/target.pfm", folder.path("dangling.pfm"));
  fs::create_symlink("dangling.pfm", folder.path("chain.pfm"));
  fs::create_symlink(folder.path("pictures/absolute.pfm"), folder.path("absolute.pfm"));
  for (const char* name : {"dangling.pfm", "chain.pfm", "absolute.pfm"}) {
    CAPTURE(name);
    check_writable(folder.path(name));
    write_picture(folder.path(name), grey, {});
    CHECK(fs::is_symlink(folder.path(name)));
    CHECK(read_picture(folder.path(name)).width == 4);
  }
  CHECK(names_in(folder.path("pictures")) == Words{"absolute.pfm", "target.pfm"});

  fs::create_symlink("nowhere/target.pfm", folder.path("lost.pfm"));
  CHECK_THAT(user_error_of([&] { check_writable(folder.path("lost.pfm")); }), Contains("there is no folder"));
  fs::create_symlink("loop.pfm", folder.path("loop.pfm"));
  CHECK_THAT(user_error_of([&] { check_writable(folder.path("loop.pfm")); }), Contains("Too many levels"));
}

TEST_CASE("bytes that find no room are kept beside their file, or in the temporary folder") {
  const TemporaryFolder folder;
  // A folder that takes the place of the file after it was checked.
  fs::create_directories(folder.path("a.pfm/in the way"));
  const std::string beside = user_error_of([&] { write_file_or_keep(folder.path("a.pfm"), "bytes"); });
  const std::string kept = name_like(folder.path(""), "a-kept-", ".pfm");
  REQUIRE(!kept.empty());
  CHECK(bytes_of(folder.path(kept)) == "bytes");
  CHECK_THAT(beside, Contains("cannot be written: ") && Contains("; it is kept as " + folder.path(kept)));

  fs::create_directory(folder.path("tmp"));
  const char* before = std::getenv("TMPDIR");
  const std::string restored = before ? before : "";
  setenv("TMPDIR", folder.path("tmp").c_str(), 1);
  const std::string elsewhere =
      user_error_of([&] { write_file_or_keep(folder.path("none/b.pfm"), "bytes"); });
  before ? setenv("TMPDIR", restored.c_str(), 1) : unsetenv("TMPDIR");
  const std::string name = name_like(folder.path("tmp"), "b-kept-", ".pfm");
  REQUIRE(!name.empty());
  CHECK(bytes_of(folder.path("tmp/" + name)) == "bytes");
  CHECK_THAT(elsewhere, Contains("; it is kept as " + folder.path("tmp/" + name)));
}

TEST_CASE("an output that fails costs neither the others nor its picture") {
  const TemporaryFolder folder;
  fs::create_symlink("/dev/full", folder.path("full.pfm"));
  fs::create_directory(folder.path("tmp"));
  const Finished run = run_causticl(small_render({"--passes", "1", "-o", "full.pfm", "-o", "a.png", "-o",
                                                  "b.pfm", "--stats-json", "stats.json"}),
                                    folder.path(""), {{"TMPDIR", folder.path("tmp")}});
  CAPTURE(run.errors);
  CHECK(run.exit_code == 2);
  CHECK_THAT(run.errors, Contains("causticl: wrote a.png, b.pfm: 1 pass in "));
  CHECK_THAT(
      run.errors,
      Contains("causticl: error: full.pfm: cannot be written: No space left on device; it is kept as "));
  CHECK(names_in(folder.path("")) == Words{"a.png", "b.pfm", "full.pfm", "stats.json", "tmp"});
  const std::string kept = name_like(folder.path("tmp"), "full-kept-", ".pfm");
  REQUIRE(!kept.empty());
  CHECK(bytes_of(folder.path("tmp/" + kept)) == bytes_of(folder.path("b.pfm")));
}

TEST_CASE("standard output that cannot be written is an error of every command") {
  const TemporaryFolder folder;
  write_picture(folder.path("a.pfm"), grey, {});
  std::string render = "render " + cornell_box + " --size 8x6 --photons 500 --passes 1 --stats -o b.pfm";
  if (const char* device = std::getenv("CAUSTICL_DEVICE")) render += std::string(" --device ") + device;
  for (const char* redirection : {"> /dev/full", ">&-"})
    for (const std::string& words :
         {std::string("--version"), std::string("--help"), "info " + cornell_box, "explain " + cornell_box,
          std::string("devices"), std::string("compare a.pfm a.pfm"), render}) {
      CAPTURE(words, redirection);
      const std::string command =
          "cd '" + folder.path("") + "' && '" + CAUSTICL_BINARY + "' " + words + " 2> errors " + redirection;
      const int status = std::system(command.c_str());
      CHECK(WEXITSTATUS(status) == 2);
      CHECK_THAT(bytes_of(folder.path("errors")),
                 Contains("causticl: error: standard output cannot be written: "));
    }
  CHECK(read_picture(folder.path("b.pfm")).width == 8);
}

TEST_CASE("a closed standard output does not become the picture") {
  const TemporaryFolder folder;
  std::string command = "cd '" + folder.path("") + "' && '" + CAUSTICL_BINARY + "' render " + cornell_box +
                        " --size 8x6 --photons 500 --passes 1 -o b.pfm";
  if (const char* device = std::getenv("CAUSTICL_DEVICE")) command += std::string(" --device ") + device;
  CHECK(WEXITSTATUS(std::system((command + " <&- >&- 2>&-").c_str())) == 0);
  CHECK(read_picture(folder.path("b.pfm")).width == 8);
}

TEST_CASE("a reader of standard output that leaves ends the program by SIGPIPE, silently") {
  const TemporaryFolder folder;
  const std::string command = "cd '" + folder.path("") + "' && { sleep 1; '" + CAUSTICL_BINARY +
                              "' --help 2> errors; echo $? > status; } | true";
  CHECK(std::system(command.c_str()) == 0);
  for (int i = 0; i < 100 && !fs::exists(folder.path("status")); ++i) usleep(100000);
  CHECK(bytes_of(folder.path("status")) == "141\n");
  CHECK(bytes_of(folder.path("errors")).empty());
}

TEST_CASE("SIGHUP, also twice, finishes the pass and writes the image; under nohup it is ignored") {
  const TemporaryFolder folder;
  Process process(small_render(endless + Words{"-o", "a.pfm"}), folder.path(""));
  process.wait_for("pass 2/");
  process.send(SIGHUP);
  process.send(SIGHUP);
  process.wait_for("interrupted");
  process.send(SIGHUP);
  const Finished run = process.wait();
  CHECK(run.exit_code == 130);
  CHECK(read_picture(folder.path("a.pfm")).width == 16);

  const auto before = std::signal(SIGHUP, SIG_IGN);
  Process ignoring(small_render({"--passes", "200", "-o", "b.pfm"}), folder.path(""));
  std::signal(SIGHUP, before);
  ignoring.wait_for("pass 2/");
  ignoring.send(SIGHUP);
  CHECK(ignoring.wait().exit_code == 0);
}
