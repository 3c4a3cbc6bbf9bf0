// What the JSON Schema says of scenes: python3-jsonschema judges.
#pragma once

#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "catch2.hpp"
#include "format/scene_schema.hpp"
#include "temporary_folder.hpp"

namespace causticl {

/// A scene as JSON without its comments.
inline nlohmann::ordered_json parse_scene(const std::string& text) {
  return nlohmann::ordered_json::parse(text, nullptr, true, true);
}

/// For each document "ok", or what is wrong with it. Of several Pythons the first that has the validator
/// runs.
inline std::vector<std::string> schema_verdicts(const nlohmann::ordered_json& documents) {
  const TemporaryFolder folder;
  const std::string command =
      "for python in python3 /usr/bin/python3; do $python -c 'import jsonschema' 2>/dev/null && exec $python "
      "'" CAUSTICL_SOURCE_DIR "/tests/scene/validate_scenes.py' '" +
      folder.write("schema.json", scene_schema()) + "' '" + folder.write("documents.json", documents.dump()) +
      "'; done; echo 'no jsonschema: install python3-jsonschema'";
  std::FILE* pipe = popen(("{ " + command + "; } 2>&1").c_str(), "r");
  REQUIRE(pipe);
  std::string output;
  char bytes[4096];
  while (const std::size_t count = std::fread(bytes, 1, sizeof bytes, pipe)) output.append(bytes, count);
  const int status = pclose(pipe);
  std::vector<std::string> verdicts;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) verdicts.push_back(line);
  INFO(output);
  REQUIRE(status == 0);
  REQUIRE(verdicts.size() == documents.size());
  return verdicts;
}

}  // namespace causticl
