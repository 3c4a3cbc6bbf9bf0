// What is done with every scene once it has been read, whatever its format.
#include <algorithm>

#include "format/scene_builder.hpp"
#include "scene/flush_emitters.hpp"

namespace causticl {
namespace {

void warn_without_light(const SourceLocation& whole, SceneBuilder& builder) {
  std::string flat;
  for (const Object& object : builder.scene.objects)
    if (emission_of(builder.scene, object) > 0 && !is_lit(builder.scene, object)) {
      if (flat.empty())
        flat = object.pointer;
      else if (!flat.ends_with(" and others"))
        flat += " and others";
    }
  if (!flat.empty()) flat += " should emit light, but without an area gives none";
  if (!has_light(builder.scene))
    builder.notice(whole, "no light: the image will be black" + (flat.empty() ? "" : "; " + flat));
  else if (!flat.empty())
    builder.notice(whole, flat);
}

}  // namespace

void SceneBuilder::finish(const SourceLocation& whole) {
  warn_without_light(whole, *this);
  const auto lifted = lift_flush_emitters(scene);
  constexpr std::size_t most_lifted = 4;
  for (std::size_t i = 0; i < std::min(most_lifted, lifted.size()); ++i) notice(whole, lifted[i]);
  if (lifted.size() > most_lifted)
    notice(whole, std::to_string(lifted.size() - most_lifted) + " more emitters are moved out of surfaces");
}

}  // namespace causticl
