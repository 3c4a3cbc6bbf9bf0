// The keys of `renderer`, each with the field of RendererSpec that it fills. The reader, the JSON Schema, and
// what a study says and changes follow from these rows.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "format/scene_table.hpp"
#include "scene/scene.hpp"

namespace causticl {

/// A field of any of the types that a key may have; none for the keys of the disc light, which is an object.
using RendererField =
    std::variant<std::monostate, Integrator RendererSpec::*, Schedule RendererSpec::*,
                 Sampler RendererSpec::*, DirectLight RendererSpec::*, int RendererSpec::*,
                 std::int64_t RendererSpec::*, double RendererSpec::*, bool RendererSpec::*,
                 std::optional<double> RendererSpec::*, std::optional<bool> RendererSpec::*>;

struct RendererKey {
  SceneKey key;
  RendererField field;
};

const std::vector<RendererKey>& renderer_keys();

/// The row of a key by its first name. Throws std::logic_error where there is none.
const RendererKey& renderer_key(const std::string& name);

}  // namespace causticl
