#include <cstring>

#include "selftest/photon_grid.hpp"
#include "vector_inputs.hpp"

using namespace causticl;

namespace {

cl::Program& program() {
  static cl::Program built = build_test_program(gather_source);
  return built;
}

std::vector<GatherSums> gather(const std::vector<GatherPoint>& points, const std::vector<Photon>& photons,
                               const Grid& grid, float radius2) {
  return gather_photons(test_device(), program(), points, photons, grid, radius2);
}

std::vector<GatherSums> brute_force(const std::vector<GatherPoint>& points,
                                    const std::vector<Photon>& photons, float radius2) {
  std::vector<GatherSums> result;
  for (const GatherPoint& point : points) result.push_back(gather_brute_force(point, photons, radius2));
  return result;
}

/// Where photons and points lie: in a box of half size `extent` about `center`, normals along the axes or
/// anyhow.
struct Space {
  Vec3 center;
  double extent;
  Vec3 position(RandomInputs& random) const {
    return center + Vec3{random.uniform(-extent, extent), random.uniform(-extent, extent),
                         random.uniform(-extent, extent)};
  }
};

uint random_normal(RandomInputs& random) {
  if (random.uniform() < 0.5) return pack_normal(random_direction(random));
  Vec3 n;
  n[static_cast<int>(random.uniform(0, 3))] = random.uniform() < 0.5 ? -1 : 1;
  return pack_normal(n);
}

Photon photon_at(RandomInputs& random, Vec3 p) {
  return {{float(p.x), float(p.y), float(p.z)},
          random_normal(random),
          static_cast<uint>(random.engine()),
          static_cast<uint>(random.engine()) & 0xffffu};
}

/// Points, half of them beside photons, so that the smallest radii find some too.
std::vector<GatherPoint> points_near(RandomInputs& random, const std::vector<Photon>& photons,
                                     const Space& space, double radius, std::size_t count) {
  std::vector<GatherPoint> points;
  for (std::size_t i = 0; i < count; ++i) {
    Vec3 p = space.position(random);
    uint normal = random_normal(random);
    if (i % 2 && !photons.empty()) {
      const Photon& photon = photons[random.engine() % photons.size()];
      p = Vec3{photon.position[0], photon.position[1], photon.position[2]} +
          random_direction(random) * (radius * random.uniform());
      normal = photon.normal;
    }
    points.push_back({float(p.x), float(p.y), float(p.z), normal});
  }
  return points;
}

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

TEST_CASE("gather_photons estimates radiance by equation (7) and updates each pixel") {
  RandomInputs random(84);
  constexpr uint pixels = 500, first = 100, samples = 4;
  const Space room{{0, 0, 0}, 1};
  std::vector<Photon> photons, of_kind[PHOTON_KINDS];
  for (int i = 0; i < 60000; ++i) {
    photons.push_back(photon_at(random, room.position(random)));
    const bool indirect = random.uniform() < 0.6;
    if (indirect) photons.back().normal |= INDIRECT_PHOTON;
    of_kind[indirect ? INDIRECT_PHOTONS : FOCUSED_PHOTONS].push_back(photons.back());
  }
  const PhotonGrids grids =
      two_grids(make_grid({}, 0.2, 8, 8, 8), make_grid({}, 0.17, 16, 8, 4), photons.size());
  std::vector<VisiblePoint> visible(pixels * samples);
  std::vector<GatherPoint> points;
  for (auto& v : visible) {
    const Photon& near = photons[random.engine() % photons.size()];
    std::copy(near.position, near.position + 3, v.position);
    v.normal = near.normal;
    for (int c = 0; c < 3; ++c) {
      v.weight[c] = random.uniform() < 0.1 ? 0 : float(random.uniform());
      v.radiance[c] = float(random.uniform());
    }
    // A path that met no diffuse surface.
    if (random.uniform() < 0.2) v.weight[0] = v.weight[1] = v.weight[2] = 0;
    points.push_back({v.position[0], v.position[1], v.position[2], v.normal});
  }
  // One path went wrong: its pixel is left out of the film, and counted.
  constexpr uint broken = 17;
  visible[broken * samples].radiance[1] = NAN;

  Params params{};
  params.first_pixel = first;
  params.pixel_count = pixels;
  params.visible_points = samples;
  params.photon_flux = 0.125f;
  params.alpha = 0.7f;
  params.indirect_radius = 1.7f;
  const SortedPhotons map = sort_photons(test_device(), program(), photons, grids);
  auto in = test_device().upload(visible, "visible points");
  auto counter = test_device().upload(std::vector<Counters>{{}}, "counters");
  auto no_walls = test_device().upload(std::vector<WallGrid>{{}}, "walls");

  for (const float shared_radius2 : {0.0f, 0.0144f}) {
    CAPTURE(shared_radius2);
    params.radius2 = shared_radius2;
    auto state = test_device().buffer((first + pixels) * sizeof(SppmPixel), "pixels");
    run_kernel(program(), "start_pixels", first + pixels, state, cl_uint(first + pixels), 0.01f);
    auto film = test_device().buffer((first + pixels) * sizeof(FilmPixel), "film");
    test_device().clear(film, (first + pixels) * sizeof(FilmPixel));
    test_device().clear(counter, sizeof(Counters));
    run_kernel(program(), "gather_photons", pixels, in, state, film, map.starts, map.sorted, counter, grids,
               params, no_walls);
    const auto out = test_device().download<FilmPixel>(film, first + pixels);
    const auto after = test_device().download<SppmPixel>(state, first + pixels);
    CHECK(test_device().download<Counters>(counter, 1)[0].non_finite == 1);

    const float radius2 = shared_radius2 > 0 ? shared_radius2 : 0.01f;
    const float wider = 1.7f * 1.7f;
    const auto focused = brute_force(points, of_kind[FOCUSED_PHOTONS], radius2);
    const auto indirect = brute_force(points, of_kind[INDIRECT_PHOTONS], radius2 * wider);
    double worst = 0, worst_radius = 0, worst_blur = 0, largest_blur = 0;
    std::size_t wrong = 0;
    for (uint i = 0; i < pixels; ++i) {
      double radiance[3] = {0, 0, 0}, kernel_bias = 0;
      std::uint64_t count = 0;
      for (uint s = 0; s < samples; ++s) {
        const VisiblePoint& v = visible[i * samples + s];
        const GatherSums &a = focused[i * samples + s], &b = indirect[i * samples + s];
        if (v.weight[0] + v.weight[1] + v.weight[2] > 0) count += a.count + b.count;
        const auto both = [&](std::uint64_t GatherSums::*sum) {
          return double(a.*sum) + double(b.*sum) / wider;
        };
        const double flux[3] = {both(&GatherSums::red), both(&GatherSums::green), both(&GatherSums::blue)};
        const double near[3] = {both(&GatherSums::near_red), both(&GatherSums::near_green),
                                both(&GatherSums::near_blue)};
        constexpr double luminance[3] = {0.2126, 0.7152, 0.0722};
        for (int c = 0; c < 3; ++c) {
          const double density = v.weight[c] * 0.125 / PHOTON_FLUX_UNIT / (M_PI * radius2);
          radiance[c] += v.radiance[c] + density * flux[c];
          kernel_bias += luminance[c] * density * (flux[c] - 4 * near[c]) / samples;
        }
      }
      largest_blur = std::max(largest_blur, std::fabs(kernel_bias));
      if (i != broken)
        worst_blur = std::max(worst_blur, std::fabs(out[first + i].kernel_bias[0] - kernel_bias));
      wrong += out[first + i].kernel_bias[1] != 0 || out[first + i].m2_deviation != 0;
      const SppmPixel& pixel = after[first + i];
      if (shared_radius2 > 0) {
        wrong += pixel.radius2_hi != 0.01f || pixel.photons_low != count;
      } else {
        wrong += pixel.photons_low != count;
        const double expected = 0.01f * (count ? 0.7 : 1);
        worst_radius = std::max(worst_radius, std::fabs(pixel.radius2_hi / expected - 1));
      }
      for (int c = 0; c < 3; ++c) {
        const double value = double(out[first + i].sum[c]) + out[first + i].low[c];
        if (i == broken)
          wrong += value != 0;
        else
          worst = std::max(worst, std::fabs(value / (radiance[c] / samples) - 1));
      }
    }
    for (uint i = 0; i < first; ++i) wrong += out[i].sum[0] != 0 || after[i].radius2_hi != 0.01f;
    CHECK(wrong == 0);
    CHECK(worst < 2e-6);
    CHECK(worst_blur < 1e-5 * largest_blur);
    CHECK(worst_radius < 1e-6);
  }

  // The count that chooses the first radius.
  params.radius2 = 0.01f;
  auto out = test_device().buffer(pixels * samples * sizeof(cl_uint), "counts");
  run_kernel(program(), "count_around", pixels * samples, in, map.starts, map.sorted, out, grids, params);
  const auto counts = test_device().download<uint>(out, pixels * samples);
  const auto focused = brute_force(points, of_kind[FOCUSED_PHOTONS], 0.01f);
  const auto indirect = brute_force(points, of_kind[INDIRECT_PHOTONS], 0.01f * (1.7f * 1.7f));
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const VisiblePoint& v = visible[i];
    const bool diffuse = v.weight[0] + v.weight[1] + v.weight[2] > 0;
    wrong +=
        counts[i] !=
        (diffuse ? static_cast<uint>(focused[i].count + indirect[i].count / (1.7 * 1.7) + 0.5) : 0xffffffffu);
  }
  CHECK(wrong == 0);
}
