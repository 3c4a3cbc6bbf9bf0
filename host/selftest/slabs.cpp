// Hard case 6: the slab test of boxes, flat ones too.
#include "selftest/edge_values.hpp"
#include "selftest/random_check.hpp"
#include "selftest/stability_checks.hpp"
#include "shared/effects.h"
#include "shared/types.h"

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
)";

struct SlabInput {
  float low[3], high[3];
  float corner[3], extent;  // of the tree: its low corner, and its longest edge
  float origin[3], direction[3];
};

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

}  // namespace

std::vector<Check> slab_checks() {
  return {{6, "slab test of boxes, flat ones too: no false miss", 1, slab_test}};
}

}  // namespace causticl
