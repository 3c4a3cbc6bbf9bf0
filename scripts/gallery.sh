#!/usr/bin/env bash
# Usage: scripts/gallery.sh [SCENE...]
# Renders the pictures that README shows into scenes/gallery/: the glass caustic at 800 x 600, all other SCENEs
# (all that are shipped, where none is named) at the size of a thumbnail.
set -euo pipefail
source "$(dirname "$0")/common.sh"

"$root/scripts/build.sh"
scenes=("$@")
[ $# -gt 0 ] || scenes=("$root"/scenes/*.json)
mkdir -p "$root/scenes/gallery"
for scene in "${scenes[@]}"; do
  name=$(basename "$scene" .json)
  size=400x300
  [ "$name" = cornell_box ] && size=300x300
  [ "$name" = glass_caustic ] && size=800x600
  "$root/build/causticl" render "$scene" --size $size --passes 96 --quiet -o "$root/scenes/gallery/$name.png"
  echo "scenes/gallery/$name.png"
done
