// The keys of the shapes and what they mean: host/shapes/NAME.cpp has both for each row of
// cl/shared/shapes.h.
#pragma once

#include "format/scene_keys.hpp"
#include "format/scene_loader.hpp"

namespace causticl {

/// The table of a shape: `own` keys after those of every object.
SceneTable shape_table(Object::Shape shape, const char* description, std::vector<SceneKey> own = {});

// NAME_keys(): the table. read_NAME(): sets what the shape's own keys say; transform, motion and pointer of
// the object are there.
#define CAUSTICL_DECLARE_KEYS(name) \
  const SceneTable& name##_keys();  \
  void read_##name(const SceneObject& json, Object& object, SceneLoader& loader);
#define CAUSTICL_DECLARE_SHAPE_KEYS(x, NAME, number, name, type, effect, points) CAUSTICL_DECLARE_KEYS(name)
#define CAUSTICL_DECLARE_TRIANGLES_KEYS(x, name, type) CAUSTICL_DECLARE_KEYS(name)
SHAPE_TABLE(CAUSTICL_DECLARE_SHAPE_KEYS, )
TRIANGLE_SHAPE_TABLE(CAUSTICL_DECLARE_TRIANGLES_KEYS, )
#undef CAUSTICL_DECLARE_KEYS
#undef CAUSTICL_DECLARE_SHAPE_KEYS
#undef CAUSTICL_DECLARE_TRIANGLES_KEYS

}  // namespace causticl
