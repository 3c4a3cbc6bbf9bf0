"""Compares claimed errors with true ones: honesty.py CAUSTICL FOLDER [--short] [--device SPEC] [SCENE_NAME...]

See scripts/honesty.sh. What was rendered is kept in FOLDER, so that a run that was interrupted goes on where it was.
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys

from honesty_scenes import scenes

MOST_TIMES = 3      # that the true error may be of the claimed one
WANTED, SLACK = 0.05, 1.5  # --error, and how far beyond it the true error may be
SHORT = ('lamp_0.003', 'cap_20', 'wall_0_unequal')  # for continuous integration

parser = argparse.ArgumentParser()
parser.add_argument('causticl')
parser.add_argument('folder', type=pathlib.Path)
parser.add_argument('--short', action='store_true')
parser.add_argument('--device', default='cpu')
parser.add_argument('--samples', type=int)
parser.add_argument('names', nargs='*')
options = parser.parse_intermixed_args()
samples = options.samples or (1024 if options.short else 16384)
size = '12x9' if options.short else '24x18'


def render(scene, picture, *settings):
    """Renders unless that was done before; returns the statistics."""
    stats = picture.with_suffix('.stats')
    if not stats.exists():
        part = picture.with_suffix('.part')
        subprocess.run([options.causticl, 'render', scene, '--quiet', '--size', size, '--device', options.device,
                        *map(str, settings), '-o', picture, '--stats-json', part], check=True)
        part.rename(stats)
    return json.loads(stats.read_text())


def true_error(picture, reference, noise):
    """That 90% of the pixels stay under, less what the reference is off by itself."""
    file = picture.with_suffix('.compared')
    subprocess.run([options.causticl, 'compare', picture, reference, '--json', file], check=True,
                   stdout=subprocess.DEVNULL)
    return math.sqrt(max(json.loads(file.read_text())['error_90'] ** 2 - noise ** 2, 0))


def percent(share):
    return 'unknown' if share is None else f'{100 * share:.2g}%'


def measure(name, scene):
    """One row: claimed and true errors after 32 passes, and the true one where --error stopped; whether all are honest."""
    file = options.folder / f'{name}.json'
    text = json.dumps(scene, indent=1)
    if file.exists() and file.read_text() != text:
        for old in options.folder.glob(f'{name}-*'):
            old.unlink()
    file.write_text(text)
    reference = options.folder / f'{name}-pt.exr'
    noise = render(file, reference, '--integrator', 'pt', '--samples', samples, '--seed', 100)['error'] or 0
    honest, cells = True, []
    for seed in (1,) if options.short else (1, 2):
        picture = options.folder / f'{name}-32-{seed}.exr'
        claimed = render(file, picture, '--passes', 32, '--seed', seed)['error']
        true = true_error(picture, reference, noise)
        # Of a few hundred pixels, the bound of 90% is itself off by a third at worst; an unknown error claims nothing.
        fair = claimed is None or true <= MOST_TIMES * max(claimed, noise)
        honest = honest and fair
        cells.append(f'{percent(true)} of {percent(claimed)}' + ('' if fair else ' *'))
    if not options.short:
        picture = options.folder / f'{name}-error.exr'
        stats = render(file, picture, '--error', f'{100 * WANTED:g}%', '--time', 120)
        if stats['stop'] == 'error':
            true = true_error(picture, reference, noise)
            fair = true <= SLACK * WANTED
            cells.append(f'{percent(true)} after {stats["passes"]} passes' + ('' if fair else ' *'))
        else:
            fair = True
            cells.append(f'{percent(stats["error"])} claimed after {stats["passes"]} passes, out of time')
        honest = honest and fair
    print(f'| `{name}` | {percent(noise)} | ' + ' | '.join(cells) + ' |', flush=True)
    return honest


options.folder.mkdir(parents=True, exist_ok=True)
known = scenes()
names = options.names or (SHORT if options.short else known)
columns = ['scene', 'noise of the reference', 'true error of the claimed one', 'another seed', f'--error {100 * WANTED:g}%']
columns = columns[:3] if options.short else columns
print('| ' + ' | '.join(columns) + ' |\n|' + '---|' * len(columns))
dishonest = [name for name in names if not measure(name, known[name])]
if dishonest:
    sys.exit(f'dishonest (*): {", ".join(dishonest)}')
