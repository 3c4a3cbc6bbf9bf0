// Damaged scene files either load or are refused with one line: never a crash, another exception or a hang.
#include <filesystem>
#include <random>

#include "catch2.hpp"
#include "format/load_scene.hpp"
#include "scene/scene.hpp"
#include "temporary_folder.hpp"

namespace causticl {
namespace {

std::string read_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

const char* const fragments[] = {"{",     "}",       "[",         "]",        ",",          ":",
                                 "\"",    "//",      "null",      "true",     "-1",         "0",
                                 "1e999", "1e-300",  "0.5",       "\\u0000",  "\xff",       "\n",
                                 "\"x\"", "[0,0,0]", "{\"x\":1}", "\"type\"", "\"sphere\"", "9999999999"};

// One to four edits: a byte changed, a stretch removed, doubled or moved, a fragment put in, or the end cut
// off.
std::string mutated(std::string text, std::mt19937_64& engine) {
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(engine);
  };
  for (std::size_t edits = 1 + below(4); edits > 0 && !text.empty(); --edits) {
    const std::size_t at = below(text.size()), length = 1 + below(12);
    switch (below(6)) {
      case 0:
        text[at] = static_cast<char>(below(256));
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(at, length));
        break;
      case 3:
        text.insert(below(text.size()), text.substr(at, length));
        break;
      case 4:
        text.insert(at, fragments[below(std::size(fragments))]);
        break;
      default:
        if (below(8) == 0) text.resize(at);
        break;
    }
  }
  return text;
}

const char* const rich_scene = R"({
  "path": "out.png", "width": 64, "height": 48, "max_depth": 5, "Na": 1, "Ng": 1.5, "thread_num": 0,
  "renderer": {"type": "sppm", "rounds": 2, "radius": 1, "alpha": 0.7, "schedule": "global",
               "light_pos": {"x": 0, "y": 5, "z": 0}, "light_r": 1, "light_radiance": [1, 2, 3]},
  "camera": {"origin": [0, 1, 5], "direct": [0, 0, -1], "view_angle_scale": 0.5, "aperture": 0.1},
  "materials": {"glass": {"type": "glass", "ior": 1.33},
                "tiles": {"type": "diffuse", "color": {"type": "checker", "a": [0, 0, 0], "b": [1, 1, 1], "scale": [2, 2]}}},
  "objects": [
    {"type": "plane", "transform": [{"type": "rotate", "axis": "x", "degree": 90}], "material": "tiles"},
    {"type": "sphere", "radius": 2, "transform": [{"type": "scale", "x": 2, "y": 2, "z": 2}], "material": "glass"},
    {"type": "bezier_rotate", "point": [[0, 0], [3, 1], [1, 2]], "texture": {"type": "raw", "emission": [0, 0, 0],
     "color": [1, 0.5, 2], "material": "specular"}},
    {"type": "mesh", "path": "triangle.obj", "smooth": true, "material": {"type": "mirror"}},
    {"type": "box", "size": [1, 2, 3], "material": {"type": "diffuse", "emission": [1, 1, 1], "two_sided": true}}
  ]
})";

}  // namespace

TEST_CASE("thousands of damaged scenes load or are refused with one line") {
  const TemporaryFolder folder;
  folder.write("triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  std::mt19937_64 engine(20261122);
  int loaded = 0, refused = 0;
  for (int i = 0; i < 3000; ++i) {
    const std::string text = i == 0 ? rich_scene : mutated(rich_scene, engine);
    const std::string file = folder.write("scene.json", text);
    INFO("mutation " << i << ":\n" << text);
    try {
      load_scene(file);
      ++loaded;
    } catch (const UserError& error) {
      ++refused;
      const std::string message = error.what();
      REQUIRE(message.compare(0, file.size(), file) == 0);
      REQUIRE(message.find_first_of("\n\r") == message.npos);
    }
    if (i == 0) REQUIRE(loaded == 1);
  }
  CHECK(loaded > 100);
  CHECK(refused > 1000);
}

TEST_CASE("damaged meshes and images are refused with one line or load") {
  const TemporaryFolder folder;
  std::mt19937_64 engine(7);
  const std::string bad = std::string(CAUSTICL_SOURCE_DIR) + "/tests/cli/bad/";
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 1\nvn 0 0 1\nf 1/1/1 2/1/1 3//1 -1\n";
  const std::string ply = read_text(bad + "index_too_large.ply");
  const std::string image = read_text(bad + "intact.png");
  REQUIRE(!image.empty());
  for (int i = 0; i < 600; ++i) {
    INFO("mutation " << i);
    folder.write("a.obj", mutated(obj, engine));
    folder.write("a.ply", mutated(ply, engine));
    folder.write("a.png", mutated(image, engine));
    for (const std::string name : {"a.obj", "a.ply"})
      CHECK_NOTHROW(user_error_of([&] { read_mesh(folder.path(name)); }));
    CHECK_NOTHROW(user_error_of([&] { read_image(folder.path("a.png"), true); }));
  }
}

TEST_CASE("every shipped scene loads") {
  int count = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(CAUSTICL_SOURCE_DIR) + "/scenes")) {
    if (entry.path().extension() != ".json") continue;
    INFO(entry.path());
    CHECK_NOTHROW(load_scene(entry.path().string()));
    ++count;
  }
  CHECK(count >= 11);
}

}  // namespace causticl
