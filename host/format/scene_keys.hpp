// The tables of the scene format (keys_*.cpp): what a file may say, and what it means.
#pragma once

#include "format/scene_table.hpp"

namespace causticl {

constexpr std::int64_t most_pixels = std::int64_t{1} << 28;
constexpr std::int64_t most_visible_points = std::int64_t{1} << 31;  // of a pass

/// The whole file. All other tables hang from it.
const SceneTable& scene_keys();

/// The two forms of a camera, which differ by their keys.
const SceneTable& target_camera_keys();
const SceneTable& direct_camera_keys();

/// The values of the keys `camera`, `renderer`, `medium`, and of the entries of `objects`, `lights`,
/// `materials` and `transform`.
ValueType camera_type();
ValueType renderer_type();
ValueType medium_type();
ValueType object_type();
ValueType light_type();
ValueType material_type();
ValueType transform_step_type();
/// A texture in the place of a colour.
ValueType color_texture_type();
/// The base format's `texture` of an object.
ValueType base_texture_type();

}  // namespace causticl
