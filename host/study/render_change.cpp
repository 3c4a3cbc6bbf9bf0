#include "study/render_change.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <type_traits>

#include "format/option_values.hpp"
#include "format/renderer_keys.hpp"
#include "scene/integrators.hpp"

namespace causticl {
namespace {

/// The value of a key from its text, into the field; the texts are the study's own.
struct FieldSetter {
  const RendererKey& row;
  const std::string& text;
  RendererSpec& renderer;

  void operator()(std::monostate) const { fail(); }
  void operator()(Integrator RendererSpec::*field) const {
    renderer.*field = checked(parse_integrator(text));
  }
  template <typename Value>
  void operator()(Value RendererSpec::*field) const {
    renderer.*field = value<Value>();
  }
  template <typename Value>
  void operator()(std::optional<Value> RendererSpec::*field) const {
    renderer.*field = value<Value>();
  }

 private:
  [[noreturn]] void fail() const {
    throw std::logic_error("a study cannot set " + std::string(row.key.name) + " to " + text);
  }
  template <typename Value>
  Value checked(const std::optional<Value>& found) const {
    if (!found) fail();
    return *found;
  }
  template <typename Value>
  Value value() const {
    if constexpr (std::is_same_v<Value, bool>) {
      if (text != "true" && text != "false") fail();
      return text == "true";
    } else if constexpr (std::is_enum_v<Value>) {
      const auto& words = row.key.type.words;
      const auto word = std::find(words.begin(), words.end(), text);
      if (word == words.end()) fail();
      return static_cast<Value>(word - words.begin());
    } else {
      return checked(number<Value>(text));
    }
  }
};

/// The same the other way round.
struct FieldText {
  const RendererKey& row;
  const RendererSpec& renderer;

  template <typename Value>
  std::string operator()(Value RendererSpec::*field) const {
    const Value value = renderer.*field;
    if constexpr (std::is_same_v<Value, bool>)
      return value ? "true" : "false";
    else if constexpr (std::is_enum_v<Value>)
      return row.key.type.words.at(static_cast<std::size_t>(value));
    else if constexpr (std::is_same_v<Value, double>)
      return short_number(value);
    else
      return std::to_string(value);
  }
  template <typename Value>
  std::string operator()(std::optional<Value> RendererSpec::*) const {
    return (*this)(std::monostate{});
  }
  std::string operator()(std::monostate) const {
    throw std::logic_error(std::string(row.key.name) + " need not have a value");
  }
};

std::vector<std::string> merged_words(const std::vector<std::string>& words,
                                      const std::vector<std::string>& more) {
  std::vector<std::string> result;
  for (std::size_t i = 0; i + 1 < words.size(); i += 2)  // every option here takes one value
    if (words[i] == "-D" || std::find(more.begin(), more.end(), words[i]) == more.end())
      result.insert(result.end(), {words[i], words[i + 1]});
  result.insert(result.end(), more.begin(), more.end());
  return result;
}

}  // namespace

RenderChange integrator_change(Integrator integrator) {
  return {{"--integrator", name_of(integrator)}, integrator, {}};
}

RenderChange renderer_change(const std::string& key, const std::string& value) {
  const RendererKey& row = renderer_key(key);
  RendererSpec probe;
  std::visit(FieldSetter{row, value, probe}, row.field);  // throws now where it would later
  return other_change({"-D", "renderer." + key + "=" + value}, [&row, value](Scene& scene, RenderOptions&) {
    std::visit(FieldSetter{row, value, scene.renderer}, row.field);
  });
}

RenderChange photons_change(std::int64_t photons) {
  return other_change({"--photons", std::to_string(photons)},
                      [=](Scene& scene, RenderOptions&) { scene.renderer.photons = photons; });
}

RenderChange other_change(std::vector<std::string> words, std::function<void(Scene&, RenderOptions&)> step) {
  return {std::move(words), {}, {std::move(step)}};
}

RenderChange merged(const RenderChange& change, const RenderChange& more) {
  RenderChange result{merged_words(change.words, more.words),
                      more.integrator ? more.integrator : change.integrator, change.steps};
  result.steps.insert(result.steps.end(), more.steps.begin(), more.steps.end());
  return result;
}

std::string renderer_value(const RendererSpec& renderer, const std::string& key) {
  const RendererKey& row = renderer_key(key);
  return std::visit(FieldText{row, renderer}, row.field);
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, std::fabs(value) >= 1000 && std::fabs(value) < 1e9 ? "%.0f" : "%.4g",
                value);
  return text;
}

}  // namespace causticl
