// Hard case 6: slabs, flat boxes and rays along an axis.
#include "accel/kdtree.hpp"
#include "scene/scene.hpp"
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
  float low[3], high[3], corner[3], extent, origin[3], direction[3];
} SlabInput;

INLINE Ray load_ray(global const float *o, global const float *d) {
  Ray ray = {(real3)(o[0], o[1], o[2]), (real3)(d[0], d[1], d[2])};
  return ray;
}

// The lanes that the ray meets of a node, and of a block of shapes in the next eight bits. Lane 0 is of the size of
// the whole tree, lane 1 the box, the others are unused.
kernel void met_lanes(global const SlabInput *in, global uint *out, uint count, global KdNode *nodes,
                      global TriangleBlock *blocks) {
  uint i = get_global_id(0);
  if (i >= count) return;
  for (uint axis = 0; axis < 3u; ++axis) {
    float corner = in[i].corner[axis], low = in[i].low[axis], high = in[i].high[axis], far = corner + in[i].extent;
    for (uint lane = 0; lane < 8u; ++lane) {
      nodes[i].bounds[axis][lane] = lane == 0 ? corner : lane == 1 ? low : FLT_MAX;
      nodes[i].bounds[axis + 3u][lane] = lane == 0 ? far : lane == 1 ? high : -FLT_MAX;
      blocks[i].position[0][axis][lane] = lane == 0 ? corner : lane == 1 ? low : NAN;
      blocks[i].position[1][axis][lane] = lane == 0 ? far : lane == 1 ? high : NAN;
      blocks[i].primitive[lane] = lane <= 1u ? BLOCK_SHAPE | lane : BLOCK_EMPTY;
    }
  }
  nodes[i].extent = in[i].extent;
  SlabRay ray = slab_ray(load_ray(in[i].origin, in[i].direction), nodes + i);
  float8 enter, leave;
  node_intervals(nodes + i, ray, &enter, &leave);
  out[i] = lane_bits(enter <= leave) | (block_shapes(blocks + i, ray, INFINITY) << 8u);
}

typedef struct {
  float origin[3], direction[3];
} AxisRay;

