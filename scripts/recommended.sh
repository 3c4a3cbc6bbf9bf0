#!/usr/bin/env bash
# Usage: scripts/recommended.sh [SCENE...]
# Holds what `causticl study` recommends for an error of 2% to its word: studies each scene, small, on the named ones or
# on three of those that are shipped, pastes the command with a seed that the study has not used, and compares
# with the study's reference, of which the own error is told as well. Prints a row a scene. Studies are kept in
# out/recommended/, so that a run that was interrupted goes on where it was. Takes about five minutes a scene.
set -euo pipefail
source "$(dirname "$0")/common.sh"

set_up "${build_packages[@]}" python3
build build causticl
scenes=("$@")
[ $# -gt 0 ] || scenes=("$root"/scenes/{analytic_sphere,cornell_box,furnace}.json)
folder=$root/out/recommended
mkdir -p "$folder"
exec python3 - "$root/build/causticl" "$folder" "${scenes[@]}" <<'PYTHON'
import json, pathlib, re, shlex, subprocess, sys
causticl, folder = sys.argv[1], pathlib.Path(sys.argv[2])
BUDGET, SEED = 240, 4711


def run(*command):
    return subprocess.run([causticl, *map(str, command)], check=True, capture_output=True, text=True).stdout


print('| scene | recommended for 2% | error of 90% of the pixels, % | by its own estimate, % | the reference\'s own, % |\n|---|---|---|---|---|')
for scene in map(pathlib.Path, sys.argv[3:]):
    study = folder / scene.stem
    summary = run('study', scene, '--size', '48x36', '--budget', BUDGET, '-o', study, '--quiet')
    found = re.search(r'^error 2%: .*\n  causticl (.*)$', summary, re.MULTILINE)
    if not found:
        sys.exit(f'error: the study of {scene} recommends nothing for 2%:\n{summary}')
    words = shlex.split(found[1])
    picture = folder / words[-1]
    words[-1] = str(picture)
    run(*words, '--seed', SEED, '--quiet')
    run('compare', picture, study / 'reference.exr', '--json', folder / 'compared.json')
    compared = json.loads((folder / 'compared.json').read_text())
    reference = json.loads((study / 'study.json').read_text())['reference']
    shown = ' '.join(words[2:-2])
    print(f"| `{scene.stem}` | `{shown}` | {100 * compared['error_90']:.2f} | {100 * compared['estimated_error_90']:.2f} | "
          f"{100 * reference['error_90']:.2f} |", flush=True)
PYTHON
