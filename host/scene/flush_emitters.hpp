// Flat emitters and panes that lie flush in another surface: a panel of light in a ceiling, a window in a
// wall.
#pragma once

#include "scene/scene.hpp"

namespace causticl {

/// Moves flat emitters, and flat panes of thin glass, that lie in a flat surface, as far as single precision
/// can tell, out of it: rays would hit one or the other by chance. A one-sided emitter goes to the side that
/// it shines to, any other to the side on which it lies in double precision. It moves by a few roundings of
/// the coordinates there. Not where the two move apart; emitters in the faces of dielectric bodies are left
/// to cl/scene/contact.cl. Returns what was moved, as sentences for the user.
std::vector<std::string> lift_flush_emitters(Scene& scene);

}  // namespace causticl
