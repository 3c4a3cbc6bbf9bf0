// What tells one study from another: every byte of what it was measured of, and every option that decides it.
#include <filesystem>
#include <set>

#include "base/folder_lock.hpp"
#include "catch2.hpp"
#include "format/load_scene.hpp"
#include "study/study_inputs.hpp"
#include "temporary_folder.hpp"

using namespace causticl;
namespace fs = std::filesystem;

TEST_CASE("fingerprints tell bytes, their order and where a part ends") {
  CHECK(content_hash("a") != content_hash("b"));
  CHECK(content_hash("b", "a") != content_hash("a", "b"));
  CHECK(content_hash("bc", "a") != content_hash("c", "ab"));
  CHECK(content_hash(std::string("a\0b", 3)) != content_hash(std::string("a\0c", 3)));
  CHECK(content_hash("a") == content_hash("a"));
  CHECK(content_hash("").size() == 32);
}

TEST_CASE("every byte of a scene and of the files that it names counts") {
  const TemporaryFolder folder;
  const std::string png = "5x4.png";
  fs::copy(std::string(CAUSTICL_SOURCE_DIR) + "/tests/cli/bad/intact.png", folder.path(png));
  std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\n# end\n";
  folder.write("m.obj", mesh);
  folder.write("e.pfm", "PF\n1 1\n-1.0\n" + std::string(12, '\0'));
  std::string text = R"({"camera": {"position": [0, 0, 5], "target": [0, 0, 0], "fov": 40}, // a comment
    "lights": [{"type": "environment", "path": "e.pfm"}],
    "objects": [{"type": "mesh", "path": "m.obj", "material": {"type": "diffuse", "color": {"type": "image", "path": "5x4.png"}}}]})";
  const std::string scene = folder.write("scene.json", text);
  const auto hash_now = [&] { return scene_hash_of(load_scene(scene)); };
  const std::string before = hash_now();
  CHECK(load_scene(scene).assets.size() == 3);
  CHECK(hash_now() == before);

  // A comment of the mesh, a place in its texture, a byte after the end of the image, a texel of the sky, a
  // blank.
  std::set<std::string> all{before};
  for (const auto& [from, to] :
       {std::pair{"# end", "# enf"}, {"vt 0 0", "vt 0 1"}, {"vn 0 0 1", "vn 0 0 2"}}) {
    std::string changed = mesh;
    changed.replace(changed.find(from), std::string(from).size(), to);
    folder.write("m.obj", changed);
    all.insert(hash_now());
  }
  folder.write("m.obj", mesh);
  std::ofstream(folder.path(png), std::ios::binary | std::ios::app) << "x";
  all.insert(hash_now());
  folder.write("e.pfm", "PF\n1 1\n-1.0\n" + std::string(11, '\0') + "\x3f");
  all.insert(hash_now());
  folder.write("scene.json", text + " ");
  all.insert(hash_now());
  CHECK(all.size() == 7);
}

TEST_CASE("every option that decides what is rendered counts") {
  StudyRequest options;
  options.study.parameters = {"alpha", "radius"};
  std::set<std::vector<std::string>> all{deciding_options(options)};
  const auto with = [&](auto change) {
    StudyRequest other = options;
    change(other);
    all.insert(deciding_options(other));
  };
  with([](StudyRequest& o) { o.study.parameters = {"alpha"}; });
  with([](StudyRequest& o) { o.study.parameters = {}; });
  with([](StudyRequest& o) { o.study.seeds = 5; });
  with([](StudyRequest& o) { o.scene_options.integrator = Integrator::pt; });
  with([](StudyRequest& o) { o.scene_options.integrator = Integrator::sppm; });
  const TemporaryFolder kernels;
  kernels.write("a.cl", "one");
  with([&](StudyRequest& o) { o.render.kernel_dir = kernels.path(""); });
  kernels.write("a.cl", "two");
  with([&](StudyRequest& o) { o.render.kernel_dir = kernels.path(""); });
  CHECK(all.size() == 8);
  // Their order, and what is printed or for how long, decides nothing.
  with([](StudyRequest& o) { o.study.parameters = {"radius", "alpha"}; });
  with([](StudyRequest& o) { o.study.budget = 1; });
  with([](StudyRequest& o) { o.study.restart = true; });
  CHECK(all.size() == 8);
}

TEST_CASE("a folder has one lock, which goes with its holder") {
  const TemporaryFolder folder;
  FolderLock second;
  {
    FolderLock first;
    CHECK(first.lock(folder.path("")));
    FolderLock other;
    CHECK_FALSE(other.lock(folder.path("")));
  }
  CHECK(second.lock(folder.path("")));
  CHECK(fs::is_empty(folder.path("")));
}
