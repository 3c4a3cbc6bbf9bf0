// Statistics and scenes of examples, and what is printed of them.
#pragma once

#include <cstdio>
#include <memory>
#include <string>

#include "catch2.hpp"
#include "render/render.hpp"

namespace causticl {

/// All that `print` puts on a stream that is no terminal.
template <typename Print>
std::string printed(Print print) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::tmpfile(), std::fclose);
  REQUIRE(stream);
  print(stream.get());
  std::rewind(stream.get());
  std::string text;
  for (int c; (c = std::fgetc(stream.get())) != EOF;) text.push_back(static_cast<char>(c));
  return text;
}

inline Statistics example_statistics() {
  Statistics statistics;
  statistics.device = "Example device";
  statistics.passes = 7;
  statistics.photons = 700;
  statistics.seconds = 2.5;
  statistics.kernels["trace_photons"] = {30, 7};
  statistics.kernels["gather"] = {90, 14};
  return statistics;
}

inline Scene example_scene() {
  Scene scene;
  scene.file = "example.json";
  scene.width = 320;
  scene.height = 200;
  scene.camera.up = {0, 2, 0};
  scene.materials.resize(2);
  scene.materials[1].kind = MaterialSpec::Kind::glass;
  scene.materials[1].emission = {0, 3, 0};
  return scene;
}

}  // namespace causticl
