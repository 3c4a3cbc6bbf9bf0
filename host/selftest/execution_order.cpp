// Hard case 20: the same bits in any order of execution.
#include <cstring>

#include "selftest/photon_grid.hpp"
#include "selftest/random_check.hpp"
#include "selftest/scene_parts.hpp"
#include "selftest/stability_checks.hpp"

namespace causticl {
namespace {

/// Puts a device's work-group size back.
class WorkGroups {
 public:
  explicit WorkGroups(Device& device) : device_(device), size_(device.local_size()) {}
  ~WorkGroups() { device_.set_local_size(size_); }
  WorkGroups(const WorkGroups&) = delete;
  WorkGroups& operator=(const WorkGroups&) = delete;

  /// Calls function() with each of these numbers of work-items a group, and with the usual one again. Those
  /// that the device has not, or not for these kernels, are named in `note`.
  template <typename Function>
  void each(std::vector<std::size_t> sizes, std::string& note, const Function& function) {
    sizes.push_back(size_);
    for (const std::size_t size : sizes) {
      try {
        device_.set_local_size(size);
        function();
      } catch (const cl::Error& error) {
        if (error.err() != CL_INVALID_WORK_GROUP_SIZE && error.err() != CL_OUT_OF_RESOURCES) throw;
        note += (note.empty() ? "no work-groups of " : ", ") + std::to_string(size);
      }
    }
  }

 private:
  Device& device_;
  std::size_t size_;
};

/// PoCL compiles all kernels anew for each size: --quick tries the most unlike alone.
std::vector<std::size_t> sizes_to_try(const CheckContext& context) {
  return context.inputs < 1000000 ? std::vector<std::size_t>{1} : std::vector<std::size_t>{1, 32, 256};
}

/// Photons in a box, shuffled before each sort as if they had been stored in another order. All are bright
/// and many lie around each point, so that sums in single precision would round.
CheckResult sort_and_gather(CheckContext& context) {
  constexpr std::size_t point_count = 256;
  const auto photon_count = std::clamp<std::size_t>(context.inputs, 1 << 10, 1 << 16);
  CheckResult result;
  InputRandom random(context.seed, 0);
  std::vector<Photon> photons(photon_count);
  const uint normal = pack_normal({0, 1, 0});
  for (auto& photon : photons) {
    for (float& x : photon.position) x = static_cast<float>(random.uniform(-1, 1));
    photon.normal = normal;
    photon.flux_rg = static_cast<uint>(random.bits()) | 0x80008000u;
    photon.flux_b = static_cast<uint>(random.bits()) & 0xffffu;
  }
  std::vector<GatherPoint> points;
  for (std::size_t i = 0; i < point_count; ++i) {
    const auto coordinate = [&] { return static_cast<float>(random.uniform(-1, 1)); };
    points.push_back({coordinate(), coordinate(), coordinate(), normal});
  }
  const auto program = context.program(gather_source, 0);
  const Grid grid = make_grid({}, 1, 8, 8, 8);
  const auto expected = gather_photons(context.device, program, points, photons, grid, 0.25f);
  WorkGroups groups(context.device);
  do {
    groups.each(sizes_to_try(context), result.note, [&] {
      for (std::size_t i = photon_count - 1; i > 0; --i)
        std::swap(photons[i], photons[random.below(static_cast<std::uint32_t>(i + 1))]);
      const auto sums = gather_photons(context.device, program, points, photons, grid, 0.25f);
      for (std::size_t i = 0; i < point_count; ++i) result.failures += !(sums[i] == expected[i]);
      result.inputs += photon_count;
    });
  } while (result.inputs < context.inputs && result.note.empty());
  return result;
}

/// Two emitters over a glass ball and one of paint on a large ball: caustics, several lights, shadow
/// rays.
Scene small_scene(std::uint64_t photons) {
  Scene scene;
  scene.width = 32;
  scene.height = 24;
  scene.max_depth = 6;
  scene.renderer.passes = 3;
  scene.renderer.visible_points = 2;
  scene.renderer.radius = 0.3;
  scene.renderer.photons = static_cast<std::int64_t>(photons);
  scene.camera.origin = {0, 1, 6};
  scene.camera.right = {1, 0, 0};
  scene.camera.up = {0, 0.75, 0};
  const auto ball = [&](Vec3 center, double radius, const MaterialSpec& material) {
    Object object;
    object.radius = radius;
    object.transform = Transform::shift(center);
    object.material = static_cast<int>(scene.materials.size());
    scene.materials.push_back(material);
    scene.objects.push_back(object);
  };
  MaterialSpec paint, glass, emitter;
  paint.color = {0.8, 0.6, 0.4};
  glass.kind = MaterialSpec::Kind::glass;
  emitter.color = {0, 0, 0};
  emitter.emission = {20, 18, 15};
  ball({0, -100, 0}, 100, paint);
  ball({-1.2, 0.8, 0}, 0.8, glass);
  ball({1.2, 0.8, 0}, 0.8, paint);
  ball({0.5, 4, 1}, 0.3, emitter);
  ball({-2, 3, 0}, 0.2, emitter);
  return scene;
}

/// Whole pictures; each photon of each render is an input.
CheckResult picture(CheckContext& context) {
  CheckResult result;
  const std::uint64_t photons = std::clamp<std::uint64_t>(context.inputs / 16, 100, 2000000);
  Scene scene = small_scene(photons);
  if (context.inputs < 10000) scene.width = 8, scene.height = 6;  // as simulators of devices are given
  const auto render = [&] {
    const RenderResult rendered = render_for(context, scene);
    result.inputs += rendered.statistics.photons;
    return rendered.picture.rgb;
  };
  const auto expected = render();
  WorkGroups groups(context.device);
  groups.each(sizes_to_try(context), result.note, [&] {
    const auto pixels = render();
    for (std::size_t i = 0; i < expected.size(); ++i)
      result.failures += std::memcmp(&pixels[i], &expected[i], sizeof(float)) != 0;
  });
  return result;
}

}  // namespace

std::vector<Check> execution_order_checks() {
  return {{20, "sorting and gathering in any order", 4, sort_and_gather},
          {20, "a picture in any order of execution", 16, picture, pass_programs}};
}

}  // namespace causticl
