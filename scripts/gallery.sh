#!/usr/bin/env bash
# Usage: scripts/gallery.sh [SCENE...]
# Renders the pictures that README shows into scenes/gallery/: the glass caustic at 800 x 600 with 96 passes,
# the tumbler at 640 x 480 with 192, all other SCENEs (all but the furnace, where none is named) at the size of a
# thumbnail with 48.
set -euo pipefail
source "$(dirname "$0")/common.sh"

"$root/scripts/build.sh"
scenes=("$@")
[ $# -gt 0 ] || scenes=("$root"/scenes/[1-7]*.json \
  "$root"/scenes/{cornell_box,analytic_sphere,glass_caustic,tumbler,effects/*}.json)
mkdir -p "$root/scenes/gallery"
for scene in "${scenes[@]}"; do
  name=$(basename "$scene" .json)
  size=400x300 passes=48
  [ "$name" = cornell_box ] && size=300x300
  [[ "$scene" == */effects/* ]] && size=400x250
  [ "$name" = rough_metals ] && size=640x400
  case "$name" in coloured_glass | prism | moving_balls | fog | leaded_window) size=480x300 passes=96 ;; esac
  [ "$name" = next_room ] && size=400x300 passes=96
  [ "$name" = glass_caustic ] && size=800x600 passes=96
  [ "$name" = tumbler ] && size=640x480 passes=192
  "$root/build/causticl" render "$scene" --size $size --passes $passes --quiet -o "$root/scenes/gallery/$name.png"
  echo "scenes/gallery/$name.png"
done
