#include "kernels/gather_fixture.hpp"

using namespace causticl;

namespace {

std::uint64_t found(const std::vector<GatherSums>& sums) {
  std::uint64_t total = 0;
  for (const auto& sum : sums) total += sum.count;
  return total;
}

}  // namespace

TEST_CASE("the gather equals brute force exactly for every table, radius and place") {
  RandomInputs random(81);
  struct Case {
    Space space;
    double radius, cell;
    uint nx, ny, nz;
    Vec3 origin;
  };
  const Space room{{0, 0, 0}, 1}, far{{1e6, -3e5, 2e6}, 100};
  for (const Case& c : {
           Case{room, 0.1, 0.2, 1, 1, 1, {}},
           Case{room, 0.1, 0.2, 8, 1, 1, {}},
           Case{room, 0.1, 0.2, 8, 8, 8, {}},
           Case{room, 0.1, 0.2, 16, 16, 16, {}},
           Case{room, 0.1, 0.2, 32, 32, 32, {}},
           Case{room, 0.1, 0.2, 2, 64, 4, {}},
           Case{room, 0.3, 0.05, 4, 4, 2, {0.01, -7, 100}},       // windows wider than the table
           Case{room, 5, 0.1, 16, 16, 16, {}},                    // the radius holds everything
           Case{room, 0.1, 0.01, 64, 64, 64, {-50, 20, 0.5}},     // every window wraps
           Case{room, 1e-9, 2e-9, 64, 64, 64, {}},                // extent / 10^9
           Case{room, 1e-9, 1e-15, 64, 64, 64, {}},               // cubes past any integer
           Case{room, 1e-3, 1e30, 8, 8, 8, {}},                   // one cube for the world
           Case{{{-40, -70, -90}, 9}, 0.8, 1.1, 16, 16, 16, {}},  // negative cubes alone
           Case{far, 2, 4, 64, 64, 64, {}},
           Case{far, 2, 4, 32, 32, 32, {1e6, -3e5, 2e6}},
       }) {
    CAPTURE(c.radius, c.cell, c.nx, c.ny, c.nz);
    std::vector<Photon> photons;
    for (int i = 0; i < 8192; ++i) photons.push_back(photon_at(random, c.space.position(random)));
    // Clusters on cube borders and on the radius, where rounding decides.
    for (std::size_t i = 0; i < 2000; ++i) {
      const Photon near = photons[i];  // a copy: the vector grows
      const Vec3 p{near.position[0], near.position[1], near.position[2]};
      photons.push_back(
          photon_at(random, {std::round(p.x / c.cell) * c.cell, p.y, std::round(p.z / c.cell) * c.cell}));
      photons.back().normal = near.normal;
      photons.push_back(photon_at(random, p + Vec3{0, i % 2 ? c.radius : -c.radius, 0}));
      photons.back().normal = near.normal;
    }
    const Grid grid = make_grid(c.origin, c.cell, c.nx, c.ny, c.nz);
    auto points = points_near(random, photons, c.space, c.radius, 1024);
    for (int i = 0; i < 200; ++i)
      points.push_back(
          {photons[i].position[0], photons[i].position[1], photons[i].position[2], photons[i].normal});
    const auto radius2 = static_cast<float>(c.radius * c.radius);
    const auto expected = brute_force(points, photons, radius2);
    CHECK(found(expected) > 500);
    CHECK((gather(points, photons, grid, radius2) == expected));
  }
}

