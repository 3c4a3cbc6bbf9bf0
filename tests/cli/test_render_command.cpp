// `causticl render` as a user meets it: files, reproducible bytes, statistics, kernels.
#include <nlohmann/json.hpp>

#include "catch2.hpp"
#include "image/image.hpp"
#include "small_render.hpp"

using namespace causticl;
using Catch::Contains;
using Catch::EndsWith;

TEST_CASE("a render writes the file that the scene names") {
  const TemporaryFolder folder;
  const Finished run = run_causticl(small_render({"--passes", "1"}), folder.path(""));
  check_success(run);
  CHECK(run.output.empty());
  CHECK(names_in(folder.path("")) == Words{"cornell_box.png"});
  const Image image = read_image(folder.path("cornell_box.png"), false);
  CHECK(image.width == 16);
  CHECK(image.height == 12);
  CHECK_THAT(run.errors, Contains("causticl: wrote cornell_box.png: 1 pass in ") && EndsWith("(done)\n"));
}

TEST_CASE("a scene without a path names the file after itself") {
  const TemporaryFolder folder;
  auto scene = nlohmann::json::parse(bytes_of(cornell_box), nullptr, true, true);
  scene.erase("path");
  const std::string file = folder.write("my box.json", scene.dump());
  check_success(run_causticl(small_render({"--passes", "1"}, file), folder.path("")));
  CHECK(names_in(folder.path("")) == Words{"my box.json", "my box.png"});
}

TEST_CASE("several outputs hold one picture") {
  const TemporaryFolder folder;
  const Words words{"--passes", "2", "-o", "a.png", "--output", "b.exr", "-o", "c.pfm"};
  check_success(run_causticl(small_render(words), folder.path("")));
  CHECK(names_in(folder.path("")) == Words{"a.png", "b.exr", "c.pfm"});
  const Picture exr = read_picture(folder.path("b.exr")), pfm = read_picture(folder.path("c.pfm"));
  CHECK(exr.rgb == pfm.rgb);
  for (const std::string name : {"error.noise", "error.pooled_noise", "error.bias", "error.drawn",
                                 "sppm.radius", "sppm.photons", "sppm.N"})
    CHECK_THAT(bytes_of(folder.path("b.exr")), Contains(name));
  CHECK(*std::max_element(pfm.rgb.begin(), pfm.rgb.end()) > 0);
}

TEST_CASE("--layers adds three layers to EXR files and wants one") {
  const TemporaryFolder folder;
  for (const char* integrator : {"sppm", "pt"}) {
    const auto render = [&](const std::string& name, const Words& more) {
      const Words limit = integrator == std::string("pt") ? Words{"--samples", "2"} : Words{"--passes", "2"};
      const Words words = limit + Words{"--integrator", integrator, "-o", name} + more;
      check_success(run_causticl(small_render(words), folder.path("")));
      return bytes_of(folder.path(name));
    };
    const std::string with = render("a.exr", {"--layers", "-o", "a.png"}), without = render("b.exr", {});
    for (const std::string layer : {"direct", "caustic", "indirect"})
      for (const std::string color : {".R", ".G", ".B"}) {
        CHECK_THAT(with, Contains(layer + color));
        CHECK_THAT(without, !Contains(layer + color));
      }
    CHECK(read_picture(folder.path("a.exr")).rgb == read_picture(folder.path("b.exr")).rgb);
  }
  check_one_error(run_causticl(small_render({"--layers", "-o", "box.png"}), folder.path("")), 2,
                  "--layers: no output can hold them; expected one that ends in .exr, as in -o box.exr");
  CHECK_FALSE(fs::exists(folder.path("box.png")));
}

TEST_CASE("the same seed gives the same bytes and another seed other ones") {
  const TemporaryFolder folder;
  for (const char* integrator : {"sppm", "pt"}) {
    const auto render = [&](const std::string& name, const Words& more) {
      const Words limit = integrator == std::string("pt") ? Words{"--samples", "2"} : Words{"--passes", "2"};
      const Words words = small_render(limit + Words{"--integrator", integrator, "-o", name} + more);
      check_success(run_causticl(words, folder.path("")));
      return bytes_of(folder.path(name));
    };
    const std::string first = render("a.pfm", {});
    CHECK(first.size() > 16 * 12 * 12);
    CHECK(render("b.pfm", {"--seed", "1"}) == first);
    CHECK(render("c.pfm", {"--threads", "1"}) == first);
    CHECK(render("d.pfm", {"--seed", "2"}) != first);
  }
}

