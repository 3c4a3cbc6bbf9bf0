// What the JSON Schema says of scenes that ship, that documents show, that are good and that are bad.
#include <filesystem>
#include <fstream>
#include <map>

#include "catch2.hpp"
#include "cli/bad_scenes.hpp"
#include "scene_folder.hpp"
#include "schema_examples.hpp"

namespace causticl {
namespace {

namespace fs = std::filesystem;
const fs::path root = CAUSTICL_SOURCE_DIR;

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  REQUIRE(in);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// What JSON Schema cannot refuse, by names in tests/cli/bad_*.hpp.
const std::map<std::string, std::string>& beyond_schema() {
  const char* const several = "what several values have to do with each other";
  const char* const name = "whether a material has that name";
  static const std::map<std::string, std::string> names{
      {"duplicate key", "a parser keeps one of them"},
      {"duplicate material", "a parser keeps one of them"},
      {"missing material", name},
      {"no table of materials", name},
      {"too many pixels", several},
      {"too many visible points", several},
      {"target at position", several},
      {"rectangle light whose up is its normal", several},
      {"up along the view", several},
      {"default up along the view", several},
      {"up of length 0", "the length of a vector"},
      {"direct of length 0", "the length of a vector"},
      {"direct along x", "the direction of a vector"},
      {"directional light without direction", "the length of a vector"},
      {"shutter that closes first", several},
      {"aperture without focus", several},
      {"scales that multiply to too much", several},
      {"ellipsoid", several},
      {"curve across the axis", several},
      {"negative end of a curve", several},
      {"curve on the axis", several},
      {"curve of one place", several},
      {"infinite light in sppm", several},
      {"medium under a sky", several},
      {"spot at its target", several},
      {"two environments", several},
      {"mesh name with a NUL", "that a character makes no path"},
  };
  return names;
}

/// The scene of a row; empty where it is no JSON.
Json parse_bad(const BadScene& bad) {
  std::string text = bad.to;
  if (bad.from == std::string("FILE")) {
    text = text_of(root / "tests/cli/bad" / bad.to);
  } else if (*bad.from) {
    text = good_scene;
    text.replace(text.find(bad.from), std::string(bad.from).size(), bad.to);
  }
  return Json::parse(text, nullptr, false, true);
}

/// The scene names a file that is not there, or that holds something else.
bool is_fault_of_file(const BadScene& bad) {
  const std::string message = bad.message;
  const auto path = message.find("/path: ");
  return path != message.npos && message.find("/path: expected the path") == message.npos &&
         message.find("/path: expected a string") == message.npos;
}

/// Values that are written in more than one way, each where it stands in a scene.
const TableExample good_values[] = {
    {"/$schema", R"("../docs/scene.schema.json")"},
    {"/width", "1e2"},
    {"/height", "48.0"},
    {"/stack_size", "267386880"},
    {"/lights", "[]"},
    {"/materials", "{}"},
    {"/medium", R"({"absorption": 0.1, "scattering": {"x": 1, "y": 0, "z": 0}, "g": -0.5})"},
    {"/renderer", "{}"},
    {"/renderer", R"({"type": "Photon-Mapping", "rounds": 2, "radius_decay": 1})"},
    {"/renderer", R"({"type": "path tracing", "samples": 4})"},
    {"/renderer", R"({"type": "PT", "sample": 4, "guided_photons": false, "aimed_photons": true})"},
    {"/renderer", R"({"passes": 1e3, "photons": 10, "visible_points": 1, "radius": 1e-12})"},
    {"/camera/up", R"({"x": 0, "y": 1, "z": 0.5})"},
    {"/camera/shutter", "[0, 0]"},
    {"/objects/0/material", R"("white")"},
    {"/objects/0/material", R"({"type": "glass", "cauchy": [1.5, 0.004], "priority": -3, "roughness": 0})"},
    {"/objects/0/material", R"({"type": "plastic", "color": 1, "ior": 1.4, "emission": [0, 0, 1e12]})"},
    {"/objects/0/material", R"({"type": "mirror", "color": {"x": 1, "y": 0.5, "z": 0}, "two_sided": true})"},
    {"/objects/0/material/color", R"({"type": "checker", "a": 0, "b": [1, 0, 1], "scale": -4})"},
    {"/objects/0/material/color", R"({"type": "image", "path": "5x4.png", "scale": [2, -1]})"},
    {"/objects/0/transform", "[]"},
    {"/objects/0/transform", R"([{"type": "scale", "factor": -2}, {"type": "shift", "z": 1}])"},
    {"/objects/0/transform", R"([{"type": "rotate", "axis": {"x": 1, "y": 1, "z": 1}, "degree": -720}])"},
    {"/objects/0/transform", R"([{"type": "rotateradian", "axis": "y", "radian": 0}])"},
    {"/objects/0",
     R"({"type": "mesh", "path": "smooth.obj", "smooth": false, "tree_type": "MyTree", "texture":
                      {"type": "raw", "color": 7, "emission": 1, "material": "refractive"}})"},
    {"/objects/0", R"({"type": "bezier_rotate", "point": [[1, 0], [-0.2, 1], [1, 2]], "material": "white"})"},
    {"/lights/0", R"({"type": "environment", "path": "5x4.png", "rotation": -1e6})"},
    {"/lights/0", R"({"type": "spot", "position": [0, 5, 0], "target": [0, 0, 0], "angle": 180, "blend": 1,
                      "intensity": {"x": 1, "y": 2, "z": 3}})"},
};

}  // namespace

