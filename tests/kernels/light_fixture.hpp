// Emitters on the device, with kernels of a test's own run over them.
#pragma once

#include "chi_square_check.hpp"
#include "device_scene/device_scene.hpp"
#include "vector_inputs.hpp"

namespace causticl {

/// Of test_light.cpp and test_emission.cpp together, for Sidak's correction.
constexpr int light_histograms = 23;

inline void add_light(Scene& scene, Object::Shape shape, const Transform& transform, double radius,
                      Color emission, bool two_sided) {
  Object object;
  object.shape = shape;
  object.transform = transform;
  object.radius = radius;
  if (shape == Object::Shape::bezier) object.points = {{0.4, -1}, {1.5, -0.4}, {0.1, 0.5}, {0.8, 1}};
  object.material = static_cast<int>(scene.materials.size());
  MaterialSpec material;
  material.emission = emission;
  material.two_sided = two_sided;
  scene.materials.push_back(material);
  scene.objects.push_back(object);
}

/// The kernel emit(): how photons leave their emitters; origins[].w is which.
inline const char* const emission_source = R"(
#include "passes/pass_photon.cl"
kernel void emit(SCENE_PARAMETERS, global float4 *origins, global float4 *directions, global float4 *fluxes, uint count,
                 Params params) {
  uint i = get_global_id(0);
  if (i >= count) return;
  SCENE_INIT(params);
  RandomStream stream = {params.seed, params.pass, i};
  real3 flux;
  real4 direction = random4(stream, DIM_EMISSION);
  uint emitter = photon_emitter(&scene, stream);
  Ray ray = photon_emit_from(&scene, emitter, random4(stream, DIM_EMITTER), direction.x, direction.y, &flux);
  origins[i] = (float4)(convert_float3(ray.origin), emitter);
  directions[i] = (float4)(convert_float3(ray.direction), 0);
  fluxes[i] = (float4)(convert_float3(flux), 0);
}
)";

/// A scene on the device with kernels run over it.
struct Lights {
  DeviceScene scene;
  Params params{};
  cl::Program program;
  Lights(const Scene& spec, const cl::Program& kernels)
      : scene(update_device_scene(spec, test_device(), 1)), program(kernels) {
    params.emitter_count = scene.emitter_count;
    params.emitter_density = static_cast<float>(1 / scene.emitted_power);
    params.plane_count = scene.plane_count;
    params.seed = 7;
  }
  template <typename... Arguments>
  void run(const char* name, std::size_t items, const Arguments&... arguments) const {
    cl::Kernel kernel(program, name);
    cl_uint index = set_scene_arguments(kernel, scene);
    (kernel.setArg(index++, arguments), ...);
    test_device().launch(kernel, items);
    test_device().queue().finish();
  }
};

}  // namespace causticl
