// Which dielectrics hold a point, and what a path meets where surfaces lie at one place.
#include "device_fixture.hpp"
#include "device_scene/device_scene.hpp"
#include "device_scene/params.hpp"
#include "render/render_fixture.hpp"
#include "scene/body.hpp"

using namespace causticl;

namespace {

const char* const source = R"(
#include "scene/path_media.cl"
kernel void around(SCENE_PARAMETERS, global const float4 *points, global uint4 *out, uint count, Params params) {
  uint i = get_global_id(0);
  if (i >= count) return;
  SCENE_INIT(params);
  uint diagnostics = 0;
  MediumStack stack = media_around(&scene, points[i].xyz, &diagnostics);
  uint bits = 0;
  for (uint k = 0; k < stack.count; ++k) bits |= 1u << (stack.material[k] & 31u);
  out[i] = (uint4)(medium_stack_top(&stack), bits, diagnostics, stack.count);
}
// Each ray from a place in the media around it to what it meets: materials before and behind, whether it crosses a
// dielectric (1) and whether something opaque lies behind that in contact (2), and the primitive that is met first.
kernel void meet(SCENE_PARAMETERS, global const float4 *rays, global uint4 *out, uint count, Params params) {
  uint i = get_global_id(0);
  if (i >= count) return;
  SCENE_INIT(params);
  uint diagnostics = 0;
  Ray ray = {rays[2 * i].xyz, rays[2 * i + 1].xyz};
  MediumStack stack = media_around(&scene, ray.origin, &diagnostics);
  Hit hit = hit_none(INFINITY);
  uint4 result = (uint4)(MEDIUM_OUTSIDE, MEDIUM_OUTSIDE, 0, diagnostics);
  if (geometry_closest(&scene.geometry, ray, &hit)) {
    Surface surface;
    geometry_surface(&scene.geometry, ray, hit, &surface);
    Interface interface = contact_meet(&scene, ray, &stack, &hit, &surface, &diagnostics);
    result = (uint4)(medium_stack_top(&interface.before), medium_stack_top(&interface.behind),
                     (interface.crosses ? 1u : 0u) | (interface.floor ? 2u : 0u) | (is_dielectric(&scene, &surface) ? 4u : 0u),
                     diagnostics);
  }
  out[i] = result;
}
)";

struct TestScene {
  Scene scene;
  DeviceScene device_scene;
  Params params;
  uint first;  // material of the first body

  explicit TestScene(const std::string& objects)
      : scene(scene_from_text(
            R"({"width": 8, "height": 8, "camera": {"position": [0, 0, 9], "target": [0, 0, 0], "fov": 40},
            "lights": [{"type": "environment", "radiance": [1, 1, 1]}], "objects": [)" +
            objects + "]}")),
        device_scene(update_device_scene(scene, test_device())),
        params(scene_params(scene, device_scene, 1)),
        first(static_cast<uint>(scene.materials.size())) {}

  std::vector<uint4> run(const char* kernel_name, const std::vector<float4>& in, std::size_t count) {
    auto program = build_test_program(source);
    cl::Kernel kernel(program, kernel_name);
    cl_uint index = set_scene_arguments(kernel, device_scene);
    auto inputs = test_device().upload(in, "inputs");
    auto out = test_device().buffer(count * sizeof(uint4), "results");
    kernel.setArg(index++, inputs);
    kernel.setArg(index++, out);
    kernel.setArg(index++, static_cast<cl_uint>(count));
    kernel.setArg(index++, sizeof params, &params);
    test_device().launch(kernel, count);
    test_device().queue().finish();
    return test_device().download<uint4>(out, count);
  }
};

std::string box(const char* size, const char* shift, const char* material) {
  return std::string(R"({"type": "box", "size": )") + size + R"(, "material": )" + material +
         R"(, "transform": [{"type": "shift", )" + shift + "}]}";
}

const char* const glass = R"({"type": "glass", "ior": 1.5})";
const char* const water = R"({"type": "glass", "ior": 1.33, "absorption": [0, 0.1, 0.2]})";

}  // namespace

