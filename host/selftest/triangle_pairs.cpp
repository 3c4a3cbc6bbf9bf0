#include "selftest/triangle_pairs.hpp"

namespace causticl {
namespace {

const std::string source = R"(
#include "shapes/triangle.cl"
typedef struct {
  float origin[3], direction[3];
  float triangle[9];  // in the blocks as well
} TrianglePair;
typedef struct {
  float t, weight_1, weight_2;
} PairHit;
// Triangle i is in lane i mod 8 of block i / 8.
kernel void triangle_pairs(global const TrianglePair *pairs, global PairHit *hits, uint count,
                           global const TriangleBlock *blocks) {
  uint i = get_global_id(0);
  if (i >= count) return;
  global const TrianglePair *in = pairs + i;
  Ray ray = {(real3)(in->origin[0], in->origin[1], in->origin[2]),
             (real3)(in->direction[0], in->direction[1], in->direction[2])};
  real8 t = (real8)INFINITY, weight_1 = (real8)0, weight_2 = (real8)0;
  block_intersect(blocks + i / 8u * BLOCK_STRIDE, triangle_ray(ray), (real)INFINITY, &t, &weight_1, &weight_2);
  real all[24];
  vstore8(t, 0, all);
  vstore8(weight_1, 1, all);
  vstore8(weight_2, 2, all);
  PairHit hit = {(float)all[i % 8u], (float)all[8u + i % 8u], (float)all[16u + i % 8u]};
  hits[i] = hit;
}
)";

}  // namespace

TrianglePairs::TrianglePairs(CheckContext& context, TriangleTest triangle_test)
    : device_(context.device),
      triangle_test_(triangle_test),
      kernel_(context, context.program(triangle_test_define(triangle_test) + source), "triangle_pairs") {}

std::vector<PairHit> TrianglePairs::run(const std::vector<TrianglePair>& pairs) {
  TriangleMesh mesh(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) mesh[i] = pairs[i].triangle;
  const auto blocks = device_.upload(blocks_in_order(mesh, triangle_test_), "triangle blocks");
  return kernel_.with(blocks).run<PairHit>(pairs);
}

ExactHit exact_hit(const TreeTriangle& triangle, Vec3 origin, Vec3 direction) {
  const Vec3 a = triangle_vertex(triangle, 0), e = triangle_vertex(triangle, 1) - a,
             f = triangle_vertex(triangle, 2) - a;
  const Vec3 p = cross(direction, f), s = origin - a, q = cross(s, e), n = cross(e, f);
  const double determinant = dot(e, p);
  ExactHit hit;
  if (determinant == 0) return hit;
  hit.weight_1 = dot(s, p) / determinant;
  hit.weight_2 = dot(direction, q) / determinant;
  hit.t = dot(f, q) / determinant;
  hit.margin = std::min({hit.weight_1, hit.weight_2, 1 - hit.weight_1 - hit.weight_2});
  hit.cosine = std::fabs(dot(n, direction)) / (length(n) * length(direction));
  return hit;
}

}  // namespace causticl
