#include "chi_square_check.hpp"
#include "vector_inputs.hpp"
#include "world/environment.hpp"

using namespace causticl;

namespace {

const char* const source = R"(
#include "lights/environment.cl"
kernel void place(global const float4 *in, global float4 *out, uint count, global const Emitter *emitter) {
  uint i = get_global_id(0);
  if (i >= count) return;
  real sine, back_sine;
  real2 position = environment_position(emitter, convert_real3(in[i].xyz), &sine);
  real3 back = environment_direction(emitter, position, &back_sine);
  out[2 * i] = convert_float4((real4)(position, sine, back_sine));
  out[2 * i + 1] = convert_float4((real4)(back, 0));
}
kernel void look_up(global const float2 *in, global float4 *out, uint count, global const Emitter *emitter,
                    global const EnvironmentTexel *environment) {
  uint i = get_global_id(0);
  if (i >= count) return;
  Scene scene;
  scene.environment = environment;
  EnvironmentValue value = environment_lookup(&scene, emitter, convert_real2(in[i]));
  out[i] = convert_float4((real4)(value.radiance, value.density));
}
kernel void draw(global const float4 *in, global float4 *out, uint count, global const Emitter *emitter,
                 global const EnvironmentTexel *environment, ulong numbers) {
  uint i = get_global_id(0);
  if (i >= count) return;
  Scene scene;
  scene.environment = environment;
  ulong number = (ulong)(uint)(in[i].x * 16777216) * numbers >> 24;
  real2 position = environment_place(&scene, emitter, number, convert_real2(in[i].yz));
  out[i] = convert_float4((real4)(position, environment_lookup(&scene, emitter, position).density, 0));
}
kernel void start(global const float4 *in, global float4 *out, uint count, global const Emitter *emitter, float4 to) {
  uint i = get_global_id(0);
  if (i >= count) return;
  out[i] = convert_float4((real4)(infinite_light_origin(emitter, convert_real3(to.xyz), convert_real2(in[i].xy)), 0));
}
)";

struct Place {
  float4 position, back;  // (u, v, sine, sine of the way back), and the direction that they stand for
};

constexpr std::size_t sample_count = 1 << 18;
constexpr int histograms = 6;  // in this file, for Sidak's correction
constexpr std::uint64_t numbers = 1ull << 40;

cl::Program& program() {
  static cl::Program built = build_test_program(source);
  return built;
}

/// A map of random texels, a third of them black.
Image random_map(RandomInputs& random, int width, int height) {
  Image map;
  map.width = width;
  map.height = height;
  for (int i = 0; i < width * height; ++i) {
    const double level = random.uniform() < 0.3 ? 0 : std::pow(10, random.uniform(-2, 1));
    for (int c = 0; c < 3; ++c) map.rgba.push_back(static_cast<float>(level * random.uniform()));
    map.rgba.push_back(1);
  }
  return map;
}

cl::Buffer upload_emitter(int width, int height, double turns = 0) {
  Emitter emitter{};
  emitter.type = LIGHT_ENVIRONMENT;
  emitter.a = {3, -2, 1, 5};
  emitter.b.x = static_cast<float>(turns);
  emitter.shape = static_cast<uint>(width);
  emitter.first_area = static_cast<uint>(height);
  return test_device().upload(std::vector<Emitter>{emitter}, "emitter");
}

}  // namespace

TEST_CASE("directions and positions of an environment's map are each other's inverse") {
  RandomInputs random(101);
  for (const double turns : {0.0, 0.3, -1.75}) {
    auto emitter = upload_emitter(8, 4, turns);
    // The poles, the axes, near the poles, and any direction.
    std::vector<float4> in{{0, 1, 0, 0},  {0, -1, 0, 0}, {1, 0, 0, 0},
                           {0, 0, -1, 0}, {-1, 0, 0, 0}, {0, 0, 1, 0}};
    for (int i = 0; i < 1000; ++i)
      in.push_back(to_float4(
          tilted_direction(random, {0, i % 2 ? 1.0 : -1.0, 0}, std::pow(10, random.uniform(-6, 0)))));
    while (in.size() < 20000) in.push_back(to_float4(random_direction(random)));
    const auto places = outputs_of<Place>(program(), "place", in, emitter);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < in.size(); ++i) {
      const float4 place = places[i].position;
      const Vec3 d = to_vec3(in[i]);
      const double u = turn(d.x, -d.z) + 0.5 + turns, v = std::atan2(std::hypot(d.x, d.z), -d.y) / M_PI;
      const double sine = std::hypot(d.x, d.z), off = place.x - u - std::round(place.x - u);
      wrong += !(place.x >= 0 && place.x <= 1 && std::fabs(place.y - v) < 3e-7 &&
                 std::fabs(place.z - sine) < 2e-7);
      wrong += !(sine == 0 || std::fabs(off) < 1e-6);
      wrong += !(length(to_vec3(places[i].back) - d) < 3e-6 && std::fabs(place.w - sine) < 3e-6);
    }
    CHECK(wrong == 0);
    if (turns == 0) {
      // The middle of the map lies towards -z, a quarter to its right towards +x.
      CHECK(places[3].position.x == Approx(0.5));
      CHECK(places[2].position.x == Approx(0.75));
      CHECK(places[0].position.y == Approx(1));
    }
  }
}

