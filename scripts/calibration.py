"""Renders what scripts/calibration.sh describes and prints its table: calibration.py CAUSTICL FOLDER SCENE..."""
import concurrent.futures
import datetime
import itertools
import json
import math
import os
import pathlib
import statistics
import subprocess
import sys

BUDGETS, SEEDS = (8, 32, 128), range(1, 9)
LONG, LONG_SEEDS = (512, 2048), (1, 2)  # where half the error is
SETTINGS = ['--quiet', '--size', '48x36', '--threads', '1']  # one scene for each processor is faster
PHOTONS = 10000
SAMPLES, MORE_SAMPLES = 16384, 65536  # of a path-traced reference; more where its own error is above the worst
WORST_REFERENCE = 0.1

causticl, folder = sys.argv[1], pathlib.Path(sys.argv[2])


def run(*arguments):
    subprocess.run([causticl, *map(str, arguments)], check=True, stdout=subprocess.DEVNULL)


def render(scene, picture, *options):
    """Renders unless that was done before; returns the statistics."""
    stats = picture.with_suffix('.stats')
    if not stats.exists():
        unfinished = stats.with_suffix('.part')
        run('render', scene, *SETTINGS, *options, '-o', picture, '--stats-json', unfinished)
        unfinished.rename(stats)
    return json.loads(stats.read_text())


def has_hidden_caustics(scene):
    """Whether path tracing may miss light: see README, Limits."""
    file = folder / f'{scene.stem}-explained.json'
    run('explain', scene, '--json', file)
    called = {e['key'] for e in json.loads(file.read_text())['effects'] if e['called_for']}
    return 'delta_lights' in called and bool(called & {'mirror', 'glass', 'conductor', 'plastic'})


def reference_of(scene, first_radius):
    """The picture that is as good as the truth, and its statistics."""
    name = scene.stem
    if not has_hidden_caustics(scene):
        path_trace = lambda picture, samples: (
            picture, render(scene, picture, '--integrator', 'pt', '--samples', samples, '--seed', 100))
        picture, stats = path_trace(folder / f'{name}-pt.exr', SAMPLES)
        if stats['error'] > WORST_REFERENCE:
            picture, stats = path_trace(folder / f'{name}-more-pt.exr', MORE_SAMPLES)
        return picture, stats
    picture = folder / f'{name}-sppm.exr'
    return picture, render(scene, picture, '--integrator', 'sppm', '--photons', 50000, '--passes', 1280, '--seed', 100,
                           '-D', f'renderer.radius={first_radius / 5:.6g}', '-D', 'renderer.alpha=0.99',
                           '-D', 'renderer.schedule=global')


def points(scene, passes, seeds):
    for seed in seeds:
        picture = folder / f'{scene.stem}-{passes}-{seed}.exr'
        yield picture, render(scene, picture, '--integrator', 'sppm', '--photons', PHOTONS, '--passes', passes, '--seed', seed)


def measure(scene):
    """Returns one row of the table, whether all shares are right, and the ratios of errors and of passes to half."""
    _, first = next(points(scene, BUDGETS[0], SEEDS))
    reference, reference_stats = reference_of(scene, first['first_radius'])
    noise = reference_stats['error']
    covered, truth, estimate, half = {}, {}, {}, {}
    for passes in (*BUDGETS, *LONG):
        pictures = list(points(scene, passes, LONG_SEEDS if passes in LONG else SEEDS))
        compared = []
        for picture, _ in pictures:
            file = picture.with_suffix('.compared')
            run('compare', picture, reference, '--json', file)
            compared.append(json.loads(file.read_text()))
        covered[passes] = statistics.mean(c['covered_90'] for c in compared)
        # Independent errors add up as squares.
        squares = statistics.mean(c['error_90'] for c in compared) ** 2 - noise ** 2
        truth[passes] = math.sqrt(squares) if squares > 0 else 0
        estimate[passes] = statistics.mean(s['error'] for _, s in pictures)
        further = [s['passes_to_half_error'] or math.inf for _, s in pictures if 'passes_to_half_error' in s]
        half[passes] = passes + statistics.median(further) if further else None

    def passes_at(error):
        """Where the true error is this, by lines between its logarithms; none after the last one."""
        for low, high in itertools.pairwise((*BUDGETS, *LONG)):
            if truth[high] <= error <= truth[low] and truth[high] < truth[low] and truth[high] > 0:
                return low * (high / low) ** (math.log(truth[low] / error) / math.log(truth[low] / truth[high]))
        return None

    def halved(passes):
        at = passes_at(truth[passes] / 2)
        return half[passes] / at if at and half[passes] else None

    halves = [halved(n) for n in BUDGETS[1:]]
    told = lambda ratio: '–' if ratio is None else f'{ratio:.2f}'

    row = lambda values, form: ', '.join(form.format(100 * values[n]) for n in BUDGETS)
    inside = all(0.85 <= covered[n] <= 0.97 for n in BUDGETS)
    kind = 'path tracing' if reference.stem.endswith('-pt') else 'SPPM'
    text = (f"| `{scene.stem}` | {row(covered, '{:.1f}')}{'' if inside else ' *'} | {row(truth, '{:.3g}')} | "
            f"{row(estimate, '{:.3g}')} | {', '.join(map(told, halves))} | {kind}, {100 * noise:.2g} |")
    return text, inside, [estimate[n] / truth[n] if truth[n] else math.inf for n in BUDGETS], [h for h in halves if h is not None]


def main():
    scenes = [pathlib.Path(scene) for scene in sys.argv[3:]]
    devices = subprocess.run([causticl, 'devices'], check=True, capture_output=True, text=True).stdout
    print(f"`scripts/calibration.sh` on {datetime.date.today()}, {os.cpu_count()} cores, {devices.splitlines()[0].strip()}; "
          f"48 × 36 pixels, {PHOTONS:,} photons a pass:\n")
    print('| scene | % of pixels within their 90% bound after 8, 32, 128 passes | true error, % | estimated error, % '
          '| after 32, 128: predicted / true passes to half of it | truth, and its error, % |\n|---|---|---|---|---|---|')
    inside, errors, halves = [], [], []
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for text, *measured in pool.map(measure, scenes):
            print(text, flush=True)
            for values, value in zip((inside, errors, halves), measured):
                values.append(value)
    errors, halves = [*itertools.chain(*errors)], [*itertools.chain(*halves)]
    print(f'\n{sum(inside)} of {len(scenes)} scenes lie between 85 and 97% throughout. The estimated error is within a factor of '
          f'1.25 of the true one in {sum(1 / 1.25 <= e <= 1.25 for e in errors)} of {len(errors)} cases, the passes to half of it '
          f'within 30% in {sum(0.7 <= h <= 1.3 for h in halves)} of {len(halves)}.')


if __name__ == '__main__':
    main()
