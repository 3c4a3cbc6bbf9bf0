#!/usr/bin/env bash
# Usage: scripts/deleted_effects.sh [SCENE...]
# Measures what the effects that a scene does not use still cost it: renders the named scenes, or three that are shipped,
# by the kernels as they ship and by a copy in which all code of those effects is deleted (scripts/without_effects.py).
# Both must give the same picture to the bit. On PoCL, prints how many kernels have the same machine code, and by how much
# the others are longer or shorter; then the ratio of the least milliseconds a pass out of seven renders each, in turns,
# since what else the machine does only adds: of kernels that are the same it tells the noise. Takes some minutes.
set -euo pipefail
source "$(dirname "$0")/common.sh"

set_up "${build_packages[@]}" python3
build build causticl
scenes=("$@")
[ $# -gt 0 ] || scenes=("$root"/scenes/{cornell_box,glass_caustic,7_sppm_room}.json)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 - "$root" "$folder" "${scenes[@]}" <<'PYTHON'
import filecmp, json, os, pathlib, re, shutil, subprocess, sys
root, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
causticl, passes, runs = root / 'build/causticl', 8, 7


def absent_effects(scene):
    """EFFECT_* names of what the scene does not call for."""
    bits = dict(re.findall(r'\{(EFFECT_\w+), "(\w+)"', (root / 'host/effects/effects.cpp').read_text()))
    subprocess.run([causticl, 'explain', scene, '--json', folder / 'effects.json'], check=True, stdout=subprocess.DEVNULL)
    called_for = {e['key'] for e in json.load(open(folder / 'effects.json'))['effects'] if e['called_for']}
    return [bit for bit, key in bits.items() if key not in called_for]


def render(scene, kernels, *options, cache=None):
    """Milliseconds a pass of all kernels."""
    environment = {**os.environ, **({'POCL_CACHE_DIR': str(cache)} if cache else {})}
    subprocess.run([causticl, 'render', scene, '--quiet', '--size', '320x240', '--kernel-dir', folder / kernels, '-o',
                    folder / f'{kernels}.pfm', '--stats-json', folder / 'stats.json', *options], check=True, env=environment)
    return sum(json.load(open(folder / 'stats.json'))['kernels'].values()) / passes


def machine_code(scene, kernels):
    """{kernel: bytes of its instructions} that PoCL made."""
    cache, code = folder / f'cache_{kernels}', {}
    shutil.rmtree(cache, ignore_errors=True)
    cache.mkdir()
    render(scene, kernels, '--passes', '1', '--photons', '1000', cache=cache)
    for library in cache.rglob('*.so'):
        subprocess.run(['objcopy', '-O', 'binary', '--only-section=.text', library, folder / 'text'], check=True)
        code[library.stem] = (folder / 'text').read_bytes()
    return code


print('| scene | kernels with the same machine code | ms a pass as shipped | deleted | shipped / deleted |\n|---|---|---|---|---|')
for scene in sys.argv[3:]:
    for kernels in ('shipped', 'deleted'):
        shutil.rmtree(folder / kernels, ignore_errors=True)
        shutil.copytree(root / 'cl', folder / kernels)
    subprocess.run([sys.executable, root / 'scripts/without_effects.py', folder / 'deleted', *absent_effects(scene)],
                   check=True, stdout=sys.stderr)
    shipped, deleted = machine_code(scene, 'shipped'), machine_code(scene, 'deleted')
    same = sum(code == deleted[kernel] for kernel, code in shipped.items())
    other = [f'{kernel} ({len(code) / len(deleted[kernel]) - 1:+.2%} of its bytes)' for kernel, code in shipped.items()
             if code != deleted[kernel]]
    times = {'shipped': [], 'deleted': []}
    for _ in range(runs):
        for kernels in times:
            times[kernels].append(render(scene, kernels, '--passes', str(passes)))
        if not filecmp.cmp(folder / 'shipped.pfm', folder / 'deleted.pfm', shallow=False):
            sys.exit(f'error: {scene}: what was deleted changes the picture')
    least = {kernels: min(ms) for kernels, ms in times.items()}
    what = f'{same} of {len(shipped)}' + (f', but {", ".join(other)}' if other else '') if shipped else 'not of PoCL'
    print(f'| `{pathlib.Path(scene).stem}` | {what} | {least["shipped"]:.1f} | {least["deleted"]:.1f} | '
          f'{least["shipped"] / least["deleted"]:.3f} |', flush=True)
PYTHON
