// State of many rays or paths that is kept by component, an array for each, so that loops over its entries become vector
// code (vector.cl). What belongs together is declared once, by a list of rows; the fields of the struct, and what loads,
// stores and moves an entry, are made of that list:
//   ROW(x, shape, type, name, member, effects)
// `name` is the field of the state and `member` that of what an entry of it is put together to; `effects` are those with
// which it is kept, or ALWAYS.
#include "shared/effects.h"
#include "core/prelude.cl"
#include "core/stream_size.cl"

#define ALWAYS 0u
#define IS_KEPT(effects) ((effects) == ALWAYS || (EFFECTS & (effects)) != 0u)

// Shapes: SCALAR is of `type`. VECTOR has the components x, y, z of a member of type type3. PARTS are three members whose
// names go on with x, y, z; ARRAY is a member of three.
#define COMPONENT_FIELD(x, shape, type, name, member, effects) \
  FIELD_##shape(type, name, IS_KEPT(effects) ? STREAM_CAPACITY : 1u)
#define FIELD_SCALAR(type, name, count) type name[count];
#define FIELD_VECTOR(type, name, count) type name[3][count];
#define FIELD_PARTS(type, name, count) type name[3][count];
#define FIELD_ARRAY(type, name, count) type name[3][count];

// Statements about entry `i` of what `state` points to: into `entry`, out of it, and from entry `from`.
#define LOAD_ENTRY(entry, shape, type, name, member, effects) \
  if (IS_KEPT(effects)) LOAD_##shape(entry, type, name, member);
#define LOAD_SCALAR(entry, type, name, member) entry.member = state->name[i]
#define LOAD_VECTOR(entry, type, name, member) \
  entry.member = (type##3)(state->name[0][i], state->name[1][i], state->name[2][i])
#define LOAD_PARTS(entry, type, name, member) \
  entry.member##x = state->name[0][i], entry.member##y = state->name[1][i], entry.member##z = state->name[2][i]
#define LOAD_ARRAY(entry, type, name, member) \
  entry.member[0] = state->name[0][i], entry.member[1] = state->name[1][i], entry.member[2] = state->name[2][i]

#define STORE_ENTRY(entry, shape, type, name, member, effects) \
  if (IS_KEPT(effects)) STORE_##shape(entry, name, member);
#define STORE_SCALAR(entry, name, member) state->name[i] = entry.member
#define STORE_VECTOR(entry, name, member) \
  state->name[0][i] = entry.member.x, state->name[1][i] = entry.member.y, state->name[2][i] = entry.member.z
#define STORE_PARTS(entry, name, member) \
  state->name[0][i] = entry.member##x, state->name[1][i] = entry.member##y, state->name[2][i] = entry.member##z
#define STORE_ARRAY(entry, name, member) \
  state->name[0][i] = entry.member[0], state->name[1][i] = entry.member[1], state->name[2][i] = entry.member[2]

#define MOVE_ENTRY(from, shape, type, name, member, effects) \
  if (IS_KEPT(effects)) MOVE_##shape(from, name);
#define MOVE_SCALAR(from, name) state->name[i] = state->name[from]
#define MOVE_VECTOR(from, name) \
  state->name[0][i] = state->name[0][from], state->name[1][i] = state->name[1][from], state->name[2][i] = state->name[2][from]
#define MOVE_PARTS(from, name) MOVE_VECTOR(from, name)
#define MOVE_ARRAY(from, name) MOVE_VECTOR(from, name)