TEST_CASE("the reader and the schema accept each way to write a value") {
  const SceneFolder folder;
  Json scenes = Json::array();
  for (const auto& [pointer, value] : good_values) {
    Json scene = example_scene();
    if (pointer.rfind("/objects/0/material/", 0) == 0)
      scene["objects"][0]["material"] = {{"type", "diffuse"}};
    if (pointer == "/materials") scene["objects"][0]["material"] = {{"type", "diffuse"}};
    scene[Json::json_pointer(pointer)] = parse_scene(value);
    scenes.push_back(scene);
    INFO(scene);
    CHECK(user_error_of([&] { folder.load(scene.dump()); }) == "");
  }
  const auto verdicts = schema_verdicts(scenes);
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    INFO(scenes[i]);
    CHECK(verdicts[i] == "ok");
  }
}

TEST_CASE("the schema accepts what the reader accepts of the scenes that fuzzers keep") {
  const SceneFolder folder;
  Json scenes = Json::array();
  for (const auto& entry : fs::directory_iterator(root / "tests/fuzz/corpus/scene")) {
    const std::string text = text_of(entry.path());
    if (user_error_of([&] { folder.load(text); }).empty()) scenes.push_back(parse_scene(text));
  }
  CHECK(scenes.size() >= 8);
  const auto verdicts = schema_verdicts(scenes);
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    INFO(scenes[i]);
    CHECK(verdicts[i] == "ok");
  }
}

TEST_CASE("the schema accepts every scene that ships") {
  Json scenes = Json::array();
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(root / "scenes")) {
    if (entry.path().extension() != ".json") continue;
    files.push_back(entry.path().string());
    scenes.push_back(parse_scene(text_of(entry.path())));
  }
  CHECK(files.size() >= 30);
  const auto verdicts = schema_verdicts(scenes);
  for (std::size_t i = 0; i < files.size(); ++i) {
    INFO(files[i]);
    CHECK(verdicts[i] == "ok");
  }
}

TEST_CASE("the schema refuses every bad scene but those that it cannot describe") {
  Json scenes = Json::array();
  std::vector<std::string> names;
  std::size_t beyond = 0;
  for (const BadScene& bad : all_bad_scenes()) {
    const Json scene = parse_bad(bad);
    if (scene.is_discarded()) continue;
    scenes.push_back(scene);
    names.push_back(is_fault_of_file(bad) ? "" : bad.name);
  }
  const auto verdicts = schema_verdicts(scenes);
  for (std::size_t i = 0; i < names.size(); ++i) {
    INFO(names[i] << ": " << scenes[i]);
    const bool accepted = names[i].empty() || beyond_schema().count(names[i]) > 0;
    CHECK((verdicts[i] == "ok") == accepted);
    beyond += beyond_schema().count(names[i]);
  }
  CHECK(beyond == beyond_schema().size());
  CHECK(names.size() > 100);
}

}  // namespace causticl
