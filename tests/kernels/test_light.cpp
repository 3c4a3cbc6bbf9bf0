// The choice of an emitter, and points on it.
#include "light_fixture.hpp"

using namespace causticl;

namespace {

const char* const source = R"(
#include "passes/pass_photon.cl"
kernel void choose(SCENE_PARAMETERS, global const float4 *uniform, global uint *out, uint count, Params params) {
  uint i = get_global_id(0);
  if (i >= count) return;
  SCENE_INIT(params);
  out[i] = emitter_choose(&scene, uniform[i].x, uniform[i].y);
}
typedef struct {
  float4 direction;  // w: pdf
  float4 light;      // distance, pdf of the hit found that way, its distance, cosine at the light
  float4 weight;     // w: whether something is met short of the light
} Output;
kernel void sample(SCENE_PARAMETERS, global const float4 *uniform, global Output *out, uint count, float4 position,
                   Params params) {
  uint i = get_global_id(0);
  if (i >= count) return;
  SCENE_INIT(params);
  LightSample light = light_sample(&scene, position.xyz, uniform[i]);
  Ray ray = {position.xyz, light.direction};
  out[i].direction = (float4)(light.direction, light.pdf);
  out[i].light = (float4)(light.distance, 0, 0, 0);
  uint diagnostics = 0;
  bool occluded = geometry_occluded(&scene.geometry, ray, light.distance - light.margin, &diagnostics);
  out[i].weight = (float4)(light.weight, occluded);
  Hit hit = hit_none(INFINITY);
  if (!(light.pdf > 0) || !geometry_closest(&scene.geometry, ray, &hit)) return;
  Surface surface;
  geometry_surface(&scene.geometry, ray, hit, &surface);
  out[i].light.yzw = (float3)(light_pdf(&scene, ray.origin, ray.direction, hit, &surface, materials + surface.material),
                              hit.t, fabs(dot(surface.geometric_normal, ray.direction)));
}
// The density of all light_sample can draw in a direction: every surface that emits towards the point counts,
// seen or hidden. Where position.w > 0 only the first, and only if the cosine at the light is not below it.
kernel void density(SCENE_PARAMETERS, global const float4 *directions, global float *out, uint count, float4 position,
                    Params params) {
  uint i = get_global_id(0);
  if (i >= count) return;
  SCENE_INIT(params);
  Ray ray = {position.xyz, directions[i].xyz};
  real sum = 0, before = 0;
  for (uint n = 0; n < 8; ++n) {
    Hit hit = hit_none(INFINITY);
    if (!geometry_closest(&scene.geometry, ray, &hit)) break;
    Surface surface;
    geometry_surface(&scene.geometry, ray, hit, &surface);
    before = hit.t += before;
    global const Material *material = materials + surface.material;
    if (emission_at(material, &surface, ray.direction).x > 0 &&
        fabs(dot(surface.geometric_normal, ray.direction)) >= position.w)
      sum += light_pdf(&scene, position.xyz, ray.direction, hit, &surface, material);
    if (position.w > 0) break;
    ray.origin = offset_origin(surface.position, surface.error, surface.geometric_normal, ray.direction);
  }
  out[i] = sum;
}
)";

struct Output {
  float4 direction, light, weight;
};

constexpr std::size_t sample_count = 1 << 20;
constexpr std::size_t case_count = 1 << 18;  // for each of seven lights
using Shape3 = Object::Shape;

cl::Program& program() {
  static cl::Program built = build_test_program(source);
  return built;
}

std::vector<Output> sample(const Lights& lights, const std::vector<float4>& uniform, Vec3 position) {
  auto in = test_device().upload(uniform, "uniform");
  auto out = test_device().buffer(uniform.size() * sizeof(Output), "samples");
  lights.run("sample", uniform.size(), in, out, cl_uint(uniform.size()), to_float4(position), lights.params);
  return test_device().download<Output>(out, uniform.size());
}

std::vector<float> density_along(const Lights& lights, const std::vector<float4>& directions, Vec3 position,
                                 double first_above) {
  auto in = test_device().upload(directions, "directions");
  auto out = test_device().buffer(directions.size() * sizeof(float), "density");
  lights.run("density", directions.size(), in, out, cl_uint(directions.size()),
             to_float4(position, first_above), lights.params);
  return test_device().download<float>(out, directions.size());
}

}  // namespace

TEST_CASE("emitters are chosen in proportion to power") {
  RandomInputs random(91);
  Scene scene;
  for (int i = 0; i < 40; ++i)
    add_light(scene, i % 2 ? Shape3::disk : Shape3::sphere, Transform::shift({4.0 * i, 0, 0}),
              random.uniform(0.1, 1),
              {random.uniform(0, 5), random.uniform(0, 5), std::pow(10, random.uniform(-2, 1))}, i % 3 == 0);
  const Lights lights(scene, program());
  Histogram histogram(40);
  double total = 0;
  for (int i = 0; i < 40; ++i) {
    const MaterialSpec& material = scene.materials[i];
    const double r = scene.objects[i].radius, area = (i % 2 ? M_PI : 4 * M_PI) * r * r;
    total += histogram.probabilities[i] =
        max_component(material.emission) * area * (material.two_sided ? 2 : 1);
  }
  for (double& p : histogram.probabilities) p /= total;
  auto in = test_device().upload(uniform_tuples(random, sample_count), "uniform");
  auto out = test_device().buffer(sample_count * sizeof(cl_uint), "chosen");
  lights.run("choose", sample_count, in, out, cl_uint(sample_count), lights.params);
  for (const uint chosen : test_device().download<uint>(out, sample_count)) histogram.add(chosen);
  check_chi_square(histogram, light_histograms, "emitter_choose");
}

