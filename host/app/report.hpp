// Statistics as a table and as JSON, the list of devices, and what a scene holds.
#pragma once

#include <string>
#include <vector>

#include "opencl/device.hpp"
#include "render/render.hpp"
#include "scene/scene.hpp"

namespace causticl {

/// "512 B", "1.50 GiB".
std::string byte_size(double bytes);

/// The table of --stats.
std::string statistics_table(const Statistics& statistics);

/// The object of --stats-json: every number of the table, times in seconds but for the kernels' milliseconds.
std::string statistics_json(const Statistics& statistics);

/// Every device with its index. Throws DeviceError where there is none.
std::string device_list(const std::vector<DeviceInfo>& devices);

/// What was loaded: image, integrator, camera, objects, materials, textures, emitters, bounds and notices.
std::string scene_summary(const Scene& scene);

}  // namespace causticl
