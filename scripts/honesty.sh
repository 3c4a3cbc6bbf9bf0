#!/usr/bin/env bash
# Usage: scripts/honesty.sh [--short] [--device SPEC] [--samples N] [SCENE_NAME...]
# Measures whether SPPM's estimate of its error lies, on 30 small scenes made for it (scripts/honesty_scenes.py): small
# lamps, infinite planes, lamps in fog, hidden lamps, sun through windows, thin walls. After 32 passes the true error, which
# 90% of the pixels stay under, must be at most three times the claimed one, and --error 5% must end at 7.5% or less. The
# truth is a path-traced picture of 16,384 samples a pixel, kept in out/honesty. Prints a table; fails where a claim lies (*).
# --short: three scenes, tiny, for a test.
set -euo pipefail
source "$(dirname "$0")/common.sh"

set_up "${build_packages[@]}" python3
build build causticl
exec python3 "$root/scripts/honesty.py" "$root/build/causticl" "$root/out/honesty" "$@"
