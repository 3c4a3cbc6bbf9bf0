// On which sides of its surfaces a scene may be lit, or seen.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.hpp"

namespace causticl {

/// For each triangle and each shape, in the order of flatten_scene(): 1 where only the side of its normal may
/// be lit or seen, of a sphere the outer one, -1 where only the other may be, else 0. Revolved curves have 0.
struct LitSides {
  std::vector<int> triangles, shapes;
  std::vector<std::int32_t> parts;  // of each triangle: the connected part of a mesh, by number; -1 of others
};

/// Neither light nor the camera is inside of what is closed and opaque and has no emitter and no part of the
/// lens within its bounds, or on the side of something flat where there is nothing at all.
LitSides lit_sides(const Scene& scene);

/// Whether the inside of a sphere or a box may be lit, or seen.
bool may_be_lit_inside(const Scene& scene, const Object& object);

/// Of a flat object: front_side, back_side or both.
int sides_that_may_be_lit(const Scene& scene, const Object& object);

}  // namespace causticl
