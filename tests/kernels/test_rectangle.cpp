// A rectangle whose radiance is an image: points in proportion to it, their densities, photons that leave it.
#include "format/load_scene.hpp"
#include "image/image_formats.hpp"
#include "light_fixture.hpp"
#include "temporary_folder.hpp"

using namespace causticl;

namespace {

const char* const source = R"(
typedef struct {
  float4 direction;  // w: pdf
  float4 weight;     // w: distance
  float4 emission;   // that the ray finds; w: the pdf of finding it
} Output;
kernel void sample(SCENE_PARAMETERS, global const float4 *uniform, global const float4 *positions, global Output *out,
                   uint count, Params params) {
  uint i = get_global_id(0);
  if (i >= count) return;
  SCENE_INIT(params);
  real3 position = convert_real3(positions[i].xyz);
  LightSample light = light_sample(&scene, position, convert_real4(uniform[i]));
  Output found = {(float4)(0), (float4)(0), (float4)(0)};
  found.direction = (float4)(convert_float3(light.direction), light.pdf);
  found.weight = (float4)(convert_float3(light.weight), light.distance);
  Ray ray = {position, light.direction};
  Hit hit = hit_none(INFINITY);
  if (light.pdf > 0 && geometry_closest(&scene.geometry, ray, &hit)) {
    Surface surface;
    geometry_surface(&scene.geometry, ray, hit, &surface);
    global const Material *material = materials + surface.material;
    found.emission.xyz = convert_float3(surface_emission(&scene, material, &surface, ray.direction));
    found.emission.w = light_pdf(&scene, position, ray.direction, hit, &surface, material);
  }
  out[i] = found;
}
)";

struct Output {
  float4 direction, weight, emission;
};

constexpr int columns = 7, rows = 5, histograms = 10;
constexpr std::size_t sample_count = 1 << 19;
constexpr double width = 3, height = 0.5;

cl::Program& program() {
  static cl::Program built = build_test_program(std::string(emission_source) + source);
  return built;
}

/// The rectangle, tilted, with an image of random colours, some of them black, beside a ball that emits.
struct Lamp {
  Scene scene;
  const Vec3 place{1, 2, 3}, normal = normalize(Vec3{1, -3, 0.5}), up{0, 0.3, 1},
                             x = normalize(cross(up, normal)), y = cross(normal, x), scale{2, 1, 0.5};
  std::vector<Vec3> texels;  // rows from the bottom
  double sum = 0;            // of their largest channels

  Lamp(RandomInputs& random, bool two_sided) {
    Picture picture{columns, rows, std::vector<float>(3 * columns * rows)};
    for (int i = 0; i < columns * rows; ++i)
      for (int c = 0; c < 3; ++c)
        picture.rgb[static_cast<std::size_t>(3 * i + c)] =
            i % 6 == 1 ? 0 : static_cast<float>(std::pow(10, random.uniform(-2, 1)));
    for (int row = rows; row-- > 0;)
      for (int column = 0; column < columns; ++column) {
        const float* rgb = &picture.rgb[static_cast<std::size_t>(3 * (row * columns + column))];
        texels.push_back({rgb[0] * scale.x, rgb[1] * scale.y, rgb[2] * scale.z});
        sum += max_component(texels.back());
      }
    const TemporaryFolder folder;
    folder.write("image.pfm", encode_pfm(picture));
    scene = load_scene(
        folder.write("scene.json",
                     R"({"camera": {"position": [0, 1, 5], "target": [0, 0, 0],
      "fov": 40}, "objects": [{"type": "sphere", "radius": 1, "material": {"type": "diffuse", "emission": 0.2},
      "transform": [{"type": "shift", "x": 0, "y": 50, "z": 0}]}],
      "lights": [{"type": "rectangle", "position": [1, 2, 3], "normal": [1, -3, 0.5], "up": [0, 0.3, 1],
      "size": [3, 0.5], "two_sided": )" +
                         std::string(two_sided ? "true" : "false") +
                         R"(, "radiance": {"type": "image", "path": "image.pfm", "scale": [2, 1, 0.5]}}]})"));
  }

