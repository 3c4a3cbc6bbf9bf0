#!/usr/bin/env bash
# Usage: scripts/study_page.sh [FOLDER]
# Opens the page of a study in headless Chromium (installed from Debian where it is missing), wide and narrow, light
# and dark, and fails where the page has an error, lacks a plot or an inset, or shows other numbers than study.csv.
# The screenshots lie in FOLDER, of a study that is made first where there is none; default: out/study_page.
set -euo pipefail
source "$(dirname "$0")/common.sh"

case ${1:-} in -h | --help) sed -n '2,5s/^# //p' "$0"; exit ;; esac
folder=${1:-$root/out/study_page}
set_up "${build_packages[@]}" "${page_packages[@]}"
if [ ! -f "$folder/study.html" ]; then
  build build causticl
  mkdir -p "$folder"
  "$root/build/causticl" study "$root/scenes/cornell_box.json" --size 32x32 -D renderer.photon_sample=5000 \
    --budget 60 --parameters integrator,photons,alpha -o "$folder"
fi
page=$(cd "$folder" && pwd -P)
profile=$(mktemp -d)
trap 'rm -rf "$profile"' EXIT

# browse WIDTH HEIGHT light|dark OPTION...: runs Chromium on the page; what its console says goes to stderr.
browse() {
  local scheme=1
  [ "$3" = dark ] && scheme=0
  timeout 300 chromium --headless --no-sandbox --disable-gpu --hide-scrollbars --user-data-dir="$profile" \
    --enable-logging=stderr --window-size="$1,$2" --blink-settings=preferredColorScheme=$scheme "${@:4}" \
    "file://$page/study.html"
}

for shot in "1280 6000 light" "1280 6000 dark" "400 9000 light" "400 9000 dark"; do
  read -r width height scheme <<<"$shot"
  browse "$width" "$height" "$scheme" --screenshot="$page/page_${width}_$scheme.png" 2>"$profile/log" >/dev/null ||
    fail "Chromium ended with $?"
  ! grep 'CONSOLE' "$profile/log" || fail "the page says this on its console at $width pixels, $scheme"
  [ "$(stat -c %s "$page/page_${width}_$scheme.png")" -gt 50000 ] || fail "the screenshot at $width pixels is empty"
done
browse 1280 6000 light --dump-dom 2>/dev/null >"$profile/dom.html"
exec python3 "$root/scripts/study_page_check.py" "$page" "$profile/dom.html"
