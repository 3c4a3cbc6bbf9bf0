// The scene as primitives in world space: what the tree is built over and what emits.
#pragma once

#include <vector>

#include "accel/kdtree.hpp"
#include "scene/dielectrics.hpp"
#include "scene/scene.hpp"
#include "shared/types.h"

namespace causticl {

struct FlatScene {
  TreeInput tree;                              // all bounded primitives
  std::vector<TriangleAttributes> attributes;  // one per triangle of the tree
  std::vector<Shape> shapes;                   // infinite planes first
  uint plane_count = 0;
  std::vector<float> curves;  // data of the revolved curves
  std::vector<Emitter> emitters;
  std::vector<EnvironmentTexel> environment;
  double emitted_power = 0;  // of the largest channels of all emitters, over pi
};

/// The scene at `time`. Meshes, rectangles and boxes become world-space triangles, everything else becomes
/// shapes; emissive ones are listed as emitters, as are the lights that are no surfaces, with their
/// probabilities. Each body of `dielectrics` gets a material of its own, behind those of the scene.
FlatScene flatten_scene(const Scene& scene, double time = 0, const Dielectrics& dielectrics = {});

/// How many primitives it puts into the tree.
std::size_t bounded_primitives(const Scene& scene);

}  // namespace causticl
