// What the host asks about a light, by its row of LIGHT_TABLE.
#pragma once

#include "scene/scene.hpp"
#include "shared/effects.h"
#include "shared/lights.h"

namespace causticl {

/// A row of LIGHT_TABLE.
struct LightRow {
  LightSpec::Kind kind;
  unsigned number;             // in records
  const char* name;            // as scene files say it: "spot"
  unsigned effect;             // of EFFECT_TABLE; 0 where those of its body suffice
  unsigned family_properties;  // DELTA, BACKGROUND, ..., BEYOND_SCENE
  unsigned keys;
  const char* text;         // "spot light"
  const char* description;  // "light that shines ..."
};

#define ROW_OF_LIGHT(x, NAME, number, name, effect, family, properties, keys, text, description) \
  {LightSpec::Kind::name, number, #name, effect, (family) | (properties), keys, text, description},
/// In the order of LightSpec::Kind.
constexpr LightRow light_rows[] = {LIGHT_TABLE(ROW_OF_LIGHT, )};
#undef ROW_OF_LIGHT

constexpr const LightRow& row_of(LightSpec::Kind kind) { return light_rows[static_cast<unsigned>(kind)]; }

/// Whether the kind is of one of the families or has one of the properties.
constexpr bool has_property(LightSpec::Kind kind, unsigned wanted) {
  return (row_of(kind).family_properties & wanted) != 0;
}

/// Whether all of its light comes from LightSpec::position.
constexpr bool shines_from_point(LightSpec::Kind kind) {
  return has_property(kind, DELTA) && !has_property(kind, BEYOND_SCENE);
}

// A record says by one of 32 bits which light it is; those below 16 are left to surfaces.
static_assert([] {
  unsigned seen = 0xffff;
  for (const LightRow& row : light_rows) {
    if (row.number > 31 || (seen >> row.number & 1) != 0) return false;
    seen |= 1u << row.number;
  }
  return true;
}());

}  // namespace causticl
