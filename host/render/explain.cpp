#include "render/explain.hpp"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/printable.hpp"
#include "base/spelling.hpp"
#include "scene/integrators.hpp"
#include "scene/shape_kind.hpp"

namespace causticl {
namespace {

/// `text` and spaces up to `width`, two at least.
std::string column(const std::string& text, std::size_t width) {
  return text + std::string(text.size() + 2 > width ? 2 : width - text.size(), ' ');
}

std::string cost_text(const EffectCost& cost) {
  char text[160];
  std::snprintf(text, sizeof text, "%.3f +- %.3f  %s", cost.ratio, cost.spread, cost.compared.c_str());
  return text;
}

/// What a user might expect to be skipped and is not, or need not be.
std::vector<std::string> kept_for(const Scene& scene) {
  std::vector<std::string> kept;
  const auto bounded = std::any_of(scene.objects.begin(), scene.objects.end(),
                                   [](const Object& object) { return !is_infinite(object); });
  kept.push_back(bounded ? "tree: built over all bounded objects"
                         : "tree: none, since no object is bounded; its walk is not compiled");
  kept.push_back(scene.textures.empty()
                     ? "textures: none, so that no buffer holds any"
                     : "textures: " + std::to_string(scene.textures.size()) + " on the device");
  if (traces_photons(scene.renderer.integrator))
    kept.push_back(
        "visible points: traced anew each pass, with a pinhole too, since the film position within the "
        "pixel is drawn anew each pass: kept ones would leave edges jagged");
  return kept;
}

}  // namespace

Explanation explain(const Scene& scene) {
  Explanation result;
  result.scene = scene.file;
  result.integrator = name_of(scene.renderer.integrator);
  result.passes = plan_passes(scene);
  result.kept = kept_for(scene);
  for (const auto& effect : find_effects(scene)) {
    ExplainedEffect row{effect, {}, {}};
    for (const auto& pass : passes_to_run(result.passes))
      if (!effect.reason.empty() && (effects_of_pass(pass) & effect.bit)) row.passes.push_back(pass);
    result.effects.push_back(row);
  }
  return result;
}

std::string explanation_table(const Explanation& explanation) {
  std::string text = printable_line(explanation.scene) + ", " + explanation.integrator;
  if (!explanation.device.empty()) text += ", measured on " + explanation.device;
  text += "\n\n" + column("effect", 14) + column("called for by", 58) + "compiled into\n";
  for (const auto& [effect, passes, cost] : explanation.effects) {
    const bool called = !effect.reason.empty();
    text +=
        column(effect.key, 14) + column(called ? effect.reason : "-", 58) +
        (passes.empty() ? called ? "nothing: no pass that would read it runs" : "-" : joined(passes, ", ")) +
        "\n";
    if (cost) text += column("", 14) + "cost " + cost_text(*cost) + "\n";
  }
  text += "\n" + column("pass", 14) + "\n";
  for (const auto& pass : explanation.passes)
    text += column(pass.name, 14) + (pass.skipped.empty() ? "runs" : "skipped: " + pass.skipped) + "\n";
  text += "\n";
  for (const auto& line : explanation.kept) text += line + "\n";
  for (const auto& line : explanation.decided) text += "decided: " + line + "\n";
  return text;
}

std::string explanation_json(const Explanation& explanation) {
  using Json = nlohmann::ordered_json;
  Json effects = Json::array(), passes = Json::array();
  for (const auto& [effect, compiled_into, cost] : explanation.effects) {
    Json row = {{"key", effect.key},
                {"name", effect.name},
                {"called_for", !effect.reason.empty()},
                {"by", effect.reason},
                {"compiled_into", compiled_into}};
    if (cost) row["cost"] = {{"compared", cost->compared}, {"ratio", cost->ratio}, {"spread", cost->spread}};
    effects.push_back(row);
  }
  for (const auto& pass : explanation.passes)
    passes.push_back({{"name", pass.name}, {"runs", pass.skipped.empty()}, {"skipped", pass.skipped}});
  const Json object = {{"version", CAUSTICL_VERSION},
                       {"scene", explanation.scene},
                       {"integrator", explanation.integrator},
                       {"device", explanation.device},
                       {"effects", effects},
                       {"passes", passes},
                       {"kept", explanation.kept},
                       {"decided", explanation.decided}};
  return object.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace causticl
