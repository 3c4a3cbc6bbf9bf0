#!/usr/bin/env bash
# Usage: scripts/calibration.sh [SCENE...]
# Measures how honest the error estimate is, on the named scenes or on all that are shipped: after 8, 32 and 128 passes
# of eight seeds, and 512 of one, the share of pixels that are within their own 90% bound, the picture's error against
# its estimate, and the passes to half the error against those predicted. The truth is a path-traced picture of 4,096
# samples a pixel, kept in out/calibration/ for the next time, as is all that was measured. Takes about a minute a
# scene. Prints the table of README.
set -euo pipefail
source "$(dirname "$0")/common.sh"

set_up "${build_packages[@]}" python3
build build causticl
scenes=("$@")
[ $# -gt 0 ] || scenes=("$root"/scenes/*.json "$root"/scenes/effects/*.json)
folder=$root/out/calibration
mkdir -p "$folder"
options=(--quiet --size 64x48)
for scene in "${scenes[@]}"; do
  name=$(basename "$scene" .json)
  render() { "$root/build/causticl" render "$scene" "${options[@]}" "$@"; }
  reference=$folder/$name.exr
  [ -s "$reference" ] || render --integrator pt --samples 4096 --seed 100 -o "$reference"
  for passes in 8 32 128 512; do
    for seed in 1 2 3 4 5 6 7 8; do
      [ "$passes" -lt 512 ] || [ "$seed" -eq 1 ] || continue
      point=$folder/$name-$passes-$seed
      [ ! -s "$point.json" ] || continue
      render --integrator sppm --photons 25000 --passes "$passes" --seed "$seed" -o "$folder/picture.exr" \
        --stats-json "$point.stats"
      "$root/build/causticl" compare "$folder/picture.exr" "$reference" --json "$point.json" >/dev/null
    done
  done
done
python3 - "$folder" "${scenes[@]}" <<'PYTHON'
import json, math, pathlib, statistics, sys
folder = pathlib.Path(sys.argv[1])
budgets, seeds = (8, 32, 128, 512), range(1, 9)
print("| scene | pixels within their 90% bound after 8, 32, 128 passes | true error | estimate / truth "
      "| predicted / true passes to half the error, from 8, 32, 128 |\n|---|---|---|---|---|")
for scene in sys.argv[2:]:
    name = pathlib.Path(scene).stem
    covered, truth, ratio, to_half = {}, {}, {}, {}
    for passes in budgets:
        points = [folder / f"{name}-{passes}-{seed}" for seed in seeds]
        points = [p for p in points if p.with_name(p.name + ".json").exists()]
        compared = [json.loads(p.with_name(p.name + ".json").read_text()) for p in points]
        stats = [json.loads(p.with_name(p.name + ".stats").read_text()) for p in points]
        covered[passes] = statistics.mean(c["covered_90"] for c in compared)
        truth[passes] = statistics.mean(c["error_90"] for c in compared)
        ratio[passes] = statistics.mean(s["error"] for s in stats) / truth[passes]
        to_half[passes] = statistics.median(s["passes_to_half_error"] for s in stats) + passes
    def passes_at(error):
        """Where the true error is this, by lines between its logarithms; the last one goes on."""
        for low, high in zip(budgets, budgets[1:]):
            if truth[high] <= error or high == budgets[-1]:
                slope = math.log(truth[high] / truth[low]) / math.log(high / low)
                return low * (error / truth[low]) ** (1 / slope) if slope < 0 else math.inf
    half = [to_half[n] / passes_at(truth[n] / 2) for n in budgets[:3]]
    row = lambda values, form: ", ".join(format(values[n], form) for n in budgets[:3])
    print(f"| `{name}` | {row(covered, '.3f')} | {row(truth, '.1%')} | {row(ratio, '.2f')} | "
          + ", ".join(f"{h:.2f}" for h in half) + " |")
PYTHON
