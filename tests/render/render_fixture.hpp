// What the image tests share: rendering a scene, and comparing pictures.
#pragma once

#include <string>

#include "accuracy/compare.hpp"
#include "image/image.hpp"
#include "render/render.hpp"
#include "scene/scene.hpp"

namespace causticl {

/// Loads a scene written in the test.
Scene scene_from_text(const std::string& json);

/// Loads scenes/NAME of the source tree at a small size.
Scene shipped_scene(const std::string& name, int width, int height);

/// Renders with the integrator and `passes` passes (sppm) or samples a pixel (pt), on the test device.
RenderResult render_with(Scene scene, Integrator integrator, int passes, unsigned seed = 1,
                         Precision precision = Precision::float32);

/// Checks that two renders have the same picture to the bit, not a black one, by as many rays, with the same
/// faults.
void check_same_render(const RenderResult& a, const RenderResult& b);

/// A layer that a picture has as channels.
Picture layer_of(const Picture& picture, const std::string& name);

/// The mean over all pixels of a picture's luminance.
double mean_luminance(const Picture& picture);

/// The mean of each channel over all pixels.
Vec3 mean_color(const Picture& picture);

/// A picture of the means of box x box pixels; what does not fill a box at the right and bottom is left out.
Picture box_filtered(const Picture& picture, int box);

}  // namespace causticl
