// The scene on the device.
#pragma once

#include <algorithm>

#include "accel/kdtree.hpp"
#include "accel/triangle_transforms.hpp"
#include "opencl/device.hpp"
#include "scene/dielectrics.hpp"
#include "scene/scene.hpp"
#include "shared/types.h"

namespace causticl {

/// The buffers that every tracing kernel takes (SCENE_PARAMETERS of cl/scene/scene.cl), and what the host
/// keeps.
struct DeviceScene {
  cl::Buffer nodes, blocks, attributes, shapes, curves, materials, textures, texels, emitters, environment;
  uint emitter_count = 0, delta_lights = 0, plane_count = 0;
  double emitted_power = 0;  // of the largest channels of all emitters, over pi
  Vec3 center;               // of all bounded objects
  double extent = 1;         // their largest half extent
  double least_scale = 0;    // what the camera sees around it: see Pilot
  std::size_t triangles = 0, shapes_count = 0, skipped_triangles = 0;
  double tree_build_seconds = 0;                          // of all trees so far
  unsigned threads = 0;                                   // that build a tree; 0: all cores
  TriangleTest triangle_test = TriangleTest::watertight;  // of the kernels
  Dielectrics dielectrics;
};

/// The length by which the space that photons lie in is cut: half of how wide the scene is, but for what has
/// no end, as infinite planes and a medium.
inline double length_scale(const DeviceScene& scene) { return std::max(scene.extent, scene.least_scale); }

/// Uploads everything as it is when the shutter opens, with a tree built by `threads` threads (0: all cores),
/// for kernels with `triangle_test`.
DeviceScene update_device_scene(const Scene& scene, Device& device, unsigned threads = 0,
                                TriangleTest triangle_test = TriangleTest::watertight);

/// Puts what moves to where it is at `time`: builds shapes, emitters and tree anew and uploads them, into the
/// same buffers as long as they fit.
void place_flat_scene(const Scene& scene, double time, Device& device, DeviceScene& out);

/// The thin lens of the scene's camera.
Camera device_camera(const CameraSpec& camera);

/// Sets a tracing kernel's arguments from `index` on, and returns the index of the next.
cl_uint set_scene_arguments(cl::Kernel& kernel, const DeviceScene& scene, cl_uint index = 0);

}  // namespace causticl
