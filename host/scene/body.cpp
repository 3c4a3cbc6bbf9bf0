#include "scene/body.hpp"

#include <algorithm>
#include <map>
#include <numbers>

#include "scene/shape_kind.hpp"

namespace causticl {
namespace {

/// Pieces along a curve.
constexpr int curve_pieces = 64;

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

std::vector<Facet> object_facets(const Scene& scene, const Object& object) {
  std::vector<Facet> facets;
  kind_of(object).add_facets(object, curve_pieces, facets);
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
  body.radius = kind_of(object).ball_radius(object);
  if (body.radius > 0) {
    body.centre = object.transform.translation;
    body.closed = true;
    return body;
  }
  body.facets = object_facets(scene, object);
  body.closed = kind_of(object).is_closed_of_facets(object) || is_closed(body.facets);
  return body;
}

bool Body::holds(Vec3 point) const {
  if (radius > 0) return length(point - centre) < radius;
  if (is_infinite(*object)) return object->transform.inverse().point(point).z < 0;
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
  if (is_infinite(*object)) sum = object->transform.inverse().rows[2];
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