  /// Of one side, over pi.
  double power() const { return sum / (columns * rows) * width * height; }
  double probability(bool two_sided) const {
    const double mine = power() * (two_sided ? 2 : 1);
    return mine / (mine + 0.2 * 4 * M_PI);
  }

  /// The texel at a point, or -1 near its border or off the rectangle.
  int texel(Vec3 point) const {
    const double u = (dot(point - place, x) / width + 0.5) * columns,
                 v = (dot(point - place, y) / height + 0.5) * rows;
    const auto near = [](double t) { return std::fabs(t - std::round(t)) < 1e-3; };
    if (near(u) || near(v) || u < 0 || u > columns || v < 0 || v > rows) return -1;
    return static_cast<int>(v) * columns + static_cast<int>(u);
  }

  Histogram proportional() const {
    Histogram histogram(texels.size());
    for (std::size_t i = 0; i < texels.size(); ++i)
      histogram.probabilities[i] = max_component(texels[i]) / sum;
    return histogram;
  }
};

void check_samples(const Lamp& lamp, const Lights& lights, RandomInputs& random, bool two_sided) {
  std::vector<float4> positions;
  while (positions.size() < sample_count) {
    const Vec3 from = std::pow(10, random.uniform(-0.5, 1)) * random_direction(random);
    const bool behind = dot(from, lamp.normal) < 0;
    positions.push_back(to_float4(lamp.place + (behind && !two_sided ? -from : from)));
  }
  const auto uniform = test_device().upload(uniform_tuples(random, sample_count), "uniform"),
             places = test_device().upload(positions, "positions");
  const auto out = test_device().buffer(sample_count * sizeof(Output), "samples");
  lights.run("sample", sample_count, uniform, places, out, cl_uint(sample_count), lights.params);
  Histogram chosen = lamp.proportional(), within(16);
  within.probabilities.assign(16, 1.0 / 16);
  const double probability = lamp.probability(two_sided);
  std::size_t drawn = 0, wrong_pdf = 0, wrong_weight = 0, wrong_hit = 0, compared = 0;
  const auto samples = test_device().download<Output>(out, sample_count);
  for (std::size_t i = 0; i < sample_count; ++i) {
    const Vec3 from = to_vec3(positions[i]), d = to_vec3(samples[i].direction);
    const double distance = samples[i].weight.w, pdf = samples[i].direction.w,
                 cosine = std::fabs(dot(d, lamp.normal));
    const Vec3 point = from + distance * d;
    if (!(distance < 20)) continue;  // the ball's
    ++drawn;
    const double u = (dot(point - lamp.place, lamp.x) / width + 0.5) * columns,
                 v = (dot(point - lamp.place, lamp.y) / height + 0.5) * rows;
    within.add(static_cast<std::size_t>(std::floor(4 * (u - std::floor(u)))) * 4 +
               static_cast<std::size_t>(std::floor(4 * (v - std::floor(v)))));
    // Rounding moves a point among texels: those near a border are not compared.
    const int texel = lamp.texel(point);
    if (texel < 0 || cosine < 0.02) continue;
    ++compared;
    const Vec3 radiance = lamp.texels[static_cast<std::size_t>(texel)];
    const double fraction = max_component(radiance) / lamp.sum;
    const double exact =
        probability * fraction * columns * rows / (width * height) * distance * distance / cosine;
    chosen.add(static_cast<std::size_t>(texel));
    wrong_pdf += !(std::fabs(pdf / exact - 1) < 2e-4);
    wrong_weight += !(length(to_vec3(samples[i].weight) * pdf - radiance) < 1e-5 * length(radiance));
    wrong_hit += !(length(to_vec3(samples[i].emission) - radiance) < 1e-5 * length(radiance) &&
                   std::fabs(samples[i].emission.w / exact - 1) < 1e-3);
  }
  CHECK(std::fabs(static_cast<double>(drawn) - sample_count * probability) <
        5 * std::sqrt(sample_count * probability * (1 - probability)));
  CHECK(compared > 0.8 * static_cast<double>(drawn));
  CHECK(wrong_pdf == 0);
  CHECK(wrong_weight == 0);
  CHECK(wrong_hit == 0);
  check_chi_square(chosen, histograms, "texels of samples");
  check_chi_square(within, histograms, "places within a texel");
}

