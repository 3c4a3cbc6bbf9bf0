#include "device_scene/device_scene.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "device_scene/material_record.hpp"
#include "scene/float4.hpp"
#include "world/emitters.hpp"
#include "world/flat_scene.hpp"

namespace causticl {
namespace {

/// IEEE half, round to nearest even; large values become the largest finite one. NaN and infinity stay what
/// they are: the kernels stop and count them.
std::uint16_t to_half(float value) {
  cl_half sign = 0;
  if (value < 0) {
    sign = 0x8000;
    value = -value;
  }
  if (std::isnan(value)) return 0x7e00;
  if (value >= 65504.0f) return static_cast<std::uint16_t>(sign | (std::isinf(value) ? 0x7c00 : 0x7bff));
  if (value == 0) return sign;  // frexp gives 0 the exponent of 1/4
  // The smallest normal half is 2^-14; below it the spacing stays 2^-24.
  int exponent;
  std::frexp(value, &exponent);
  exponent = std::max(exponent, -13);
  const double units = std::nearbyint(std::ldexp(static_cast<double>(value), 11 - exponent));
  // `units` has eleven bits from a normal number, its leading one carrying into the exponent field.
  return static_cast<std::uint16_t>(sign | (((exponent + 13) << 10) + static_cast<int>(units)));
}

/// Textures and one buffer of all their texels; images that several textures share are stored once.
void upload_textures(const Scene& scene, Device& device, DeviceScene& out) {
  std::vector<std::uint16_t> texels;
  std::vector<uint> first_texel;
  for (const auto& image : scene.images) {
    first_texel.push_back(static_cast<uint>(texels.size() / 4));
    for (const float value : image.rgba) texels.push_back(to_half(value));
    if (texels.size() / 4 > 0xffffffffu) throw UserError("the textures have more than 2^32 texels in all");
  }
  std::vector<Texture> textures;
  for (const auto& spec : scene.textures) {
    Texture texture{};
    texture.kind = spec.kind == TextureSpec::Kind::checker ? TEXTURE_CHECKER : TEXTURE_IMAGE;
    texture.a = to_float4(spec.a);
    texture.b = to_float4(spec.b);
    texture.scale = {static_cast<float>(spec.scale[0]), static_cast<float>(spec.scale[1])};
    texture.bilinear = spec.bilinear;
    if (spec.image >= 0) {
      texture.first_texel = first_texel[spec.image];
      texture.width = static_cast<uint>(scene.images[spec.image].width);
      texture.height = static_cast<uint>(scene.images[spec.image].height);
    }
    textures.push_back(texture);
  }
  // Programs that are compiled for textures look one up at every surface, and choose then.
  if (textures.empty()) textures.emplace_back();
  out.textures = device.upload(textures, "textures");
  out.texels = device.upload(texels, "texels");
}

/// Writes `data` into `buffer`, or into a new one where that is too small.
template <typename T>
void upload_into(cl::Buffer& buffer, Device& device, const std::vector<T>& data, const std::string& what) {
  const std::size_t bytes = data.size() * sizeof(T);
  if (!buffer() || buffer.getInfo<CL_MEM_SIZE>() < bytes)
    buffer = device.upload(data, what);
  else if (bytes)
    device.queue().enqueueWriteBuffer(buffer, CL_TRUE, 0, bytes, data.data());
}

}  // namespace

void place_flat_scene(const Scene& scene, double time, Device& device, DeviceScene& out) {
  const FlatScene world = flatten_scene(scene, time, out.dielectrics);
  KdTree tree = build_kdtree(world.tree, out.threads);
  if (out.triangle_test == TriangleTest::precomputed) add_triangle_transforms(tree, out.threads);
  upload_into(out.nodes, device, tree.nodes, "tree nodes");
  upload_into(out.blocks, device, tree.blocks, "triangle blocks");
  upload_into(out.attributes, device, world.attributes, "triangle attributes");
  upload_into(out.shapes, device, world.shapes, "shapes");
  upload_into(out.curves, device, world.curves, "curves");
  upload_into(out.emitters, device, world.emitters, "emitters");
  upload_into(out.environment, device, world.environment, "environment");

  out.plane_count = world.plane_count;
  out.emitter_count = static_cast<uint>(world.emitters.size());
  out.delta_lights = static_cast<uint>(
      std::count_if(world.emitters.begin(), world.emitters.end(),
                    [](const Emitter& emitter) { return (LIGHTS_WITH(DELTA) >> emitter.type & 1) != 0; }));
  out.emitted_power = world.emitted_power;
  double extent = 0;
  for (int axis = 0; axis < 3; ++axis) {
    out.center[axis] = 0.5 * (static_cast<double>(tree.bounds.low[axis]) + tree.bounds.high[axis]);
    extent = std::max(extent, 0.5 * (static_cast<double>(tree.bounds.high[axis]) - tree.bounds.low[axis]));
  }
  if (extent > 0) out.extent = extent;
  out.triangles = world.tree.triangles.size();
  out.shapes_count = world.shapes.size();
  out.skipped_triangles = tree.skipped;
  out.tree_build_seconds += tree.build_seconds;
}

DeviceScene update_device_scene(const Scene& scene, Device& device, unsigned threads,
                                TriangleTest triangle_test) {
  DeviceScene out;
  out.threads = threads;
  out.triangle_test = triangle_test;
  out.dielectrics = find_dielectrics(scene);
  place_flat_scene(scene, scene.camera.shutter[0], device, out);
  std::vector<Material> materials;
  for (const auto& spec : scene.materials) {
    materials.push_back(material_record(spec, scene.outside_ior));
    if (spec.light >= 0) materials.back().emission.w = static_cast<float>(emitters_from(scene, spec.light));
  }
  // Behind those of the scene one for each body, in the order in which they fill what several hold.
  for (std::size_t i = 0; i < out.dielectrics.bodies.size(); ++i) {
    const Object& body = scene.objects[static_cast<std::size_t>(out.dielectrics.bodies[i])];
    materials.push_back(materials[static_cast<std::size_t>(body.material)]);
  }
  out.materials = device.upload(materials, "materials");
  upload_textures(scene, device, out);
  return out;
}

Camera device_camera(const CameraSpec& spec) {
  Camera camera{};
  camera.origin = to_float4(spec.origin, spec.plane_distance);
  camera.axis = to_float4(spec.axis, spec.focal_distance);
  camera.right = to_float4(spec.right, spec.aperture);
  camera.up = to_float4(spec.up, spec.flat_focus ? 1 : 0);
  camera.lens_right = to_float4(normalize(spec.right));
  camera.lens_up = to_float4(normalize(spec.up));
  return camera;
}

cl_uint set_scene_arguments(cl::Kernel& kernel, const DeviceScene& scene, cl_uint index) {
  for (const cl::Buffer* buffer :
       {&scene.nodes, &scene.blocks, &scene.attributes, &scene.shapes, &scene.curves, &scene.materials,
        &scene.textures, &scene.texels, &scene.emitters, &scene.environment})
    kernel.setArg(index++, *buffer);
  return index;
}

}  // namespace causticl
