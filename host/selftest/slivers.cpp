// Hard case 5: slivers, tiny, degenerate and duplicate triangles.
#include "selftest/stability_checks.hpp"
#include "selftest/triangle_pairs.hpp"

namespace causticl {
namespace {

Vec3 in_cube(InputRandom& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

Vec3 rounded(Vec3 p) {
  return {double(static_cast<float>(p.x)), double(static_cast<float>(p.y)), double(static_cast<float>(p.z))};
}

/// A triangle with edges of `size` and `size` times `ratio`, or with three long edges and that height.
TreeTriangle sliver(InputRandom& random, Vec3 center, double size, double ratio) {
  const Vec3 along = random.direction();
  const Vec3 across = normalize(cross(along, random.direction()));
  const Vec3 a = center - along * (0.5 * size), b = center + along * (0.5 * size);
  const Vec3 near = random.below(2) ? b : center + along * (random.uniform(-0.4, 0.4) * size);
  return make_triangle(a, b, near + across * (ratio * size));
}

/// A triangle without area: a point, two equal vertices, three on a line, or one that is no number.
TreeTriangle without_area(InputRandom& random) {
  const Vec3 a = rounded(in_cube(random, 1)), b = rounded(in_cube(random, 1));
  switch (random.below(6)) {
    case 0:
      return make_triangle(a, a, a);
    case 1:
      return make_triangle(a, b, a);
    case 2: {  // on a line through the origin, 2^40 times as far
      const Vec3 far = a * 0x1p40;
      return make_triangle(a, a * -2, far);
    }
    case 3: {  // on a line between points whose coordinates have few digits
      Vec3 p, step;
      for (int k = 0; k < 3; ++k) {
        p[k] = (random.below(2048) - 1024.0) / 1024;
        step[k] = (random.below(64) - 32.0) / 1024;
      }
      return make_triangle(p, p + step * 3.0, p + step * 7.0);
    }
    case 4: {  // on a line through the origin as well, but differences of its vertices need more than 53 bits
      const Vec3 v = Vec3{1, 3, 5} * 0.25;
      return make_triangle(v * (0x1p-40 * (1 + 0x1p-20)), v, v * 3.0);
    }
    default: {
      TreeTriangle triangle = make_triangle(a, b, in_cube(random, 1));
      triangle.position[random.below(3)][random.below(3)] = random.below(2) ? NAN : INFINITY;
      return triangle;
    }
  }
}

struct Debris {
  TriangleMesh mesh;
  std::vector<bool> degenerate;
  std::uint64_t degenerate_count = 0;
};

/// Needles to 1 : 10^6, areas to 1e-20, triangles without area, and all of them again.
Debris make_debris(std::uint32_t seed) {
  Debris debris;
  InputRandom random(seed, 0);
  for (int i = 0; i < 1200; ++i) {
    const bool degenerate = i % 3 == 0;
    debris.degenerate_count += 2 * degenerate;
    debris.mesh.push_back(degenerate   ? without_area(random)
                          : i % 3 == 1 ? sliver(random, in_cube(random, 1), 1, random.scale(-6, 0))
                                       : sliver(random, in_cube(random, 1e-9), 1e-9, random.scale(-2, 0)));
    debris.degenerate.push_back(degenerate);
  }
  for (int i = 0; i < 1200; ++i) {
    debris.mesh.push_back(debris.mesh[i]);
    debris.degenerate.push_back(debris.degenerate[i]);
  }
  return debris;
}

CheckResult degenerate_skipped(CheckContext& context) {
  const Debris debris = make_debris(context.seed);
  MeshSet meshes(context, {debris.mesh});
  const auto aimed_ray = [&](InputRandom& random, std::uint64_t) {
    const auto& triangle = debris.mesh[random.below(static_cast<std::uint32_t>(debris.mesh.size()))];
    const double s = random.below(2) ? random.uniform() : 0, t = random.uniform() * (1 - s);
    const Vec3 target = triangle_vertex(triangle, 0) * (1 - s - t) + triangle_vertex(triangle, 1) * s +
                        triangle_vertex(triangle, 2) * t;
    const Vec3 origin = in_cube(random, 2);
    return make_mesh_ray(origin, length(target) < 1e6 ? target : Vec3{}, 0);
  };
  CheckResult result = run_random_check(
      context, 0, "", aimed_ray, [&](const auto& rays) { return meshes.closest(rays); },
      [&](const MeshRay&, const MeshHit& hit) {
        if (hit.triangle == BLOCK_EMPTY) return std::isnan(hit.t) ? 1.0 : 0.0;
        return hit.t > 0 && std::isfinite(hit.t) && !debris.degenerate[hit.triangle] ? 0.0 : 1.0;
      });
  const std::uint64_t skipped = meshes.tree(0).skipped;
  if (skipped != debris.degenerate_count) ++result.failures;
  result.note = std::to_string(skipped) + " of " + std::to_string(debris.mesh.size()) +
                " triangles skipped, " + std::to_string(debris.degenerate_count) + " have no area";
  return result;
}

/// Rays to points well inside triangles of all sizes, areas down to 1e-20. The shear rounds vertices by about
/// four units of the largest coordinate, which moves the hit by that over the cosine; the error is in such
/// units, and infinite for a miss.
CheckResult tiny_met(CheckContext& context) {
  TrianglePairs pairs(context, TriangleTest::watertight);
  const auto aimed_pair = [](InputRandom& random, std::uint64_t) {
    const double size = random.scale(-10, 3);
    const Vec3 center = in_cube(random, size);
    TrianglePair pair{{}, {}, sliver(random, center, size, random.uniform(0.2, 1))};
    const Vec3 a = triangle_vertex(pair.triangle, 0), b = triangle_vertex(pair.triangle, 1),
               c = triangle_vertex(pair.triangle, 2);
    const double s = random.uniform(0.1, 0.8), t = random.uniform(0.1, 0.9 - s);
    const Vec3 target = a + (b - a) * s + (c - a) * t, normal = normalize(cross(b - a, c - a));
    Vec3 out = random.direction();
    while (std::fabs(dot(out, normal)) < 0.2) out = random.direction();
    const MeshRay ray = make_mesh_ray(target + out * (size * random.uniform(0.1, 10)), target, 0);
    std::copy_n(ray.origin, 3, pair.origin);
    std::copy_n(ray.direction, 3, pair.direction);
    return pair;
  };
  return run_random_check(
      context, 8, "roundings", aimed_pair, [&](const auto& inputs) { return pairs.run(inputs); },
      [](const TrianglePair& pair, const PairHit& hit) {
        const Vec3 origin{pair.origin[0], pair.origin[1], pair.origin[2]};
        const ExactHit exact =
            exact_hit(pair.triangle, origin, {pair.direction[0], pair.direction[1], pair.direction[2]});
        const double largest = length(origin) + length(triangle_vertex(pair.triangle, 0));
        return std::fabs(hit.t - exact.t) / (0x1p-24 * largest / exact.cosine);
      });
}

/// The normal of a sliver is a small difference of large products. Where the sine between two edges is above
/// 0.1 they are rounded as they come: six times 2^-24 over 0.1 and a little for what follows; below, hardly
/// at all.
CheckResult normals(CheckContext& context) {
  struct Normal {
    float n[3];
  };
  CheckKernel kernel(context, context.program(R"(
#include "shapes/triangle.cl"
kernel void normals(global const float *triangles, global float *out, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  global const float *v = triangles + 9 * i;
  real3 n = triangle_normal((real3)(v[0], v[1], v[2]), (real3)(v[3], v[4], v[5]), (real3)(v[6], v[7], v[8]));
  out[3 * i] = (float)n.x, out[3 * i + 1] = (float)n.y, out[3 * i + 2] = (float)n.z;
}
)"),
                     "normals");
  return run_random_check(
      context, 4e-6, "absolute",
      [](InputRandom& random, std::uint64_t) {
        const double size = random.scale(-10, 10);
        return sliver(random, in_cube(random, 0.5 * size), size, random.scale(-6, 0));
      },
      [&](const auto& triangles) { return kernel.run<Normal>(triangles); },
      [](const TreeTriangle& triangle, const Normal& found) {
        const Vec3 a = triangle_vertex(triangle, 0);
        const Vec3 exact =
            normalize(cross(triangle_vertex(triangle, 1) - a, triangle_vertex(triangle, 2) - a));
        return length(Vec3{found.n[0], found.n[1], found.n[2]} - exact);
      });
}

}  // namespace

std::vector<Check> sliver_checks() {
  return {{5, "triangles without area are skipped, none is met", 1, degenerate_skipped},
          {5, "triangles of area 1e-20 are met", 2, tiny_met},
          {5, "normals of slivers 1 : 10^6", 1, normals}};
}

}  // namespace causticl
