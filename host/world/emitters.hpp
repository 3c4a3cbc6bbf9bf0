// The lights of a scene that are no surfaces, and how all emitters share the choice among them.
#pragma once

#include "world/flat_scene.hpp"

namespace causticl {

/// How many emitters there are from that of a light that is lit, index into Scene::lights, to the last.
std::size_t emitters_from(const Scene& scene, int light);

/// Appends the scene's lights to the surfaces that are emitters of the world already,
/// gives each its probability, and fills the tables of their maps.
void finish_emitters(const Scene& scene, const Dielectrics& dielectrics, FlatScene& world);

}  // namespace causticl
