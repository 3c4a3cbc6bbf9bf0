// Checks of what stands on the command line: each says what was expected and what was found.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/spelling.hpp"
#include "format/option_values.hpp"
#include "scene/integrators.hpp"

namespace causticl {

constexpr int largest_int = 2147483647;
constexpr int largest_extent = 65536;  // pixels of an edge

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

inline std::optional<std::pair<int, int>> parse_size(const std::string& text) {
  const auto cross = text.find_first_of("xX");
  if (cross == std::string::npos) return {};
  const auto width = number<int>(text.substr(0, cross)), height = number<int>(text.substr(cross + 1));
  if (!width || !height || *width < 1 || *height < 1 || *width > largest_extent || *height > largest_extent)
    return {};
  return std::pair{*width, *height};
}

/// A validator that says what was expected and what was found. It sees the text before CLI11 converts it, so
/// that every fault of a value gets a message of this one form.
template <typename Accepts>
CLI::Validator expect(const std::string& expected, Accepts accepts) {
  return CLI::Validator(
      [=](std::string& text) {
        return accepts(text) ? std::string() : "expected " + expected + ", found '" + text + "'";
      },
      "");
}

inline CLI::Validator whole_number(std::int64_t low, std::int64_t high) {
  const auto accepts = [=](const std::string& text) {
    const auto value = number<std::int64_t>(text);
    return value && *value >= low && *value <= high;
  };
  return expect("a whole number from " + std::to_string(low) + " to " + std::to_string(high), accepts);
}

inline const auto is_bytes = [](const std::string& text) { return parse_bytes(text).has_value(); };
/// A fraction between 0 and `below`; a number that lacks its percent sign is told the two spellings that
/// work.
inline CLI::Validator fraction(const std::string& expected, double below) {
  return CLI::Validator(
      [=](std::string& text) {
        if (parse_fraction(text, below)) return std::string();
        const std::string spellings = fraction_spellings(text, below);
        return "expected " + expected + ", found '" + text + "'" +
               (spellings.empty() ? "" : "; write " + spellings);
      },
      "");
}

/// A positive time, which becomes its number of seconds.
inline CLI::Validator duration() {
  return CLI::Validator(
      [](std::string& text) {
        const auto seconds = parse_duration(text);
        if (!seconds)
          return "expected a positive time in seconds, or as in 90s, 10m or 1h30m, found '" + text + "'";
        char exact[32];
        text.assign(exact, std::to_chars(exact, exact + sizeof exact, *seconds).ptr);
        return std::string();
      },
      "");
}

/// One of `names`, in any case; `expected` lists them for people.
inline CLI::Validator one_of(const std::string& expected, const std::vector<std::string>& names) {
  return CLI::Validator(
      [=](std::string& text) {
        const std::string wanted = CLI::detail::to_lower(text);
        if (std::find(names.begin(), names.end(), wanted) == names.end())
          return "expected " + expected + ", found '" + text + "'" + did_you_mean(text, names);
        text = wanted;
        return std::string();
      },
      "");
}

/// An integrator by any of its spellings, which becomes its name.
inline CLI::Validator integrator_name() {
  return CLI::Validator(
      [](std::string& text) {
        const auto integrator = parse_integrator(text);
        if (!integrator)
          return "expected " + listed(integrator_names()) + ", found '" + text + "'" +
                 did_you_mean(text, integrator_spellings());
        text = name_of(*integrator);
        return std::string();
      },
      "");
}

inline const auto is_size = [](const std::string& text) { return parse_size(text).has_value(); };
inline const auto is_override = [](const std::string& text) {
  const auto equals = text.find('=');
  return equals != std::string::npos && equals > 0;
};
inline const auto is_folder = [](const std::string& text) {
  std::error_code unreadable;
  return std::filesystem::is_directory(text, unreadable);
};

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
