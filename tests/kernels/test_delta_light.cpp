#include "chi_square_check.hpp"
#include "vector_inputs.hpp"

using namespace causticl;

namespace {

const char* const source = R"(
#include "lights/light.cl"
kernel void falloff(global const float4 *in, global float *out, uint count, global const Emitter *emitter) {
  uint i = get_global_id(0);
  if (i >= count) return;
  out[i] = spot_falloff(emitter, convert_real3(in[i].xyz));
}
kernel void arrive(global const float4 *in, global float4 *out, uint count, global const Emitter *emitter) {
  uint i = get_global_id(0);
  if (i >= count) return;
  Scene scene;
  scene.emitters = emitter;
  LightSample light = light_sample_from(&scene, 0, convert_real3(in[i].xyz), (real4)(0, 0, 0, 0));
  out[2 * i] = convert_float4((real4)(light.weight, 0));
  out[2 * i + 1] = convert_float4((real4)(light.direction, light.distance));
}
kernel void leave(global const float4 *in, global float4 *out, uint count, global const Emitter *emitter) {
  uint i = get_global_id(0);
  if (i >= count) return;
  Scene scene;
  scene.emitters = emitter;
  scene.geometry.plane_count = 0;
  real3 flux;
  Ray ray = photon_emit_from(&scene, 0, (real4)(0, 0, 0, 0), in[i].x, in[i].y, &flux);
  out[i] = convert_float4((real4)(ray.direction, max_component(flux)));
}
)";

struct Arrival {
  float4 weight, direction;  // direction.w: distance
};

constexpr std::size_t sample_count = 1 << 18;

cl::Program& program() {
  static cl::Program built = build_test_program(source);
  return built;
}

double drop(double angle) { return 2 * std::sin(angle / 2) * std::sin(angle / 2); }

const Vec3 axis = normalize(Vec3{1, -2, 0.5});

/// A spot with these half angles, in radians, at (1, 2, 3).
Emitter spot(double outer, double even) {
  Emitter emitter{};
  emitter.type = LIGHT_SPOT;
  emitter.a = {1, 2, 3, 0};
  emitter.b = to_float4(axis);
  emitter.c = {static_cast<float>(drop(outer)), static_cast<float>(drop(even)), 0, 0};
  emitter.probability = 1;
  emitter.radiance = {2, 4, 1, emitter.c.x + emitter.c.y};
  return emitter;
}

double expected_falloff(double angle, double outer, double even) {
  if (angle <= even) return 1;
  if (angle >= outer) return 0;
  const double t = (std::cos(angle) - std::cos(outer)) / (std::cos(even) - std::cos(outer));
  return t * t * (3 - 2 * t);
}

}  // namespace

TEST_CASE("a spot falls off by the cubic step of the cosine") {
  RandomInputs random(111);
  for (const auto& [outer, even] : {std::pair{0.5, 0.3}, {M_PI / 2, 0.0}, {0.01, 0.005}, {0.2, 0.2}}) {
    CAPTURE(outer, even);
    std::vector<float4> in;
    std::vector<double> expected;
    for (int i = 0; i < 20000; ++i) {
      const double angle = random.uniform(0, std::min(M_PI, 1.5 * outer));
      in.push_back(to_float4(tilted_direction(random, axis, angle)));
      // The edge of an even cone is a step, which rounding moves.
      expected.push_back(
          outer == even && std::fabs(angle - outer) < 1e-6 ? NAN : expected_falloff(angle, outer, even));
    }
    auto emitter = test_device().upload(std::vector<Emitter>{spot(outer, even)}, "emitter");
    const auto got = outputs_of<float>(program(), "falloff", in, emitter);
    std::size_t wrong = 0;
    // A direction is off by 1e-7, the border of the narrowest spot 0.005 wide.
    for (std::size_t i = 0; i < in.size(); ++i)
      wrong += !(std::isnan(expected[i]) || std::fabs(got[i] - expected[i]) < 1e-4);
    CHECK(wrong == 0);
  }
}

