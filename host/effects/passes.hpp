// Which passes a render runs, and why the others do not.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace causticl {

/// Whether photons that land on the material may be stored: cl/photons/photon_interaction.cl.
bool stores_photons(const MaterialSpec& material);

/// A pass is a program: "photon" is cl/passes/pass_photon.cl.
struct PassPlan {
  std::string name;
  std::string skipped;  // why it does not run; empty where it does
};

/// The passes of the scene's integrator in the order of their first use. A pass is skipped only where it
/// could change no bit of the picture. A pure function of the scene.
std::vector<PassPlan> plan_passes(const Scene& scene);

/// The names of those that run.
std::vector<std::string> passes_to_run(const std::vector<PassPlan>& plan);

/// A row of PASS_TABLE.
struct PassRow {
  const char* name;
  unsigned bit;             // IN_*
  const char* main_kernel;  // that runs whenever the pass does: its launches count the pass
  unsigned properties;
};
/// That of a pass. Throws std::logic_error where there is none.
const PassRow& pass_row(const std::string& pass);

/// Why that pass is skipped; empty where it runs.
std::string why_skipped(const std::vector<PassPlan>& plan, const std::string& pass);

}  // namespace causticl
