// The walls that may part a visible point from the photons around it: the lists that cl/photons/walls.cl
// reads.
#pragma once

#include <cstddef>
#include <vector>

#include "scene/lit_sides.hpp"
#include "scene/scene.hpp"
#include "world/flat_scene.hpp"

namespace causticl {

/// A WallGrid with its lists and walls, as cl/shared/wall_records.h lays them out, for balls of at most
/// `radius` about visible points of the scene at `time`. A cell lists the surfaces near it if one of them has
/// surface on both sides that may hold photons of one normal. Where there is none, nothing parts photons from
/// a visible point.
std::vector<std::byte> wall_grid(const Scene& scene, const FlatScene& world, const LitSides& sides,
                                 double time, double radius);

/// The grid of a scene without walls.
std::vector<std::byte> no_walls();

}  // namespace causticl
