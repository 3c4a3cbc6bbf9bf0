// Which effects a scene calls for, and by what: the kernels are compiled for these and nothing else.
#pragma once

#include <string>
#include <vector>

#include "scene.hpp"

namespace causticl {

struct Effect {
  unsigned bit;  // EFFECT_* of cl/effects.h
  std::string name;
  std::string reason;  // what calls for it; empty where nothing does
};

/// One row for every effect there is, in the order of their bits.
using Effects = std::vector<Effect>;

/// A pure function of the scene. Implications come last (a texture that makes texels diffuse needs nothing
/// more; a disc light is a disk).
Effects find_effects(const Scene& scene);

/// The bits of the effects that something calls for.
unsigned effect_bits(const Effects& effects);

}  // namespace causticl
