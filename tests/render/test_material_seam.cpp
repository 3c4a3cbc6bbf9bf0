// A material that is added as docs/architecture.md says, by a file and its row, works in every driver.
#include <fstream>

#include "catch2.hpp"
#include "device_fixture.hpp"
#include "render_fixture.hpp"
#include "temporary_folder.hpp"

using namespace causticl;

namespace {

std::string read_text(const std::string& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

void replace_in(const std::string& file, const std::string& from, const std::string& to) {
  std::string text = read_text(file);
  const auto at = text.find(from);
  INFO(file << ": " << from);
  REQUIRE(at != std::string::npos);
  std::ofstream(file) << text.replace(at, from.size(), to);
}

/// A copy of cl/ with the material DUMMY, which is `code` and takes the place of what scenes call `taken`:
/// their number and effect are its own. `columns` of its row: family, layers, fields and properties.
void add_dummy(const TemporaryFolder& folder, const std::string& taken, const std::string& columns,
               const std::string& code) {
  namespace fs = std::filesystem;
  fs::copy(std::string(CAUSTICL_SOURCE_DIR) + "/cl", folder.path("cl"), fs::copy_options::recursive);
  std::ofstream(folder.path("cl/materials/dummy.cl"))
      << "#include \"materials/fresnel.cl\"\n#include \"materials/mirror.cl\"\n" + code;
  const std::string all = folder.path("cl/materials/all_materials.cl"),
                    table = folder.path("cl/shared/materials.h");
  replace_in(all, "#include", "#include \"materials/dummy.cl\"\n#include");
  const std::string text = read_text(table), row = "ROW(x, " + taken + ",";
  const auto digit = text.find_first_of("0123456789", text.find(row));
  REQUIRE(digit != std::string::npos);
  const std::string number(1, text[digit]);
  replace_in(table, text.substr(text.find(row), digit + 1 - text.find(row)), row + " 99");
  replace_in(table, "  " + row,
             "  ROW(x, DUMMY, " + number + ", dummy, EFFECT_" + taken + ", " + columns +
                 ", KEY_COLOR, \"dummy\") \\\n  " + row);
}

/// A lamp in a box, a ball of `material`, and `more` objects.
Scene room(const std::string& material, const std::string& more = "") {
  return scene_from_text(R"({"width": 20, "height": 15, "max_depth": 8,
    "camera": {"position": [0, 2, 6.5], "target": [0, 1.6, 0], "fov": 50},
    "renderer": {"type": "sppm", "photon_sample": 20000, "radius": 0.3},
    "objects": [
      {"type": "rectangle", "material": {"type": "diffuse", "color": [0.7, 0.6, 0.5]},
       "transform": [{"type": "scale", "x": 8, "y": 8, "z": 1}, {"type": "rotate", "axis": "x", "degree": -90}]},
      {"type": "rectangle", "material": {"type": "diffuse", "color": [0.5, 0.6, 0.7]},
       "transform": [{"type": "scale", "x": 8, "y": 8, "z": 1}, {"type": "shift", "x": 0, "y": 2, "z": -3}]},
      {"type": "sphere", "radius": 0.4, "material": {"type": "diffuse", "color": 0, "emission": [20, 18, 15]},
       "transform": [{"type": "shift", "x": 1, "y": 4, "z": 1}]},
      {"type": "sphere", "radius": 0.9, "material": )" +
                         material + R"(, "transform": [{"type": "shift", "x": 0, "y": 1, "z": 0}]})" + more +
                         "]}");
}

RenderResult render(const Scene& scene, Integrator integrator, int passes, RenderOptions options,
                    const std::string& kernel_dir) {
  Scene own = scene;
  own.renderer.integrator = integrator;
  own.renderer.passes = own.renderer.samples = passes;
  options.kernel_dir = kernel_dir;
  return render_scene(own, test_device(), options);
}

}  // namespace

TEST_CASE("a material of the family REFLECTS is its file and its row, in every driver") {
  const TemporaryFolder folder;
  add_dummy(folder, "MIRROR", "REFLECTS, ONE_LOBE, COMMON_FIELDS, 0u",
            "INLINE real3 dummy_tint(const Bsdf *bsdf, real cosine, bool refracts) {\n"
            "  return scaled3((real)0.5f, bsdf->color);\n}\n");
  const auto ball = [](const char* color) {
    return R"({"type": "mirror", "color": )" + std::string(color) + "}";
  };
  // With plastic in the scene photons are scattered one by one.
  const std::string scalar = R"(, {"type": "sphere", "radius": 0.4, "material": {"type": "plastic"},
    "transform": [{"type": "shift", "x": 1.6, "y": 0.4, "z": 1}]})";
  RenderOptions brute_force, tree, in_double;
  brute_force.photon_rays = PhotonRays::brute_force;
  tree.photon_rays = PhotonRays::tree;
  in_double.precision = Precision::float64;
  struct Driver {
    const char* name;
    Integrator integrator;
    RenderOptions options;
    std::string more;
  };
  std::vector<Driver> drivers{{"batches by brute force", Integrator::sppm, brute_force, ""},
                              {"batches through the tree", Integrator::sppm, tree, ""},
                              {"photons one by one", Integrator::sppm, {}, scalar},
                              {"path tracing", Integrator::pt, {}, ""}};
  if (test_device().info().fp64) drivers.push_back({"double precision", Integrator::sppm, in_double, ""});
  for (const auto& [name, integrator, options, more] : drivers) {
    INFO(name);
    const auto dummy = render(room(ball("0.8"), more), integrator, 2, options, folder.path("cl"));
    const auto half = render(room(ball("0.4"), more), integrator, 2, options, "");
    const auto mirror = render(room(ball("0.8"), more), integrator, 2, options, "");
    CHECK(dummy.picture.rgb == half.picture.rgb);
    CHECK(dummy.picture.rgb != mirror.picture.rgb);
  }
}