TEST_CASE("an environment is interpolated around the seam and held beyond the last rows") {
  RandomInputs random(102);
  for (const auto& [width, height] : {std::pair{16, 8}, {5, 3}, {2, 1}, {1, 2}, {1, 1}}) {
    CAPTURE(width, height);
    Image map = random_map(random, width, height);
    map.rgba[0] = 1;
    const auto table = environment_table(map, numbers);
    auto emitter = upload_emitter(width, height), texels = test_device().upload(table, "texels");
    std::vector<float2> in{{0, 0}, {1, 1}, {0, 1}, {0.5f, 0.5f}, {0.9999999f, 0}};
    while (in.size() < 20000) in.push_back({uniform24(random), uniform24(random)});
    const auto values = outputs_of<float4>(program(), "look_up", in, emitter, texels);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < in.size(); ++i) {
      // Brute force: the sum of all tents, on the cylinder, rows beyond the last held.
      double expected[4] = {0, 0, 0, 0}, largest = 0;
      for (int row = -1; row <= height; ++row)
        for (int column = -1; column <= width; ++column) {
          const double x = 1 - std::fabs(in[i].x * width - column - 0.5),
                       y = 1 - std::fabs(in[i].y * height - row - 0.5);
          if (x <= 0 || y <= 0) continue;
          const EnvironmentTexel& texel = table[static_cast<std::size_t>(
              std::clamp(row, 0, height - 1) * width + (column + width) % width)];
          for (int c = 0; c < 4; ++c) {
            const double value = c < 3 ? texel.radiance[c] : texel.density;
            expected[c] += x * y * value;
            largest = std::max(largest, value);
          }
        }
      const double got[] = {values[i].x, values[i].y, values[i].z, values[i].w};
      for (int c = 0; c < 4; ++c) wrong += !(std::fabs(got[c] - expected[c]) <= 1e-5 * largest);
    }
    CHECK(wrong == 0);
  }
}

TEST_CASE("positions are drawn with the density that the lookup gives, and texels own what they should") {
  RandomInputs random(103);
  for (const auto& [width, height] : {std::pair{16, 8}, {5, 3}, {1, 1}}) {
    CAPTURE(width, height);
    Image map = random_map(random, width, height);
    map.rgba[0] = 1;
    const auto table = environment_table(map, numbers);
    // Fractions of the largest channel times the sine, exact but for the rounding of both ends.
    std::vector<double> weights;
    double total = 0;
    for (int i = 0; i < width * height; ++i) {
      const float* rgb = &map.rgba[4 * static_cast<std::size_t>(i)];
      weights.push_back(std::max({rgb[0], rgb[1], rgb[2]}) * std::sin(M_PI * (i / width + 0.5) / height));
      total += weights.back();
    }
    CHECK(environment_integral(map) == Approx(2 * M_PI * M_PI * total / (width * height)));
    CHECK(table.back().cdf == numbers);
    double mean = 0;
    for (std::size_t i = 0; i < table.size(); ++i) {
      const std::uint64_t owned = table[i].cdf - (i ? table[i - 1].cdf : 0);
      CHECK(std::fabs(static_cast<double>(owned) - weights[i] / total * static_cast<double>(numbers)) < 1.01);
      mean += table[i].density / static_cast<double>(table.size());
    }
    CHECK(mean == Approx(1));

    auto emitter = upload_emitter(width, height), texels = test_device().upload(table, "texels");
    const auto in = uniform_tuples(random, sample_count);
    // Four bins a texel each way; the density is integrated by its values at a grid of points.
    const SquareBins bins{4u * static_cast<unsigned>(width), 4u * static_cast<unsigned>(height)};
    Histogram histogram(bins.count());
    for (const float4& sample :
         outputs_of<float4>(program(), "draw", in, emitter, texels, cl_ulong(numbers))) {
      if (sample.z > 0)
        histogram.add(bins.bin(sample.x, sample.y));
      else
        histogram.add_outside();
    }
    constexpr std::size_t fine = 8;
    std::vector<float2> grid;
    for (std::size_t y = 0; y < bins.ny * fine; ++y)
      for (std::size_t x = 0; x < bins.nx * fine; ++x)
        grid.push_back(
            {static_cast<float>((static_cast<double>(x) + 0.5) / static_cast<double>(bins.nx * fine)),
             static_cast<float>((static_cast<double>(y) + 0.5) / static_cast<double>(bins.ny * fine))});
    const auto densities = outputs_of<float4>(program(), "look_up", grid, emitter, texels);
    for (std::size_t i = 0; i < grid.size(); ++i)
      histogram.probabilities[bins.bin(grid[i].x, grid[i].y)] +=
          densities[i].w / static_cast<double>(grid.size());
    check_chi_square(histogram, histograms, "positions");
  }
}

TEST_CASE("light from afar starts uniformly on the disc that touches the sphere of the scene") {
  RandomInputs random(104);
  auto emitter = upload_emitter(1, 1);
  const auto in = uniform_tuples(random, sample_count);
  for (const Vec3 to : {Vec3{0, 0, -1}, Vec3{0, 0, 1}, normalize(Vec3{0.3, -2, 0.5})}) {
    const SquareBins bins{16, 16};
    Histogram histogram(bins.count());
    histogram.probabilities.assign(bins.count(), 1.0 / static_cast<double>(bins.count()));
    const Frame frame(to);
    std::size_t off = 0;
    for (const float4& origin : outputs_of<float4>(program(), "start", in, emitter, to_float4(to))) {
      const Vec3 p = frame.to_local(to_vec3(origin) - Vec3{3, -2, 1});
      off += !(std::fabs(p.z + 5) < 1e-5);
      histogram.add(bins.bin((p.x * p.x + p.y * p.y) / 25, turn(p.y, p.x)));
    }
    CHECK(off == 0);
    check_chi_square(histogram, histograms, "places on the disc");
  }
}
