// How much of a kernel lies on surfaces: probes against areas that are known, and what a picture gains.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "catch2.hpp"
#include "device_scene/device_scene.hpp"
#include "device_scene/params.hpp"
#include "render/render_fixture.hpp"
#include "vector_inputs.hpp"

using namespace causticl;

namespace {

const char* const source = R"(
#include "passes/pass_camera.cl"
kernel void probe(SCENE_PARAMETERS, global const float4 *points, global const float4 *normals, global uint *out,
                  global uint *traced, uint count, uint each, float radius2, Params params,
                  volatile global Counters *counters) {
  uint i = get_global_id(0);
  if (i >= count) return;
  SCENE_INIT(params);
  RandomStream stream = {7, 0, i};
  uint rays = 0;
  real3 point = convert_real3(points[i / each].xyz), normal = convert_real3(normals[i / each].xyz);
  Ray ray = {point + (real)0.001 * normal, -normal};
  Hit here = hit_none(INFINITY);
  geometry_closest(&scene.geometry, ray, &here);
  out[i] = kernel_area_probe(&scene, here, point, normal, radius2, random4(stream, 0), &rays, counters);
  traced[i] = rays;
}
kernel void holds(global const TriangleBlock *blocks, global const float4 *weights, global const float4 *offsets,
                  global uint *out, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  Hit hit = {1, i, weights[i].x, weights[i].y, 0};
  out[i] = triangle_holds(blocks, hit, convert_real3(offsets[i].xyz));
}
)";

struct Place {
  const char* name;
  float4 point, normal;
  double whole, half_radius;  // covered, of a disc of radius 0.4 and of 0.2
};

/// The part of a disc of radius 1 on this side of a line at a distance from its centre.
double beside_line(double distance) {
  const double d = std::min(distance, 1.0);
  return 1 - (std::acos(d) - d * std::sqrt(1 - d * d)) / std::numbers::pi;
}

/// Of a ball around a point of a face that meets another at 45 degrees, at that distance over the ball's
/// radius: what it holds of the other face, over a disc.
double beyond_crease(double distance) {
  const double below = distance * std::sqrt(0.5), radius = std::sqrt(1 - below * below);
  return radius * radius * (1 - beside_line(below / radius));
}

Scene places() {
  return scene_from_text(R"({
    "camera": {"position": [0, 1, 6], "target": [0, 0, 0], "fov": 60},
    "materials": {"grey": {"type": "diffuse", "color": [0.5, 0.5, 0.5]}},
    "objects": [
      {"type": "rectangle", "material": "grey", "transform": [{"type": "scale", "x": 4, "y": 4, "z": 1},
        {"type": "rotate", "axis": "x", "degree": -90}]},
      {"type": "sphere", "material": "grey", "radius": 1, "transform": [{"type": "shift", "x": 10, "y": 0, "z": 0}]},
      {"type": "box", "material": "grey", "size": [2, 2, 2], "transform": [{"type": "shift", "x": -10, "y": 0, "z": 0}]},
      {"type": "rectangle", "material": "grey", "transform": [{"type": "scale", "x": 2, "y": 2, "z": 1},
        {"type": "rotate", "axis": "x", "degree": -90}, {"type": "shift", "x": 20, "y": 0, "z": 0}]},
      {"type": "rectangle", "material": "grey", "transform": [{"type": "scale", "x": 2, "y": 2, "z": 1},
        {"type": "rotate", "axis": "x", "degree": -90}, {"type": "shift", "x": 1, "y": 0, "z": 0},
        {"type": "rotate", "axis": "z", "degree": 45}, {"type": "shift", "x": 21, "y": 0, "z": 0}]},
      {"type": "rectangle", "material": {"type": "glass"}, "transform": [{"type": "scale", "x": 0.2, "y": 1, "z": 1},
        {"type": "rotate", "axis": "x", "degree": -90}, {"type": "shift", "x": -1.4, "y": 0.05, "z": 1}]},
      {"type": "rectangle", "material": {"type": "mirror"}, "transform": [{"type": "scale", "x": 2, "y": 2, "z": 1},
        {"type": "rotate", "axis": "x", "degree": -90}, {"type": "shift", "x": 22.5, "y": 5, "z": 0}]},
      {"type": "rectangle", "material": "grey", "transform": [{"type": "scale", "x": 2, "y": 2, "z": 1},
        {"type": "rotate", "axis": "x", "degree": -90}, {"type": "shift", "x": 20.5, "y": 5, "z": 0}]},
      {"type": "box", "material": "grey", "size": [0.1, 1, 2], "transform": [{"type": "shift", "x": 0, "y": 0.5, "z": 0}]},
      {"type": "plane", "material": "grey", "transform": [{"type": "rotate", "axis": "x", "degree": -90},
        {"type": "shift", "x": 0, "y": -20, "z": 0}]}]
  })");
}

}  // namespace

