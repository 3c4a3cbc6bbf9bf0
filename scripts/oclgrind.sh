#!/usr/bin/env bash
# Usage: scripts/oclgrind.sh [SCENE...]
# Runs the kernels of both integrators under Oclgrind, which reports accesses out of bounds, data races and
# barrier divergence, on tiny pictures of the SCENEs. Where none is named it takes all that are shipped, and runs
# the checks of `causticl selftest` on a few inputs each. Takes long.
set -euo pipefail
source "$(dirname "$0")/common.sh"

set_up "${build_packages[@]}" oclgrind
build build causticl
scenes=("$@")
[ $# -gt 0 ] || scenes=("$root"/scenes/{,effects/}*.json)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failed=0
for scene in "${scenes[@]}"; do
  for options in "--integrator sppm" "--integrator pt" \
    "--integrator sppm -D renderer.direct_light=photons -D renderer.schedule=global"; do
    # shellcheck disable=SC2086 # words
    # Optimised kernels make Oclgrind 21.10 loop for ever, and it knows no inlined calls.
    if messages=$(oclgrind --data-races --build-options "-cl-opt-disable -DCAUSTICL_NO_INLINE" \
      "$root/build/causticl" render "$scene" $options --size 5x4 --photons 100 --passes 2 --samples 2 \
      --no-cache --quiet -o "$folder/picture.pfm" 2>&1) && [ -z "$messages" ]; then
      echo "clean: $(basename "$scene") $options"
    else
      echo "FAILED: $(basename "$scene") $options"
      head -40 <<<"$messages"
      failed=$((failed + 1))
    fi
  done
done
if [ $# -eq 0 ]; then
  if messages=$(oclgrind --data-races --build-options "-cl-opt-disable -DCAUSTICL_NO_INLINE" \
    "$root/build/causticl" selftest --no-cache --inputs 64 2>&1); then
    echo "clean: selftest"
  else
    echo "FAILED: selftest"
    echo "$messages"
    failed=$((failed + 1))
  fi
fi
[ $failed -eq 0 ] || fail "Oclgrind has complaints about $failed runs (above)"
