#include "image/image_exr_channels.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <stdexcept>

#include "base/text_input.hpp"

namespace causticl {
namespace {

enum Component { red, green, blue, alpha, luminance, other };

Component component_of(std::string name) {
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (name == "r" || name == "red") return red;
  if (name == "g" || name == "green") return green;
  if (name == "b" || name == "blue") return blue;
  if (name == "a" || name == "alpha") return alpha;
  if (name == "y") return luminance;
  return other;
}

/// The channels that share what stands before the last dot of their names.
struct Layer {
  std::array<std::string, 6> by_component;  // full names
  std::size_t colors = 0;                   // red, green and blue
  std::vector<std::string> others;          // luminance too

  void add(const std::string& full, Component component) {
    by_component[component] = full;
    if (component <= blue) ++colors;
    if (component >= luminance) others.push_back(full);
  }

  std::optional<ExrChannels> picture() const {
    ExrChannels result;
    result.names[alpha] = by_component[alpha];
    if (colors > 1) {
      std::copy_n(by_component.begin(), 3, result.names.begin());
      return result;
    }
    result.is_grey = true;
    result.names[0] = by_component[luminance];
    for (const Component component : {red, green, blue})
      if (colors == 1 && !by_component[component].empty()) result.names[0] = by_component[component];
    if (result.names[0].empty()) return {};
    return result;
  }

  /// The one channel beside alpha, whatever its name.
  std::optional<ExrChannels> single() const {
    if (others.size() != 1) return {};
    ExrChannels result;
    result.is_grey = true;
    result.names = {others[0], "", "", by_component[alpha]};
    return result;
  }
};

/// Of several layers the one that renderers save the whole picture in.
bool is_main(std::string layer) {
  layer = layer.substr(layer.rfind('.') + 1);
  for (char& c : layer) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return layer == "combined" || layer == "composite" || layer == "beauty" || layer == "rgba" ||
         layer == "rgb";
}

[[noreturn]] void fail_channels(const Imf::ChannelList& list) {
  std::string names;
  std::size_t count = 0;
  for (auto i = list.begin(); i != list.end(); ++i, ++count)
    if (count < 8) names.append(" ").append(quoted(i.name()));
  if (count > 8) names += " and " + std::to_string(count - 8) + " more";
  throw std::runtime_error("it has no channels R, G, B or Y, nor one layer of them, but:" + names);
}

}  // namespace

ExrChannels choose_exr_channels(const Imf::ChannelList& list) {
  std::map<std::string, Layer> layers;
  for (auto i = list.begin(); i != list.end(); ++i) {
    const std::string name = i.name();
    const auto dot = name.rfind('.');
    const std::string layer = dot == name.npos ? "" : name.substr(0, dot);
    layers[layer].add(name, component_of(dot == name.npos ? name : name.substr(dot + 1)));
  }
  if (const auto picture = layers[""].picture()) return *picture;

  std::vector<std::pair<std::string, ExrChannels>> pictures;
  for (const auto& [name, layer] : layers)
    if (const auto picture = layer.picture()) pictures.emplace_back(name, *picture);
  if (pictures.empty())
    for (const auto& [name, layer] : layers)
      if (const auto single = layer.single()) pictures.emplace_back(name, *single);
  auto chosen = pictures.begin();
  if (pictures.size() > 1)
    chosen = std::find_if(pictures.begin(), pictures.end(), [](const auto& p) { return is_main(p.first); });
  if (chosen == pictures.end()) fail_channels(list);
  ExrChannels result = chosen->second;
  if (!chosen->first.empty()) result.notes.push_back("its layer " + quoted(chosen->first) + " is read");
  return result;
}

}  // namespace causticl
