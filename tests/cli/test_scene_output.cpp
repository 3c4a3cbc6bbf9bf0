// Where the picture goes that a scene names, and what a scene may have read.
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include "catch2.hpp"

#include "format/asset_file.hpp"
#include "format/load_scene.hpp"
#include "format/scene_output.hpp"
#include "image/image.hpp"
#include "small_render.hpp"

using namespace causticl;
using Catch::Contains;

namespace {

/// A working directory of its own.
class WorkingFolder {
 public:
  WorkingFolder() : before_(fs::current_path()) { fs::current_path(folder.path("")); }
  ~WorkingFolder() { fs::current_path(before_); }

  const TemporaryFolder folder;

 private:
  const fs::path before_;
};

SceneOutput output_of(const std::string& path) {
  Scene scene;
  scene.file = "some/where/name.json";
  scene.output = path;
  return scene_output(scene);
}

std::string scene_with(const std::string& path, const std::string& object = "") {
  return R"({"path": ")" + path + R"(", "camera": {"position": [0, 0, 5], "target": [0, 0, 0], "fov": 40},
    "objects": [{"type": "sphere", "radius": 1, "material": {"type": "diffuse", "emission": 1}})" +
         object + "]}";
}

const Picture grey{4, 2, std::vector<float>(24, 0.5f)};

}  // namespace

TEST_CASE("a scene's picture stays below the working directory") {
  const WorkingFolder here;
  CHECK(output_of("").file == "name.png");
  for (const auto& [path, file] : std::vector<std::pair<std::string, std::string>>{
           {"a.png", "a.png"}, {"./result/x.png", "result/x.png"}, {"a/b/c.exr", "a/b/c.exr"}}) {
    CHECK(output_of(path).file == file);
    CHECK(output_of(path).notice.empty());
  }
  for (const char* path :
       {"/tmp/x.png", "../x.png", "a/../../x.png", "a/../x.png", "//x.png", "./../../etc/x.png"}) {
    CAPTURE(path);
    CHECK(output_of(path).file == "x.png");
    CHECK_THAT(output_of(path).notice,
               Contains("leads out of the working directory; the picture goes to x.png") && Contains("-o"));
  }
}

TEST_CASE("links do not lead a scene's picture out of the working directory") {
  const WorkingFolder here;
  const TemporaryFolder elsewhere;
  fs::create_directories("inside/deeper");
  fs::create_symlink(elsewhere.path(""), "out");
  fs::create_symlink("..", "inside/deeper/up");
  fs::create_symlink("../../..", "inside/deeper/far");
  fs::create_symlink("nowhere", "dangling");
  CHECK(output_of("out/x.png").file == "x.png");
  CHECK(output_of("out/new/x.png").file == "x.png");
  CHECK(output_of("inside/deeper/far/x.png").file == "x.png");
  CHECK(output_of("dangling/x.png").file == "x.png");
  CHECK(output_of("inside/deeper/up/x.png").file == "inside/deeper/up/x.png");

  fs::create_symlink(elsewhere.path("x.png"), "x.png");
  CHECK_THAT(user_error_of([] { prepare_scene_output("x.png"); }),
             Contains("x.png: is a link that leads out of the working directory") && Contains("-o x.png"));
  fs::create_symlink("inside/y.png", "y.png");
  CHECK_NOTHROW(prepare_scene_output("y.png"));
}

TEST_CASE("a scene's picture overwrites pictures alone, and its folder is made") {
  const WorkingFolder here;
  write_picture("a.png", grey, {});
  write_picture("b.exr", grey, {});
  write_picture("c.pfm", grey, {});
  here.folder.write("empty.png", "");
  fs::copy_file("c.pfm", "d.png");
  for (const char* name : {"a.png", "b.exr", "c.pfm", "empty.png", "d.png", "new.png"}) {
    CAPTURE(name);
    CHECK_NOTHROW(prepare_scene_output(name));
  }
  here.folder.write("notes.png", "my notes of ten years");
  CHECK_THAT(user_error_of([] { prepare_scene_output("notes.png"); }),
             Contains("notes.png: exists and is no picture"));
  mkfifo("pipe.png", 0600);
  CHECK_THAT(user_error_of([] { prepare_scene_output("pipe.png"); }), Contains("is no regular file"));
  prepare_scene_output("some/folders/x.png");
  CHECK(fs::is_directory("some/folders"));
}

