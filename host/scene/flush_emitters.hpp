// Flat emitters that lie flush in another surface, as a panel of light in a ceiling.
#pragma once

#include "scene/scene.hpp"

namespace causticl {

/// Moves flat emitters that lie in an opaque flat surface, as far as single precision can tell, out of it:
/// rays would hit one or the other by chance. A one-sided emitter goes to the side that it shines to, a
/// two-sided one to the side on which it lies in double precision. It moves by a few roundings of the
/// coordinates there. Not where the two move apart; glass is left to cl/scene/contact.cl. Returns what was
/// moved, as sentences for the user.
std::vector<std::string> lift_flush_emitters(Scene& scene);

}  // namespace causticl
