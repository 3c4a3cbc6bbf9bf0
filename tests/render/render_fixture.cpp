#include "render_fixture.hpp"
#include "format/load_scene.hpp"

#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>

#include "catch2.hpp"
#include "device_fixture.hpp"
#include "image/luminance.hpp"

namespace causticl {

Scene scene_from_text(const std::string& json) {
  static std::atomic<int> number{0};
  const auto file = std::filesystem::temp_directory_path() / ("causticl_test_" + std::to_string(::getpid()) +
                                                              "_" + std::to_string(number++) + ".json");
  std::ofstream(file) << json;
  Scene scene = load_scene(file.string());
  std::filesystem::remove(file);
  return scene;
}

Scene shipped_scene(const std::string& name, int width, int height) {
  SceneOptions options;
  options.size = {width, height};
  return load_scene(std::string(CAUSTICL_SOURCE_DIR) + "/scenes/" + name, options);
}

RenderResult render_with(Scene scene, Integrator integrator, int passes, unsigned seed, Precision precision) {
  scene.renderer.integrator = integrator;
  scene.renderer.passes = scene.renderer.samples = passes;
  RenderOptions options;
  options.seed = seed;
  options.precision = precision;
  return render_scene(scene, test_device(), options);
}

void check_same_render(const RenderResult& a, const RenderResult& b) {
  CHECK(a.picture.rgb == b.picture.rgb);
  CHECK(a.statistics.rays == b.statistics.rays);
  for (const auto& kind : diagnostic_kinds)
    CHECK(a.statistics.diagnostics.*kind.count == b.statistics.diagnostics.*kind.count);
  CHECK(mean_luminance(a.picture) > 0);
}

Picture layer_of(const Picture& picture, const std::string& name) {
  Picture layer{picture.width, picture.height, std::vector<float>(picture.rgb.size())};
  int found = 0;
  for (const auto& channel : picture.channels)
    for (std::size_t c = 0; c < 3; ++c) {
      if (channel.name != name + "." + "RGB"[c]) continue;
      ++found;
      for (std::size_t i = 0; i < channel.values.size(); ++i) layer.rgb[3 * i + c] = channel.values[i];
    }
  REQUIRE(found == 3);
  return layer;
}

double mean_luminance(const Picture& picture) {
  double sum = 0;
  for (std::size_t i = 0; i + 2 < picture.rgb.size(); i += 3) sum += luminance(&picture.rgb[i]);
  return sum / (static_cast<double>(picture.width) * picture.height);
}

Vec3 mean_color(const Picture& picture) {
  Vec3 sum;
  for (std::size_t i = 0; i < picture.rgb.size(); ++i) sum[static_cast<int>(i % 3)] += picture.rgb[i];
  return sum / (static_cast<double>(picture.width) * picture.height);
}

Picture box_filtered(const Picture& picture, int box) {
  Picture out{picture.width / box, picture.height / box, {}};
  out.rgb.assign(3u * out.width * out.height, 0.0f);
  for (int y = 0; y < out.height * box; ++y)
    for (int x = 0; x < out.width * box; ++x)
      for (int c = 0; c < 3; ++c)
        out.rgb[3 * ((y / box) * out.width + x / box) + c] +=
            picture.rgb[3 * (y * picture.width + x) + c] / static_cast<float>(box * box);
  return out;
}

}  // namespace causticl
