// What the host asks about the shapes of objects: one file a shape, host/shapes/NAME.cpp, and its row of
// cl/shared/shapes.h.
#pragma once

#include "scene/facet.hpp"
#include "scene/object_triangles.hpp"
#include "shared/effects.h"
#include "shared/types.h"

namespace causticl {

/// An object as one primitive of the device, in the world.
struct ShapePrimitive {
  /// Without its material. `curve` and `area_table` count from the begin of `curves`.
  Shape shape{};
  std::vector<float> curves;  // its part of the curve buffer
  BoundingBox bounds;         // padded by what single precision may lose; empty if it is infinite
  double area = 0;            // 0 where it cannot emit
  Emitter emitter{};          // type and place alone
};

/// A wall that is no triangle, with its bounds.
struct ShapeWall {
  Wall wall;
  Vec3 low, high;
};

/// A shape. Functions take objects of that shape alone. Transforms are those at time 0, unless said
/// otherwise.
class ShapeKind {
 public:
  virtual ~ShapeKind() = default;

  /// Whether it lies in the plane z = 0 of its local space, and its front looks to +z.
  virtual bool is_flat() const { return false; }
  /// Whether it has no bounds. An infinite shape is flat.
  virtual bool is_infinite() const { return false; }
  /// Whether the object is the whole surface of a convex body.
  virtual bool is_convex_body(const Object&) const { return false; }

  /// A box around the object in its local space: low and high corner.
  virtual std::array<Vec3, 2> local_box(const Scene& scene, const Object& object) const = 0;
  /// Bounds of the object in the world, as close as its shape allows.
  virtual BoundingBox bounds(const Scene& scene, const Object& object) const;

  /// The triangles that it is made of: see visit_triangles(). None of a shape that is a primitive.
  virtual bool visit_triangles(const Scene&, const Object&, const TriangleVisitor&) const { return true; }
  virtual std::size_t triangles(const Scene&, const Object&) const { return 0; }

  /// A primitive that is neither infinite nor a ball, cut into flat pieces. `pieces` are those along a curve.
  virtual void add_facets(const Object&, int pieces, std::vector<Facet>&) const { static_cast<void>(pieces); }
  /// Whether these facets, whose rounding may leave gaps, stand for a closed surface.
  virtual bool is_closed_of_facets(const Object&) const { return false; }
  /// The radius in the world where the object is a ball about its local origin; else 0.
  virtual double ball_radius(const Object&) const { return 0; }

  /// The object as a primitive of the device, `placed` in the world. Not of triangles. What only emission
  /// needs is there where it `emits`.
  virtual ShapePrimitive primitive(const Object& placed, bool emits) const;
  /// The primitive as one wall; false where its facets are walls.
  virtual bool wall(const Shape&, ShapeWall&) const { return false; }
};

#define CAUSTICL_DECLARE_SHAPE(x, NAME, number, name, type, effect, points) const ShapeKind& name##_shape();
#define CAUSTICL_DECLARE_TRIANGLES(x, name, type) const ShapeKind& name##_shape();
SHAPE_TABLE(CAUSTICL_DECLARE_SHAPE, )
TRIANGLE_SHAPE_TABLE(CAUSTICL_DECLARE_TRIANGLES, )
#undef CAUSTICL_DECLARE_SHAPE
#undef CAUSTICL_DECLARE_TRIANGLES

const ShapeKind& kind_of(Object::Shape shape);
inline const ShapeKind& kind_of(const Object& object) { return kind_of(object.shape); }
/// By its number in records of the device.
const ShapeKind& kind_of_record(const Shape& shape);

/// As scene files call it.
const char* name_of(Object::Shape shape);
/// The effect that stands for it.
EffectBit effect_of(Object::Shape shape);
/// Whether it becomes triangles on upload.
bool is_made_of_triangles(const Object& object);

inline bool is_flat(const Object& object) { return kind_of(object).is_flat(); }
inline bool is_infinite(const Object& object) { return kind_of(object).is_infinite(); }

}  // namespace causticl
