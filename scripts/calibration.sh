#!/usr/bin/env bash
# Usage: scripts/calibration.sh [--device SPEC] [--photon-device SPEC] [--most-samples N] [SCENE.json...]
# Measures how honest the error estimate is, on the named scenes or on all that are shipped, small: after 8, 32 and 128
# passes of eight seeds, the share of pixels that are within their own 90% bound, the picture's true error, its estimate,
# and the passes to half the error against those predicted (from the sixteenth on), for which 512 and 2,048 passes of four
# seeds are rendered as well.
# The truth is a path-traced picture of 16,384 samples a pixel, and four times as many while that is itself off by more than
# three tenths of the error after 128 passes, up to 65,536 (--most-samples); where path tracing would not find all light
# (beside point, spot and directional lights), it is a photon-mapped one, of 5,000 passes, twenty times as many photons and a
# radius that stays a tenth of the first, rendered by --photon-device if that is told. Its own noise is known: bounds are
# widened by it, and it is taken off true errors. What was measured is kept in out/calibration/, so that a run that was
# interrupted goes on where it was. As many pictures as there are processors are rendered side by side: hours for all on two.
# Prints the table of docs/accuracy.md.
set -euo pipefail
source "$(dirname "$0")/common.sh"

set_up "${build_packages[@]}" python3
build build causticl
arguments=("$@")
[[ ${*: -1} == *.json ]] || arguments+=("$root"/scenes/*.json "$root"/scenes/effects/*.json)
folder=$root/out/calibration
mkdir -p "$folder"
exec python3 "$root/scripts/calibration.py" "$root/build/causticl" "$folder" "${arguments[@]}"
