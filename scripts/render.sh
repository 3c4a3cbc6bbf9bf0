#!/usr/bin/env bash
# Usage: scripts/render.sh [SCENE] [OPTIONS...]
# Installs what is missing, builds, and renders SCENE; the options are those of `causticl render`. Without a
# scene it renders scenes/glass_caustic.json to out/glass_caustic.png.
set -euo pipefail
source "$(dirname "$0")/common.sh"

"$root/scripts/build.sh"
if [[ $# -eq 0 || ($1 == -* && " $* " != *.json\ *) ]]; then
  output=(-o "$root/out/glass_caustic.png")
  for option in "$@"; do
    [[ $option == -o* || $option == --output* ]] && output=()
  done
  mkdir -p "$root/out"
  set -- "$root/scenes/glass_caustic.json" "${output[@]}" "$@"
fi
exec "$root/build/causticl" render "$@"