TEST_CASE("the dielectrics around a point are those of the winding number") {
  TestScene test(box("[2, 2, 2]", R"("x": 0, "y": 0, "z": 0)", glass) + "," +
                 box("[1, 3, 1]", R"("x": 0.4, "y": 0, "z": 0)", water) + "," +
                 R"({"type": "sphere", "radius": 1.2, "material": )" + glass +
                 R"(, "transform": [{"type": "shift", "x": 1, "y": 0.5, "z": 0}]},
                 {"type": "bezier_rotate", "point": [[0, -1], [1.5, -1], [1.5, 1], [0, 1]], "material": )" +
                 water + "}");
  REQUIRE(test.device_scene.dielectrics.bodies.size() == 4);
  constexpr std::size_t count = 1 << 14;
  RandomInputs random(232);
  std::vector<float4> points(count);
  for (auto& p : points) {
    p = {static_cast<float>(random.uniform(-2, 2.5)), static_cast<float>(random.uniform(-2, 2)),
         static_cast<float>(random.uniform(-2, 2)), 0};
    // Many on the planes of the boxes' symmetry, from where rays through edges are likeliest.
    if (random.uniform() < 0.3) p.x = 0;
    if (random.uniform() < 0.3) p.z = 0;
  }
  const auto results = test.run("around", points, count);
  std::vector<Body> bodies;
  for (const int index : test.device_scene.dielectrics.bodies)
    bodies.push_back(make_body(test.scene, test.scene.objects[index]));
  std::size_t wrong = 0, held = 0;
  for (std::size_t i = 0; i < count; ++i) {
    uint bits = 0, top = 0xffffffffu;
    bool doubtful = false;
    const Vec3 p{points[i].x, points[i].y, points[i].z};
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      if (bodies[k].holds(p)) bits |= 1u << (test.first + k), top = static_cast<uint>(test.first + k);
      // The oracle's revolved curve is cut into flat pieces.
      doubtful = doubtful || bodies[k].holds(p * 1.01) != bodies[k].holds(p * 0.99);
    }
    if (doubtful) continue;
    held += bits != 0;
    wrong += results[i].x != top || results[i].y != bits || results[i].z != 0;
  }
  CHECK(wrong == 0);
  CHECK(held > count / 8);
}

TEST_CASE("faces in contact are one boundary, and something opaque lies behind a gap of no width") {
  // From above: glass, water that shares a face with it, a floor on which the water stands.
  for (const bool turned : {false, true}) {
    const std::string upper = box("[1, 1, 1]", R"("x": 0, "y": 1.5, "z": 0)", glass),
                      lower = box("[1, 1, 1]", R"("x": 0, "y": 0.5, "z": 0)", water);
    const std::string floor =
        R"({"type": "rectangle", "material": {"type": "diffuse", "color": [0.5, 0.5, 0.5]},
        "transform": [{"type": "scale", "x": 9, "y": 9, "z": 1}, {"type": "rotate", "axis": "x", "degree": -90}]})";
    TestScene test(turned ? floor + "," + lower + "," + upper : upper + "," + lower + "," + floor);
    const uint glass_body = turned ? test.first + 1 : test.first,
               water_body = turned ? test.first : test.first + 1;
    constexpr std::size_t each = 1 << 12;
    RandomInputs random(233);
    std::vector<float4> rays;
    const float from[] = {2.5f, 1.5f, 0.5f, 0.5f};
    for (std::size_t i = 0; i < 4 * each; ++i) {
      const bool up = i / each == 3;
      Vec3 d{random.uniform(-1, 1), up ? 1.0 : -1.0, random.uniform(-1, 1)};
      d = normalize({0.3 * d.x, d.y, 0.3 * d.z});
      rays.push_back({static_cast<float>(random.uniform(-0.1, 0.1)), from[i / each],
                      static_cast<float>(random.uniform(-0.1, 0.1)), 0});
      rays.push_back({static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z), 0});
    }
    const auto results = test.run("meet", rays, 4 * each);
    const uint outside = 0xffffffffu;
    const uint4 expected[] = {{outside, glass_body, 5, 0},
                              {glass_body, water_body, 5, 0},
                              {water_body, outside, 7, 0},
                              {water_body, glass_body, 5, 0}};
    std::size_t wrong[4]{};
    for (std::size_t i = 0; i < results.size(); ++i) {
      const uint4 &is = results[i], &be = expected[i / each];
      wrong[i / each] += is.x != be.x || is.y != be.y || is.z != be.z || is.w != be.w;
    }
    for (const std::size_t number : wrong) CHECK(number == 0);
  }
}
