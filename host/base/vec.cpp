#include "base/vec.hpp"

namespace causticl {

Transform Transform::followed_by(const Transform& then) const {
  Transform result;
  const Vec3 columns[3] = {{rows[0].x, rows[1].x, rows[2].x},
                           {rows[0].y, rows[1].y, rows[2].y},
                           {rows[0].z, rows[1].z, rows[2].z}};
  for (int i = 0; i < 3; ++i)
    result.rows[i] = {dot(then.rows[i], columns[0]), dot(then.rows[i], columns[1]),
                      dot(then.rows[i], columns[2])};
  result.translation = then.point(translation);
  return result;
}

Transform Transform::inverse() const {
  const double d = determinant();
  const Vec3 c0 = cross(rows[1], rows[2]) / d, c1 = cross(rows[2], rows[0]) / d,
             c2 = cross(rows[0], rows[1]) / d;
  Transform result;
  result.rows = {Vec3{c0.x, c1.x, c2.x}, Vec3{c0.y, c1.y, c2.y}, Vec3{c0.z, c1.z, c2.z}};
  result.translation = -result.vector(translation);
  return result;
}

Transform Transform::shift(Vec3 by) {
  Transform result;
  result.translation = by;
  return result;
}

Transform Transform::scale(Vec3 by) {
  Transform result;
  result.rows = {Vec3{by.x, 0, 0}, Vec3{0, by.y, 0}, Vec3{0, 0, by.z}};
  return result;
}

Transform Transform::rotate(int axis, double radians) {
  const double c = std::cos(radians), s = std::sin(radians);
  Transform result;
  const int j = (axis + 1) % 3, k = (axis + 2) % 3;
  result.rows[j] = {};
  result.rows[k] = {};
  result.rows[j][j] = c;
  result.rows[j][k] = -s;
  result.rows[k][j] = s;
  result.rows[k][k] = c;
  return result;
}

// Rodrigues: v cos + (a x v) sin + a (a . v) (1 - cos).
Transform Transform::rotate(Vec3 a, double radians) {
  const double c = std::cos(radians), s = std::sin(radians);
  Transform result;
  result.rows = {Vec3{c + a.x * a.x * (1 - c), a.x * a.y * (1 - c) - a.z * s, a.x * a.z * (1 - c) + a.y * s},
                 Vec3{a.y * a.x * (1 - c) + a.z * s, c + a.y * a.y * (1 - c), a.y * a.z * (1 - c) - a.x * s},
                 Vec3{a.z * a.x * (1 - c) - a.y * s, a.z * a.y * (1 - c) + a.x * s, c + a.z * a.z * (1 - c)}};
  return result;
}

}  // namespace causticl
