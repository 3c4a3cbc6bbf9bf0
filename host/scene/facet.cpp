#include "scene/facet.hpp"

namespace causticl {

BoundingBox Facet::bounds() const {
  BoundingBox box;
  for (const Vec3 p : corner) box.add(p);
  return box;
}

void add_quad(std::vector<Facet>& facets, Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  facets.push_back({{a, b, c}});
  facets.push_back({{a, c, d}});
}

}  // namespace causticl
