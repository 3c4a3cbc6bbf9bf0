#!/usr/bin/env bash
# Usage: scripts/overhead.sh [SCENE...]
# Measures what the error estimate adds to a render, on the named scenes or on the Cornell box and the glass caustic:
# pairs of renders, one by the kernels as they ship, one by a copy without the estimate (tests/bench/without_errors.patch).
# Both must give the same picture to the bit. Prints the table of README: the ratio of the milliseconds of all kernels,
# and that of the process's CPU time, in which the host's share of the estimate counts too and, on a CPU device, the
# kernels do; less the CPU time of one pass, which is mostly start-up. Of each kernel and of CPU time the least of eleven
# runs each, in turns, since what else the machine does only adds. Takes some minutes.
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
import filecmp, json, os, pathlib, subprocess, sys
causticl, folder = sys.argv[1:3]
passes, pairs = {'sppm': 48, 'pt': 96}, 11


def render(scene, integrator, kernels, passes):
    """Milliseconds of each kernel and CPU seconds of one render."""
    command = [causticl, 'render', scene, '--integrator', integrator, '--quiet', '--size', '160x120', '--kernel-dir',
               f'{folder}/{kernels}/cl', '-o', f'{folder}/{kernels}.pfm', '--stats-json', f'{folder}/stats.json',
               *(['--passes', str(passes), '--photons', '50000'] if integrator == 'sppm' else ['--samples', str(passes)])]
    process = subprocess.Popen(command)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        sys.exit(f'error: {" ".join(command)} failed')
    kernels = json.load(open(f'{folder}/stats.json'))['kernels']
    return kernels, usage.ru_utime + usage.ru_stime


def least(runs):
    """The sum over kernels of the least time of each."""
    return sum(min(run[kernel] for run in runs) for kernel in runs[0])


print('| scene | integrator | kernels: with / without | CPU time: with / without |\n|---|---|---|---|')
for scene in sys.argv[3:]:
    for integrator in ('sppm', 'pt'):
        kernels, seconds = {}, {}
        for variant in ('with', 'without'):
            render(scene, integrator, variant, 1)  # compiles
            kernels[variant], seconds[variant] = [], {1: [], passes[integrator]: []}
        for pair in range(pairs):
            for count in (1, passes[integrator]):
                for variant in ('with', 'without') if pair % 2 else ('without', 'with'):
                    run, cpu = render(scene, integrator, variant, count)
                    seconds[variant][count].append(cpu)
                    if count > 1:
                        kernels[variant].append(run)
            if not filecmp.cmp(f'{folder}/with.pfm', f'{folder}/without.pfm', shallow=False):
                sys.exit(f'error: {scene} by {integrator}: the estimate changes the picture')
        work = {v: min(seconds[v][passes[integrator]]) - min(seconds[v][1]) for v in seconds}
        print(f"| `{pathlib.Path(scene).stem}` | {integrator} | {least(kernels['with']) / least(kernels['without']):.3f} | "
              f"{work['with'] / work['without']:.3f} |", flush=True)
PYTHON
