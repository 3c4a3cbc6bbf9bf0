#!/usr/bin/env bash
# Builds the release binary build/causticl, and installs what that needs.
set -euo pipefail
source "$(dirname "$0")/common.sh"

set_up "${build_packages[@]}"
build build causticl
