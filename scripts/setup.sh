#!/usr/bin/env bash
# Installs what is missing for a build and for the tests from Debian's packages. The other scripts do the same
# by themselves, each for what it needs.
set -euo pipefail
source "$(dirname "$0")/common.sh"

set_up "${build_packages[@]}" "${test_packages[@]}"
