#include "effects/effects.hpp"

#include <algorithm>
#include <sstream>

#include "base/error.hpp"
#include "base/spelling.hpp"
#include "effects/effect_reasons.hpp"

namespace causticl {

Effects find_effects(const Scene& scene) {
#define EFFECT_ROW(x, name, bit, key, programs, scalar, geometry, text) \
  {EFFECT_##name, key, text, effect_reason<EFFECT_##name>(scene)},
  Effects effects{EFFECT_TABLE(EFFECT_ROW, )};
#undef EFFECT_ROW
  std::sort(effects.begin(), effects.end(), [](const Effect& a, const Effect& b) { return a.bit < b.bit; });
  return effects;
}

unsigned effect_bits(const Effects& effects) {
  unsigned bits = 0;
  for (const auto& effect : effects)
    if (!effect.reason.empty()) bits |= effect.bit;
  return bits;
}

std::string effect_keys(const Effects& effects, unsigned bits) {
  std::string text;
  for (const auto& effect : effects)
    if (effect.bit & bits) text += (text.empty() ? "" : ", ") + effect.key;
  return text;
}

unsigned chosen_effects(const Effects& effects, const std::string& choice) {
  if (choice == "auto") return effect_bits(effects);
  if (choice == "all") return EFFECT_ALL;
  unsigned bits = 0;
  std::istringstream list(choice);
  for (std::string key; std::getline(list, key, ',');) {
    const auto found =
        std::find_if(effects.begin(), effects.end(), [&](const Effect& effect) { return effect.key == key; });
    if (found == effects.end()) {
      std::vector<std::string> keys{"auto", "all"};
      for (const auto& effect : effects) keys.push_back(effect.key);
      throw UserError("--effects: no effect is called '" + key + "'; expected auto, all, or a list of " +
                      effect_keys(effects, EFFECT_ALL) + did_you_mean(key, keys));
    }
    bits |= found->bit;
  }
  for (const auto& effect : effects)
    if (!effect.reason.empty() && !(effect.bit & bits))
      throw UserError("--effects " + choice + ": the scene calls for " + effect.key + " (" + effect.reason +
                      "); expected a list with " + effect_keys(effects, effect_bits(effects)));
  return bits;
}

}  // namespace causticl
