// Whether the camera sees anything at all.
#pragma once

#include <string>

#include "scene/scene.hpp"

namespace causticl {

/// What the user should know where no object lies in the camera's view; else empty. No claim is made of a
/// camera with a lens, of a scene that moves, and where bounds of an object reach into the view.
std::string empty_view_notice(const Scene& scene);

}  // namespace causticl