void check_photons(const Lamp& lamp, const Lights& lights, bool two_sided) {
  const std::size_t bytes = sample_count * sizeof(float4);
  const auto origins = test_device().buffer(bytes, "origins"),
             directions = test_device().buffer(bytes, "directions"),
             fluxes = test_device().buffer(bytes, "fluxes");
  lights.run("emit", sample_count, origins, directions, fluxes, cl_uint(sample_count), lights.params);
  const auto starts = test_device().download<float4>(origins, sample_count),
             along = test_device().download<float4>(directions, sample_count),
             flux = test_device().download<float4>(fluxes, sample_count);
  Histogram chosen = lamp.proportional(), directed(32);
  directed.probabilities.assign(32, 1.0 / 32);
  std::size_t front = 0, emitted = 0, wrong_flux = 0, wrong_start = 0;
  for (std::size_t i = 0; i < sample_count; ++i) {
    if (starts[i].w != 1) continue;
    ++emitted;
    const Vec3 p = to_vec3(starts[i]), d = to_vec3(along[i]);
    const double cosine = dot(d, lamp.normal), off = dot(p - lamp.place, lamp.normal);
    front += cosine > 0;
    wrong_start += !(std::fabs(off) < 1e-4 && off * cosine > 0);
    directed.add(std::min<std::size_t>(31, static_cast<std::size_t>(32 * cosine * cosine)));
    const int texel = lamp.texel(p);
    if (texel < 0) continue;
    chosen.add(static_cast<std::size_t>(texel));
    const Vec3 radiance = lamp.texels[static_cast<std::size_t>(texel)];
    wrong_flux += !(length(to_vec3(flux[i]) - radiance / max_component(radiance)) < 1e-4);
  }
  CHECK(wrong_start == 0);
  CHECK(wrong_flux == 0);
  const double half = static_cast<double>(emitted) / 2;
  if (two_sided)
    CHECK(std::fabs(static_cast<double>(front) - half) < 5 * std::sqrt(half / 2));
  else
    CHECK(front == emitted);
  check_chi_square(chosen, histograms, "texels of photons");
  check_chi_square(directed, histograms, "squared cosines of photons");
}

}  // namespace

TEST_CASE("a rectangle's points are drawn in proportion to its image, with the density that is stated") {
  for (const bool two_sided : {false, true}) {
    CAPTURE(two_sided);
    RandomInputs random(171 + two_sided);
    const Lamp lamp(random, two_sided);
    const Lights lights(lamp.scene, program());
    check_samples(lamp, lights, random, two_sided);
    check_photons(lamp, lights, two_sided);
  }
}

TEST_CASE("several rectangles and an environment each draw from their own image") {
  RandomInputs random(175);
  const Lamp lamp(random, false);
  Scene scene = lamp.scene;
  LightSpec sky;
  sky.kind = LightSpec::Kind::environment;
  sky.map.width = 3;
  sky.map.height = 2;
  sky.map.rgba.assign(4 * 3 * 2, 1e-12f);
  scene.lights.insert(scene.lights.begin(), sky);
  // A second rectangle, of one texel, far away: the first one's texels stay its own.
  LightSpec second = scene.lights[1];
  second.map.width = second.map.height = 1;
  second.map.rgba.assign(4, 1e-12f);
  second.object = static_cast<int>(scene.objects.size());
  Object object = scene.objects[1];
  MaterialSpec material = scene.materials[static_cast<std::size_t>(object.material)];
  object.transform.translation = {0, -100, 0};
  object.material = static_cast<int>(scene.materials.size());
  material.light = 2;
  scene.materials[static_cast<std::size_t>(scene.objects[1].material)].light = 1;
  scene.objects.push_back(object);
  scene.materials.push_back(material);
  scene.lights.push_back(second);
  check_samples(lamp, Lights(scene, program()), random, false);
}
