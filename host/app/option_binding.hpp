// Options of the command line, each bound to the place where its value is used, with what it may hold. A
// value that is not understood gets a message that says what was expected and what was found.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/options.hpp"
#include "base/spelling.hpp"
#include "film/pass_set.hpp"
#include "format/load_scene.hpp"
#include "format/option_values.hpp"
#include "scene/integrators.hpp"

namespace causticl {

constexpr int largest_int = 2147483647;
constexpr int largest_extent = 65536;  // pixels of an edge
constexpr std::int64_t largest_seed = 4294967295;

/// "512M" or "4G" as bytes; without a letter they are bytes.
inline std::optional<std::uint64_t> parse_bytes(std::string text) {
  int shift = 0;
  constexpr std::string_view units = "KMGT";
  const auto unit = text.empty() ? units.npos : units.find(text.back());
  if (unit != units.npos) {
    shift = 10 * (static_cast<int>(unit) + 1);
    text.pop_back();
  }
  const auto value = number<std::uint64_t>(text);
  if (!value || *value == 0 || *value > std::uint64_t{1} << (50 - shift)) return {};
  return *value << shift;
}

/// "1:64": numbers of passes that count from 1, both included.
inline std::optional<PassRange> parse_pass_range(const std::string& text) {
  const auto colon = text.find(':');
  if (colon == std::string::npos) return {};
  const auto first = number<std::int64_t>(text.substr(0, colon)),
             last = number<std::int64_t>(text.substr(colon + 1));
  if (!first || !last || *first < 1 || *last < *first || *last >= largest_int) return {};
  return PassRange{static_cast<std::uint64_t>(*first - 1), static_cast<std::uint64_t>(*last)};
}

inline std::optional<std::pair<int, int>> parse_size(const std::string& text) {
  const auto cross = text.find_first_of("xX");
  if (cross == std::string::npos) return {};
  const auto width = number<int>(text.substr(0, cross)), height = number<int>(text.substr(cross + 1));
  if (!width || !height || *width < 1 || *height < 1 || *width > largest_extent || *height > largest_extent)
    return {};
  return std::pair{*width, *height};
}

/// How the text of an option becomes a value.
template <typename Value>
struct OptionText {
  std::string type;                                              // as the help shows it: "N", "WxH"
  std::string expected;                                          // after "expected "
  std::function<std::optional<Value>(const std::string&)> read;  // nothing for what is not understood
  std::function<std::string(const std::string&)> hint = {};      // what to add of such a text
};

/// Declares an option whose texts, each of them understood, go to `take`.
template <typename Text, typename Value>
CLI::Option* bind_text(CLI::App& app, const std::string& name, const std::function<void(const Text&)>& take,
                       const OptionText<Value>& text, const std::string& help) {
  return app.add_option_function<Text>(name, take, help)
      ->check(CLI::Validator(
          [text](std::string& word) {
            if (text.read(word)) return std::string();
            return "expected " + text.expected + ", found '" + word + "'" +
                   (text.hint ? text.hint(word) : "");
          },
          ""))
      ->type_name(text.type);
}

/// Declares an option whose value goes to `target`.
template <typename Value, typename Target>
CLI::Option* add_value(CLI::App& app, const std::string& name, Target& target, const OptionText<Value>& text,
                       const std::string& help) {
  return bind_text<std::string>(
      app, name, [&target, read = text.read](const std::string& word) { target = *read(word); }, text, help);
}

/// Declares an option that may be repeated, whose values `target` holds.
template <typename Value>
CLI::Option* add_values(CLI::App& app, const std::string& name, std::vector<Value>& target,
                        const OptionText<Value>& text, const std::string& help) {
  return bind_text<std::vector<std::string>>(
             app, name,
             [&target, read = text.read](const std::vector<std::string>& words) {
               for (const auto& word : words) target.push_back(*read(word));
             },
             text, help)
      ->allow_extra_args(false);
}

/// Declares an option that is given or not.
inline CLI::Option* add_switch(CLI::App& app, const std::string& name, bool& target,
                               const std::string& help) {
  return app.add_flag(name, target, help)->disable_flag_override();
}

/// Declares an option of any text but none, such as a file: an unset variable of a shell is no choice.
inline CLI::Option* add_text(CLI::App& app, const std::string& name, std::string& target,
                             const std::string& type, const std::string& help) {
  const auto not_empty = [type](const std::string& text) {
    return text.empty() ? "expected " + (type.empty() ? "a file" : type) + ", found nothing" : std::string();
  };
  return app.add_option(name, target, help)->check(CLI::Validator(not_empty, ""))->type_name(type);
}

template <typename Value>
OptionText<Value> whole_number(std::int64_t low, std::int64_t high) {
  return {"N", "a whole number from " + std::to_string(low) + " to " + std::to_string(high),
          [=](const std::string& text) -> std::optional<Value> {
            const auto value = number<std::int64_t>(text);
            if (!value || *value < low || *value > high) return {};
            return static_cast<Value>(*value);
          }};
}

/// A fraction between 0 and `below`; a number that lacks its percent sign is told the two spellings that
/// work.
inline OptionText<double> fraction_text(const std::string& expected, double below) {
  return {"SHARE", expected, [=](const std::string& text) { return parse_fraction(text, below); },
          [=](const std::string& text) {
            const std::string spellings = fraction_spellings(text, below);
            return spellings.empty() ? "" : "; write " + spellings;
          }};
}

/// A positive time, as its number of seconds.
inline OptionText<double> duration_text() {
  return {"TIME", "a positive time in seconds, or as in 90s, 10m or 1h30m", parse_duration};
}

/// One of some names, in any case.
template <typename Value>
OptionText<Value> choice_text(const std::string& type,
                              const std::vector<std::pair<std::string, Value>>& values) {
  std::vector<std::string> names;
  for (const auto& [name, value] : values) names.push_back(name);
  return {type, listed(names),
          [=](const std::string& text) -> std::optional<Value> {
            for (const auto& [name, value] : values)
              if (lower(text) == name) return value;
            return {};
          },
          [=](const std::string& text) { return did_you_mean(text, names); }};
}

/// An integrator by any of its spellings.
inline OptionText<Integrator> integrator_choice() {
  return {joined(integrator_names(), "|"), listed(integrator_names()), parse_integrator,
          [](const std::string& text) { return did_you_mean(text, integrator_spellings()); }};
}

inline OptionText<std::pair<int, int>> size_text() {
  return {"WxH", "WxH in pixels, as in 640x480, each from 1 to " + std::to_string(largest_extent),
          parse_size};
}

/// The memory of all images together, by which no other limit holds.
inline OptionText<ImageLimits> image_memory_text() {
  return {"SIZE", "a size from 1 to 1024T, as in 512M or 4G",
          [](const std::string& text) -> std::optional<ImageLimits> {
            const auto bytes = parse_bytes(text);
            if (!bytes) return {};
            return ImageLimits{*bytes, true};
          }};
}

inline std::optional<CropText> parse_crop(const std::string& text) {
  CropText crop{{}, text.find('.') != std::string::npos};
  std::size_t begin = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t end = i < 3 ? text.find(',', begin) : text.size();
    if (end == std::string::npos) return {};
    const auto edge = number<double>(text.substr(begin, end - begin));
    const double highest = crop.is_fraction ? 1 : largest_extent;
    if (!edge || !(*edge >= 0) || *edge > highest || (!crop.is_fraction && *edge != std::floor(*edge)))
      return {};
    crop.edge[i] = *edge;
    begin = end + 1;
  }
  if (!(crop.edge[0] < crop.edge[2]) || !(crop.edge[1] < crop.edge[3])) return {};
  return crop;
}

