// What the host asks about an integrator, by its row of INTEGRATOR_TABLE.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace causticl {

struct IntegratorRow {
  Integrator integrator;
  const char* name;           // "sppm"
  const char* spellings;      // others, with spaces between
  const char* text;           // "photon mapping"
  int RendererSpec::*passes;  // the field that counts its passes
  const char* passes_option;  // "--passes"
  const char* programs;       // with spaces between
  double mse_slope;           // d log MSE / d log passes in the long run
};

#define ROW_OF_INTEGRATOR(name, spellings, text, count, programs, slope) \
  {Integrator::name, #name, spellings, text, &RendererSpec::count, "--" #count, programs, slope},
constexpr IntegratorRow integrator_rows[] = {INTEGRATOR_TABLE(ROW_OF_INTEGRATOR)};
#undef ROW_OF_INTEGRATOR

/// The rows stand in the order of the enumeration, which is made of the same table.
constexpr const IntegratorRow& row_of(Integrator integrator) {
  return integrator_rows[static_cast<std::size_t>(integrator)];
}

/// "sppm", as scenes and --integrator have it.
constexpr const char* name_of(Integrator integrator) { return row_of(integrator).name; }

/// "photon", "camera", ...: in the order of their first use.
std::vector<std::string> programs_of(Integrator integrator);

/// Whether it traces photons, by which all that is said of them concerns it.
bool traces_photons(Integrator integrator);

/// Whether a pass is one sample of each pixel, and quick.
constexpr bool passes_are_samples(Integrator integrator) {
  return row_of(integrator).passes == &RendererSpec::samples;
}

/// The names of those that `holds` says yes to.
template <typename Holds>
std::vector<std::string> integrators_with(const Holds& holds) {
  std::vector<std::string> names;
  for (const IntegratorRow& row : integrator_rows)
    if (holds(row)) names.emplace_back(row.name);
  return names;
}

/// The names of all.
inline std::vector<std::string> integrator_names() {
  return integrators_with([](const IntegratorRow&) { return true; });
}

}  // namespace causticl
