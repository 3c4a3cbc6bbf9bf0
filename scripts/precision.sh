#!/usr/bin/env bash
# Usage: scripts/precision.sh
# Renders every shipped scene with both integrators in float and in double, with the same random numbers, at
# 128 x 96 with 64 passes (sppm: 20,000 photons each), and prints a table of relative MSE: the noise of the float
# picture, the difference between float and double, and their ratio, which should be at least 100; the share of the
# pixels that differ by 1% of the picture's mean, where a path decided otherwise; and over how many seeds these are means:
# eight where one came below 200. Takes minutes.
set -euo pipefail
source "$(dirname "$0")/common.sh"

set_up "${build_packages[@]}" "${test_packages[@]}"
build build causticl_tests -DCAUSTICL_TESTS=ON
cd "$root"
exec build/tests/causticl_tests "float is as good as double on every shipped scene*"
