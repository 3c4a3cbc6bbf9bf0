// A render in pieces has the bits of the render in one: resumed, of ranges of passes, of crops.
#include <algorithm>

#include "film_fixture.hpp"
#include "vector_inputs.hpp"

using namespace causticl;
using Catch::Contains;

namespace {

Scene small(const std::string& name, Integrator integrator = Integrator::sppm) {
  Scene scene = shipped_scene(name, 26, 19);
  scene.renderer.integrator = integrator;
  scene.renderer.photons = 3000;
  return scene;
}

/// Passes of such a scene can be rendered apart.
Scene without_history(Scene scene) {
  scene.renderer.schedule = Schedule::global;
  scene.renderer.boundary_correction = false;
  return scene;
}

/// Stops after each of these numbers of passes and goes on from the film.
void check_resumed(Scene scene, RenderOptions options, const std::vector<int>& stops,
                   std::size_t devices = 1) {
  FilmFixture fixture(std::move(scene), std::move(options));
  const int passes = 9;
  const RenderResult whole = fixture.render("whole", passes);
  CHECK(mean_luminance(whole.picture) > 0);
  for (const int stop : stops) {
    CAPTURE(stop, devices);
    fixture.render("part", stop, "", devices);
    const RenderResult resumed = fixture.render("part", passes, "part", devices);
    check_same_film(read_film(fixture.file("part")), read_film(fixture.file("whole")));
    CHECK(resumed.picture.rgb == whole.picture.rgb);
    CHECK(resumed.statistics.passes == 9);
    CHECK(resumed.statistics.photons == whole.statistics.photons);
    // Nothing to do is nothing lost.
    fixture.render("part", passes, "part", devices);
    check_same_film(read_film(fixture.file("part")), read_film(fixture.file("whole")));
    if (devices == 1) CHECK(resumed.statistics.rays == whole.statistics.rays);
    CHECK(resumed.statistics.error->error == whole.statistics.error->error);
  }
}

void check_ranges(Scene scene, RenderOptions options, std::vector<PassRange> ranges) {
  FilmFixture fixture(std::move(scene), std::move(options));
  fixture.render("whole", 11);
  std::vector<std::string> names;
  for (const PassRange& range : ranges) {
    names.push_back(text_of(range));
    fixture.render_range(names.back(), range);
  }
  RandomInputs random(301);
  for (int order = 0; order < 3; ++order) {
    std::shuffle(names.begin(), names.end(), random.engine);
    fixture.merge("merged", names);
    CAPTURE(names, random.seed);
    check_same_film(read_film(fixture.file("merged")), read_film(fixture.file("whole")));
  }
}

/// The crops fill the picture of 26 x 19.
void check_crops(Scene scene, RenderOptions options, const std::vector<PixelRect>& crops) {
  TemporaryFolder folder;
  options.outputs = {folder.path("picture.exr")};  // so that pictures have channels
  FilmFixture fixture(std::move(scene), std::move(options));
  const RenderResult whole = fixture.render("whole", 5);
  std::vector<std::string> names;
  for (const PixelRect& crop : crops) {
    names.push_back(text_of(crop));
    const RenderResult part = fixture.render_crop(names.back(), 5, crop);
    CAPTURE(text_of(crop));
    REQUIRE(part.picture.width == crop.width());
    REQUIRE(part.picture.height == crop.height());
    REQUIRE(part.picture.channels.size() == whole.picture.channels.size());
    std::size_t wrong = 0;
    for (int y = crop.y0; y < crop.y1; ++y)
      for (int x = crop.x0; x < crop.x1; ++x) {
        const std::size_t of_whole = static_cast<std::size_t>(y) * 26 + x;
        const std::size_t of_part = static_cast<std::size_t>(y - crop.y0) * crop.width() + (x - crop.x0);
        for (std::size_t c = 0; c < 3; ++c)
          wrong += part.picture.rgb[3 * of_part + c] != whole.picture.rgb[3 * of_whole + c];
        // The errors of its pixels among them, also next to its edges.
        for (std::size_t k = 0; k < part.picture.channels.size(); ++k)
          wrong += part.picture.channels[k].values[of_part] != whole.picture.channels[k].values[of_whole];
      }
    CHECK(wrong == 0);
  }
  fixture.merge("merged", names);
  check_same_film(read_film(fixture.file("merged")), read_film(fixture.file("whole")));
  if (crops.size() > 1) {
    // What was merged goes on as the whole would.
    const RenderResult more = fixture.render("more", 7, "merged");
    CHECK(more.picture.rgb == fixture.render("all", 7).picture.rgb);
  }
}

const std::vector<PixelRect> halves{{0, 0, 26, 8}, {0, 8, 26, 19}};
const std::vector<PixelRect> six{{0, 0, 9, 10},  {9, 0, 10, 10},  {10, 0, 26, 10},
                                 {0, 10, 9, 19}, {9, 10, 20, 19}, {20, 10, 26, 19}};

}  // namespace

