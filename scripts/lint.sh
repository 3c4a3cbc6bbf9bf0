#!/usr/bin/env bash
# Runs clang-tidy with the checks of .clang-tidy over host/.
set -euo pipefail
source "$(dirname "$0")/common.sh"

set_up "${build_packages[@]}" "${lint_packages[@]}"
build build causticl_host
find "$root/host" -name '*.cpp' -print0 | xargs -0 -n 1 -P "$(nproc)" clang-tidy --quiet -p "$root/build"
