#!/usr/bin/env bash
# Usage: scripts/profile.sh SCENE [RENDER_OPTION...]
# Where a render's CPU time goes on PoCL: the shares of the kernels and, within the three heaviest, of the functions
# of cl/, inlined or not (with what they call, and by themselves). Needs `perf`, and a kernel that allows it.
set -euo pipefail
source "$(dirname "$0")/common.sh"

[ $# -ge 1 ] || fail "which scene? Usage: scripts/profile.sh SCENE [RENDER_OPTION...]"
set_up "${build_packages[@]}" python3 binutils linux-perf
build build causticl
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/cache"
# Debug lines in the compiled kernels, in a cache of their own; the first render compiles.
export POCL_CACHE_DIR=$folder/cache POCL_EXTRA_BUILD_FLAGS=-g
render=("$root/build/causticl" render --quiet -o "$folder/picture.pfm" "$@")
"${render[@]}" 2>"$folder/log" || { cat "$folder/log" >&2; exit 1; }
# PoCL complains of debug lines in its own functions.
perf record --quiet -o "$folder/samples" -e cpu-clock -F 4000 "${render[@]}" >/dev/null 2>&1
python3 "$root/scripts/profile.py" "$folder/samples" "$folder/cache"
