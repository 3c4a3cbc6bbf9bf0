#!/usr/bin/env bash
# Usage: scripts/mutations.sh [PATCH...]
# Puts naive methods back into a copy of the kernels, one patch of tests/stability/mutations/ at a time (all of
# them, where none is named), and reports whether `causticl selftest` catches each: its check must fail. The name
# of a patch begins with the number of its hard case; its first line says what is naive about it.
set -euo pipefail
source "$(dirname "$0")/common.sh"

set_up "${build_packages[@]}" patch
build build causticl
patches=("$@")
[ $# -gt 0 ] || patches=("$root"/tests/stability/mutations/*.patch)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
missed=0
for patch in "${patches[@]}"; do
  name=$(basename "$patch" .patch)
  hard_case=$((10#${name%%_*}))
  rm -rf "$folder/cl"
  cp -r "$root/cl" "$folder/cl"
  patch --quiet -d "$folder" -p1 <"$patch" >"$folder/log" 2>&1 || fail "$name does not apply: $(head -1 "$folder/log")"
  status=0
  # A mutant that loops for ever is caught as well: the time is many times what the check takes.
  timeout 300 "$root/build/causticl" selftest --quick --case "$hard_case" --kernel-dir "$folder/cl" \
    >"$folder/log" 2>&1 || status=$?
  caught=$(grep -o '"[^"]*" failed' "$folder/log" | sed 's/ failed$//' | paste -sd, || true)
  [ "$status" -ne 3 ] || [ -n "$caught" ] || fail "$name does not build: $(head -5 "$folder/log")"
  case $status in
    3) result="caught by $caught" ;;
    124) result="caught: ran into the time limit" ;;
    *)
      result="MISSED (exit code $status)"
      missed=$((missed + 1))
      ;;
  esac
  printf '%-40s %s\n' "$name" "$result"
done
[ $missed -eq 0 ] || fail "$missed mutations were missed"