OUTLINE float2 through_tree_one(global const AxisRay *in, global const KdNode *nodes,
                                global const TriangleBlock *blocks, global const Shape *shapes) {
  Ray ray = load_ray(in->origin, in->direction);
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

struct SlabInput {
  float low[3], high[3];
  float corner[3], extent;  // of the tree: its low corner, and its longest edge
  float origin[3], direction[3];
};

float signed_zero(InputRandom& random) { return random.below(2) ? 0.0f : -0.0f; }

/// One number above or below `value`, or, next to 0, a tiny part of `size`: products of denormals vanish.
float neighbour(InputRandom& random, float value, double size) {
  const int step = random.below(2) ? 1 : -1;
  return value == 0 ? static_cast<float>(step * 1e-20 * size) : next_float(value, step);
}

/// A coordinate on one of the two planes of a slab, one number beside it, between, or outside.
float beside_slab(InputRandom& random, float low, float high, double size) {
  const float plane = random.below(2) ? low : high;
  switch (random.below(6)) {
    case 0:
    case 1:
      return plane;
    case 2:
      return neighbour(random, plane, size);
    case 3:
      return static_cast<float>(low + random.uniform() * (static_cast<double>(high) - low));
    case 4:
      return static_cast<float>(plane + size * random.uniform(-1, 1));
    default:
      return static_cast<float>(plane + std::copysign(size * random.scale(-7, 2), random.uniform(-1, 1)));
  }
}

/// A box that is flat along none, one or two axes, in a tree that is as large or larger, and a ray: along
/// an axis, within a plane of two axes, with a component that is next to nothing, or at a point of the box.
SlabInput slab_input(InputRandom& random, std::uint64_t index) {
  SlabInput in{};
  const double size = random.scale(-8, 8);
  const Vec3 center = random.below(3) ? random.direction() * (size * random.scale(-1, 3)) : Vec3{};
  const bool alone = random.below(2) == 0;
  const int solid = static_cast<int>(random.below(3));
  Vec3 target;
  for (int axis = 0; axis < 3; ++axis) {
    const double half = axis == solid || random.below(2) ? size * random.uniform(0.05, 1) : 0;
    in.low[axis] = static_cast<float>(center[axis] - half);
    in.high[axis] = static_cast<float>(center[axis] + half);
    in.corner[axis] = in.low[axis];
    if (!alone) in.corner[axis] -= static_cast<float>(size * random.scale(-1, 2));
    in.extent = std::fmax(in.extent, next_float(in.high[axis] - in.corner[axis], 1));
    in.origin[axis] = beside_slab(random, in.low[axis], in.high[axis], size);
    target[axis] = random.below(3) == 0 ? random.uniform(in.low[axis], in.high[axis])
                   : random.below(2)    ? in.low[axis]
                                        : in.high[axis];
  }
  if (!alone) in.extent *= static_cast<float>(random.scale(0, 1));

  Vec3 direction = random.direction();
  const Vec3 way = target - Vec3{in.origin[0], in.origin[1], in.origin[2]};
  if (random.below(2) && length(way) > 0) direction = normalize(way);
  const int axis = static_cast<int>(random.below(3)),
            other = (axis + 1 + static_cast<int>(random.below(2))) % 3;
  switch (index % 4) {
    case 0:
      for (int k = 0; k < 3; ++k) {
        in.direction[k] = signed_zero(random);
        if (k == axis) in.direction[k] = direction[k] < 0 ? -1.0f : 1.0f;
      }
      return in;
    case 1:
      direction[axis] = 0;
      break;
    case 2:
      direction[axis] = std::copysign(random.scale(-30, -6), direction[axis]);
      if (random.below(2)) direction[other] = std::copysign(random.scale(-30, -6), direction[other]);
      break;
    default:
      break;
  }
  if (!(length(direction) > 0)) direction[other] = 1;
  direction = normalize(direction);
  for (int k = 0; k < 3; ++k)
    in.direction[k] = direction[k] == 0 ? signed_zero(random) : static_cast<float>(direction[k]);
  return in;
}

/// Whether the ray meets the box made wider by `margin`; in double, with division only where it is allowed.
bool hits_box(const SlabInput& in, double margin) {
  double enter = 0, leave = INFINITY;
  for (int axis = 0; axis < 3; ++axis) {
    const double o = in.origin[axis], d = in.direction[axis];
    const double low = in.low[axis] - margin, high = in.high[axis] + margin;
    if (d == 0) {
      if (o < low || o > high) return false;
      continue;
    }
    const double a = (low - o) / d, b = (high - o) / d;
    enter = std::fmax(enter, std::fmin(a, b));
    leave = std::fmin(leave, std::fmax(a, b));
  }
  return enter <= leave;
}

/// A box that the ray meets, or passes within the four roundings by which a triangle in it may still be met,
/// is met. One that it passes at twice the roundings that the slabs are widened by (8 of the distance to the
/// farthest point of the tree, 2 of the origin), is not: else a test that is always true would pass. Unused
/// lanes never are.
CheckResult slab_test(CheckContext& context) {
  CheckKernel kernel(context, context.program(source, EFFECT_TRIANGLES | EFFECT_SPHERES), "met_lanes");
  const cl::Buffer nodes = context.device.buffer(check_batch * sizeof(KdNode), "nodes of a check");
  const cl::Buffer blocks = context.device.buffer(check_batch * sizeof(TriangleBlock), "blocks of a check");
  kernel.with(nodes, blocks);
  return run_random_check(
      context, 0, "", slab_input, [&](const auto& inputs) { return kernel.run<std::uint32_t>(inputs); },
      [](const SlabInput& in, std::uint32_t lanes) -> double {
        double farthest = 0, largest = 0;
        for (int axis = 0; axis < 3; ++axis) {
          farthest = std::fmax(farthest, std::fabs(static_cast<double>(in.origin[axis]) - in.corner[axis]));
          largest = std::fmax(largest, std::fabs(in.origin[axis]));
        }
        farthest += in.extent;
        const bool node = lanes & 2u, block = lanes & 0x200u;
        if ((lanes & ~0x303u) != 0 || node != block) return 1;
        if (hits_box(in, 4 * 0x1p-24 * farthest)) return node ? 0 : 1;
        return node && !hits_box(in, 20 * 0x1p-24 * (farthest + largest)) ? 1 : 0;
      });
}

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

std::vector<Check> slab_checks() {
  return {{6, "slab test of boxes, flat ones too: no false miss", 1, slab_test},
          {6, "rays along an axis through flat boxes of triangles", 1, boxes_in_tree}};
}

}  // namespace causticl
