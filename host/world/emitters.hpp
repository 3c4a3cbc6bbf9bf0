// The lights of a scene that are no surfaces, and how all emitters share the choice among them.
#pragma once

#include "world/flat_scene.hpp"

namespace causticl {

/// Appends the scene's delta lights and environment to the surfaces that are emitters of the world already,
/// gives each its probability, and fills the environment's table.
void finish_emitters(const Scene& scene, const Dielectrics& dielectrics, FlatScene& world);

}  // namespace causticl
