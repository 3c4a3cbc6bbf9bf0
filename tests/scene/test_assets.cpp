// The shipped scenes' meshes and pictures: what glass needs, and that they stay small.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "catch2.hpp"
#include "mesh/mesh.hpp"

using namespace causticl;
namespace fs = std::filesystem;
using json = nlohmann::json;

namespace {

const fs::path scenes = fs::path(CAUSTICL_SOURCE_DIR) / "scenes";

json scene_json(const fs::path& file) {
  std::ifstream stream(file);
  return json::parse(stream, nullptr, true, true);
}

std::vector<fs::path> scene_files() {
  std::vector<fs::path> files;
  for (const fs::path& folder : {scenes, scenes / "effects"})
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

// As seen from scenes/: those in scenes/effects/ name their assets by "../assets/...".
std::string asset_of(const std::string& path) { return path.rfind("../", 0) == 0 ? path.substr(3) : path; }

// Calls use(path) for every "path" below `value` that names an asset.
template <typename Use>
void for_each_asset(const json& value, const Use& use) {
  if (value.is_object() && value.contains("path") && value["path"].is_string()) {
    const std::string path = asset_of(value["path"]);
    if (path.rfind("assets/", 0) == 0) use(path);
  }
  if (value.is_structured())
    for (const json& child : value) for_each_asset(child, use);
}

bool is_glass(const json& scene, const json& object) {
  if (object.contains("texture")) return object["texture"]["material"] == "refractive";
  json material = object.value("material", json());
  if (material.is_string()) material = scene["materials"][material.get<std::string>()];
  return material.is_object() && material.value("type", "") == "glass";
}

std::set<std::string> glass_meshes() {
  std::set<std::string> files;
  for (const fs::path& file : scene_files()) {
    const json scene = scene_json(file);
    for (const json& object : scene["objects"])
      if (object["type"] == "mesh" && is_glass(scene, object)) files.insert(asset_of(object["path"]));
  }
  return files;
}

using Vector = std::array<double, 3>;

Vector difference(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <typename A, typename B>
double dot(const A& a, const B& b) {
  return double(a[0]) * b[0] + double(a[1]) * b[1] + double(a[2]) * b[2];
}

// How many directed edges lack exactly one partner in the other direction; vertices at one place are one.
std::size_t open_edges(const Mesh& mesh) {
  std::map<std::array<double, 3>, std::size_t> places;
  const auto place = [&](std::uint32_t i) {
    return places.emplace(mesh.positions[i], places.size()).first->second;
  };
  std::map<std::pair<std::size_t, std::size_t>, int> edges;
  for (const auto& triangle : mesh.position_index)
    for (int c = 0; c < 3; ++c) ++edges[{place(triangle[c]), place(triangle[(c + 1) % 3])}];
  std::size_t open = 0;
  for (const auto& [edge, count] : edges) {
    const auto partner = edges.find({edge.second, edge.first});
    if (count != 1 || partner == edges.end() || partner->second != 1) ++open;
  }
  return open;
}

double signed_volume(const Mesh& mesh) {
  double volume = 0;
  for (const auto& t : mesh.position_index) {
    const auto &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    volume += dot(a, cross({b[0], b[1], b[2]}, {c[0], c[1], c[2]})) / 6;
  }
  return volume;
}

}  // namespace

TEST_CASE("every file that a shipped scene names is there, and every asset is used") {
  std::set<std::string> named;
  for (const fs::path& file : scene_files())
    for_each_asset(scene_json(file), [&](const std::string& path) {
      INFO(file << " names " << path);
      CHECK(fs::is_regular_file(scenes / path));
      named.insert(path);
    });
  REQUIRE(named.size() > 10);
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::directory_iterator(scenes / "assets")) {
    INFO(entry.path());
    CHECK(named.count("assets/" + entry.path().filename().string()) == 1);
    bytes += entry.file_size();
  }
  CHECK(bytes < 5'000'000);
}

TEST_CASE("glass meshes are closed and wound outward") {
  REQUIRE(glass_meshes().size() >= 3);
  for (const std::string& file : glass_meshes()) {
    INFO(file);
    const Mesh mesh = read_mesh(scenes / file);
    CHECK(open_edges(mesh) == 0);
    CHECK(signed_volume(mesh) > 0);
  }
}

TEST_CASE("meshes have unit normals on the side of their triangles") {
  for (const auto& entry : fs::directory_iterator(scenes / "assets")) {
    const fs::path& file = entry.path();
    if (file.extension() != ".ply" && file.extension() != ".obj") continue;
    INFO(file);
    const Mesh mesh = read_mesh(file);
    REQUIRE(mesh.triangles() > 0);
    std::size_t missing = 0, not_unit = 0, turned_away = 0, degenerate = 0;
    for (std::size_t t = 0; t < mesh.triangles(); ++t) {
      const auto& p = mesh.position_index[t];
      Vector normal = cross(difference(mesh.positions[p[1]], mesh.positions[p[0]]),
                            difference(mesh.positions[p[2]], mesh.positions[p[0]]));
      const double length = std::sqrt(dot(normal, normal));
      if (length == 0) {
        ++degenerate;
        continue;
      }
      for (int c = 0; c < 3; ++c) {
        const std::uint32_t i = mesh.normal_index[t][c];
        if (i == no_index) {
          ++missing;
          continue;
        }
        const auto& n = mesh.normals[i];
        if (std::abs(dot(n, n) - 1) > 1e-3) ++not_unit;
        if (dot(n, normal) / length < 0.1) ++turned_away;
      }
    }
    CHECK(missing == 0);
    CHECK(not_unit == 0);
    CHECK(degenerate == 0);
    // A few may remain in creases that are finer than the mesh.
    CHECK(turned_away * 5000 <= 3 * mesh.triangles());
  }
}
