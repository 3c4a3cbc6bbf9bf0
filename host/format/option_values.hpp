// Values as people write them on the command line and in scenes: fractions, times, names of integrators.
#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace causticl {

/// The whole of `text` as a number, if it is one.
template <typename T>
std::optional<T> number(const std::string& text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || text.empty()) return {};
  return value;
}

/// "2%" or "0.02" as a fraction between 0 and `below`. A number of 1 and more needs its percent sign: nobody
/// who writes 2 means 200%.
std::optional<double> parse_fraction(std::string text, double below);

/// What to write for a `text` that parse_fraction() refuses for want of a percent sign, as in "2% or 0.02";
/// empty where it refuses it for something else.
std::string fraction_spellings(const std::string& text, double below);

/// Seconds of "90", "90s", "10m", "1h30m", "1.5h", "2d", "250ms"; units fall and none comes twice.
std::optional<double> parse_duration(const std::string& text);

/// "pt", "path", "path-tracing", ...; "sppm", "photon", "photon_mapping", ...: in any case, and with or
/// without what joins the words.
std::optional<Integrator> parse_integrator(const std::string& text);

/// The names of all integrators, and then all other spellings.
std::vector<std::string> integrator_spellings();

}  // namespace causticl
