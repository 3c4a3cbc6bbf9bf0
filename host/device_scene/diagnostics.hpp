// What should not happen in a render and is counted where it does: shown by --stats, written to EXR metadata,
// and warned about.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace causticl {

struct Diagnostics {
  std::uint64_t non_finite = 0, saturated = 0, unresolved = 0, traversal_bound = 0, dropped = 0;
  std::uint64_t media_full = 0, media_left = 0;
};

struct DiagnosticKind {
  const char* key;  // in JSON and metadata
  std::uint64_t Diagnostics::*count;
  const char* meaning;  // after the count: "3 samples were ..."
};

/// Every kind, one row each.
inline constexpr DiagnosticKind diagnostic_kinds[] = {
    {"non_finite", &Diagnostics::non_finite,
     "samples were NaN or infinite and were left out (look for such values in textures)"},
    {"saturated", &Diagnostics::saturated,
     "photons or pixels were brighter than their record holds: light is missing"},
    {"unresolved", &Diagnostics::unresolved,
     "rays met a revolved curve where two roots could not be told apart; one was taken"},
    {"traversal_bound", &Diagnostics::traversal_bound,
     "rays gave up in the tree: the device computes wrongly (run `causticl selftest`)"},
    {"media_full", &Diagnostics::media_full,
     "paths were in more than 8 dielectrics at once, or came to a place where more of their faces meet: the "
     "innermost were left out"},
    {"media_left", &Diagnostics::media_left,
     "boundaries of dielectrics were left from behind without having been entered: an open surface, which "
     "holds what lies behind it, or, below one in 100,000 paths, rounding"},
    {"dropped", &Diagnostics::dropped,
     "photons found no room in the device's memory: light is missing; fewer photons a pass (--photons) fit"},
};

/// "3 samples were NaN or infinite ...", for each kind that occurred.
std::vector<std::string> diagnostic_warnings(const Diagnostics& diagnostics);

}  // namespace causticl