TEST_CASE("--stats-json is one object whose numbers agree with the options") {
  const TemporaryFolder folder;
  const Finished run =
      run_causticl(small_render({"--passes", "3", "--stats-json", "stats.json"}), folder.path(""));
  check_success(run);
  CHECK(run.output.empty());
  CHECK(names_in(folder.path("")) == Words{"cornell_box.png", "stats.json"});
  const auto stats = nlohmann::json::parse(bytes_of(folder.path("stats.json")));
  CHECK_FALSE(stats.at("device").get<std::string>().empty());
  CHECK(stats.at("precision") == "float");
  CHECK(stats.at("passes") == 3);
  CHECK(stats.at("photons") == 6000);
  CHECK(stats.at("stop") == "passes");
  CHECK(stats.at("rays") > 6000);
  CHECK(stats.at("photons_per_second") > 0);
  CHECK(stats.at("bytes_per_pixel") > 0);
  CHECK(stats.at("peak_memory_bytes") > 1 << 20);
  CHECK(stats.at("emitters") >= 1);
  const double seconds = stats.at("seconds");
  CHECK(seconds > 0);
  CHECK(seconds < run.seconds);
  for (const char* key : {"first_pass_seconds", "tree_build_seconds"}) {
    CHECK(stats.at(key) >= 0);
    CHECK(stats.at(key) <= seconds);
  }
  // A sum over programs, of which some drivers build several at a time.
  CHECK(stats.at("kernel_build_seconds") >= 0);
  CHECK(stats.at("kernel_build_seconds") <= seconds * static_cast<double>(stats.at("programs").size()));
  REQUIRE(stats.at("kernels").size() > 3);
  double milliseconds = 0;
  for (const auto& [kernel, time] : stats.at("kernels").items()) milliseconds += time.get<double>();
  CHECK(milliseconds > 0);
  CHECK(milliseconds < 1000 * seconds);
}

TEST_CASE("--stats prints a table to standard output, also when quiet") {
  const TemporaryFolder folder;
  const Finished run = run_causticl(small_render({"--passes", "1", "--stats", "--quiet"}), folder.path(""));
  check_success(run);
  CHECK(run.errors.empty());
  for (const char* word :
       {"device", "passes", "photons", "rays", "peak memory", "kernel", "launches", "share"})
    CHECK_THAT(run.output, Contains(word));
}

TEST_CASE("limits of the other integrator are said to have no effect") {
  const TemporaryFolder folder;
  const Finished run =
      run_causticl(small_render({"--integrator", "pt", "--samples", "3", "--passes", "5"}), folder.path(""));
  check_success(run);
  CHECK_THAT(run.errors,
             Contains("note: --passes has no effect: it belongs to sppm and this render uses pt"));
  CHECK_THAT(run.errors, Contains("note: --photons has no effect"));
  CHECK_THAT(run.errors, Contains("3 passes in "));
}

TEST_CASE("--kernel-dir reads the kernels from a folder and --dump-kernels writes them") {
  const TemporaryFolder folder;
  const std::string kernels = CAUSTICL_SOURCE_DIR "/cl", dump = folder.path("dump");
  check_success(run_causticl(small_render({"--passes", "1", "-o", "a.pfm"}), folder.path("")));
  check_success(run_causticl(
      small_render({"--passes", "1", "-o", "b.pfm", "--kernel-dir", kernels, "--dump-kernels", dump}),
      folder.path("")));
  CHECK(bytes_of(folder.path("a.pfm")) == bytes_of(folder.path("b.pfm")));
  REQUIRE(fs::is_directory(dump));
  CHECK(std::distance(fs::directory_iterator(dump), {}) >= 3);

  fs::create_directory(folder.path("empty"));
  check_one_error(run_causticl(small_render({"--quiet", "--kernel-dir", "empty"}), folder.path("")), 2,
                  "empty");
}

TEST_CASE("--effects compiles more and changes no byte, and refuses less than the scene calls for") {
  const TemporaryFolder folder;
  const auto render = [&](const std::string& effects, const std::string& name) {
    return run_causticl(
        small_render({"--passes", "1", "--effects", effects, "-o", name, "--dump-kernels", name + "_cl"}),
        folder.path(""));
  };
  const auto defined = [&](const std::string& name) {
    const std::string source = bytes_of(folder.path(name + "_cl/pass_photon.cl"));
    return source.substr(0, source.find('\n'));
  };
  check_success(render("auto", "auto.pfm"));
  check_success(render("triangles,shadow_rays,spheres,walls", "more.pfm"));
  CHECK(bytes_of(folder.path("more.pfm")) == bytes_of(folder.path("auto.pfm")));
  CHECK(defined("auto.pfm") == "#define EFFECTS 0x201u");
  CHECK(defined("more.pfm") == "#define EFFECTS 0x203u");
  check_one_error(render("triangles", "x.pfm"), 2,
                  "the scene calls for shadow_rays (/renderer/direct_light with the emitter /objects/");
  check_one_error(render("everything", "x.pfm"), 2,
                  "no effect is called 'everything'; expected auto, all, or a list of triangles, spheres,");
}
