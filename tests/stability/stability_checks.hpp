// The checks of the hard cases, one source file a group.
#pragma once

#include "selftest_check.hpp"

namespace causticl {

/// All checks, by number of their hard case.
std::vector<Check> stability_checks();

std::vector<Check> sphere_checks();      // hard cases 1 and 2
std::vector<Check> arithmetic_checks();  // hard case 24

}  // namespace causticl
