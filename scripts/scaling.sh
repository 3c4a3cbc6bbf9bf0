#!/usr/bin/env bash
# Usage: scripts/scaling.sh [--quick]
# How time and memory grow with photons, pixels, triangles, lights and threads, with the exponent of each fitted by
# least squares between logarithms. Prints the table of growth of docs/performance.md. --quick leaves out the largest of each.
set -euo pipefail
source "$(dirname "$0")/common.sh"

set_up "${build_packages[@]}" python3
build build causticl
exec python3 "$root/scripts/scaling.py" "$root/build/causticl" "$root/scenes" "$@"
