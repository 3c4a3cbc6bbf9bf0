// Hard case 6: rays along an axis through flat boxes of triangles.
#include "accel/kdtree.hpp"
#include "scene/scene.hpp"
#include "selftest/edge_values.hpp"
#include "selftest/random_check.hpp"
#include "selftest/stability_checks.hpp"
#include "shared/effects.h"
#include "shared/types.h"
#include "world/flat_scene.hpp"

namespace causticl {
namespace {

constexpr const char* source = R"(
#include "shapes/shape.cl"
#include "traversal/kdtree.cl"
typedef struct {
  float origin[3], direction[3];
} AxisRay;

OUTLINE float2 through_tree_one(global const AxisRay *in, global const KdNode *nodes,
                                global const TriangleBlock *blocks, global const Shape *shapes) {
  global const float *o = in->origin, *d = in->direction;
  Ray ray = {(real3)(o[0], o[1], o[2]), (real3)(d[0], d[1], d[2])};
  Hit hit = {INFINITY, HIT_NONE, 0, 0, 0};
  kdtree_closest(nodes, blocks, shapes, 0, ray, &hit);
  uint diagnostics = 0;
  bool occluded = kdtree_occluded(nodes, blocks, shapes, 0, ray, INFINITY, &diagnostics);
  return (float2)(hit.t, occluded && diagnostics == 0 && hit.diagnostics == 0);
}
kernel void through_tree(global const AxisRay *in, global float2 *out, uint count, global const KdNode *nodes,
                         global const TriangleBlock *blocks, global const Shape *shapes) {
  uint i = get_global_id(0);
  if (i < count) out[i] = through_tree_one(in + i, nodes, blocks, shapes);
}
)";

/// A rectangle of the oracle: its bounds, exact, and the axis along which it is flat.
struct Rectangle {
  float low[3], high[3];
  int axis;
};

struct AxisRay {
  float origin[3], direction[3];
};

/// Rectangles and boxes as a scene file has them, on a lattice of quarters so that many share planes; one box
/// in three is a millionth of a millionth thick, which rounds to two coincident rectangles and four without
/// area.
Scene flat_boxes() {
  InputRandom random(6, 0);
  Scene scene;
  scene.materials.emplace_back();
  for (int i = 0; i < 48; ++i) {
    Object object;
    object.shape = i % 2 ? Object::Shape::box : Object::Shape::rectangle;
    Vec3 scale;
    for (int axis = 0; axis < 3; ++axis) {
      scale[axis] = 0.5 * (1 + random.below(3));
      object.transform.translation[axis] = 0.25 * (static_cast<int>(random.below(17)) - 8);
    }
    if (i % 6 == 1) scale[static_cast<int>(random.below(3))] = 1e-12;
    // Turns the rectangle's normal to each axis by exchanging axes, which rounds nothing.
    const int turn = i / 2 % 3;
    for (int row = 0; row < 3; ++row) {
      object.transform.rows[row] = {};
      object.transform.rows[row][(row + turn) % 3] = scale[row];
    }
    scene.objects.push_back(object);
  }
  return scene;
}

std::vector<Rectangle> rectangles(const FlatScene& world) {
  std::vector<Rectangle> all;
  // Two triangles each.
  for (std::size_t i = 0; i + 1 < world.tree.triangles.size(); i += 2) {
    Rectangle r{{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, 0};
    for (std::size_t t = i; t < i + 2; ++t)
      for (const auto& vertex : world.tree.triangles[t].position)
        for (int axis = 0; axis < 3; ++axis) {
          r.low[axis] = std::fmin(r.low[axis], vertex[axis]);
          r.high[axis] = std::fmax(r.high[axis], vertex[axis]);
        }
    int flat = 0;
    for (int axis = 0; axis < 3; ++axis)
      if (r.low[axis] == r.high[axis]) r.axis = axis, ++flat;
    if (flat == 1) all.push_back(r);
  }
  return all;
}

/// A ray along an axis, its zeros of either sign; each coordinate of its origin is on the lattice of the
/// boxes' edges, one number beside it, or anywhere.
AxisRay axis_ray(InputRandom& random, std::uint64_t) {
  AxisRay in{};
  const auto axis = random.below(3);
  for (std::uint32_t k = 0; k < 3; ++k) {
    const float lattice = 0.25f * static_cast<float>(static_cast<int>(random.below(25)) - 12);
    const std::uint32_t kind = random.below(4);
    in.origin[k] = kind < 2    ? lattice
                   : kind == 2 ? neighbour(random, lattice, 1)
                               : static_cast<float>(random.uniform(-3, 3));
    in.direction[k] = k == axis ? (random.below(2) ? 1.0f : -1.0f) : signed_zero(random);
  }
  return in;
}

/// The first rectangle across the ray's axis, its edges included: signs are exact there. The distance is a
/// weighted mean of three equal numbers, after eight roundings of less than an ulp each: a vertex's
/// difference, a product, two sums, two more of the weights, their inverse and the product with it.
/// Rectangles along the ray are not met.
CheckResult boxes_in_tree(CheckContext& context) {
  const FlatScene world = flatten_scene(flat_boxes());
  const std::vector<Rectangle> faces = rectangles(world);
  const KdTree tree = build_kdtree(world.tree, context.threads);
  const cl::Buffer nodes = context.device.upload(tree.nodes, "tree nodes");
  const cl::Buffer blocks = context.device.upload(tree.blocks, "triangle blocks");
  const cl::Buffer shapes = context.device.upload(std::vector<Shape>(1), "shapes");
  CheckKernel kernel(context, context.program(source, EFFECT_TRIANGLES | EFFECT_SPHERES), "through_tree");
  kernel.with(nodes, blocks, shapes);
  CheckResult result = run_random_check(
      context, 8, "ulp", axis_ray, [&](const auto& inputs) { return kernel.run<float2>(inputs); },
      [&](const AxisRay& in, float2 out) -> double {
        int axis = 0;
        while (in.direction[axis] == 0) ++axis;
        double expected = INFINITY;
        for (const auto& face : faces) {
          bool within = face.axis == axis;
          for (int k = 0; k < 3 && within; ++k)
            within = k == axis || (in.origin[k] >= face.low[k] && in.origin[k] <= face.high[k]);
          if (!within) continue;
          const double t = (static_cast<double>(face.low[axis]) - in.origin[axis]) * in.direction[axis];
          if (t > 0) expected = std::fmin(expected, t);
        }
        const bool hit = std::isfinite(out.x);
        if ((out.y != 0) != hit || hit != std::isfinite(expected)) return INFINITY;
        return hit ? std::fabs(out.x - expected) / std::ldexp(1.0, std::ilogb(expected) - 23) : 0;
      });
  result.note = std::to_string(faces.size()) + " rectangles, " + std::to_string(tree.skipped) +
                " triangles without area";
  return result;
}

}  // namespace

std::vector<Check> flat_box_checks() {
  return {{6, "rays along an axis through flat boxes of triangles", 1, boxes_in_tree}};
}

}  // namespace causticl