TEST_CASE("a path with control characters, or none that names a file, is refused with its place") {
  const TemporaryFolder folder;
  for (const char* path :
       {"evil.sh\\u0000.png", "a\\n.png", "\\u001b[31m.png", "a\\u009b.png", "gnp.\\u202eexe.png"}) {
    CAPTURE(path);
    const std::string file = folder.write("scene.json", scene_with(path));
    const Finished run = run_causticl({"info", file}, folder.path(""), no_device);
    check_one_error(run, 2,
                    "scene.json:1: /path: expected the name of a picture without control characters, got ");
    CHECK_THAT(run.errors, !Contains("\033") && !Contains("\u202e") && !Contains("\u009b"));
  }
  for (const char* path : {"..", "folder/", "/", "."})
    CHECK_THAT(user_error_of([&] { load_scene(folder.write("scene.json", scene_with(path))); }),
               Contains("/path: expected the name of a picture, as in \"picture.png\", got "));
}

TEST_CASE("a render goes where the scene may, and anywhere that the user says") {
  const TemporaryFolder folder;
  fs::create_directory(folder.path("work"));
  const std::string scene = folder.write("scene.json", scene_with("../result/x.png"));
  const Words words{"--passes", "1"};
  const Finished run = run_causticl(small_render(words, scene, 500), folder.path("work"));
  check_success(run);
  CHECK_THAT(run.errors,
             Contains("note: /path: \"../result/x.png\" leads out of the working directory; the picture "
                      "goes to x.png in it (-o chooses another place)\n"));
  CHECK(names_in(folder.path("work")) == Words{"x.png"});
  const Finished elsewhere =
      run_causticl(small_render(words + Words{"-o", "../y.png"}, scene, 500), folder.path("work"));
  check_success(elsewhere);
  CHECK_THAT(elsewhere.errors, !Contains("leads out"));
  CHECK(fs::exists(folder.path("y.png")));

  const std::string below = folder.write("below.json", scene_with("./result/deep/x.png"));
  check_success(run_causticl(small_render(words, below, 500), folder.path("work")));
  CHECK(fs::exists(folder.path("work/result/deep/x.png")));

  folder.write("work/x.png", "no picture");
  check_one_error(run_causticl(small_render(words, scene, 500) + Words{"--quiet"}, folder.path("work")), 2,
                  "x.png: exists and is no picture");
  CHECK(bytes_of(folder.path("work/x.png")) == "no picture");
  check_success(run_causticl(small_render(words + Words{"-o", "x.png"}, scene, 500), folder.path("work")));
  CHECK(read_image(folder.path("work/x.png"), false).width == 16);
}

TEST_CASE("assets are regular files that are no work of the kernel, and nothing waits for them") {
  const TemporaryFolder folder;
  mkfifo(folder.path("pipe.obj").c_str(), 0600);
  const int socket_descriptor = socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  folder.path("socket.png").copy(address.sun_path, sizeof address.sun_path - 1);
  REQUIRE(bind(socket_descriptor, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0);
  fs::create_symlink("pipe.obj", folder.path("link.obj"));
  const std::vector<std::pair<std::string, std::string>> cases{
      {"pipe.obj", "that is a pipe"},
      {"link.obj", "that is a pipe"},
      {"socket.png", "that is a socket"},
      {"/dev/zero", "that is a device"},
      {"/dev/stdin", "that is a "},
      {"/proc/self/environ", "that is a file of the kernel"},
      {"/proc/version", "file of the kernel"},
      {"/sys/kernel/uevent_seqnum", "that is a file of the kernel"},
      {"/etc", "that is a directory"}};
  for (const auto& [path, fault] : cases) {
    if (!fs::exists(path[0] == '/' ? path : folder.path(path)) || (path == "/dev/stdin" && isatty(0) == 0))
      continue;
    CAPTURE(path);
    for (
        const std::string object :
        {R"({"type": "mesh", "material": {"type": "mirror"}, "path": "FILE"})",
         R"({"type": "sphere", "radius": 1, "material": {"type": "diffuse", "color": {"type": "image", "path": "FILE"}}})",
         R"({"type": "sphere", "radius": 1, "texture": {"type": "image", "path": "FILE", "material": "diffuse"}})"}) {
      std::string with = ", " + object;
      with.replace(with.find("FILE"), 4, path);
      const std::string scene = folder.write("scene.json", scene_with("a.png", with));
      CHECK_THAT(user_error_of([&] { load_scene(scene); }),
                 Contains("/path: expected a file, got ") && Contains(fault));
    }
  }
  close(socket_descriptor);
  CHECK(asset_fault(folder.write("plain", "bytes")).empty());
}
