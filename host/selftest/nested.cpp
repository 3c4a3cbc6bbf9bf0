// Hard case 26: dielectrics that touch, overlap or lie in each other.
#include <cmath>

#include "device_scene/params.hpp"
#include "scene/body.hpp"
#include "selftest/random_check.hpp"
#include "selftest/scene_parts.hpp"
#include "selftest/stability_checks.hpp"
#include "shared/effects.h"

namespace causticl {
namespace {

using Kind = MaterialSpec::Kind;
using Shape = Object::Shape;

int add_glass(Scene& scene, double ior) {
  scene.materials.push_back(make_material(Kind::glass, 1));
  scene.materials.back().ior = ior;
  return static_cast<int>(scene.materials.size()) - 1;
}

void add_box(Scene& scene, Vec3 size, Vec3 centre, double ior) {
  Object box = make_object(Shape::box, Transform::shift(centre), add_glass(scene, ior));
  box.size = size;
  scene.objects.push_back(box);
}

void add_sphere(Scene& scene, double radius, Vec3 centre, double ior) {
  scene.objects.push_back(make_sphere(centre, radius, add_glass(scene, ior)));
}

Scene sky_of_one() {
  Scene scene;
  scene.max_depth = 256;
  LightSpec environment;
  environment.kind = LightSpec::Kind::environment;
  environment.map.width = 4;
  environment.map.height = 2;
  environment.map.rgba.assign(std::size_t{4} * 4 * 2, 1.0f);
  scene.lights.push_back(environment);
  // From above, through the faces that bodies share.
  scene.camera = make_camera({0.4, 8, 4}, {0, 0.3, 0}, 0.7);
  return scene;
}

/// Six arrangements beside each other: boxes that share a face; boxes that overlap; a ball in a ball in a
/// box, the last of index 1; tangent balls; a thin shell; a ball on a mirror. With `turned` the other way
/// round, since of surfaces at one place the one that is found first depends on the order.
Scene contacts(bool turned) {
  Scene scene = sky_of_one();
  add_box(scene, {1, 1, 1}, {-2, 1.5, 0}, 1.5);
  add_box(scene, {1, 1, 1}, {-2, 0.5, 0}, 1.33);
  add_box(scene, {1, 1, 1}, {0, 1, 0}, 1.5);
  add_box(scene, {1, 1, 0.75}, {0.25, 1.25, 0}, 1.33);
  add_box(scene, {1.25, 1.25, 1.25}, {2, 1, 0}, 1.33);
  add_sphere(scene, 0.5, {2, 1, 0}, 1.7);
  add_sphere(scene, 0.25, {2, 1, 0}, 1);
  add_sphere(scene, 0.5, {-2, -1, 0}, 1.5);
  add_sphere(scene, 0.5, {-1, -1, 0}, 1.7);
  add_sphere(scene, 0.5, {0.5, -1, 0}, 1.7);
  add_sphere(scene, 0.5 + 1.0 / (1 << 20), {0.5, -1, 0}, 1.5);
  add_sphere(scene, 0.5, {2, -1, 0}, 1.5);
  scene.materials.push_back(make_material(Kind::mirror, 1));
  scene.objects.push_back(
      make_object(Shape::rectangle,
                  Transform::rotate(0, -std::numbers::pi / 2).followed_by(Transform::shift({2, -1.5, 0})),
                  static_cast<int>(scene.materials.size()) - 1));
  if (turned) std::reverse(scene.objects.begin(), scene.objects.end());
  return scene;
}

/// The mean of a picture that is 1 everywhere, less four of its standard errors.
CheckResult furnace(CheckContext& context) {
  CheckResult result;
  result.tolerance = 1e-3;
  result.unit = "of radiance 1";
  const RenderBudget budget(context.inputs, 2, 64);
  for (const bool turned : {false, true}) {
    Scene scene = contacts(turned);
    scene.renderer.integrator = Integrator::pt;
    budget.apply(scene);
    const RenderResult rendered =
        render_for(context, scene, "triangles,spheres,mirror,glass,shadow_rays,environment,nested,walls");
    double sum = 0, squares = 0;
    for (const float value : rendered.picture.rgb) {
      sum += value - 1.0;
      squares += (value - 1.0) * (value - 1.0);
    }
    // Three channels of a pixel are one sample.
    const double values = static_cast<double>(rendered.picture.rgb.size());
    const double error =
        std::max(0.0, std::fabs(sum / values) - 4 * std::sqrt(squares / values / (values / 3)));
    if (!(error <= result.tolerance)) ++result.failures;
    if (!(error <= result.worst_error)) result.worst_error = error;
  }
  result.inputs = 2 * budget.inputs();
  return result;
}

constexpr const char* source = R"(
#include "scene/path_media.cl"
typedef struct {
  float point[3];
} Place;
kernel void around(global const Place *in, global uint *out, uint count, SCENE_PARAMETERS, Params params) {
  uint i = get_global_id(0);
  if (i >= count) return;
  SCENE_INIT(params);
  uint diagnostics = 0;
  MediumStack stack = media_around(&scene, (real3)(in[i].point[0], in[i].point[1], in[i].point[2]), &diagnostics);
  uint bits = 0;
  for (uint k = 0; k < stack.count; ++k) bits |= 1u << (stack.material[k] & 31u);
  bits |= (medium_stack_top(&stack) & 31u) << 20u;  // which fills the place
  out[i] = diagnostics == 0 ? bits : 0xffffffffu;
}
)";

struct Place {
  float point[3];
};

/// Bodies that hold each other and touch: boxes, balls and a torus, against winding numbers in double
/// precision. Half the places lie on the planes of symmetry, from where a ray is likeliest to meet an edge.
CheckResult inside(CheckContext& context) {
  Scene scene = sky_of_one();
  add_box(scene, {2, 2, 2}, {0, 0, 0}, 1.5);
  add_box(scene, {1, 3, 1}, {0.4375, 0, 0}, 1.33);
  add_sphere(scene, 1.25, {1, 0.5, 0}, 1.7);
  add_sphere(scene, 0.25, {1, 0.5, 0}, 1.1);
  scene.meshes = {torus(12, 8, 1.5, 0.4)};
  scene.objects.push_back(make_mesh_object(0, {}, add_glass(scene, 1.2)));
  scene.objects.back().smooth = false;
  const DeviceScene device_scene = update_device_scene(scene, context.device);
  const Params params = scene_params(scene, device_scene, 1);
  std::vector<Body> bodies;
  for (const int index : device_scene.dielectrics.bodies)
    bodies.push_back(make_body(scene, scene.objects[static_cast<std::size_t>(index)]));
  const unsigned first = static_cast<unsigned>(scene.materials.size());
  const auto program =
      context.program(source, EFFECT_TRIANGLES | EFFECT_SPHERES | EFFECT_GLASS | EFFECT_NESTED);
  CheckKernel kernel(context, program, "around");
  const DeviceScene& d = device_scene;
  kernel.with(d.nodes, d.blocks, d.attributes, d.shapes, d.curves, d.materials, d.textures, d.texels,
              d.emitters, d.environment, params);
  return run_random_check(
      context, 0, "wrong",
      [](InputRandom& random, std::uint64_t index) {
        Place in{};
        for (int axis = 0; axis < 3; ++axis)
          in.point[axis] = index % 2 && random.below(2) ? 0 : static_cast<float>(random.uniform(-2.25, 2.5));
        return in;
      },
      [&](const auto& inputs) { return kernel.run<std::uint32_t>(inputs); },
      [&](const Place& in, std::uint32_t bits) {
        const Vec3 p{in.point[0], in.point[1], in.point[2]};
        std::uint32_t expected = 0, top = 31;
        for (std::size_t k = 0; k < bodies.size(); ++k) {
          if (bodies[k].holds(p)) {
            expected |= 1u << ((first + k) & 31u);
            top = static_cast<std::uint32_t>(first + k) & 31u;
          }
          // On the surface itself either is right.
          for (const double scale : {0.999999, 1.000001})
            if (bodies[k].holds(p * scale) != bodies[k].holds(p)) return 0.0;
        }
        return bits == (expected | top << 20u) ? 0.0 : 1.0;
      });
}

}  // namespace

std::vector<Check> nested_checks() {
  return {{26, "glass in contact and in glass under an even sky of 1 is 1", 1, furnace, pass_programs},
          {26, "which bodies hold a point", 1, inside}};
}

}  // namespace causticl
