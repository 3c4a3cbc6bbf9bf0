// What a setting of a study changes of a render: as data, and as the words that do the same on the command
// line.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "render/render.hpp"
#include "scene/scene.hpp"

namespace causticl {

struct RenderChange {
  std::vector<std::string> words = {};        // of `causticl render`, for people to paste
  std::optional<Integrator> integrator = {};  // for which the scene is read
  std::vector<std::function<void(Scene&, RenderOptions&)>> steps = {};  // taken in order once it is
};

/// --integrator.
RenderChange integrator_change(Integrator integrator);

/// A key of the renderer, as -D sets it; `value` as it is written there.
RenderChange renderer_change(const std::string& key, const std::string& value);

/// --photons.
RenderChange photons_change(std::int64_t photons);

/// Any other option or key: its words, and the step that does the same.
RenderChange other_change(std::vector<std::string> words, std::function<void(Scene&, RenderOptions&)> step);

/// `more` after `change`; of an option other than -D that both have, the later value is kept.
RenderChange merged(const RenderChange& change, const RenderChange& more);

/// What a scene says of a key of the renderer that always has a value, as -D would set it.
std::string renderer_value(const RendererSpec& renderer, const std::string& key);

/// Up to four significant digits, as the command line and plots show a number.
std::string short_number(double value);

}  // namespace causticl
