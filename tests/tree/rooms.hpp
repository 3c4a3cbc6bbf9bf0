// The rooms of the tree and which way includes may go: see docs/architecture.md.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace causticl {

/// The rooms of host/, each with those that it may include beside itself and cl/shared.
inline const std::map<std::string, std::set<std::string>>& host_rooms() {
  static const std::map<std::string, std::set<std::string>> rooms = [] {
    std::map<std::string, std::set<std::string>> result{
        {"base", {}},
        {"image", {"base"}},
        {"mesh", {"base"}},
        {"scene", {"base", "image", "mesh"}},
        {"format", {"base", "image", "mesh", "scene"}},
        {"shapes", {"base", "image", "mesh", "scene", "format"}},
        {"accel", {"base"}},
        {"world", {"base", "accel", "scene"}},
        {"effects", {"base", "scene", "world"}},
        {"opencl", {"base", "accel", "effects"}},
        {"accuracy", {"base", "image"}}};
    const auto above = [&](const std::string& room, const std::string& highest, std::set<std::string> more) {
      more.insert(result.at(highest).begin(), result.at(highest).end());
      more.insert(highest);
      result[room] = more;
    };
    above("device_scene", "opencl", {"scene", "world"});
    above("photons", "device_scene", {});
    above("film", "opencl", {"accuracy", "image"});
    above("integrators", "photons", {"accuracy", "image", "film"});
    above("render", "integrators", {});
    above("selftest", "render", {});
    above("study", "render", {"format"});
    above("app", "study", {"mesh", "selftest"});
    return result;
  }();
  return rooms;
}

/// The rooms of cl/, from the lowest up. Each may include those before it.
inline const std::vector<std::string> kernel_rooms{"shared",    "core",    "sampling", "shapes", "traversal",
                                                   "materials", "media",   "film",     "scene",  "lights",
                                                   "paths",     "photons", "passes"};

/// What is wrong with an include of `included` in the file `file` of `tree` ("host", "cl"), a path from
/// there; nothing where the rooms allow it.
inline std::optional<std::string> fault_of_include(const std::string& tree, const std::string& file,
                                                   const std::string& included) {
  const auto room_of = [](const std::string& path) { return path.substr(0, path.find('/')); };
  const std::string room = room_of(file), other = room_of(included);
  if (included.find('/') == std::string::npos) return "an include names its room, as in \"base/error.hpp\"";
  if (room == other ||
      (tree == "host" && (other == "shared" || file == "main.cpp" || included.ends_with(".cl"))))
    return {};
  if (tree == "host") {
    const auto& rooms = host_rooms();
    if (!rooms.count(room)) return "no room of host/ is called " + room;
    if (!rooms.at(room).count(other)) return "host/" + room + " may not include host/" + other;
    return {};
  }
  const auto place = [](const std::string& name) {
    return std::find(kernel_rooms.begin(), kernel_rooms.end(), name) - kernel_rooms.begin();
  };
  if (place(room) == std::ssize(kernel_rooms)) return "no room of cl/ is called " + room;
  if (place(other) > place(room))
    return "cl/" + room + " may not include cl/" + other + ", which lies above it";
  return {};
}

}  // namespace causticl
