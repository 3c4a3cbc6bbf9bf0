// The medium: free flight, and photons gathered in a volume.
#include "chi_square_check.hpp"
#include "phase_oracle.hpp"
#include "selftest/photon_grid.hpp"
#include "vector_inputs.hpp"

using namespace causticl;

namespace {

const char* const source = R"(
#include "photons/gather.cl"
#include "passes/pass_grid.cl"
typedef struct {
  float4 throughput;     // w: random number that chooses the channel
  float4 extinction;  // w: random number that chooses the distance
  float4 end;         // x: t_max
} Flight;
kernel void fly(global const Flight *in, global float4 *out, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  Medium medium = {in[i].extinction.xyz, (real3)(0, 0, 0), 0};
  real3 throughput = in[i].throughput.xyz;
  real distance = -1;
  bool interacts = medium_flight(&medium, in[i].end.x, (real2)(in[i].throughput.w, in[i].extinction.w), &throughput, &distance);
  out[i] = (float4)(throughput, interacts ? distance : -1);
}
kernel void collect(Grid grid, global const uint *starts, global const PhotonBlock *sorted, global const float4 *points,
                    global ulong4 *out, uint count, float4 direction, float4 extinction, float g, float radius2) {
  uint i = get_global_id(0);
  if (i >= count) return;
  MediumSegment segment = {points[i].xyz, direction.xyz, 0, 0, extinction.xyz, g};
  Gathered sum = gather_medium(grid, starts, sorted, segment, points[i].w, radius2);
  out[2 * i] = (ulong4)(sum.red, sum.green, sum.blue, sum.count);
  out[2 * i + 1] = (ulong4)(sum.near_red, sum.near_green, sum.near_blue, 0);
}
kernel void cut(global const Flight *in, global float4 *out, uint count, float segment) {
  uint i = get_global_id(0);
  if (i >= count) return;
  Medium medium = {in[i].extinction.xyz, (real3)(0, 0, 0), 0};
  real3 throughput = in[i].throughput.xyz;
  real distance = -1, begin = -1, length = -1;
  real3 weight = (real3)(0, 0, 0);
  if (medium_flight(&medium, in[i].end.x, (real2)(in[i].throughput.w, in[i].extinction.w), &throughput, &distance))
    weight = medium_segment(&medium, in[i].throughput.xyz, in[i].end.x, distance, segment, &begin, &length);
  out[2 * i] = (float4)(weight, begin);
  out[2 * i + 1] = (float4)(distance, length, 0, 0);
}
kernel void directions(global const float4 *in, global uint *out, uint count) {
  uint i = get_global_id(0);
  if (i < count) out[i] = direction_pack(in[i].xyz);
}
)";

cl::Program& program() {
  static cl::Program built = build_test_program(source);
  return built;
}

}  // namespace

TEST_CASE(
    "free flight weighs every distance by transmittance over its density, and loses nothing on average") {
  struct Flight {
    float4 throughput, extinction, end;
  };
  constexpr std::size_t count = 1 << 20;
  RandomInputs random(223);
  std::vector<Flight> inputs(count);
  for (auto& input : inputs) {
    const auto channel = [&] { return random.uniform() < 0.2 ? 0.0 : random.uniform(); };
    input.throughput = to_float4({channel(), channel(), channel()}, uniform24(random));
    input.extinction = to_float4({3 * channel(), 3 * channel(), 3 * channel()}, uniform24(random));
    input.end.x = random.uniform() < 0.1 ? INFINITY : static_cast<float>(random.uniform(0, 3));
  }
  auto in = test_device().upload(inputs, "inputs");
  auto out = test_device().buffer(count * sizeof(float4), "outputs");
  run_kernel(program(), "fly", count, in, out, cl_uint(count));
  const auto outputs = test_device().download<float4>(out, count);
  std::size_t wrong = 0, grown = 0, interactions = 0;
  // What passes the end, over what should: by transmittance to it. What interacts, over what is taken away.
  double passed[3] = {}, passes[3] = {}, taken[3] = {}, takes[3] = {};
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 throughput = to_vec3(inputs[i].throughput), extinction = to_vec3(inputs[i].extinction),
               found = to_vec3(outputs[i]);
    const double sum = throughput.x + throughput.y + throughput.z, end = inputs[i].end.x,
                 distance = outputs[i].w;
    const bool interacts = distance >= 0;
    interactions += interacts;
    if (sum == 0 || max_component(extinction) == 0) {
      wrong += interacts || !(found == throughput);
      continue;
    }
    const auto left = [&](int c, double t) {
      return extinction[c] == 0 ? 1.0 : std::exp(-extinction[c] * t);
    };
    double density = 0, after = 0;
    for (int c = 0; c < 3; ++c)
      density += throughput[c] / sum * (interacts ? extinction[c] * left(c, distance) : left(c, end));
    for (int c = 0; c < 3; ++c) {
      const double exact = throughput[c] * left(c, interacts ? distance : end) / density;
      wrong += !(std::fabs(found[c] - exact) <= 3e-5 * exact + 1e-30);
      after += interacts ? found[c] * extinction[c] : found[c];
      (interacts ? taken : passed)[c] += interacts ? found[c] * extinction[c] : found[c];
      passes[c] += throughput[c] * left(c, end);
      takes[c] += throughput[c] * (1 - left(c, end));
    }
    wrong += interacts && !(distance < end);
    grown += !(after <= sum * (1 + 1e-5));
  }
  CHECK(wrong == 0);
  CHECK(grown == 0);
  CHECK(interactions > count / 3);
  for (int c = 0; c < 3; ++c) {
    // Each sample is at most 3, so that a sum of a million has a standard deviation below 1,500.
    CHECK(std::fabs(passed[c] - passes[c]) < 5 * 1500);
    CHECK(std::fabs(taken[c] - takes[c]) < 5 * 1500);
  }
}

