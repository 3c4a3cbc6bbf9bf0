// Renders whose films are compared.
#pragma once

#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "catch2.hpp"
#include "device_fixture.hpp"
#include "film/film_file.hpp"
#include "film/merge_films.hpp"
#include "render_fixture.hpp"
#include "temporary_folder.hpp"

namespace causticl {

/// A scene that is rendered in pieces, into films of a folder of its own.
class FilmFixture {
 public:
  explicit FilmFixture(Scene of, RenderOptions with = {}) : scene(std::move(of)), options(std::move(with)) {
    options.film.identity = {{"scene", "of a test"}};
  }

  Scene scene;
  RenderOptions options;

  std::string file(const std::string& name) { return folder_.path(name + ".film"); }

  /// Passes up to `passes`, into the film NAME; goes on from the film FROM where there is one.
  RenderResult render(const std::string& name, int passes, const std::string& from = "",
                      std::size_t devices = 1) {
    RenderOptions own = options;
    own.film.file = file(name);
    if (!from.empty()) own.film.resume = file(from);
    return run(own, passes, devices);
  }
  RenderResult render_range(const std::string& name, PassRange range) {
    RenderOptions own = options;
    own.film.file = file(name);
    own.film.range = range;
    return run(own, 1, 1);
  }
  RenderResult render_crop(const std::string& name, int passes, const PixelRect& crop) {
    RenderOptions own = options;
    own.film.file = file(name);
    own.film.crop = crop;
    return run(own, passes, 1);
  }

  /// The films of these names put together as NAME.
  void merge(const std::string& name, const std::vector<std::string>& parts) {
    FilmMerger merger;
    for (const auto& part : parts) merger.add(file(part));
    write_film(file(name), merger.whole());
  }

 private:
  TemporaryFolder folder_;

  RenderResult run(const RenderOptions& own, int passes, std::size_t count) {
    scene.renderer.passes = scene.renderer.samples = passes;
    std::vector<std::unique_ptr<Device>> opened;
    std::vector<Device*> devices;
    for (std::size_t i = 0; i < count; ++i) {
      opened.push_back(std::make_unique<Device>(test_device().info()));
      devices.push_back(opened.back().get());
    }
    return render_scene(scene, devices, own);
  }
};

template <typename Record>
bool same_bytes(const std::vector<Record>& a, const std::vector<Record>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Record)) == 0);
}

/// Checks that two films hold the same to the bit, whatever runs have made them.
inline void check_same_film(const FilmState& a, const FilmState& b) {
  CHECK(a.passes == b.passes);
  CHECK(a.crop == b.crop);
  CHECK(a.photons == b.photons);
  CHECK(a.photons_stored == b.photons_stored);
  CHECK(same_bytes(a.pixels, b.pixels));
  CHECK(same_bytes(a.layers, b.layers));
  REQUIRE(a.state.size() == b.state.size());
  for (const auto& [name, bytes] : a.state) {
    INFO(name);
    REQUIRE(b.state.contains(name));
    CHECK(same_bytes(bytes, b.state.at(name)));
  }
}

}  // namespace causticl
