#!/usr/bin/env bash
# Usage: scripts/bench.sh [MESH...] [--quick] [--json FILE] [--device SPEC] [--passes N] [--triangles N...]
# Installs what is missing, builds and runs the benchmark: what the device copies and computes at best, whole renders
# with milliseconds per kernel, start-up with an empty and a full kernel cache, tree building and traversal beside
# Embree on the same rays in the same run. Without a MESH, the test meshes in ../shared/assets/ are traced too where
# that folder is there.
set -euo pipefail
source "$(dirname "$0")/common.sh"

set_up "${build_packages[@]}"
(set_up "${bench_packages[@]}") || echo "Without Embree: there will be nothing to compare traversal with." >&2
build build-bench causticl_bench -DCAUSTICL_BENCH=ON
meshes=()
if [[ " $* " != *.ply* && " $* " != *.obj* ]]; then
  for mesh in "$root"/../shared/assets/*.ply; do
    [ -f "$mesh" ] && meshes+=("$mesh")
  done
fi
exec "$root/build-bench/causticl_bench" "${meshes[@]}" "$@"
