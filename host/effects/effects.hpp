// Which effects a scene calls for, and by what: the kernels are compiled for these and nothing else.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace causticl {

struct Effect {
  unsigned bit;        // EFFECT_* of cl/shared/effects.h
  std::string key;     // one word, as --effects takes it
  std::string name;    // what it is called in text
  std::string reason;  // what calls for it, by JSON pointer; empty where nothing does
};

/// One row for every effect there is, in the order of their bits.
using Effects = std::vector<Effect>;

/// A pure function of the scene.
Effects find_effects(const Scene& scene);

/// The bits of the effects that something calls for.
unsigned effect_bits(const Effects& effects);

/// The bits to compile kernels for by --effects: "auto" (what the scene calls for), "all", or a list of keys
/// with commas between. Throws UserError for a key that is none, or a list that lacks what the scene calls
/// for.
unsigned chosen_effects(const Effects& effects, const std::string& choice);

/// "triangles, spheres": the keys of these bits.
std::string effect_keys(const Effects& effects, unsigned bits);

}  // namespace causticl
