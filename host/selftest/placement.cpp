// Hard case 9: the whole scene far from the origin, tiny or huge.
#include <cmath>

#include "selftest/scene_parts.hpp"
#include "selftest/stability_checks.hpp"

namespace causticl {
namespace {

using Kind = MaterialSpec::Kind;

/// A room of four units with one object of each kind, moved by `shift`; its first radius is chosen from the
/// scene. Where it is moved by 10^6, floats are 1/16 apart, and points of surfaces are known and left by some
/// such steps: a unit of 256 makes that a thousandth of a unit. All vertices are multiples of 1/64 unit, so
/// that the room keeps its shape.
Scene room(double unit, Vec3 shift, Integrator integrator) {
  Scene scene;
  scene.max_depth = 8;
  scene.renderer.integrator = integrator;
  scene.materials = {make_material(Kind::diffuse, 0.7), make_material(Kind::mirror, 0.9),
                     make_material(Kind::glass, 1), make_material(Kind::diffuse, 0, 8)};
  TextureSpec checker;
  checker.kind = TextureSpec::Kind::checker;
  checker.a = {0.8, 0.6, 0.4};
  checker.b = {0.3, 0.4, 0.6};
  checker.scale = {8, 8};
  scene.textures = {checker};
  scene.materials[0].color_texture = 0;
  const Transform place = Transform::scale({unit, unit, unit}).followed_by(Transform::shift(shift));
  const auto at = [&](Vec3 p) { return place.point(p); };

  Mesh mesh = torus(12, 8, 0.5, 0.1875);
  for (auto& p : mesh.positions)
    for (double& x : p) x = std::round(x * 64) / 64;
  scene.meshes = {mesh};
  Object box = make_object(Object::Shape::box, place, 0);
  box.size = {4, 4, 4};
  Object emitter = make_object(Object::Shape::disk,
                               Transform::rotate(0, std::numbers::pi / 2)
                                   .followed_by(Transform::shift({0, 1.875, 0}))
                                   .followed_by(place),
                               3);
  emitter.radius = 0.75;
  scene.objects = {box, emitter,
                   make_mesh_object(0, Transform::shift({-0.75, -1, -0.5}).followed_by(place), 2),
                   make_sphere(at({0.25, -1.5, 0.75}), 0.5 * unit, 1),
                   make_sphere(at({-1.25, 1.25, 1.25}), 0.25 * unit, 3)};
  scene.camera = make_camera(at({0.25, 0, 1.875}), at({0, -0.75, 0}), 1.5);
  return scene;
}

/// The root of the mean squared difference of two pictures beside the mean of the second.
double relative_rmse(const Picture& a, const Picture& b) {
  double squares = 0, sum = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) {
    const double difference = static_cast<double>(a.rgb[i]) - b.rgb[i];
    squares += difference * difference;
    sum += b.rgb[i];
  }
  const double count = static_cast<double>(a.rgb.size());
  return std::sqrt(squares / count) / (sum / count);
}

double relative_difference_of_means(const Picture& a, const Picture& b) {
  double sum_a = 0, sum_b = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) {
    sum_a += a.rgb[i];
    sum_b += b.rgb[i];
  }
  return std::fabs(sum_a - sum_b) / sum_b;
}

void take(CheckResult& result, double error) {
  result.failures += !(error <= result.tolerance);
  if (!(error <= result.worst_error)) result.worst_error = error;
}

Picture picture_of(CheckContext& context, const RenderBudget& budget, Scene scene) {
  budget.apply(scene);
  return render_for(context, scene).picture;
}

/// Powers of two scale every float of a computation without rounding, unless a length is compared with a
/// constant: 2^20 is 10^6. The pictures are the same to the bit where divisions and roots round alike at all
/// exponents; elsewhere a few paths may go other ways.
CheckResult scaled(CheckContext& context) {
  CheckResult result;
  result.tolerance = 1e-3;
  result.unit = "relative RMSE";
  const RenderBudget budget(context.inputs, 6, 16);
  for (const Integrator integrator : {Integrator::pt, Integrator::sppm}) {
    const Picture unscaled = picture_of(context, budget, room(1, {}, integrator));
    for (const double unit : {0x1p-20, 0x1p20})
      take(result, relative_rmse(picture_of(context, budget, room(unit, {}, integrator)), unscaled));
  }
  result.inputs = 6 * budget.inputs();
  return result;
}

/// The same paths go the same ways but where a step decides, so that both pictures have much of their noise
/// in common.
CheckResult moved(CheckContext& context) {
  CheckResult result;
  result.tolerance = 5e-3;
  result.unit = "relative, of the mean";
  const RenderBudget budget(context.inputs, 4, 16);
  // A sample's standard deviation is about the mean's; half of it is in common, and four are granted.
  const double noise = 4 * std::sqrt(0.5 / static_cast<double>(budget.inputs()));
  for (const Integrator integrator : {Integrator::pt, Integrator::sppm}) {
    const double difference =
        relative_difference_of_means(picture_of(context, budget, room(256, {1e6, -1e6, 1e6}, integrator)),
                                     picture_of(context, budget, room(256, {}, integrator)));
    take(result, std::max(0.0, difference - noise));
  }
  result.inputs = 4 * budget.inputs();
  return result;
}

}  // namespace

std::vector<Check> placement_checks() {
  return {{9, "a scene scaled by 2^20 and 2^-20 is the same picture", 10, scaled, pass_programs},
          {9, "a scene moved by 10^6 units is the same picture", 10, moved, pass_programs}};
}

}  // namespace causticl
