// Hard cases 14 and 15: white furnaces, and light through closed smooth meshes.
#include <cmath>
#include <numeric>

#include "selftest/scene_parts.hpp"
#include "selftest/stability_checks.hpp"

namespace causticl {
namespace {

using Kind = MaterialSpec::Kind;

/// The materials that lose nothing: a furnace holds a ball of each.
struct FurnaceMaterial {
  const char* name;
  MaterialSpec spec;
};

std::vector<FurnaceMaterial> furnace_materials() {
  const MaterialSpec diffuse = make_material(Kind::diffuse, 1), mirror = make_material(Kind::mirror, 1),
                     plastic = make_material(Kind::plastic, 1);
  MaterialSpec glass = make_material(Kind::glass, 1), dense = glass, rare = glass, textured = diffuse;
  MaterialSpec rough_diffuse = make_material(Kind::oren_nayar, 1);
  rough_diffuse.diffuse_roughness = 1;
  dense.ior = 2.5;
  rare.ior = 0.7;
  textured.color_texture = 0;
  return {{"diffuse", diffuse},
          {"textured", textured},
          {"mirror", mirror},
          {"glass", glass},
          {"dense glass", dense},
          {"rare glass", rare},
          {"plastic", plastic},
          {"thin glass", make_material(Kind::thin_glass, 1)},
          {"rough diffuse", rough_diffuse}};
}

/// A column of the picture for each material, with its ball, in a box of infinite planes of radiance 1:
/// whatever path is taken, it ends at a plane, and each pixel is 1. Planes are no emitters that are sampled,
/// so that path tracing has no noise but that of choosing lobes. With `closed_sphere`, a sphere with K_d =
/// L_e = 1/2 is put round the balls: inside it radiance is 1/2 + 1/4 + 1/8 + ... = 1 as well, now by sampled
/// emitters and photons.
Scene furnace(bool closed_sphere) {
  const auto materials = furnace_materials();
  Scene scene;
  // Light in a ball of glass leaves it after some reflections; in grazing directions, after many.
  scene.max_depth = 256;
  // The cap of a sphere within distance r of a point on it has area pi r^2: the density estimate has no bias,
  // as long as the cap is below 60 degrees, beyond which photons count as on another wall.
  scene.renderer.radius = 0.4;
  scene.camera = make_camera({0, 0, 3.4}, {0, 0, 0}, 1.0);
  TextureSpec white;
  white.kind = TextureSpec::Kind::checker;
  white.a = white.b = {1, 1, 1};
  scene.textures = {white};
  scene.materials = {make_material(Kind::diffuse, 0, 1), make_material(Kind::diffuse, 0.5, 0.5)};
  for (MaterialSpec& material : scene.materials) material.two_sided = true;
  for (const double side : {-10.0, 10.0}) {
    scene.objects.push_back(make_object(Object::Shape::plane, Transform::shift({0, 0, side}), 0));
    for (const int axis : {0, 1})
      scene.objects.push_back(make_object(
          Object::Shape::plane,
          Transform::shift({0, 0, side}).followed_by(Transform::rotate(axis, std::numbers::pi / 2)), 0));
  }
  const double width = 3.0 / static_cast<double>(materials.size());
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const double x = (static_cast<double>(i) + 0.5) * width - 1.5;
    scene.objects.push_back(make_sphere({x, 0, 0}, 0.42 * width, static_cast<int>(scene.materials.size())));
    scene.materials.push_back(materials[i].spec);
  }
  if (closed_sphere) scene.objects.push_back(make_sphere({0, 0, 0}, 4, 1));
  return scene;
}

/// How far the mean of columns [first, last) is from 1, beyond four of its standard errors: pixels of path
/// tracing are independent.
double deviation_from_one(const Picture& picture, int first, int last) {
  double sum = 0, squares = 0, count = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = first; x < last; ++x) {
      const double value = picture.rgb[3 * (y * picture.width + x)] - 1.0;
      sum += value;
      squares += value * value;
      ++count;
    }
  const double mean = sum / count, variance = std::max(0.0, squares / count - mean * mean);
  return std::max(0.0, std::fabs(mean) - 4 * std::sqrt(variance / count));
}

CheckResult deviation_result() {
  CheckResult result;
  result.tolerance = 1e-3;
  result.unit = "of radiance 1";
  return result;
}

void take(CheckResult& result, double error, const std::string& what) {
  if (!(error <= result.tolerance)) {
    ++result.failures;
    result.note += (result.note.empty() ? "" : ", ") + what;
  }
  if (!(error <= result.worst_error)) result.worst_error = error;
}

CheckResult white_furnace(CheckContext& context) {
  CheckResult result = deviation_result();
  const auto materials = furnace_materials();
  const RenderBudget budget(context.inputs, 1, 64);
  Scene scene = furnace(false);
  scene.renderer.integrator = Integrator::pt;
  budget.apply(scene);
  const Picture picture = render_for(context, scene).picture;
  result.inputs = budget.inputs();
  // The balls' columns take the middle 3 / 3.4 of the picture.
  const auto column = [&](std::size_t i) {
    const double x = 3.0 / 3.4 * (static_cast<double>(i) / static_cast<double>(materials.size()) - 0.5) + 0.5;
    return static_cast<int>(std::lround(x * budget.side));
  };
  for (std::size_t i = 0; i < materials.size(); ++i)
    take(result, deviation_from_one(picture, column(i), column(i + 1)), materials[i].name);
  return result;
}

