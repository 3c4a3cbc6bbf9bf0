// What programs ask about a material, by its row of MATERIAL_TABLE.
#include "shared/effects.h"
#include "shared/materials.h"
#include "core/prelude.cl"

// Whether a material is of the kind of a row. No material is where the program is compiled without its effect.
#define IS_KIND(kind, NAME, effect) (((effect) == 0u || HAS(effect)) && (kind) == MATERIAL_##NAME)

#define KIND_HAS(wanted, NAME, number, name, effect, family, layers, fields, properties, ...) \
  || ((((family) | (layers) | (properties)) & (wanted)) != 0u && IS_KIND(kind, NAME, effect))

// Every lobe has an effect: the code of programs that do not know it is left out by HAS().
#define LOBE_HAS_EFFECT(x, NAME, number, name, effect, family, ...) && ((family) == LAMBERT || (effect) != 0u)
typedef char every_lobe_has_an_effect[1 MATERIAL_TABLE(LOBE_HAS_EFFECT, ) ? 1 : -1];

INLINE bool is_diffuse(uint kind) { return false MATERIAL_TABLE(KIND_HAS, DIFFUSE_FAMILIES); }
INLINE bool scatters(uint kind) { return false MATERIAL_TABLE(KIND_HAS, SCATTERS); }
INLINE bool transmits(uint kind) { return false MATERIAL_TABLE(KIND_HAS, TRANSMITS); }
INLINE bool is_layered(uint kind) { return false MATERIAL_TABLE(KIND_HAS, LAYERED); }
INLINE bool stores_photons(uint kind) { return false MATERIAL_TABLE(KIND_HAS, STORES_PHOTONS); }
INLINE bool bounds_body(uint kind) { return false MATERIAL_TABLE(KIND_HAS, BOUNDS_BODY); }

// The effects of the materials with a property, for HAS().
#define EFFECT_IF_HAS(wanted, NAME, number, name, effect, family, layers, fields, properties, ...) \
  | ((((family) | (layers) | (properties)) & (wanted)) != 0u ? (effect) : 0u)
#define EFFECTS_OF_MATERIALS(wanted) (0u MATERIAL_TABLE(EFFECT_IF_HAS, wanted))