TEST_CASE("a material of the family TRANSMITS is its file and its row") {
  const TemporaryFolder folder;
  // Air: everything goes on as it came. The picture is that of the scene without the ball.
  add_dummy(folder, "THIN_GLASS", "TRANSMITS, ONE_LOBE, COMMON_FIELDS, 0u", R"(
INLINE BsdfSample dummy_sample(const Bsdf *bsdf, const Surface *surface, real3 d, real3 n, real4 random, bool radiance) {
  BsdfSample sample = {d, bsdf->color, 0};
  return sample;
}
INLINE real dummy_reflectance(const Bsdf *bsdf, const Surface *surface, real3 d, real3 n) { return 0; }
INLINE real3 dummy_tint(const Bsdf *bsdf, real cosine, bool refracts) { return bsdf->color; }
INLINE SpecularWays dummy_ways(const Bsdf *bsdf, ShadingFrame f, real eta) {
  SpecularWays ways = mirror_ways(f);
  ways.mirrored_s = ways.mirrored_g = 0, ways.refracted_s = 0, ways.refracted_g = 1;
  ways.cosine_t_g = f.cosine_g;
  return ways;
}
)");
  const Scene with = room(R"({"type": "thin_glass"})");
  const Scene dark = room(R"({"type": "thin_glass", "color": 0.1})");
  Scene without = with;
  without.objects.pop_back();
  for (const Integrator integrator : {Integrator::sppm, Integrator::pt}) {
    INFO((integrator == Integrator::pt ? "pt" : "sppm"));
    const int passes = integrator == Integrator::pt ? 1024 : 96;
    const double seen = mean_luminance(render(with, integrator, passes, {}, folder.path("cl")).picture);
    const double exact = mean_luminance(render(without, integrator, passes, {}, "").picture);
    const double shaded = mean_luminance(render(dark, integrator, passes, {}, "").picture);
    CHECK(seen == Approx(exact).epsilon(0.01));
    CHECK(shaded < 0.985 * exact);  // so that the ball counts
  }
}

TEST_CASE("a material of the family SCATTERS is its file and its row") {
  const TemporaryFolder folder;
  add_dummy(folder, "OREN_NAYAR", "SCATTERS, ONE_LOBE, COMMON_FIELDS, STORES_PHOTONS",
            "INLINE real3 dummy_over_lambert(const Bsdf *bsdf, real3 wi, real3 wo, real3 n) {\n"
            "  return (real3)((real)0.25f, (real)0.125f, 0);\n}\n");
  const Scene with = room(R"({"type": "oren_nayar", "color": 0.8})");
  const Scene lambert = room(R"({"type": "diffuse", "color": [0.2, 0.1, 0]})");
  const Scene white = room(R"({"type": "diffuse", "color": 0.8})");
  for (const Integrator integrator : {Integrator::sppm, Integrator::pt}) {
    INFO((integrator == Integrator::pt ? "pt" : "sppm"));
    const int passes = integrator == Integrator::pt ? 1024 : 96;
    const double seen = mean_luminance(render(with, integrator, passes, {}, folder.path("cl")).picture);
    const double exact = mean_luminance(render(lambert, integrator, passes, {}, "").picture);
    CHECK(seen == Approx(exact).epsilon(0.005));
    CHECK(mean_luminance(render(white, integrator, passes, {}, "").picture) > 1.01 * exact);
  }
}
