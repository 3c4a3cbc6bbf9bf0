// What in a scene calls for each effect.
#pragma once

#include <string>

#include "scene/scene.hpp"
#include "shared/effects.h"

namespace causticl {

/// What calls for the effect, by JSON pointer: "sphere /objects/0 and 2 more"; empty where nothing does. A
/// pure function of the scene. A row of EFFECT_TABLE without such a function does not link.
template <EffectBit effect>
std::string effect_reason(const Scene& scene);

#define DECLARE_REASON(x, name, bit, key, programs, scalar, geometry, text) \
  template <>                                                               \
  std::string effect_reason<EFFECT_##name>(const Scene& scene);
EFFECT_TABLE(DECLARE_REASON, )
#undef DECLARE_REASON

}  // namespace causticl
