#!/usr/bin/env bash
# Usage: scripts/study.sh [OPTIONS of causticl study]
# Makes the plot and the table of docs/accuracy.md: a study of the Cornell box (300 seconds,
# where no option says otherwise), whose page is opened in headless Chromium to draw scenes/gallery/study.svg.
set -euo pipefail
source "$(dirname "$0")/common.sh"

case ${1:-} in -h | --help) sed -n '2,4s/^# //p' "$0"; exit ;; esac
set_up "${build_packages[@]}" "${page_packages[@]}"
build build causticl
folder=$root/out/study
mkdir -p "$folder"
cd "$root"
build/causticl study scenes/cornell_box.json --budget 300 -o "$folder" "$@"
profile=$(mktemp -d)
trap 'rm -rf "$profile"' EXIT
timeout 300 chromium --headless --no-sandbox --disable-gpu --user-data-dir="$profile" --window-size=1280,6000 \
  --blink-settings=preferredColorScheme=1 --dump-dom "file://$folder/study.html?plots=error_90" 2>/dev/null >"$profile/dom.html"
python3 scripts/study_figure.py "$folder" "$profile/dom.html" scenes/gallery/study.svg