TEST_CASE("light arrives by the inverse square of the distance, and from afar as it is") {
  RandomInputs random(112);
  Emitter point{};
  point.type = LIGHT_POINT;
  point.probability = 1;
  point.a = {1, 2, 3, 0};
  point.radiance = {2, 4, 1, 4};
  Emitter distant = point;
  distant.type = LIGHT_DIRECTIONAL;
  distant.b = to_float4(axis);
  for (const Emitter& light : {point, spot(0.8, 0.4), distant}) {
    CAPTURE(light.type);
    std::vector<float4> in{{1, 2, 3, 0}};
    while (in.size() < 20000)
      in.push_back(to_float4(Vec3{1, 2, 3} + std::pow(10, random.uniform(-2, 3)) * random_direction(random)));
    auto emitter = test_device().upload(std::vector<Emitter>{light}, "emitter");
    const auto got = outputs_of<Arrival>(program(), "arrive", in, emitter);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < in.size(); ++i) {
      const Vec3 irradiance = to_vec3(got[i].weight), direction = to_vec3(got[i].direction);
      const double distance = got[i].direction.w;
      if (light.type == LIGHT_DIRECTIONAL) {
        wrong += !(irradiance == Vec3{2, 4, 1} && length(direction + axis) < 1e-6 && std::isinf(distance));
        continue;
      }
      const Vec3 to_light = Vec3{1, 2, 3} - to_vec3(in[i]);
      const double square = dot(to_light, to_light);
      // At the very place of the light nothing is defined, and nothing arrives.
      if (square == 0) {
        wrong += !(irradiance == Vec3{});
        continue;
      }
      double falloff = 1;
      if (light.type == LIGHT_SPOT)
        falloff = expected_falloff(std::acos(std::clamp(-dot(to_light, axis) / std::sqrt(square), -1.0, 1.0)),
                                   0.8, 0.4);
      wrong += !(length(irradiance * square - Vec3{2, 4, 1} * falloff) < 1e-5 &&
                 length(direction - to_light / std::sqrt(square)) < 1e-6 &&
                 std::fabs(distance - std::sqrt(square)) < 1e-6 * distance);
    }
    CHECK(wrong == 0);
  }
}

TEST_CASE("photons carry the falloff of their spot, one on average") {
  RandomInputs random(113);
  const SquareBins bins{16, 16};
  for (const auto& [outer, even] : {std::pair{0.5, 0.3}, {M_PI / 2, 0.0}, {0.2, 0.2}}) {
    CAPTURE(outer, even);
    auto emitter = test_device().upload(std::vector<Emitter>{spot(outer, even)}, "emitter");
    const auto in = uniform_tuples(random, sample_count);
    Histogram histogram(bins.count());
    histogram.probabilities.assign(bins.count(), 1.0 / static_cast<double>(bins.count()));
    const Frame frame(axis);
    double sum = 0, squares = 0;
    std::size_t wrong = 0;
    for (const float4& ray : outputs_of<float4>(program(), "leave", in, emitter)) {
      const Vec3 local = frame.to_local(to_vec3(ray)), chord = to_vec3(ray) - axis;
      const double down = dot(chord, chord) / 2, angle = 2 * std::asin(std::sqrt(down / 2));
      histogram.add(bins.bin(down / drop(outer), turn(local.y, local.x), 1e-4));
      sum += ray.w;
      squares += double{ray.w} * ray.w;
      const double mean = (drop(outer) + drop(even)) / (2 * drop(outer));
      if (outer != even) wrong += !(std::fabs(ray.w * mean - expected_falloff(angle, outer, even)) < 1e-4);
    }
    const double mean = sum / sample_count,
                 deviation = std::sqrt(std::max(0.0, squares / sample_count - mean * mean));
    CHECK(std::fabs(mean - 1) < 1e-5 + 5 * deviation / std::sqrt(sample_count));
    CHECK(wrong == 0);
    check_chi_square(histogram, 3, "directions");
  }
}