TEST_CASE("the segment that a flight ends in carries transmittance over the probability of ending there") {
  struct Flight {
    float4 throughput, extinction, end;
  };
  constexpr std::size_t count = 1 << 19;
  constexpr float segment = 0.7f;
  RandomInputs random(226);
  std::vector<Flight> inputs(count);
  for (auto& input : inputs) {
    const auto channel = [&] { return random.uniform() < 0.2 ? 0.0 : random.uniform(); };
    input.throughput = to_float4({channel(), channel(), channel()}, uniform24(random));
    input.extinction = to_float4({3 * channel(), 3 * channel(), 3 * channel()}, uniform24(random));
    input.end.x = random.uniform() < 0.1 ? INFINITY : static_cast<float>(random.uniform(0, 3));
  }
  auto in = test_device().upload(inputs, "inputs");
  auto out = test_device().buffer(2 * count * sizeof(float4), "outputs");
  run_kernel(program(), "cut", count, in, out, cl_uint(count), segment);
  const auto outputs = test_device().download<float4>(out, 2 * count);
  std::size_t wrong = 0, ended = 0, last = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double distance = outputs[2 * i + 1].x, length = outputs[2 * i + 1].y, begin = outputs[2 * i].w;
    if (begin < 0) continue;  // it passes
    ++ended;
    last += length < segment;
    const Vec3 throughput = to_vec3(inputs[i].throughput), extinction = to_vec3(inputs[i].extinction);
    const double sum = throughput.x + throughput.y + throughput.z, end = inputs[i].end.x;
    // Segments follow each other from the origin on, and the last one ends where the ray does.
    wrong += std::fabs(begin / segment - std::round(begin / segment)) > 1e-6 * (1 + begin) ||
             !(begin <= distance * (1 + 1e-6)) || !(distance <= (begin + length) * (1 + 1e-6)) ||
             std::fabs(length - std::min<double>(segment, end - begin)) > 1e-6 * (1 + begin);
    double probability = 0;
    for (int c = 0; c < 3; ++c)
      probability +=
          throughput[c] / sum * std::exp(-extinction[c] * begin) * -std::expm1(-extinction[c] * length);
    for (int c = 0; c < 3; ++c) {
      const double exact = throughput[c] * std::exp(-extinction[c] * begin) / probability;
      wrong += !(std::fabs(to_vec3(outputs[2 * i])[c] - exact) <= 1e-4 * exact + 1e-30);
    }
  }
  CHECK(wrong == 0);
  CHECK(ended > count / 3);
  CHECK(last > count / 20);
}

TEST_CASE("photons far from the peak of the phase function are worth what they should be together") {
  constexpr std::size_t photon_count = 100000;
  RandomInputs random(227);
  const Vec3 towards = to_vec3(to_float4(random_direction(random)));
  // Photons that fly as the ray does turn right back: by g = 0.99 to a ten-millionth of the peak, two parts
  // of PHASE_UNIT, of which the three channels' extinctions leave all, half and a fifth.
  const float g = 0.99f, radius2 = 0.01f, length = 1;
  const Vec3 extinction{0, 1, 3};
  auto in = test_device().upload(std::vector<float4>(photon_count, to_float4(towards)), "directions");
  auto words = test_device().buffer(photon_count * sizeof(cl_uint), "words");
  run_kernel(program(), "directions", photon_count, in, words, cl_uint(photon_count));
  const auto packed = test_device().download<cl_uint>(words, photon_count);
  std::vector<Photon> photons(photon_count);
  const double phase = phase_oracle(g, -1) / phase_oracle(g, 1), flux = 1000;
  double exact[3] = {};
  for (std::size_t i = 0; i < photon_count; ++i) {
    const double along = random.uniform(0.01, 0.99);
    const Vec3 p = along * towards;
    photons[i] = {{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)},
                  packed[i],
                  1000u | 1000u << 16,
                  1000u};
    for (int c = 0; c < 3; ++c) exact[c] += phase * std::exp(-extinction[c] * along) * flux * 16777216;
  }
  const Grid grid = make_grid({0.1, -0.2, 0}, 0.17, 8, 8, 8);
  const auto sorted = sort_photons(test_device(), program(), photons, one_grid(grid, photons.size()));
  auto where = test_device().upload(std::vector<float4>{{0, 0, 0, length}}, "points");
  auto out = test_device().buffer(8 * sizeof(cl_ulong), "sums");
  run_kernel(program(), "collect", 1, grid, sorted.starts, sorted.sorted, where, out, cl_uint(1),
             to_float4(towards), to_float4(extinction), g, radius2);
  const auto sums = test_device().download<cl_ulong>(out, 8);
  CHECK(sums[3] == photon_count);
  for (int c = 0; c < 3; ++c) {
    CAPTURE(c, sums[c], exact[c]);
    // Packed directions, near the back of the lobe, hardly matter; each dither is at most half a part off.
    CHECK(std::fabs(static_cast<double>(sums[c]) - exact[c]) < 0.01 * exact[c]);
  }
}