TEST_CASE("probes find how much of a disc lies on surfaces") {
  const float4 up{0, 1, 0, 0};
  const double diagonal = std::sqrt(0.5);
  const std::vector<Place> expected{
      {"amid a floor", {-1, 0, 0, 0}, up, 1, 1},
      {"at its edge", {-2, 0, 0, 0}, up, 0.5, 0.5},
      {"at its corner", {-2, 0, 2, 0}, up, 0.25, 0.25},
      {"beside its edge", {-1.8f, 0, 0, 0}, up, beside_line(0.5), 1},
      {"below, beside its edge", {-1.7f, 0, 0, 0}, {0, -1, 0, 0}, beside_line(0.75), 1},
      // What lies inside of a ball of a sphere is as large as the disc (Archimedes).
      {"on a sphere", {10, 1, 0, 0}, up, 1, 1},
      {"at a box's edge", {-9, 1, 0, 0}, up, 0.5, 0.5},
      {"beside a box's edge", {-9, 0.9f, 0, 0}, {1, 0, 0, 0}, beside_line(0.25), beside_line(0.5)},
      // Both faces take part, since they lean by less than 60 degrees.
      {"where two faces meet at 45 degrees", {21, 0, 0, 0}, up, 1, 1},
      {"beside that",
       {21 + 0.1f * static_cast<float>(diagonal), 0.1f * static_cast<float>(diagonal), 0, 0},
       {-static_cast<float>(diagonal), static_cast<float>(diagonal), 0, 0},
       beside_line(0.25) + beyond_crease(0.25),
       beside_line(0.5) + beyond_crease(0.5)},
      {"below a sheet of glass", {-1.4f, 0, 1, 0}, up, 1, 1},
      {"beside a mirror", {21.4f, 5, 0, 0}, up, beside_line(0.25), beside_line(0.5)},
      {"on a plane", {3, -20, 0, 0}, up, 1, 1},
      // The top of a wall as thick as a quarter of the disc; a smaller disc finds more of it.
      {"on a thin wall", {0, 1, 0, 0}, up, 2 * beside_line(0.125) - 1, 2 * beside_line(0.25) - 1}};
  constexpr cl_uint each = 1 << 16;
  const Scene scene = places();
  const DeviceScene device_scene = update_device_scene(scene, test_device());
  cl::Program program = build_test_program(source, effect_bits(find_effects(scene)));
  std::vector<float4> points, normals;
  for (const Place& place : expected) {
    points.push_back(place.point);
    normals.push_back(place.normal);
  }
  const auto count = static_cast<cl_uint>(points.size()) * each;
  const auto out = test_device().buffer(count * sizeof(cl_uint), "probes");
  const auto at = test_device().upload(points, "points"), facing = test_device().upload(normals, "normals");
  const auto counters = test_device().upload(std::vector<Counters>{{}}, "counters");
  const Params params = scene_params(scene, device_scene, 5);
  cl::Kernel kernel(program, "probe");
  const cl_uint index = set_scene_arguments(kernel, device_scene);
  kernel.setArg(index, at);
  kernel.setArg(index + 1, facing);
  const auto traced = test_device().buffer(count * sizeof(cl_uint), "rays");
  kernel.setArg(index + 2, out);
  kernel.setArg(index + 3, traced);
  kernel.setArg(index + 4, count);
  kernel.setArg(index + 5, each);
  kernel.setArg(index + 6, 0.16f);
  kernel.setArg(index + 7, params);
  kernel.setArg(index + 8, counters);
  test_device().launch(kernel, count);
  const auto probes = test_device().download<cl_uint>(out, count),
             rays = test_device().download<cl_uint>(traced, count);
  const auto rays_at = [&](const std::string& name) {
    const auto p =
        static_cast<std::ptrdiff_t>(std::find_if(expected.begin(), expected.end(),
                                                 [&](const Place& place) { return place.name == name; }) -
                                    expected.begin());
    return std::accumulate(rays.begin() + p * each, rays.begin() + (p + 1) * each, 0.0) / each;
  };
  // None where its own triangle or plane holds the place.
  CHECK(rays_at("amid a floor") < 0.5);
  CHECK(rays_at("on a plane") == 0);
  CHECK(rays_at("at its edge") == Approx(0.5).margin(0.01));
  CHECK(rays_at("on a sphere") == 1);
  for (std::size_t p = 0; p < expected.size(); ++p) {
    double sum[2] = {}, number[2] = {};
    for (std::size_t i = p * each; i < (p + 1) * each; ++i) {
      REQUIRE((probes[i] & KERNEL_AREA_PROBED) != 0);
      const int disc = (probes[i] & KERNEL_AREA_OF_HALF) ? 1 : 0;
      sum[disc] += probes[i] >> KERNEL_AREA_SHIFT & 3u;
      number[disc] += 1;
    }
    INFO(expected[p].name);
    CHECK(number[1] == Approx(each / 4.0).epsilon(0.03));
    CHECK(sum[0] / number[0] == Approx(expected[p].whole).margin(2.5 / std::sqrt(number[0])));
    CHECK(sum[1] / number[1] == Approx(expected[p].half_radius).margin(2.5 / std::sqrt(number[1])));
  }
}