inline OptionText<CropText> crop_text() {
  return {"x0,y0,x1,y1",
          "x0,y0,x1,y1, the left, top, right and bottom edge in pixels, as in 0,0,320,240, or as fractions "
          "with a "
          "decimal point, as in 0.0,0.0,0.5,0.5",
          parse_crop};
}

inline OptionText<PassRange> pass_range_text() {
  return {"A:B", "A:B, the first and the last of some passes, as in 1:64", parse_pass_range};
}

inline OptionText<std::string> folder_text() {
  return {"DIR", "an existing folder", [](const std::string& text) -> std::optional<std::string> {
            std::error_code unreadable;
            if (!std::filesystem::is_directory(text, unreadable)) return {};
            return text;
          }};
}

inline OptionText<Override> override_text() {
  return {"key=value", "key=value, as in renderer.radius=0.1",
          [](const std::string& text) -> std::optional<Override> {
            const auto equals = text.find('=');
            if (equals == std::string::npos || equals == 0) return {};
            return Override{text.substr(0, equals), text.substr(equals + 1)};
          }};
}

/// `text` with line breaks in place of spaces, so that no line is longer than `width`.
inline std::string wrapped(const std::string& text, std::size_t width) {
  std::string result;
  std::size_t line = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::size_t word = end - begin;
    if (line > 0) result += line + 1 + word > width ? '\n' : ' ';
    line = line > 0 && line + 1 + word <= width ? line + 1 + word : word;
    result += text.substr(begin, word);
    begin = end + 1;
  }
  return result;
}

}  // namespace causticl
