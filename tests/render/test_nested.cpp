// Dielectrics that touch, overlap or hold the camera or a lamp, by values that are known.
#include <cmath>

#include "catch2.hpp"
#include "render_fixture.hpp"
#include "scene/dielectrics.hpp"

using namespace causticl;

namespace {

const std::string sky = R"("lights": [{"type": "environment", "radiance": [1, 1, 1]}])";

std::string scene_text(const std::string& objects, const std::string& camera, const std::string& rest = sky) {
  return R"({"width": 8, "height": 8, "max_depth": 64, "renderer": {"type": "sppm", "photon_sample": 20000},
    "camera": {)" +
         camera + R"(}, "objects": [)" + objects + "], " + rest + "}";
}

std::string placed(const std::string& object, double x, double y, double z) {
  return "{" + object + R"(, "transform": [{"type": "shift", "x": )" + std::to_string(x) + R"(, "y": )" +
         std::to_string(y) + R"(, "z": )" + std::to_string(z) + "}]}";
}

std::string glass_box(double size, double ior, double x, double y, double z, const std::string& keys = "") {
  const std::string edge = std::to_string(size);
  return placed(R"("type": "box", "size": [)" + edge + ", " + edge + ", " + edge +
                    R"(], "material": {"type": "glass", "ior": )" + std::to_string(ior) + keys + "}",
                x, y, z);
}

std::string glass_sphere(double radius, double ior, double x, double y, double z,
                         const std::string& keys = "") {
  return placed(R"("type": "sphere", "radius": )" + std::to_string(radius) +
                    R"(, "material": {"type": "glass", "ior": )" + std::to_string(ior) + keys + "}",
                x, y, z);
}

const std::string along_z = R"("position": [0, 0, 5], "target": [0, 0, 0], "fov": 0.5)";
const std::string aslant = R"("position": [0.4, 1.2, 4], "target": [0, 0, 0], "fov": 30)";

Vec3 mean(const Picture& picture) {
  Vec3 sum;
  for (std::size_t i = 0; i < picture.rgb.size(); ++i) sum[static_cast<int>(i % 3)] += picture.rgb[i];
  return sum / (static_cast<double>(picture.width) * picture.height);
}

/// The mean of both integrators' pictures against a value in every channel.
void check_mean(const std::string& text, Vec3 expected, double tolerance, int samples) {
  for (const Integrator integrator : {Integrator::pt, Integrator::sppm}) {
    const auto result =
        render_with(scene_from_text(text), integrator, integrator == Integrator::pt ? samples : samples / 8);
    const Vec3 is = mean(result.picture);
    INFO(text << "\n" << (integrator == Integrator::pt ? "pt" : "sppm"));
    for (int c = 0; c < 3; ++c) CHECK(is[c] == Approx(expected[c]).epsilon(tolerance));
    CHECK(result.statistics.diagnostics.media_full == 0);
    CHECK(result.statistics.diagnostics.media_left == 0);
  }
}

const Vec3 one{1, 1, 1};

}  // namespace

TEST_CASE("clear dielectrics in contact lose and add no light") {
  const std::string upper = glass_box(1, 1.5, 0, 0, 0.5), lower = glass_box(1, 1.33, 0, 0, -0.5);
  check_mean(scene_text(upper + "," + lower, along_z), one, 2e-3, 256);
  check_mean(scene_text(lower + "," + upper, aslant), one, 2e-3, 256);
  // Overlapping, within each other, and a shell as thin as floats can tell.
  check_mean(scene_text(upper + "," + glass_box(1, 1.33, 0, 0, -0.3), aslant), one, 2e-3, 256);
  check_mean(scene_text(glass_box(1.2, 1.33, 0, 0, 0) + "," + glass_sphere(0.4, 1.5, 0, 0, 0) + "," +
                            glass_sphere(0.2, 1.0, 0, 0, 0),
                        aslant),
             one, 2e-3, 256);
}

TEST_CASE("a sphere of glass that is tangent to a mirror reflects all light at the point of contact") {
  const std::string mirror =
      R"({"type": "rectangle", "material": {"type": "mirror", "color": [1, 1, 1]},
          "transform": [{"type": "scale", "x": 9, "y": 9, "z": 1}]})";
  check_mean(scene_text(glass_sphere(1, 1.5, 0, 0, 1) + "," + mirror, along_z), one, 2e-3, 256);
}

