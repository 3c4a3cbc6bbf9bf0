// What trades accuracy for time: the table of parameters that `causticl study` turns.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "study/render_change.hpp"

namespace causticl {

/// What the values of a parameter may depend on.
struct ParameterContext {
  const Scene& scene;       // as the user gave it
  double first_radius = 0;  // of SPPM, as the scene says or as chosen from it
  bool fp64 = false;        // the device has double precision
};

/// One position of a parameter.
struct ParameterValue {
  std::string label;
  RenderChange change;
};

struct StudyParameter {
  const char* name;                             // as --parameters takes it
  const char* title;                            // of its plot
  const char* unit;                             // of its values; empty: names
  const char* meaning;                          // one sentence for somebody who has not read a paper
  bool sppm_only;                               // of photons, which other integrators do not trace
  std::string (*own)(const ParameterContext&);  // the label of what the scene itself says
  std::vector<ParameterValue> (*others)(
      const ParameterContext&);  // other values to try; empty: none make sense here
};

/// Every parameter, the most telling first: where time is short, those at the end are left out.
const std::vector<StudyParameter>& study_parameters();

/// Those that `names` lists, in the order of the table; all where it is empty. Throws UserError for a name
/// that is none.
std::vector<const StudyParameter*> wanted_parameters(const std::vector<std::string>& names);

}  // namespace causticl
