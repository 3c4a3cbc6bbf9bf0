#include "scene/body.hpp"

#include <algorithm>
#include <map>
#include <numbers>

#include "scene/object_triangles.hpp"

namespace causticl {
namespace {

// Pieces along a revolved curve and around its axis, and around a disk.
constexpr int curve_steps = 64, curve_turns = 32, disk_turns = 64;

void add_quad(std::vector<Facet>& facets, Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  facets.push_back({{a, b, c}});
  facets.push_back({{a, c, d}});
}

std::array<double, 2> curve_point(std::vector<std::array<double, 2>> p, double t) {
  for (std::size_t n = p.size(); n > 1; --n)
    for (std::size_t i = 0; i + 1 < n; ++i)
      for (int k = 0; k < 2; ++k) p[i][k] += (p[i + 1][k] - p[i][k]) * t;
  return p[0];
}

/// The normal of a revolved curve points away from the axis side on which the area swept lies: outward where
/// the closed profile runs upward outside.
void add_curve(std::vector<Facet>& facets, const Object& object) {
  std::vector<std::array<double, 2>> profile;
  for (int i = 0; i <= curve_steps; ++i)
    profile.push_back(curve_point(object.points, static_cast<double>(i) / curve_steps));
  double area = 0;  // of the profile closed along the axis, positive where it runs upward outside
  for (std::size_t i = 0; i + 1 < profile.size(); ++i)
    area +=
        0.5 * (std::fabs(profile[i][0]) + std::fabs(profile[i + 1][0])) * (profile[i + 1][1] - profile[i][1]);
  const auto point = [&](std::size_t i, int turn) {
    const double angle = 2 * std::numbers::pi * (turn % curve_turns) / curve_turns,
                 r = std::fabs(profile[i][0]);
    return object.transform.point({r * std::cos(angle), profile[i][1], r * std::sin(angle)});
  };
  const bool turned = (area < 0) != (object.transform.determinant() < 0);
  for (std::size_t i = 0; i + 1 < profile.size(); ++i)
    for (int turn = 0; turn < curve_turns; ++turn) {
      const Vec3 a = point(i, turn), b = point(i + 1, turn), c = point(i + 1, turn + 1),
                 d = point(i, turn + 1);
      if (turned)
        add_quad(facets, a, d, c, b);
      else
        add_quad(facets, a, b, c, d);
    }
}

void add_disk(std::vector<Facet>& facets, const Object& object) {
  const auto point = [&](int turn) {
    const double angle = 2 * std::numbers::pi * turn / disk_turns;
    return object.transform.point({object.radius * std::cos(angle), object.radius * std::sin(angle), 0});
  };
  const bool mirrored = object.transform.determinant() < 0;
  for (int turn = 0; turn < disk_turns; ++turn) {
    const Vec3 a = point(turn), b = point(turn + 1);
    facets.push_back(mirrored ? Facet{{object.transform.translation, b, a}}
                              : Facet{{object.transform.translation, a, b}});
  }
}

/// Whether every edge runs as often one way as the other, corners told apart by their place.
bool is_closed(const std::vector<Facet>& facets) {
  using Place = std::array<double, 3>;
  std::map<Place, int> numbers;
  std::map<std::pair<int, int>, int> edges;
  const auto number = [&](Vec3 p) {
    return numbers.try_emplace(Place{p.x + 0.0, p.y + 0.0, p.z + 0.0}, static_cast<int>(numbers.size()))
        .first->second;
  };
  for (const auto& facet : facets) {
    int corner[3];
    for (int i = 0; i < 3; ++i) corner[i] = number(facet.corner[i]);
    for (int i = 0; i < 3; ++i) {
      const int from = corner[i], to = corner[(i + 1) % 3];
      if (from < to) ++edges[{from, to}];
      if (from > to) --edges[{to, from}];
    }
  }
  return !facets.empty() &&
         std::all_of(edges.begin(), edges.end(), [](const auto& edge) { return edge.second == 0; });
}

bool is_closed_curve(const Object& object) {
  const auto& first = object.points.front();
  const auto& last = object.points.back();
  return first == last || (first[0] == 0 && last[0] == 0);
}

/// Solid angle under which a facet is seen, over 4 pi, positive where its outside is turned away.
double winding(const Facet& facet, Vec3 point) {
  const Vec3 a = facet.corner[0] - point, b = facet.corner[1] - point, c = facet.corner[2] - point;
  const double la = length(a), lb = length(b), lc = length(c);
  const double y = dot(a, cross(b, c));
  const double x = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
  return std::atan2(y, x) / (2 * std::numbers::pi);
}

/// 1 where a ray leaves through the front of the facet, -1 where it enters by it, 0 where it misses (Moller &
/// Trumbore 1997).
int crossing(const Facet& facet, Vec3 origin, Vec3 direction) {
  const Vec3 e = facet.corner[1] - facet.corner[0], f = facet.corner[2] - facet.corner[0];
  const Vec3 p = cross(direction, f), from = origin - facet.corner[0], q = cross(from, e);
  const double determinant = dot(e, p);
  if (determinant == 0) return 0;
  const double u = dot(from, p) / determinant, v = dot(direction, q) / determinant;
  if (u < 0 || v < 0 || u + v > 1 || !(dot(f, q) / determinant > 0)) return 0;
  return determinant < 0 ? 1 : -1;
}

}  // namespace

BoundingBox Facet::bounds() const {
  BoundingBox box;
  for (const Vec3 p : corner) box.add(p);
  return box;
}

std::vector<Facet> object_facets(const Scene& scene, const Object& object) {
  std::vector<Facet> facets;
  if (object.shape == Object::Shape::bezier) add_curve(facets, object);
  if (object.shape == Object::Shape::disk) add_disk(facets, object);
  visit_triangles(scene, object, [&](const TriangleCorner(&c)[3], bool) {
    facets.push_back({{c[0].position, c[1].position, c[2].position}});
    return true;
  });
  return facets;
}

Body make_body(const Scene& scene, const Object& object) {
  Body body;
  body.object = &object;
  body.bounds = object_bounds(scene, object);
  if (object.shape == Object::Shape::sphere) {
    body.centre = object.transform.translation;
    body.radius = object.radius * std::cbrt(std::fabs(object.transform.determinant()));
    body.closed = true;
    return body;
  }
  body.facets = object_facets(scene, object);
  body.closed = object.shape == Object::Shape::bezier ? is_closed_curve(object) : is_closed(body.facets);
  return body;
}

bool Body::holds(Vec3 point) const {
  if (radius > 0) return length(point - centre) < radius;
  if (object->shape == Object::Shape::plane) return object->transform.inverse().point(point).z < 0;
  if (!closed) {
    const Vec3 direction = mean_normal();
    int exits = 0;
    for (const auto& facet : facets) exits += crossing(facet, point, direction);
    return exits > 0;
  }
  if (!causticl::holds(bounds, point)) return false;
  double sum = 0;
  for (const auto& facet : facets) sum += winding(facet, point);
  return sum > 0.5;
}

Vec3 Body::mean_normal() const {
  Vec3 sum;
  if (object->shape == Object::Shape::plane) sum = object->transform.inverse().rows[2];
  for (const auto& facet : facets) sum = sum + facet.normal();
  const double size = length(sum);
  return size > 0 ? sum / size : Vec3{};
}

std::vector<Vec3> surface_points(const Body& body) {
  constexpr std::size_t most = 200;
  std::vector<Vec3> points;
  if (body.radius > 0)
    for (int i = 0; i < 64; ++i) {  // a spiral from pole to pole
      const double z = 1 - (2 * i + 1) / 64.0, r = std::sqrt(1 - z * z), angle = 2.399963229728653 * i;
      points.push_back(body.centre + body.radius * Vec3{r * std::cos(angle), r * std::sin(angle), z});
    }
  const std::size_t step = body.facets.size() / (most / 2) + 1;
  for (std::size_t i = 0; i < body.facets.size(); i += step) {
    const auto& c = body.facets[i].corner;
    points.push_back(c[0]);
    points.push_back((c[0] + c[1] + c[2]) / 3);
  }
  return points;
}

}  // namespace causticl