TEST_CASE("a glass cube on a floor is the limit of a vanishing gap, in any order of the objects") {
  const std::string floor =
      R"({"type": "rectangle", "material": {"type": "diffuse", "color": [0.8, 0.2, 0.2]},
          "transform": [{"type": "scale", "x": 20, "y": 20, "z": 1}, {"type": "rotate", "axis": "x", "degree": -90}]})";
  const std::string camera = R"("position": [0, 3, 4], "target": [0, 0.3, 0], "fov": 15)";
  const std::string stands = glass_box(1, 1.5, 0, 0.5, 0), floats = glass_box(1, 1.5, 0, 0.501, 0);
  const auto render = [&](const std::string& objects, Integrator integrator, int passes) {
    return mean(render_with(scene_from_text(scene_text(objects, camera)), integrator, passes).picture);
  };
  const Vec3 gap = render(floats + "," + floor, Integrator::pt, 1024);
  for (const std::string& objects : {stands + "," + floor, floor + "," + stands}) {
    const Vec3 pt = render(objects, Integrator::pt, 1024), sppm = render(objects, Integrator::sppm, 64);
    for (int c = 0; c < 3; ++c) {
      CHECK(pt[c] == Approx(gap[c]).epsilon(0.01));
      CHECK(sppm[c] == Approx(gap[c]).epsilon(0.015));
    }
  }
}

TEST_CASE("the camera and lamps may stand in what absorbs") {
  const std::string pebble =
      R"({"type": "sphere", "radius": 1, "material": {"type": "diffuse", "color": [0, 0, 0], "emission": [1, 1, 1]}})";
  const std::string camera = R"("position": [0, 0, 3], "target": [0, 0, 0], "fov": 0.5)";
  check_mean(scene_text(glass_sphere(10, 1.5, 0, 0, 0, R"(, "absorption": [0.5, 0, 1])") + "," + pebble,
                        camera, R"("lights": [])"),
             {std::exp(-1.0), 1, std::exp(-2.0)}, 2e-3, 64);
  // The medium of the scene ends where a dielectric begins, of whatever index.
  check_mean(scene_text(glass_sphere(10, 1.0, 0, 0, 0) + "," + pebble, camera,
                        R"("lights": [], "medium": {"absorption": [0.3, 0.3, 0.3]})"),
             one, 2e-3, 64);
}

TEST_CASE("light of a lamp in absorbing glass is absorbed on its way to what stands in the same glass") {
  // A white wall within the glass, lit by a lamp before it that is seen through nothing else.
  const std::string inside =
      R"({"type": "sphere", "radius": 0.2, "material": {"type": "diffuse", "color": [0, 0, 0], "emission": [9, 9, 9]},
          "transform": [{"type": "shift", "x": 1, "y": 0, "z": 1}]},
         {"type": "rectangle", "material": {"type": "diffuse", "color": [0.8, 0.8, 0.8]},
          "transform": [{"type": "scale", "x": 2, "y": 2, "z": 1}]},)" +
      glass_sphere(30, 1.5, 0, 0, 0, R"(, "absorption": [0, 0.3, 0.6])");
  const std::string text =
      scene_text(inside, R"("position": [0, 0, 3], "target": [0, 0, 0], "fov": 20)", R"("lights": [])");
  const Vec3 pt = mean(render_with(scene_from_text(text), Integrator::pt, 1024).picture);
  Scene by_photons = scene_from_text(text);
  by_photons.renderer.direct_light = DirectLight::photons;
  const Vec3 rays = mean(render_with(scene_from_text(text), Integrator::sppm, 32).picture),
             photons = mean(render_with(by_photons, Integrator::sppm, 64).picture);
  for (int c = 0; c < 3; ++c) {
    CHECK(rays[c] == Approx(pt[c]).epsilon(0.01));
    CHECK(photons[c] == Approx(pt[c]).epsilon(0.015));
  }
  CHECK(pt.y < 0.5 * pt.x);
}

TEST_CASE("which body fills a place that several hold") {
  const auto bodies = [](const std::string& objects) {
    return find_dielectrics(scene_from_text(scene_text(objects, along_z))).bodies;
  };
  const std::string a = glass_box(1, 1.5, 0, 0, 0), b = glass_box(1, 1.3, 0.5, 0, 0),
                    inner = glass_box(0.4, 1.3, 0, 0, 0),
                    first = glass_box(1, 1.5, 0, 0, 0, R"(, "priority": 1)");
  CHECK(bodies(a + "," + b) == std::vector<int>{0, 1});
  CHECK(bodies(first + "," + b) == std::vector<int>{1, 0});
  CHECK(bodies(inner + "," + a) == std::vector<int>{1, 0});
  CHECK(bodies(a + "," + inner) == std::vector<int>{0, 1});
  // What stands apart keeps nothing.
  CHECK(bodies(a + "," + glass_box(1, 1.3, 1.1, 0, 0)).empty());
}
