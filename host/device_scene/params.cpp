#include "device_scene/params.hpp"

namespace causticl {

void set_nested(Params& params, const Dielectrics& dielectrics) {
  if (dielectrics.bodies.empty()) return;
  params.nested = NESTED_ON | (dielectrics.holds_camera ? NESTED_CAMERA : 0u) |
                  (dielectrics.touches_emitter ? NESTED_EMITTERS : 0u);
  for (int axis = 0; axis < 3; ++axis) {
    params.inside_direction[axis] = static_cast<float>(dielectrics.inside_direction[axis]);
    params.contact_low[axis] = std::nextafter(static_cast<float>(dielectrics.contact.low[axis]), -INFINITY);
    params.contact_high[axis] = std::nextafter(static_cast<float>(dielectrics.contact.high[axis]), INFINITY);
  }
}

}  // namespace causticl