TEST_CASE(
    "photons around a segment in the medium are gathered as brute force does, and those on surfaces left "
    "out") {
  RandomInputs random(225);
  constexpr std::size_t photon_count = 20000, point_count = 500;
  std::vector<float4> directions(photon_count);
  for (auto& direction : directions) direction = to_float4(random_direction(random));
  auto in = test_device().upload(directions, "directions");
  auto words = test_device().buffer(photon_count * sizeof(cl_uint), "words");
  run_kernel(program(), "directions", photon_count, in, words, cl_uint(photon_count));
  const auto packed = test_device().download<cl_uint>(words, photon_count);
  std::vector<Photon> photons(photon_count);
  const auto coordinate = [&] { return static_cast<float>(random.uniform(-1, 1)); };
  for (std::size_t i = 0; i < photon_count; ++i) {
    photons[i] = {{coordinate(), coordinate(), coordinate()},
                  packed[i],
                  static_cast<uint>(random.engine()),
                  static_cast<uint>(random.engine()) & 0xffffu};
    if (i % 3 == 0) photons[i].normal &= 0xffffffu;
  }
  // From less than a cube to several times around the grid.
  std::vector<float4> points(point_count);
  for (auto& point : points)
    point = {coordinate(), coordinate(), coordinate(),
             static_cast<float>(random.uniform() < 0.1 ? 4 : random.uniform(0, 0.6))};
  const Vec3 towards = to_vec3(to_float4(random_direction(random))), extinction{0.3, 0, 2};
  for (const auto& [g, radius] : {std::pair{0.0, 0.1}, {0.6, 0.3}, {-0.9, 0.2}}) {
    const Grid grid = make_grid({0.1, -0.2, 0}, 0.17, 8, 8, 8);
    const auto sorted = sort_photons(test_device(), program(), photons, one_grid(grid, photons.size()));
    auto where = test_device().upload(points, "points");
    auto out = test_device().buffer(2 * point_count * 4 * sizeof(cl_ulong), "sums");
    const auto radius2 = static_cast<float>(radius * radius);
    run_kernel(program(), "collect", point_count, grid, sorted.starts, sorted.sorted, where, out,
               cl_uint(point_count), to_float4(towards), to_float4(extinction), static_cast<float>(g),
               radius2);
    const auto sums = test_device().download<cl_ulong>(out, 8 * point_count);
    const double peak = phase_oracle(std::fabs(g), 1);
    std::size_t wrong = 0, found = 0;
    for (std::size_t p = 0; p < point_count; ++p) {
      double red = 0, blue = 0, near_red = 0;
      std::size_t inside = 0, border = 0;
      for (std::size_t i = 0; i < photon_count; ++i) {
        if (i % 3 == 0) continue;
        const Vec3 d =
            Vec3{photons[i].position[0], photons[i].position[1], photons[i].position[2]} - to_vec3(points[p]);
        const double along = dot(d, towards), distance2 = dot(d, d) - along * along;
        const bool is_near = distance2 <= radius2 / 4;
        if (distance2 > radius2 * 1.001 || along < -0.001 || along > points[p].w + 0.001) continue;
        border += std::fabs(distance2 - radius2) < 1e-5 * radius2 || std::fabs(along) < 1e-6 ||
                  std::fabs(along - points[p].w) < 1e-6 ||
                  std::fabs(distance2 - radius2 / 4) < 1e-5 * radius2;
        if (distance2 > radius2 || along < 0 || along >= points[p].w) continue;
        ++inside;
        const double phase = phase_oracle(g, -dot(to_vec3(directions[i]), towards)) / peak;
        const double red_flux = phase * std::exp(-extinction.x * along) * (photons[i].flux_rg & 0xffffu);
        red += red_flux;
        if (is_near) near_red += red_flux;
        blue += phase * std::exp(-extinction.z * along) * photons[i].flux_b;
      }
      found += inside;
      if (border) continue;
      const double unit = 16777216;
      const cl_ulong* all = &sums[8 * p];
      // Packed directions are a ten-thousandth off, of which the phase function near its peak makes more.
      wrong += all[3] != inside || !(std::fabs(all[0] / unit - red) <= 2e-3 * red + 0.01) ||
               !(std::fabs(all[2] / unit - blue) <= 2e-3 * blue + 0.01) ||
               !(std::fabs(all[4] / unit - near_red) <= 2e-3 * near_red + 0.01);
    }
    CAPTURE(g, radius);
    CHECK(found > point_count);
    CHECK(wrong == 0);
  }
}