TEST_CASE("whether a triangle holds a point beside a hit, against double precision") {
  auto program = build_test_program(source, EFFECT_TRIANGLES);
  RandomInputs random(20261127);
  constexpr std::size_t count = 1 << 16;
  std::vector<TriangleBlock> blocks(count / 8);
  std::vector<float4> weights, offsets;
  std::vector<int> expected;  // -1: too close to tell
  for (std::size_t i = 0; i < count; ++i) {
    TriangleBlock& block = blocks[i / 8];
    const double size = std::pow(10, random.uniform(-3, 3)),
                 thin = i % 4 == 0 ? std::pow(10, random.uniform(-9, -4)) : 1;
    Vec3 corners[3];
    for (int v = 0; v < 3; ++v)
      for (int k = 0; k < 3; ++k) {
        // The third corner of a sliver lies by the second.
        const double x = v == 2 && thin < 1 ? corners[1][k] + thin * size * random.uniform(-1, 1)
                                            : size * random.uniform(-1, 1);
        corners[v][k] = block.position[v][k][i % 8] = static_cast<float>(x);
      }
    const double u = random.uniform(), v = random.uniform(0, 1 - u), to_u = random.uniform(-0.5, 1.5),
                 to_v = random.uniform(-0.5, 1.5);
    const Vec3 offset = (to_u - u) * (corners[1] - corners[0]) + (to_v - v) * (corners[2] - corners[0]);
    weights.push_back({static_cast<float>(u), static_cast<float>(v), 0, 0});
    offsets.push_back(
        {static_cast<float>(offset.x), static_cast<float>(offset.y), static_cast<float>(offset.z), 0});
    const Vec3 e = corners[1] - corners[0], f = corners[2] - corners[0];
    const double sine2 = 1 - std::pow(dot(e, f), 2) / (dot(e, e) * dot(f, f));
    const double inside = std::min({to_u, to_v, 1 - to_u - to_v});
    expected.push_back(sine2 < 5e-6 ? 0 : sine2 < 0.01 || std::fabs(inside) < 1e-3 ? -1 : inside > 0);
  }
  const auto out = test_device().buffer(count * sizeof(cl_uint), "out");
  run_kernel(program, "holds", count, test_device().upload(blocks, "blocks"),
             test_device().upload(weights, "weights"), test_device().upload(offsets, "offsets"), out,
             static_cast<cl_uint>(count));
  const auto found = test_device().download<cl_uint>(out, count);
  std::size_t wrong = 0, held = 0, slivers = 0;
  for (std::size_t i = 0; i < count; ++i) {
    wrong += expected[i] >= 0 && static_cast<int>(found[i]) != expected[i];
    held += expected[i] == 1;
    slivers += i % 4 == 0 && expected[i] == 0;
  }
  CHECK(wrong == 0);
  CHECK(held > count / 20);
  CHECK(slivers > count / 10);
}

TEST_CASE("corners and edges are too dark without the correction, and not with it") {
  const auto room = [](bool corrected) {
    Scene scene = scene_from_text(R"({
      "width": 24, "height": 16, "max_depth": 12,
      "renderer": {"type": "sppm", "view_point_sample": 4, "photon_sample": 40000, "radius": 0.3, "schedule": "global"},
      "camera": {"position": [0.8, 0.6, 0.9], "target": [-1, -0.8, -1], "fov": 80},
      "materials": {"white": {"type": "diffuse", "color": [0.7, 0.7, 0.7]},
                    "lamp": {"type": "diffuse", "color": [0, 0, 0], "emission": [8, 8, 8]}},
      "objects": [{"type": "box", "material": "white", "size": [2, 2, 2]},
                  {"type": "box", "material": "white", "size": [0.6, 0.8, 0.6],
                   "transform": [{"type": "shift", "x": -0.3, "y": -0.6, "z": -0.3}]},
                  {"type": "sphere", "material": "lamp", "radius": 0.2,
                   "transform": [{"type": "shift", "x": 0.5, "y": 0.6, "z": 0.2}]}]
    })");
    scene.renderer.boundary_correction = corrected;
    return scene;
  };
  const Picture truth = render_with(room(true), Integrator::pt, 4096).picture;
  // Of the pixels: how much darker the darkest tenth is than it should be, and how much brighter the
  // brightest.
  const auto extremes = [&](bool corrected) {
    const Picture picture = render_with(room(corrected), Integrator::sppm, 32).picture;
    std::vector<double> ratios;
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3)
      ratios.push_back(static_cast<double>(picture.rgb[i]) / static_cast<double>(truth.rgb[i]));
    std::sort(ratios.begin(), ratios.end());
    return std::pair{ratios[ratios.size() / 20], ratios[ratios.size() - ratios.size() / 20]};
  };
  const auto before = extremes(false), after = extremes(true);
  INFO("darkest " << before.first << ", " << after.first << "; brightest " << before.second << ", "
                  << after.second);
  CHECK(before.first < 0.82);
  CHECK(after.first > 0.88);
  CHECK(after.second < 1.12);
}
