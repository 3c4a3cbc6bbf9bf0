#!/usr/bin/env bash
# Usage: scripts/bench_against.sh COMMIT [--json FILE] [SCENE...]
# Builds COMMIT beside this tree and renders the named scenes (or three of the shipped ones, and that of
# ../shared/references/ where it is there) with both, and with this tree compiled for all effects, in turns. Prints
# milliseconds a pass of each kernel and their ratios: the least of five runs each, since what else the machine does
# only adds. --json adds the figures to an array in FILE: docs/performance.json keeps them by date and commit.
set -euo pipefail
source "$(dirname "$0")/common.sh"

[ $# -ge 1 ] || fail "which commit to compare with? Usage: scripts/bench_against.sh COMMIT [--json FILE] [SCENE...]"
commit=$(git -C "$root" rev-parse --verify --quiet "$1^{commit}") || fail "$1 is not a commit of this repository"
shift
json=
if [ "${1:-}" = --json ]; then
  [ $# -ge 2 ] || fail "--json: expected a file name"
  json=$2
  shift 2
fi
set_up "${build_packages[@]}" python3 git
build build causticl

source_folder=$root/build-against/$commit
if [ ! -x "$source_folder/build/causticl" ]; then
  rm -rf "$source_folder"
  mkdir -p "$source_folder"
  git -C "$root" archive "$commit" | tar -x -C "$source_folder"
  (root=$source_folder && build build causticl)
fi

scenes=("$@")
if [ $# -eq 0 ]; then
  scenes=("$root"/scenes/{cornell_box,glass_caustic,2_glass_knot}.json)
  reference=$root/../shared/references/cornell_spheres.json
  if [ -f "$reference" ]; then scenes+=("$reference"); fi
fi
python3 "$root/scripts/bench_against.py" --base "$commit" "$source_folder/build/causticl" \
  --commit "$(git -C "$root" describe --always --dirty)" "$root/build/causticl" ${json:+--json "$json"} "${scenes[@]}"
