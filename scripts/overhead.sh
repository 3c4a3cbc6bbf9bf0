#!/usr/bin/env bash
# Usage: scripts/overhead.sh [SCENE...]
# Measures what the error estimate adds to a render, on the named scenes or on the Cornell box and the glass caustic, by
# kernels as they ship and by a copy without the estimate (tests/bench/without_errors.patch), in turns. Both must give the
# same picture to the bit. Prints the table of docs/accuracy.md: milliseconds of the kernels whose source differs, as a share of all
# kernels' (the median of fifteen pairs in turns, since the machine's speed drifts); seconds of looks at the error, as a
# share of the passes' (the least of the runs'); and both together. Takes some minutes.
set -euo pipefail
source "$(dirname "$0")/common.sh"

set_up "${build_packages[@]}" patch python3
build build causticl
scenes=("$@")
[ $# -gt 0 ] || scenes=("$root/scenes/cornell_box.json" "$root/scenes/glass_caustic.json")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/with" "$folder/without"
cp -r "$root/cl" "$folder/with/cl"
cp -r "$root/cl" "$folder/without/cl"
patch --quiet -d "$folder/without" -p1 <"$root/tests/bench/without_errors.patch" >"$folder/log" 2>&1 ||
  fail "tests/bench/without_errors.patch does not apply: $(head -1 "$folder/log")"
python3 - "$root/build/causticl" "$folder" "${scenes[@]}" <<'PYTHON'
import filecmp, json, pathlib, re, statistics, subprocess, sys
causticl, folder = sys.argv[1], pathlib.Path(sys.argv[2])
VARIANTS, RUNS = ('with', 'without'), 15
PASSES = {'sppm': ['--passes', '48', '--photons', '50000'], 'pt': ['--samples', '96']}


def render(scene, integrator, variant, *options):
    """Milliseconds of each kernel, and the share of looks at the error, of one render."""
    command = [causticl, 'render', scene, '--integrator', integrator, '--quiet', '--kernel-dir', folder / variant / 'cl',
               '-o', folder / f'{variant}.pfm', '--stats-json', folder / 'stats.json', *options]
    subprocess.run(list(map(str, command)), check=True)
    stats = json.loads((folder / 'stats.json').read_text())
    return stats['kernels'], stats['error_seconds'] / stats['pass_seconds']


def changed_kernels(scene, integrator):
    """Those of programs whose source is another without the estimate; all others are the same code."""
    changed = set()
    for variant in VARIANTS:
        render(scene, integrator, variant, '--size', '16x16', '--passes', '1', '--samples', '1', '--dump-kernels',
               folder / variant / 'built')
    for file in (folder / 'with/built').iterdir():
        if not filecmp.cmp(file, folder / 'without/built' / file.name, shallow=False):
            changed.update(re.findall(r'^kernel void (\w+)', file.read_text(), re.MULTILINE))
    return changed - {'pixel_errors'}  # part of a look


print('| scene | integrator | kernels, % | looks, % | together, % |\n|---|---|---|---|---|')
for scene in map(pathlib.Path, sys.argv[3:]):
    for integrator, options in PASSES.items():
        changed = changed_kernels(scene, integrator)
        kernels, looks = {v: [] for v in VARIANTS}, []
        for _ in range(RUNS):
            for variant in VARIANTS:
                run, look = render(scene, integrator, variant, '--size', '160x120', *options)
                kernels[variant].append(run)
                looks += [look] if variant == 'with' else []
            if not filecmp.cmp(folder / 'with.pfm', folder / 'without.pfm', shallow=False):
                sys.exit(f'error: {scene} by {integrator}: the estimate changes the picture')
        device = statistics.median(sum(one[k] - other.get(k, 0) for k in one if k in changed) / sum(other.values())
                                   for one, other in zip(kernels['with'], kernels['without']))
        print(f'| `{scene.stem}` | {integrator} | {100 * device:.1f} | {100 * min(looks):.1f} | {100 * (device + min(looks)):.1f} |',
              flush=True)
PYTHON
