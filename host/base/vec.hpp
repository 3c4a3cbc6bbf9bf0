// Vectors and affine maps of the host, in double precision.
#pragma once

#include <array>
#include <cmath>

namespace causticl {

struct Vec3 {
  double x = 0, y = 0, z = 0;

  double operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  double& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  bool operator==(const Vec3&) const = default;
};

inline Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
inline Vec3 operator*(Vec3 a, double s) { return {a.x * s, a.y * s, a.z * s}; }
inline Vec3 operator*(double s, Vec3 a) { return a * s; }
inline Vec3 operator/(Vec3 a, double s) { return {a.x / s, a.y / s, a.z / s}; }
inline double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vec3 a) { return std::sqrt(dot(a, a)); }
inline Vec3 normalize(Vec3 a) { return a / length(a); }
inline double max_component(Vec3 a) { return std::fmax(a.x, std::fmax(a.y, a.z)); }

/// An affine map x -> linear x + translation.
struct Transform {
  std::array<Vec3, 3> rows{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};  // of the linear part
  Vec3 translation;

  Vec3 vector(Vec3 v) const { return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)}; }
  Vec3 point(Vec3 p) const { return vector(p) + translation; }
  double determinant() const { return dot(rows[0], cross(rows[1], rows[2])); }

  /// The map that does `this` first and `then` after it.
  Transform followed_by(const Transform& then) const;
  /// The inverse map. The determinant must not be zero.
  Transform inverse() const;

  static Transform shift(Vec3 by);
  static Transform scale(Vec3 by);
  /// Right-handed rotation about a world axis, 0 for x, 1 for y, 2 for z.
  static Transform rotate(int axis, double radians);
  /// The same about a direction of unit length.
  static Transform rotate(Vec3 axis, double radians);
};

}  // namespace causticl