TEST_CASE("sides are told apart alike by floats, by bytes where the device has that, and exactly") {
  auto sides = build_test_program(R"(
#include "photons/gather.cl"
kernel void sides(global const uint *photons, global const uint *points, global uint2 *out, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  out[i] = (uint2)(same_side(as_int8((uint8)photons[i]), points[i]).s3, same_side_by_floats(as_int8((uint8)photons[i]), points[i]).s3);
}
)");
  RandomInputs random(88);
  const auto dot = [](uint a, uint b) {
    const auto p = normal_components(a), q = normal_components(b);
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
  };
  std::vector<uint> photons, points;
  int at_the_limit = 0;
  while (photons.size() < 100000 || at_the_limit < 100) {
    // Marks and probes in the highest byte are of no matter.
    const uint a = random_normal(random) | static_cast<uint>(random.engine()) << 24;
    const uint b = random_normal(random) | static_cast<uint>(random.engine()) << 24;
    const bool near_limit = dot(a, b) == 8064 || dot(a, b) == 8065;
    at_the_limit += near_limit;
    if (photons.size() >= 100000 && !near_limit) continue;
    photons.push_back(a);
    points.push_back(b);
  }
  const auto in = test_device().upload(photons, "photons"), of = test_device().upload(points, "points");
  const auto out = test_device().buffer(photons.size() * sizeof(uint2), "sides");
  run_kernel(sides, "sides", photons.size(), in, of, out, cl_uint(photons.size()));
  const auto found = test_device().download<uint2>(out, photons.size());
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < photons.size(); ++i) {
    const bool same = 2 * dot(photons[i], points[i]) > 127 * 127;
    wrong += (found[i].x != 0) != same || (found[i].y != 0) != same;
  }
  CHECK(wrong == 0);
}

TEST_CASE("gathered sums depend neither on the order of photons nor on the work-group") {
  RandomInputs random(82);
  const Space room{{0, 0, 0}, 1};
  std::vector<Photon> photons;
  for (int i = 0; i < 200000; ++i) photons.push_back(photon_at(random, room.position(random)));
  const Grid grid = make_grid({}, 0.1, 16, 16, 16);
  const auto points = points_near(random, photons, room, 0.05, 4096);
  const auto expected = gather(points, photons, grid, 0.0025f);
  CHECK(found(expected) > 4096);
  const WorkGroupSize restored;
  for (const std::size_t local : {1, 32, 256}) {
    test_device().set_local_size(local);
    std::shuffle(photons.begin(), photons.end(), random.engine);
    CHECK((gather(points, photons, grid, 0.0025f) == expected));
  }
}

TEST_CASE("a cell of more photons than the lanes can add up is summed exactly") {
  RandomInputs random(83);
  const std::size_t count =
      (1 << 19) + 100003;  // with all flux at its largest, lanes overflow without a flush
  std::vector<Photon> photons;
  const uint normal = pack_normal({0, 1, 0});
  for (std::size_t i = 0; i < count; ++i)
    photons.push_back(
        {{float(random.uniform(0, 0.01)), 0, float(random.uniform(0, 0.01))}, normal, 0xffffffffu, 0xffffu});
  std::vector<GatherPoint> points;
  for (int i = 0; i < 16; ++i) points.push_back({0.005f, 0, 0.005f, normal});
  const auto sums = gather(points, photons, make_grid({-1, -1, -1}, 0.2, 16, 16, 16), 0.01f);
  const std::uint64_t flux = count * 65535;
  const GatherSums expected{flux, flux, flux, count, flux, flux, flux};
  for (const auto& sum : sums) CHECK((sum == expected));
}

TEST_CASE("photons of the other side, of another wall or of no place are not found") {
  const Vec3 up{0, 1, 0};
  const auto at = [](Vec3 n) { return Photon{{0, 0, 0}, pack_normal(n), 1 | 1 << 16, 1}; };
  const std::vector<GatherPoint> points{{0, 0, 0, pack_normal(up)}};
  const auto count = [&](const Photon& photon) {
    return gather(points, {photon}, make_grid({}, 1, 4, 4, 4), 1)[0].count;
  };
  CHECK(count(at(up)) == 1);
  CHECK(count(at(-up)) == 0);
  CHECK(count(at({1, 0, 0})) == 0);
  CHECK(count(at({0, std::cos(1.0), std::sin(1.0)})) == 1);  // 57 degrees
  CHECK(count(at({0, std::cos(1.1), std::sin(1.1)})) == 0);  // 63 degrees
  Photon lost = at(up);
  lost.position[1] = NAN;
  CHECK(count(lost) == 0);
  lost.position[1] = INFINITY;
  CHECK(count(lost) == 0);
  // An empty map.
  CHECK((gather(points, {}, make_grid({}, 1, 4, 4, 4), 1)[0] == GatherSums{}));
}
