// A cylinder against a mesh of many faces, as what light falls on, what sends it and what it goes through.
#include <cmath>
#include <cstdio>
#include <sstream>

#include "catch2.hpp"
#include "format/load_scene.hpp"
#include "render_fixture.hpp"
#include "temporary_folder.hpp"

using namespace causticl;

namespace {

/// A closed cylinder of that many faces around, or one without caps, wound outward, as an OBJ.
std::string faceted_cylinder(double radius, double height, bool capped, int turns) {
  std::ostringstream out;
  out.precision(9);
  for (const double y : {-0.5, 0.5})
    for (int i = 0; i < turns; ++i) {
      const double angle = 2 * M_PI * i / turns;
      out << "v " << radius * std::cos(angle) << " " << y * height << " " << radius * std::sin(angle) << "\n";
    }
  for (int i = 0; i < turns; ++i) {
    const double angle = 2 * M_PI * i / turns;
    out << "vn " << std::cos(angle) << " 0 " << std::sin(angle) << "\n";
  }
  out << "vn 0 -1 0\nvn 0 1 0\n";
  for (int i = 0; i < turns; ++i) {
    const int a = i + 1, d = (i + 1) % turns + 1, b = a + turns, c = d + turns;
    out << "f " << a << "//" << a << " " << b << "//" << a << " " << c << "//" << d << " " << d << "//" << d
        << "\n";
  }
  if (capped) {
    out << "f";
    for (int i = 0; i < turns; ++i) out << " " << i + 1 << "//" << turns + 1;
    out << "\nf";
    for (int i = turns; i-- > 0;) out << " " << turns + i + 1 << "//" << turns + 2;
    out << "\n";
  }
  return out.str();
}

/// A scene of one object, in a room of one floor, one wall and a lamp.
Scene scene_with(const TemporaryFolder& folder, const std::string& shape, const std::string& material) {
  return load_scene(folder.write("scene.json", R"({"width": 24, "height": 18, "max_depth": 24,
  "camera": {"position": [0.4, 1.6, 5], "target": [0, 0.6, 0], "up": [0, 1, 0], "fov": 42},
  "renderer": {"type": "sppm", "photon_sample": 60000, "radius": 0.12},
  "objects": [
    {"type": "rectangle", "material": {"type": "diffuse", "color": [0.7, 0.6, 0.5]},
     "transform": [{"type": "scale", "x": 8, "y": 8, "z": 1}, {"type": "rotate", "axis": "x", "degree": -90}]},
    {"type": "rectangle", "material": {"type": "diffuse", "color": [0.4, 0.5, 0.7]},
     "transform": [{"type": "scale", "x": 8, "y": 5, "z": 1}, {"type": "shift", "x": 0, "y": 2.5, "z": -2}]},
    {"type": "sphere", "radius": 0.4, "material": {"type": "diffuse", "color": 0, "emission": [9, 8, 7]},
     "transform": [{"type": "shift", "x": 1.8, "y": 3, "z": 1}]},
    {)" + shape + R"(, "material": )" + material + R"(,
     "transform": [{"type": "scale", "x": 1.4, "y": 0.9, "z": 0.7}, {"type": "rotate", "axis": "z", "degree": 35},
                   {"type": "rotate", "axis": "y", "degree": 20}, {"type": "shift", "x": -0.2, "y": 1, "z": 0}]}]})"));
}

double mean_of(const Picture& picture) {
  const Vec3 mean = mean_color(picture);
  return (mean.x + mean.y + mean.z) / 3;
}

}  // namespace

TEST_CASE("a cylinder is the limit of a mesh of many faces, in both integrators") {
  const TemporaryFolder folder;
  const std::string diffuse = R"({"type": "diffuse", "color": [0.8, 0.3, 0.2], "two_sided": true})";
  const std::string lamp = R"({"type": "diffuse", "color": 0.3, "emission": [3, 4, 5]})";
  const std::string both = R"({"type": "diffuse", "color": 0.3, "emission": [3, 4, 5], "two_sided": true})";
  const std::string glass = R"({"type": "glass", "ior": 1.5, "absorption": [0.1, 0.4, 0.8]})";
  const std::string plastic = R"({"type": "plastic", "color": [0.2, 0.6, 0.3], "roughness": 0.3})";
  struct Case {
    const char* name;
    bool capped;
    const std::string& material;
    int passes, samples;
    double tolerance;
  };
  for (const Case& c :
       {Case{"a diffuse tube", false, diffuse, 32, 128, 0.004}, Case{"a lamp", true, lamp, 300, 256, 0.012},
        Case{"a tube that emits on both sides", false, both, 300, 256, 0.012},
        Case{"a rod of glass", true, glass, 100, 1024, 0.01},
        Case{"coated", true, plastic, 48, 256, 0.004}}) {
    INFO(c.name);
    folder.write("mesh.obj", faceted_cylinder(0.6, 1.8, c.capped, 512));
    const Scene exact = scene_with(
                    folder,
                    std::string(R"("type": "cylinder", "radius": 0.6, "height": 1.8, "capped": )") +
                        (c.capped ? "true" : "false"),
                    c.material),
                mesh = scene_with(folder, R"("type": "mesh", "path": "mesh.obj")", c.material);
    const double by_paths = mean_of(render_with(exact, Integrator::pt, c.samples).picture),
                 mesh_by_paths = mean_of(render_with(mesh, Integrator::pt, c.samples).picture),
                 by_photons = mean_of(render_with(exact, Integrator::sppm, c.passes).picture),
                 mesh_by_photons = mean_of(render_with(mesh, Integrator::sppm, c.passes).picture);
    std::printf("%-32s pt %.5f, mesh %.5f; sppm %.5f, mesh %.5f\n", c.name, by_paths, mesh_by_paths,
                by_photons, mesh_by_photons);
    CHECK(by_paths == Approx(mesh_by_paths).epsilon(c.tolerance));
    CHECK(by_photons == Approx(mesh_by_photons).epsilon(c.tolerance));
    CHECK(by_photons == Approx(by_paths).epsilon(2 * c.tolerance));
  }
}
