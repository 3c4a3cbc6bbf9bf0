// Hard case 22: NaN and infinity from anywhere stop at their sample.
#include <bit>
#include <cmath>

#include "device_scene/diagnostics.hpp"
#include "film/film.hpp"
#include "selftest/random_check.hpp"
#include "selftest/scene_parts.hpp"
#include "selftest/stability_checks.hpp"
#include "shared/types.h"

namespace causticl {
namespace {

constexpr const char* source = R"(
#include "film/film.cl"
typedef struct { float estimates[4][3]; } Input;
typedef struct { FilmPixel pixel; uint counted; uint unused; } Output;
// Four estimates for one pixel, with counters of its own.
kernel void add_four(global const Input *inputs, global Output *outputs, uint count, volatile global Counters *counters) {
  uint i = get_global_id(0);
  if (i >= count) return;
  for (uint k = 0; k < sizeof(FilmPixel) / sizeof(uint); ++k) ((global uint *)&outputs[i].pixel)[k] = 0;
  counters[i].non_finite = 0;
  for (int k = 0; k < 4; ++k)
    film_add(&outputs[i].pixel, convert_real3(vload3(k, inputs[i].estimates[0])), 0, k, counters + i);
  outputs[i].counted = counters[i].non_finite;
}
)";

struct Estimates {
  float rgb[4][3];
};
struct Summed {
  FilmPixel pixel;
  std::uint32_t counted, unused;
};

float sometimes_not_finite(InputRandom& random) {
  switch (random.below(16)) {
    case 0:
      return std::bit_cast<float>(0x7fc00000u | static_cast<std::uint32_t>(random.bits() & 0x803fffffu));
    case 1:
      return random.below(2) ? INFINITY : -INFINITY;
    default:
      return static_cast<float>(random.scale(-20, 20));
  }
}

/// The film's sum is that of the finite estimates, and the others are counted.
CheckResult film_leaves_out(CheckContext& context) {
  constexpr std::size_t batch = std::size_t{1} << 18;
  const auto counters = context.device.buffer(batch * sizeof(Counters), "counters");
  CheckKernel kernel(context, context.program(source, 0), "add_four");
  kernel.with(counters);
  return run_random_check(
      context, 1e-6, "relative",  // four roundings of 2^-24, and more than that is a fault
      [](InputRandom& random, std::uint64_t) {
        Estimates in;
        for (auto& rgb : in.rgb)
          for (float& value : rgb) value = sometimes_not_finite(random);
        return in;
      },
      [&](const auto& inputs) { return kernel.run<Summed>(inputs); },
      [](const Estimates& in, const Summed& out) {
        double sum[3]{};
        std::uint32_t bad = 0;
        for (const auto& rgb : in.rgb) {
          const bool finite = std::isfinite(rgb[0]) && std::isfinite(rgb[1]) && std::isfinite(rgb[2]);
          bad += !finite;
          for (int c = 0; c < 3 && finite; ++c) sum[c] += rgb[c];
        }
        if (out.counted != bad || out.pixel.left_out[0] + out.pixel.left_out[1] != bad)
          return static_cast<double>(NAN);
        double worst = 0;
        for (int c = 0; c < 3; ++c)
          worst = std::max(worst,
                           std::fabs(mean_of(out.pixel.radiance[c], 1) - sum[c]) / std::max(sum[c], 1e-30));
        return worst;
      });
}

Object rectangle(const Transform& transform, int material) {
  Object object;
  object.shape = Object::Shape::rectangle;
  object.transform = transform;
  object.material = material;
  return object;
}

/// A white box without a front wall, an emitter under its ceiling. Of the 2 x 2 texels of its back wall,
/// which the camera sees above the floor, one is `first` and one is `second`.
Scene bad_texture_scene(std::uint64_t inputs, float first, float second, Integrator integrator) {
  Scene scene;
  scene.width = scene.height =
      std::clamp(static_cast<int>(std::sqrt(static_cast<double>(inputs)) / 16), 6, 64);
  scene.max_depth = 6;
  scene.renderer.integrator = integrator;
  scene.renderer.photons = std::clamp<std::int64_t>(static_cast<std::int64_t>(inputs) / 50, 200, 20000);
  scene.renderer.passes = scene.renderer.samples = 4;
  scene.renderer.radius = 0.3;
  const Vec3 target{0, -0.5, -1};
  scene.camera.origin = {0, 0, 0.5};
  scene.camera.axis = normalize(target - scene.camera.origin);
  scene.camera.right = {0.6, 0, 0};
  scene.camera.up = cross({1, 0, 0}, scene.camera.axis) * 0.6;

  Image image{"", 2, 2, std::vector<float>(16, 0.5f)};
  std::fill_n(image.rgba.begin(), 3, first);
  std::fill_n(image.rgba.begin() + 12, 3, second);
  scene.images = {image};
  TextureSpec texture;
  texture.image = 0;
  scene.textures = {texture};
  MaterialSpec white, textured, emitter;
  white.color = {0.7, 0.7, 0.7};
  textured.color_texture = 0;
  emitter.color = {0, 0, 0};
  emitter.emission = {5, 5, 5};
  scene.materials = {white, textured, emitter};
  const auto wall = [](int axis, double degrees, Vec3 to) {
    return Transform::scale({2, 2, 1})
        .followed_by(Transform::rotate(axis, degrees * std::numbers::pi / 180))
        .followed_by(Transform::shift(to));
  };
  scene.objects = {rectangle(wall(0, 0, {0, 0, -1}), 1), rectangle(wall(0, -90, {0, -1, 0}), 0),
                   rectangle(wall(0, 90, {0, 1, 0}), 0), rectangle(wall(1, 90, {-1, 0, 0}), 0),
                   rectangle(wall(1, -90, {1, 0, 0}), 0)};
  scene.objects.push_back(rectangle(Transform::scale({0.5, 0.5, 1})
                                        .followed_by(Transform::rotate(0, std::numbers::pi / 2))
                                        .followed_by(Transform::shift({0, 0.9, 0})),
                                    2));
  return scene;
}

/// Whole pictures with bad texels: each must be that of black texels, to the bit, and
/// counted.
CheckResult bad_texels(CheckContext& context) {
  CheckResult result;
  for (const Integrator integrator : {Integrator::sppm, Integrator::pt}) {
    const auto render = [&](float first, float second) {
      return render_for(context, bad_texture_scene(context.inputs, first, second, integrator));
    };
    const RenderResult bad = render(NAN, INFINITY), black = render(0, 0);
    for (std::size_t i = 0; i < black.picture.rgb.size(); ++i)
      result.failures += !(bad.picture.rgb[i] == black.picture.rgb[i]);
    result.failures += bad.statistics.diagnostics.non_finite == 0;
    result.inputs += black.picture.rgb.size() / 3;
  }
  return result;
}

}  // namespace

std::vector<Check> non_finite_checks() {
  return {{22, "the film leaves out what is not finite", 1, film_leaves_out},
          {22, "bad texels change a counter and no pixel", 1, bad_texels, pass_programs}};
}

}  // namespace causticl
