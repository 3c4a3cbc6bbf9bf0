// Every bad scene, mesh and image gets its one line, from load_scene and from the program.
#include <sys/wait.h>

#include <cstdio>
#include <filesystem>

#include "bad_scenes.hpp"
#include "catch2.hpp"
#include "format/load_scene.hpp"
#include "scene/scene.hpp"
#include "temporary_folder.hpp"

namespace causticl {
namespace {

namespace fs = std::filesystem;

std::string without(std::string text, const std::string& part) {
  for (std::size_t at; (at = text.find(part)) != text.npos;) text.erase(at, part.size());
  return text;
}

// A copy of the bad files, in which the scenes of the table are written beside them.
class BadFolder {
 public:
  BadFolder() {
    fs::copy(fs::path(CAUSTICL_SOURCE_DIR) / "tests/cli/bad", path(""), fs::copy_options::recursive);
    folder_.write("good.json", good_scene);
  }
  std::string path(const std::string& name) const { return folder_.path(name); }

  std::string scene_of(const BadScene& bad) const {
    const std::string from = bad.from;
    if (from == "FILE") return path(bad.to);
    std::string text = good_scene;
    if (from.empty()) return folder_.write("scene.json", bad.to);
    const std::size_t at = text.find(from);
    REQUIRE(at != text.npos);
    return folder_.write("scene.json", text.replace(at, from.size(), bad.to));
  }

  std::string message_of(const std::string& scene, const SceneOptions& options = {}) const {
    return without(user_error_of([&] { load_scene(scene, options); }), path(""));
  }

 private:
  TemporaryFolder folder_;
};

struct Output {
  int status;
  std::string errors;
};

Output run_program(const std::string& arguments) {
  const std::string command = std::string(CAUSTICL_BINARY) + " " + arguments + " 2>&1 >/dev/null";
  FILE* pipe = popen(command.c_str(), "r");
  REQUIRE(pipe);
  std::string errors;
  for (int c; (c = std::fgetc(pipe)) != EOF;) errors += static_cast<char>(c);
  const int status = pclose(pipe);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, errors};
}

}  // namespace

TEST_CASE("the scene that the bad ones are made from loads without a notice") {
  const BadFolder folder;
  const Scene scene = load_scene(folder.path("good.json"));
  CHECK(scene.objects.size() == 2);
  CHECK(scene.notices.empty());
}

TEST_CASE("every bad scene, mesh and image gets its one-line message") {
  const BadFolder folder;
  CHECK(all_bad_scenes().size() >= 60);
  for (const BadScene& bad : all_bad_scenes()) {
    INFO(bad.name);
    const std::string message = folder.message_of(folder.scene_of(bad));
    CHECK(message == bad.message);
    CHECK(message.find('\n') == message.npos);
  }
}

TEST_CASE("scene files that cannot be read get one line") {
  const BadFolder folder;
  CHECK(folder.message_of(folder.path("nowhere.json")) ==
        "nowhere.json: cannot read the scene file: No such file or directory");
  fs::create_directory(folder.path("folder.json"));
  CHECK(folder.message_of(folder.path("folder.json")) ==
        "folder.json: expected a scene file, got a directory");
  fs::create_symlink("loop.json", folder.path("loop.json"));
  CHECK(folder.message_of(folder.path("loop.json")) ==
        "loop.json: cannot read the scene file: Too many levels of symbolic links");
  fs::permissions(folder.path("good.json"), fs::perms::none);
  if (geteuid() != 0)  // who may read everything anyway
    CHECK(folder.message_of(folder.path("good.json")) ==
          "good.json: cannot read the scene file: Permission denied");
  CHECK(folder.message_of("/dev/zero") ==
        "/dev/zero: expected a scene file of at most 32 MiB, got a larger one");
  CHECK(folder.message_of("/dev/null") == "/dev/null:1: expected a scene, got an empty file");
}

TEST_CASE("a hundred thousand open brackets do not overflow the stack") {
  const TemporaryFolder folder;
  for (const std::string bracket : {"[", "{\"a\":"}) {
    std::string text;
    for (int i = 0; i < 100000; ++i) text += bracket;
    const std::string file = folder.write("deep.json", text);
    CHECK(user_error_of([&] { load_scene(file); }, file) ==
          "deep.json:1: expected at most 64 levels of nesting, got more");
  }
}

TEST_CASE("bad options of the command line are named by the message") {
  const BadFolder folder;
  const std::string scene = folder.path("good.json");
  const auto with = [&](const std::string& key, const std::string& value) {
    SceneOptions options;
    options.overrides = {{key, value}};
    return folder.message_of(scene, options);
  };
  CHECK(with("renderer.radius", "-1") ==
        "-D renderer.radius=-1: /renderer/radius: expected a positive number from 1e-12 to 1e12, got -1");
  CHECK(with("renderer.raduis", "1") ==
        "-D renderer.raduis=1: /renderer/raduis: unknown key \"raduis\"; did you mean \"radius\"?");
  CHECK(with("objects.1.radius", "large") ==
        "-D objects.1.radius=large: /objects/1/radius: expected a positive number from 1e-12 to 1e12, got "
        "\"large\"");
  CHECK(with("objects.1.material.color", "{\"x\": 2}") ==
        "-D objects.1.material.color={\"x\": 2}: /objects/1/material/color/x: expected a number from 0 to 1, "
        "got 2");
  CHECK(with("objects.2.radius", "1") ==
        "-D objects.2.radius=1: expected an index below 2 into \"objects\", got \"2\"");
  CHECK(with("objects.first.radius", "1") ==
        "-D objects.first.radius=1: expected an index below 2 into \"objects\", got \"first\"");
  CHECK(with("width.x", "1") == "-D width.x=1: \"width\" is not an object: it can hold no \"x\"");
  CHECK(with("", "1") == "-D =1: expected keys joined by dots before '=', got \"\"");
  CHECK(with("renderer..radius", "1") ==
        "-D renderer..radius=1: expected keys joined by dots before '=', got \"renderer..radius\"");

  SceneOptions options;
  options.size = {0, 480};
  CHECK(folder.message_of(scene, options) ==
        "--size 0x480: expected a width and a height of at least 1, got 0x480");
  options.size = {1000000, 1000000};
  CHECK(folder.message_of(scene, options) ==
        "--size 1000000x1000000: expected at most 2^28 pixels, got 1000000x1000000");
}

TEST_CASE("the program prints each message and exits with 2") {
  if (!fs::exists(CAUSTICL_BINARY)) {
    WARN("skipped: there is no " << CAUSTICL_BINARY);
    return;
  }
  const BadFolder folder;
  for (const BadScene& bad : all_bad_scenes()) {
    INFO(bad.name);
    const Output output = run_program("render '" + folder.scene_of(bad) + "'");
    CHECK(without(output.errors, folder.path("")) == std::string("causticl: error: ") + bad.message + "\n");
    CHECK(output.status == 2);
  }
}

}  // namespace causticl
