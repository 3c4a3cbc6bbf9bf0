// Which triangles are slivers: the host's verdict against the kernel that asks.
#include "device_fixture.hpp"
#include "scene/object_triangles.hpp"

using namespace causticl;

namespace {

const char* const normal_kernel = R"(
#include "shapes/triangle.cl"
kernel void normals(global const float *corners, global float4 *out, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  global const float *c = corners + 9 * i;
  real3 n = triangle_normal((real3)(c[0], c[1], c[2]), (real3)(c[3], c[4], c[5]), (real3)(c[6], c[7], c[8]));
  out[i] = (float4)(convert_float3(n), 0);
}
)";

std::vector<float4> normals(unsigned effects, const std::vector<float>& corners) {
  const auto program = build_test_program(normal_kernel, effects);
  const std::size_t count = corners.size() / 9;
  auto in = test_device().upload(corners, "corners");
  auto out = test_device().buffer(count * sizeof(float4), "normals");
  cl::Kernel kernel(program, "normals");
  set_arguments(kernel, in, out, static_cast<cl_uint>(count));
  test_device().launch(kernel, count);
  return test_device().download<float4>(out, count);
}

/// A scene of one object, a mesh.
struct OneMesh {
  Scene scene;
  OneMesh() : scene() {
    scene.meshes.resize(1);
    scene.meshes[0].position_index = {{0, 1, 2}};
    scene.objects.resize(1);
    scene.objects[0].shape = Object::Shape::mesh;
    scene.objects[0].mesh = 0;
  }
  bool has_slivers(const std::vector<std::array<double, 3>>& corners) {
    scene.meshes[0].positions = corners;
    return causticl::has_slivers(scene, scene.objects[0]);
  }
};

}  // namespace

TEST_CASE(
    "what the host calls no needle has the same normal without the code for needles, wherever it has moved") {
  RandomInputs random(191);
  constexpr int wanted = 1 << 17;
  OneMesh mesh;
  std::vector<float> still, moved;
  int slivers = 0;
  while (still.size() < 9 * wanted) {
    const double size = std::pow(10, random.uniform(-3, 3)),
                 away = size * std::pow(10, random.uniform(-1, 4));
    const double angle = random.uniform(0.05, 0.3), longer = std::pow(10, random.uniform(-1, 1));
    const double turn = random.uniform(0, 6.3), c = std::cos(turn), s = std::sin(turn);
    const auto in_plane = [&](double length, double at) {
      const double x = length * std::cos(at), y = length * std::sin(at);
      return Vec3{c * x, s * x, y};
    };
    const Vec3 corner{random.uniform(-away, away), random.uniform(-away, away), random.uniform(-away, away)};
    const Vec3 motion{random.uniform(-away, away), random.uniform(-away, away), random.uniform(-away, away)};
    const Vec3 all[3] = {corner, corner + in_plane(size, 0), corner + in_plane(size * longer, angle)};
    std::vector<std::array<double, 3>> positions;
    for (const Vec3& p : all)
      positions.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
    mesh.scene.objects[0].motion = motion;
    if (mesh.has_slivers(positions)) {
      ++slivers;
      continue;
    }
    const double time = random.uniform();
    for (const auto& p : positions)
      for (int axis = 0; axis < 3; ++axis) {
        still.push_back(static_cast<float>(p[axis]));
        moved.push_back(static_cast<float>(p[axis] + time * motion[axis]));
      }
  }
  CHECK(slivers > wanted / 10);
  for (const auto& corners : {still, moved}) {
    const auto with = normals(EFFECT_ALL, corners), without = normals(EFFECT_ALL & ~EFFECT_SLIVERS, corners);
    // Bit by bit where sums of products are rounded as they are written; a GPU's compiler fuses some, one way
    // or another by what stands around them.
    const double allowed = test_device().info().type == "cpu" ? 0 : 1e-5;
    int different = 0;
    for (std::size_t i = 0; i < with.size(); ++i)
      different +=
          !(std::fabs(with[i].x - without[i].x) <= allowed &&
            std::fabs(with[i].y - without[i].y) <= allowed && std::fabs(with[i].z - without[i].z) <= allowed);
    CHECK(different == 0);
  }
}

TEST_CASE("thin triangles are needles, and so are those too small to tell") {
  OneMesh mesh;
  CHECK(!mesh.has_slivers({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  CHECK(mesh.has_slivers({{0, 0, 0}, {1, 0, 0}, {1, 0.05f, 0}}));
  CHECK(!mesh.has_slivers({{1, 0.05f, 0}, {0, 0, 0}, {1, 0, 0}}));  // the angle at its first corner decides
  CHECK(mesh.has_slivers({{1, 1, 1}, {1, 1, 1}, {0, 1, 0}}));
  CHECK(mesh.has_slivers({{1e6f, 1e6f, 0}, {1e6f + 0.5f, 1e6f, 0}, {1e6f, 1e6f + 0.5f, 0}}));
  // A box of two by two by `height` has slivers where its sides are thin; a sphere has none.
  Object& object = mesh.scene.objects[0];
  object.shape = Object::Shape::box;
  for (const double height : {0.1, 1.0}) {
    object.size = {2, height, 2};
    CHECK(has_slivers(mesh.scene, object) == (height < 0.2));
  }
  object.shape = Object::Shape::sphere;
  CHECK(!has_slivers(mesh.scene, object));
}
