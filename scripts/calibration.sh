#!/usr/bin/env bash
# Usage: scripts/calibration.sh [SCENE...]
# Measures how honest the error estimate is, on the named scenes or on all that are shipped, small: after 8, 32 and 128
# passes of eight seeds, the share of pixels that are within their own 90% bound, the picture's true error, its estimate,
# and the passes to half the error against those predicted (from the sixteenth on), for which 512 and 2,048 passes of two
# seeds are rendered as well.
# The truth is a path-traced picture of 16,384 samples a pixel, or 65,536 where that is itself off by more than 10%; where
# path tracing would not find all light (beside point, spot and directional lights), it is a photon-mapped one, of five
# times as many photons and a radius that stays a fifth of the first. Its own noise is known: bounds are widened by it, and
# it is taken off true errors. What was measured is kept in out/calibration/, so that a run that was interrupted goes on where it was.
# As many scenes as there are processors are rendered side by side: an hour for all on two. Prints the table of README.
set -euo pipefail
source "$(dirname "$0")/common.sh"

set_up "${build_packages[@]}" python3
build build causticl
scenes=("$@")
[ $# -gt 0 ] || scenes=("$root"/scenes/*.json "$root"/scenes/effects/*.json)
folder=$root/out/calibration
mkdir -p "$folder"
exec python3 "$root/scripts/calibration.py" "$root/build/causticl" "$folder" "${scenes[@]}"