/// The mean of a scene's picture by path tracing and by SPPM, whose standard error is at most `deviation`
/// over the root of the number of inputs; four of them are granted.
CheckResult both_are_one(CheckContext& context, Scene scene, double deviation) {
  CheckResult result = deviation_result();
  const RenderBudget budget(context.inputs, 2, 32);
  budget.apply(scene);
  scene.renderer.integrator = Integrator::pt;
  take(result, deviation_from_one(render_for(context, scene).picture, 0, budget.side), "path tracing");
  scene.renderer.integrator = Integrator::sppm;
  const Picture picture = render_for(context, scene).picture;
  const double mean =
      std::accumulate(picture.rgb.begin(), picture.rgb.end(), 0.0) / static_cast<double>(picture.rgb.size());
  const double noise = 4 * deviation / std::sqrt(static_cast<double>(budget.inputs()));
  take(result, std::max(0.0, std::fabs(mean - 1) - noise), "photon mapping");
  result.inputs = 2 * budget.inputs();
  return result;
}

/// The mean of the closed sphere's picture, balls and all, by both integrators.
CheckResult closed_sphere(CheckContext& context) {
  // A quarter of the radiance comes by photons, a quarter by shadow rays. Each of N photons leaves one on
  // average, with variance two, and the picture sees about a third of where they land: with the shadow rays'
  // noise a standard deviation of 1 / sqrt(N) at most.
  return both_are_one(context, furnace(true), 1);
}

/// Balls that lose nothing under an environment of radiance 1, which all of the picture shows. Photons and
/// shadow rays come from the environment alone.
CheckResult environment_furnace(CheckContext& context) {
  Scene scene;
  // Light is lost with the paths that are cut off, between white balls one in a few hundred a bounce.
  scene.max_depth = 64;
  scene.renderer.radius = 0.2;
  scene.camera = make_camera({0, 0, 3.4}, {0, 0, 0}, 1.0);
  const auto materials = furnace_materials();
  TextureSpec white;
  white.kind = TextureSpec::Kind::checker;
  white.a = white.b = {1, 1, 1};
  scene.textures = {white};
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const std::size_t across = i % 3, down = i / 3;
    const auto column = static_cast<double>(across), row = static_cast<double>(down);
    scene.objects.push_back(
        make_sphere({1.05 * (column - 1), 1.05 * (row - 1), 0}, 0.5, static_cast<int>(i)));
    scene.materials.push_back(materials[i].spec);
  }
  LightSpec environment;
  environment.kind = LightSpec::Kind::environment;
  environment.map.width = 64;
  environment.map.height = 32;
  environment.map.rgba.assign(std::size_t{4} * 64 * 32, 1.0f);
  scene.lights.push_back(environment);
  // A sixth of the picture is diffuse, and what photons bring there, from ball to ball, is a small part of
  // its light.
  return both_are_one(context, std::move(scene), 0.5);
}

/// A coarse smooth torus of diffuse walls and, inside its tube, a smaller one of mirrors. The camera is in
/// the tube or outside of it, and emitters are where it is not: the picture is black.
Scene dark_tube(bool camera_inside, Integrator integrator) {
  Scene scene;
  scene.max_depth = 12;
  scene.renderer.integrator = integrator;
  // Far below the thickness between the two tubes; nothing here may depend on it.
  scene.renderer.radius = 0.1;
  scene.materials = {make_material(Kind::diffuse, 0.9), make_material(Kind::mirror, 0.95),
                     make_material(Kind::diffuse, 0, 100)};
  scene.meshes = {torus(9, 7, 3, 1), torus(11, 6, 3, 0.4)};
  scene.objects = {make_mesh_object(0, {}, 0), make_mesh_object(1, {}, 1)};
  for (int i = 0; i < 11; ++i) {
    const double angle = 2 * std::numbers::pi * i / 11;
    scene.objects.push_back(make_sphere({3 * std::cos(angle), 0, -3 * std::sin(angle)}, 0.25, 2));
  }
  if (camera_inside) {
    // The camera looks along the mirrors: at grazing incidence shading normals fail first.
    for (const double y : {0.0, 5.0}) scene.objects.push_back(make_sphere({0, y, 0}, 0.8, 2));
    scene.camera = make_camera({3.5, 0.1, 0}, {3, 0, -1.6}, 2);
  } else {
    for (const double x : {3.6, -3.5}) scene.objects.push_back(make_sphere({x, 0, 0}, 0.1, 2));
    scene.camera = make_camera({0, 6, 6}, {0, 0, 0}, 1);
  }
  return scene;
}

CheckResult dark_inside(CheckContext& context) {
  CheckResult result;
  const RenderBudget budget(context.inputs, 4, 16);
  for (const Integrator integrator : {Integrator::pt, Integrator::sppm})
    for (const bool camera_inside : {true, false}) {
      Scene scene = dark_tube(camera_inside, integrator);
      budget.apply(scene);
      const Picture picture = render_for(context, scene).picture;
      for (std::size_t i = 0; i < picture.rgb.size(); i += 3)
        result.failures += !(picture.rgb[i] == 0 && picture.rgb[i + 1] == 0 && picture.rgb[i + 2] == 0);
      result.inputs += budget.inputs();
    }
  return result;
}

}  // namespace

std::vector<Check> energy_checks() {
  return {{14, "white furnace: no material loses or gains", 1, white_furnace, pass_programs},
          {14, "a closed sphere with K_d = L_e = 1/2 is 1", 3, closed_sphere, pass_programs},
          {14, "white balls under an even sky of 1 are 1", 3, environment_furnace, pass_programs},
          {15, "no light through closed smooth meshes", 10, dark_inside, pass_programs}};
}

}  // namespace causticl