TEST_CASE("light_sample draws directions with the density that it states, and that light_pdf finds again") {
  RandomInputs random(92);
  struct Case {
    std::string name;
    Shape3 shape;
    Vec3 position;  // of the lit point; the light is about the origin, its size 1
    double reach;   // 1 - cos of a cone about the light's centre that holds it
    bool two_sided, convex;
  };
  const Transform tilt = Transform::rotate(0, 0.4).followed_by(Transform::rotate(1, 0.7));
  for (const Case& c : {
           Case{"rectangle", Shape3::rectangle, {1, 0.5, 2.5}, 0.15, false, true},
           Case{"rectangle from behind", Shape3::rectangle, {0, 0.2, -1}, 1, true, true},
           Case{"disk", Shape3::disk, {0.3, 0.2, 1.5}, 1, false, true},
           Case{"small far sphere", Shape3::sphere, {300, 200, 10}, 8e-6, false, true},
           Case{"near sphere", Shape3::sphere, {0, 1.2, 0.3}, 0.7, false, true},
           Case{"within a sphere", Shape3::sphere, {0.2, -0.5, 0.3}, 2, true, true},
           Case{"revolved curve", Shape3::bezier, {2.5, 0.4, -1}, 0.2, false, false},
       }) {
    INFO(c.name);
    Scene spec;
    add_light(spec, c.shape, tilt, 1, {1, 4, 2}, c.two_sided);
    const Lights lights(spec, program());
    // The direction density, integrated over bins by jittered strata.
    const Frame frame(length(c.position) > 0 ? normalize(-c.position) : Vec3{0, 0, 1});
    const SquareBins bins{12, 24};
    constexpr std::size_t strata = 32;
    std::vector<float4> directions;
    const std::size_t nx = bins.nx * strata, ny = bins.ny * strata;
    for (std::size_t y = 0; y < ny; ++y)
      for (std::size_t x = 0; x < nx; ++x) {
        const double drop = c.reach * (static_cast<double>(x) + random.uniform()) / static_cast<double>(nx);
        const double angle = 2 * M_PI * (static_cast<double>(y) + random.uniform()) / static_cast<double>(ny);
        const double s = std::sqrt(drop * (2 - drop));
        directions.push_back(to_float4(frame.to_world({s * std::cos(angle), s * std::sin(angle), 1 - drop})));
      }
    // A cone holds the near side of its sphere alone. Toward the silhouettes of a curved light drawn by area
    // the density grows without bound, where no quadrature follows: there what is seen at 0.2 or more is
    // compared.
    const bool cone = c.shape == Shape3::sphere && length(c.position) > 1;
    const double first_above = cone ? 1e-9 : c.convex ? 0 : 0.2;
    const auto densities = density_along(lights, directions, c.position, first_above);
    Histogram histogram(bins.count());
    double integral = 0;
    for (std::size_t i = 0; i < densities.size(); ++i) {
      const double probability = densities[i] * 2 * M_PI * c.reach / static_cast<double>(nx * ny);
      histogram.probabilities[i / nx / strata * bins.nx + i % nx / strata] += probability;
      integral += probability;
    }
    for (double& p : histogram.probabilities) p /= integral;

    const auto samples = sample(lights, uniform_tuples(random, case_count), c.position);
    std::size_t used = 0, seen = 0, disagree = 0, blocked = 0, wrong_weight = 0, grazing = 0;
    for (const Output& sample : samples) {
      const double pdf = sample.direction.w, distance = sample.light.x, hit_pdf = sample.light.y,
                   t = sample.light.z;
      if (!(pdf > 0)) continue;
      ++used;
      const bool visible = std::fabs(t - distance) <= 1e-3 * distance;
      if (c.convex || (visible && sample.light.w >= 0.2)) {
        const Vec3 direction = to_vec3(sample.direction), local = frame.to_local(direction);
        const Vec3 chord = direction - frame.z;
        histogram.add(bins.bin(dot(chord, chord) / 2 / c.reach, turn(local.y, local.x), 1e-3));
      }
      // What is seen edge-on is left out.
      const bool edge_on = sample.light.w < 0.02 && to_vec3(sample.weight) == Vec3{};
      wrong_weight += !edge_on && !(length(to_vec3(sample.weight) * pdf - Vec3{1, 4, 2}) < 1e-5);
      if (sample.light.w < 0.02) {
        ++grazing;
        continue;
      }
      if (c.convex) blocked += sample.weight.w != 0;
      // Hidden behind a nearer part of the light.
      if (!visible) continue;
      ++seen;
      disagree += !(std::fabs(hit_pdf / pdf - 1) < 1e-3);
    }
    // The density integrates to the fraction of samples that fell there: all of them for a convex light.
    CHECK(integral == Approx(histogram.total / case_count).margin(4e-3));
    if (c.convex) {
      CHECK(used > 0.999 * case_count);
      CHECK(seen + grazing > 0.999 * case_count);
    }
    CHECK(seen > case_count / 5);
    // A point of a curve on the border of two steps of its table may be found in the other.
    CHECK(disagree <= (c.convex ? 0 : 10));
    CHECK(blocked == 0);
    CHECK(wrong_weight == 0);
    check_chi_square(histogram, light_histograms, c.name);
  }
}