TEST_CASE("a resumed render has the bits of one run: radii of each pixel's own, with layers") {
  RenderOptions options;
  options.layers = true;
  check_resumed(small("glass_caustic.json"), options, {1, 4, 8});
}

TEST_CASE("a resumed render has the bits of one run: one radius, direct light by photons") {
  Scene scene = small("cornell_box.json");
  scene.renderer.schedule = Schedule::geometric;
  scene.renderer.direct_light = DirectLight::photons;
  check_resumed(scene, {}, {2, 7});
}

TEST_CASE("a resumed render has the bits of one run: Metropolis photons, a light in the next room") {
  Scene scene = small("effects/next_room.json");
  scene.renderer.guided_photons = true;
  check_resumed(scene, {}, {1, 2, 5});
}

TEST_CASE("a resumed render has the bits of one run: photons by the projection map, things that move") {
  check_resumed(small("effects/prism.json"), {}, {3});
  check_resumed(small("effects/moving_balls.json"), {}, {3});
}

TEST_CASE("a resumed render has the bits of one run: path tracing, with layers and in double") {
  RenderOptions options;
  options.layers = true;
  check_resumed(small("cornell_box.json", Integrator::pt), options, {1, 6});
  if (!test_device().info().fp64) return;
  options.precision = Precision::float64;
  check_resumed(small("cornell_box.json"), options, {5});
}

TEST_CASE("a resumed render has the bits of one run: on several devices") {
  check_resumed(small("cornell_box.json"), {}, {2, 5}, 2);
}

TEST_CASE("ranges of passes in any order add up to the bits of one run") {
  const std::vector<PassRange> ranges{{0, 1}, {1, 2}, {2, 7}, {7, 8}, {8, 11}};
  RenderOptions options;
  options.layers = true;
  check_ranges(without_history(small("glass_caustic.json")), options, ranges);
  Scene geometric = without_history(small("effects/prism.json"));
  geometric.renderer.schedule = Schedule::geometric;
  check_ranges(geometric, {}, ranges);
  check_ranges(without_history(small("effects/moving_balls.json")), {}, {{0, 4}, {4, 11}});
  check_ranges(small("cornell_box.json", Integrator::pt), options, ranges);
}

TEST_CASE("crops have the bits of the picture's part, and fit together: radii of each pixel's own") {
  check_crops(small("glass_caustic.json"), {}, halves);
  RenderOptions options;
  options.layers = true;
  check_crops(small("cornell_box.json"), options, six);
}

TEST_CASE("crops have the bits of the picture's part, and fit together: path tracing, a medium, one pixel") {
  check_crops(small("cornell_box.json", Integrator::pt), {}, six);
  Scene fog = small("effects/fog.json");
  fog.renderer.boundary_correction = true;
  check_crops(fog, {}, halves);
  Scene clay = small("effects/clay.json");
  check_crops(clay, {}, {{0, 0, 25, 19}, {25, 0, 26, 18}, {25, 18, 26, 19}});
}

