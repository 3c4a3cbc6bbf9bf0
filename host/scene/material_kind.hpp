// What the host asks about a material, by its row of MATERIAL_TABLE.
#pragma once

#include <iterator>

#include "scene/scene.hpp"
#include "shared/effects.h"
#include "shared/materials.h"

namespace causticl {

// Rows of MATERIAL_TABLE stand in the order of their numbers: readers take the one for the other.
#define NUMBER_OF_ROW(x, NAME, number, ...) number,
constexpr unsigned material_numbers[] = {MATERIAL_TABLE(NUMBER_OF_ROW, )};
#undef NUMBER_OF_ROW
static_assert([] {
  for (unsigned i = 0; i < std::size(material_numbers); ++i)
    if (material_numbers[i] != i) return false;
  return true;
}());

/// Whether the kind has one of the properties: LAMBERT, TRANSMITS, LAYERED, STORES_PHOTONS, BOUNDS_BODY, ...
constexpr bool has_property(MaterialSpec::Kind kind, unsigned wanted) {
  switch (kind) {
#define PROPERTY_OF_ROW(x, NAME, number, name, effect, family, layers, fields, properties, ...) \
  case MaterialSpec::Kind::name:                                                                \
    return (((family) | (layers) | (properties)) & wanted) != 0;
    MATERIAL_TABLE(PROPERTY_OF_ROW, )
#undef PROPERTY_OF_ROW
  }
  return false;
}

/// The effect of EFFECT_TABLE that stands for the kind; 0 for one that every program knows.
constexpr unsigned effect_of(MaterialSpec::Kind kind) {
  switch (kind) {
#define EFFECT_OF_ROW(x, NAME, number, name, effect, family, layers, fields, properties, ...) \
  case MaterialSpec::Kind::name:                                                              \
    return effect;
    MATERIAL_TABLE(EFFECT_OF_ROW, )
#undef EFFECT_OF_ROW
  }
  return 0;
}

/// As scene files say it: "glass".
constexpr const char* name_of(MaterialSpec::Kind kind) {
  switch (kind) {
#define NAME_OF_ROW(x, NAME, number, name, effect, family, layers, fields, properties, ...) \
  case MaterialSpec::Kind::name:                                                            \
    return #name;
    MATERIAL_TABLE(NAME_OF_ROW, )
#undef NAME_OF_ROW
  }
  return "";
}

/// The effects of all kinds with one of the properties.
constexpr unsigned effects_of_kinds(unsigned wanted) {
  unsigned effects = 0;
#define EFFECTS_OF_ROW(x, NAME, number, name, effect, family, layers, fields, properties, ...) \
  if (has_property(MaterialSpec::Kind::name, wanted)) effects |= effect;
  MATERIAL_TABLE(EFFECTS_OF_ROW, )
#undef EFFECTS_OF_ROW
  return effects;
}

/// Whether light may go through it somewhere. A texture may make parts of a surface opaque: see
/// alpha_diffuse.
inline bool is_transparent(const MaterialSpec& material) { return has_property(material.kind, TRANSMITS); }

/// Whether it encloses a dielectric.
inline bool bounds_body(const MaterialSpec& material) { return has_property(material.kind, BOUNDS_BODY); }

}  // namespace causticl
