#include "format/option_values.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "base/spelling.hpp"
#include "scene/integrators.hpp"

namespace causticl {
namespace {

struct TimeUnit {
  const char* name;
  double seconds;
};
constexpr TimeUnit time_units[] = {{"d", 86400}, {"h", 3600}, {"min", 60},  {"m", 60},
                                   {"sec", 1},   {"s", 1},    {"ms", 0.001}};

const TimeUnit* time_unit(const std::string& name) {
  for (const TimeUnit& unit : time_units)
    if (name == unit.name) return &unit;
  return nullptr;
}

}  // namespace

std::optional<double> parse_fraction(std::string text, double below) {
  const bool percent = !text.empty() && text.back() == '%';
  if (percent) text.pop_back();
  auto value = number<double>(text);
  if (!value || (!percent && *value >= 1)) return {};
  if (percent) *value /= 100;
  return *value > 0 && *value < below ? value : std::nullopt;
}

std::string fraction_spellings(const std::string& text, double below) {
  const auto value = number<double>(text);
  if (!value || !(*value >= 1) || !(*value / 100 < below)) return "";
  if (*value >= 100) return text + "%";
  char fraction[32];
  const auto [end, error] = std::to_chars(fraction, fraction + sizeof fraction, *value / 100);
  return text + "% or " + std::string(fraction, end);
}

std::optional<double> parse_duration(const std::string& text) {
  if (const auto seconds = number<double>(text))
    return std::isfinite(*seconds) && *seconds > 0 ? seconds : std::nullopt;
  const std::string all = lower(text);
  double sum = 0, last_unit = HUGE_VAL;
  for (const char *at = all.data(), *end = at + all.size(); at < end;) {
    double value = 0;
    const auto [after, error] = std::from_chars(at, end, value, std::chars_format::fixed);
    const char* unit_end = after;
    while (unit_end < end && std::isalpha(static_cast<unsigned char>(*unit_end))) ++unit_end;
    const TimeUnit* unit = time_unit({after, unit_end});
    if (error != std::errc() || !unit || !(value >= 0) || unit->seconds >= last_unit) return {};
    sum += value * unit->seconds;
    last_unit = unit->seconds;
    at = unit_end;
  }
  return std::isfinite(sum) && sum > 0 ? std::optional(sum) : std::nullopt;
}

std::optional<Integrator> parse_integrator(const std::string& text) {
  std::string letters;
  for (const char c : lower(text))
    if (c != '-' && c != '_' && c != ' ') letters += c;
  for (const IntegratorRow& row : integrator_rows) {
    const auto spellings = words_of(row.spellings);
    if (letters == row.name || std::find(spellings.begin(), spellings.end(), letters) != spellings.end())
      return row.integrator;
  }
  return {};
}

std::vector<std::string> integrator_spellings() {
  std::vector<std::string> spellings = integrator_names();
  for (const IntegratorRow& row : integrator_rows)
    for (const auto& word : words_of(row.spellings)) spellings.push_back(word);
  return spellings;
}

}  // namespace causticl