TEST_CASE("what cannot be put together is refused, with the option that helps") {
  FilmFixture fixture(small("cornell_box.json"));
  CHECK_THROWS_WITH(fixture.render_range("late", {3, 5}),
                    Contains("--pass-range 4:5") && Contains("renderer.schedule=global"));
  fixture.scene.renderer.schedule = Schedule::global;
  CHECK_THROWS_WITH(fixture.render_range("late", {3, 5}), Contains("renderer.boundary_correction=false"));
  fixture.scene.renderer.boundary_correction = false;
  fixture.scene.renderer.guided_photons = true;
  CHECK_THROWS_WITH(fixture.render_range("late", {3, 5}), Contains("renderer.guided_photons=false"));
  CHECK_THROWS_WITH(fixture.render_crop("part", 3, {0, 0, 5, 5}),
                    Contains("--crop 0,0,5,5") && Contains("renderer.guided_photons=false"));
  fixture.scene.renderer.guided_photons = false;
  fixture.render_range("late", {3, 5});
  fixture.render_range("early", {0, 2});
  fixture.render_range("next", {2, 3});
  CHECK_THROWS_WITH(fixture.merge("whole", {"late", "early"}), Contains("the passes 3:3 are missing"));
  CHECK_THROWS_WITH(fixture.merge("whole", {"late", "early", "late"}),
                    Contains("late.film: holds the passes 4:5, and ") && Contains("late.film holds 4:5"));
  fixture.merge("end", {"late", "next"});
  CHECK(text_of(read_film(fixture.file("end")).passes) == "3:5");
  CHECK_THROWS_WITH(fixture.render("more", 9, "end"), Contains("holds the passes 3:5 alone"));

  fixture.render_crop("left", 2, {0, 0, 9, 19});
  fixture.render_crop("top", 2, {9, 0, 26, 5});
  fixture.render_crop("over", 2, {8, 0, 26, 19});
  fixture.render_crop("longer", 3, {9, 0, 26, 19});
  CHECK_THROWS_WITH(fixture.merge("whole", {"left", "top"}), Contains("the pixel 9,5 is missing"));
  CHECK_THROWS_WITH(
      fixture.merge("whole", {"left", "over"}),
      Contains("over.film: its pixels 8,0,26,19 overlap those of ") && Contains("left.film, 0,0,9,19"));
  CHECK_THROWS_WITH(
      fixture.merge("whole", {"left", "longer"}),
      Contains("longer.film: its pixels have the passes 1:3, those of ") && Contains("left.film have 1:2"));
  CHECK_THROWS_WITH(fixture.render("more", 4, "left"), Contains("holds the pixels 0,0,9,19"));

  fixture.options.film.identity = {{"scene", "another"}};
  CHECK_THROWS_WITH(fixture.render("more", 4, "early"),
                    Contains("scene: of a test in the film, another in this command"));
  FilmMerger merger;
  merger.add(fixture.file("early"));
  FilmState foreign = read_film(fixture.file("next"));
  foreign.identity = {{"scene", "of a test"}, {"seed", "2"}};
  write_film(fixture.file("foreign"), foreign);
  CHECK_THROWS_WITH(merger.add(fixture.file("foreign")), Contains("seed: 2 in it, none in "));
}

TEST_CASE("resumed at twenty random passes, merged of up to 64 parts, of up to sixteen crops", "[long]") {
  RandomInputs random(302);
  for (const Integrator integrator : {Integrator::sppm, Integrator::pt}) {
    FilmFixture fixture(small("glass_caustic.json", integrator));
    fixture.render("whole", 200);
    for (int n = 0; n < 20; ++n) {
      const int stop = 1 + static_cast<int>(random.engine() % 199);
      CAPTURE(stop, random.seed);
      fixture.render("part", stop);
      fixture.render("part", 200, "part");
      check_same_film(read_film(fixture.file("part")), read_film(fixture.file("whole")));
    }
    fixture.scene = without_history(fixture.scene);
    fixture.render("whole", 64);
    for (const std::uint64_t count : {1u, 2u, 7u, 64u}) {
      std::vector<std::string> names;
      for (std::uint64_t k = 0; k < count; ++k) {
        const PassRange range{64 * k / count, 64 * (k + 1) / count};
        names.push_back(text_of(range));
        fixture.render_range(names.back(), range);
      }
      std::shuffle(names.begin(), names.end(), random.engine);
      CAPTURE(names, random.seed);
      fixture.merge("merged", names);
      check_same_film(read_film(fixture.file("merged")), read_film(fixture.file("whole")));
    }
    // Columns and rows of random widths.
    for (const int side : {2, 3, 4}) {
      std::vector<int> columns{0, 26}, rows{0, 19};
      const auto cut = [&](std::vector<int>& edges, int size) {
        while (static_cast<int>(edges.size()) <= side)
          if (const int edge = 1 + static_cast<int>(random.engine() % static_cast<unsigned>(size - 1));
              std::find(edges.begin(), edges.end(), edge) == edges.end())
            edges.push_back(edge);
        std::sort(edges.begin(), edges.end());
      };
      cut(columns, 26);
      cut(rows, 19);
      std::vector<PixelRect> crops;
      for (std::size_t j = 0; j + 1 < rows.size(); ++j)
        for (std::size_t i = 0; i + 1 < columns.size(); ++i)
          crops.push_back({columns[i], rows[j], columns[i + 1], rows[j + 1]});
      std::shuffle(crops.begin(), crops.end(), random.engine);
      CAPTURE(columns, rows, random.seed);
      check_crops(small("glass_caustic.json", integrator), {}, crops);
    }
  }
}
