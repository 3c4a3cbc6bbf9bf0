#!/usr/bin/env bash
# Usage: scripts/overhead.sh [SCENE...]
# Measures what the error estimate adds to a render, on the named scenes or on the Cornell box and the glass caustic:
# pairs of renders, one by the kernels as they ship, one by a copy without the estimate (tests/bench/without_errors.patch).
# Both must give the same picture to the bit. Prints the table of README: the ratio of the milliseconds of all kernels,
# and that of the process's CPU time, in which the host's share of the estimate counts too and, on a CPU device, the
# kernels do; less the CPU time of one pass, which is mostly start-up. Medians of nine pairs, and half the distance of
# the quartiles. Takes some minutes.
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
import filecmp, json, os, pathlib, statistics, subprocess, sys
causticl, folder = sys.argv[1:3]
passes, pairs = {'sppm': 48, 'pt': 96}, 9


def render(scene, integrator, kernels, passes):
    """Kernel milliseconds and CPU seconds of one render."""
    command = [causticl, 'render', scene, '--integrator', integrator, '--quiet', '--size', '160x120', '--kernel-dir',
               f'{folder}/{kernels}/cl', '-o', f'{folder}/{kernels}.pfm', '--stats-json', f'{folder}/stats.json',
               *(['--passes', str(passes), '--photons', '50000'] if integrator == 'sppm' else ['--samples', str(passes)])]
    process = subprocess.Popen(command)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        sys.exit(f'error: {" ".join(command)} failed')
    kernels = json.load(open(f'{folder}/stats.json'))['kernels']
    return sum(kernels.values()), usage.ru_utime + usage.ru_stime


def spread(ratios):
    low, middle, high = statistics.quantiles(ratios, n=4)
    return f'{middle:.3f} ± {(high - low) / 2:.3f}'


print('| scene | integrator | kernels: with / without | CPU time: with / without |\n|---|---|---|---|')
for scene in sys.argv[3:]:
    for integrator in ('sppm', 'pt'):
        for kernels in ('with', 'without'):
            render(scene, integrator, kernels, 1)  # compiles
        ratios = [], []
        for pair in range(pairs):
            start = {k: render(scene, integrator, k, 1)[1] for k in ('with', 'without')}
            whole = {k: render(scene, integrator, k, passes[integrator]) for k in ('with', 'without')}
            if not filecmp.cmp(f'{folder}/with.pfm', f'{folder}/without.pfm', shallow=False):
                sys.exit(f'error: {scene} by {integrator}: the estimate changes the picture')
            ratios[0].append(whole['with'][0] / whole['without'][0])
            ratios[1].append((whole['with'][1] - start['with']) / (whole['without'][1] - start['without']))
        print(f'| `{pathlib.Path(scene).stem}` | {integrator} | {spread(ratios[0])} | {spread(ratios[1])} |', flush=True)
PYTHON
