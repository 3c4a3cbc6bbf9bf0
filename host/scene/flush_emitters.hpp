// Flat emitters that lie flush in another surface, as a lamp that is drawn on a ceiling.
#pragma once

#include "scene/scene.hpp"

namespace causticl {

/// Moves flat emitters that lie in an opaque surface, as far as single precision can tell, clear of it: rays
/// would meet one or the other by chance. The emitter goes to the side of the surface that it lies on in
/// double precision; where it lies exactly in it, to the side that its normal points to, so that it shines.
/// Returns the pointers of those that were moved.
std::vector<std::string> lift_flush_emitters(Scene& scene);

}  // namespace causticl
