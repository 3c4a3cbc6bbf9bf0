// Rays against one triangle each, on the device and in double precision.
#pragma once

#include "selftest/mesh_set.hpp"

namespace causticl {

struct TrianglePair {
  float origin[3], direction[3];
  TreeTriangle triangle;
};

/// What the triangle test says: an infinite t where the ray misses, and the weights of vertices 1 and 2.
struct PairHit {
  float t, weight_1, weight_2;
};

class TrianglePairs {
 public:
  TrianglePairs(CheckContext& context, TriangleTest triangle_test);

  std::vector<PairHit> run(const std::vector<TrianglePair>& pairs);

 private:
  Device& device_;
  TriangleTest triangle_test_;
  CheckKernel kernel_;
};

/// The same in double precision (Möller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection",
/// 1997).
struct ExactHit {
  double t = 0, weight_1 = 0, weight_2 = 0;
  double margin = -1;  // the smallest of the three weights: how far inside; below 0 where the ray misses
  double cosine = 0;   // between ray and normal
};
ExactHit exact_hit(const TreeTriangle& triangle, Vec3 origin, Vec3 direction);

}  // namespace causticl
