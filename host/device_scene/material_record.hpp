// A material as the kernels read it.
#pragma once

#include "scene/scene.hpp"
#include "shared/types.h"

namespace causticl {

/// `outside_ior` is the index of what surrounds the scene: those of records are relative to it.
Material material_record(const MaterialSpec& spec, double outside_ior);

}  // namespace causticl
