"""Renders what scripts/calibration.sh describes and prints its table: calibration.py CAUSTICL FOLDER [OPTION...] SCENE..."""
import argparse
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
LONG, LONG_SEEDS = (512, 2048), (1, 2, 3, 4)  # where half the error is
SETTINGS = ['--quiet', '--size', '48x36']
PHOTONS = 10000
SAMPLES = 16384  # of a path-traced reference; four times as many, and again, while its own error is too large
WORST_REFERENCE = 0.3  # of the error after the last budget

parser = argparse.ArgumentParser()
parser.add_argument('causticl')
parser.add_argument('folder', type=pathlib.Path)
parser.add_argument('--device', default='cpu')
parser.add_argument('--photon-device')
parser.add_argument('--most-samples', type=int, default=65536)
parser.add_argument('scenes', nargs='+', type=pathlib.Path)
options = parser.parse_args()
causticl, folder = options.causticl, options.folder
photon_device = options.photon_device or options.device


def run(*arguments):
    subprocess.run([causticl, *map(str, arguments)], check=True, stdout=subprocess.DEVNULL)


def render(scene, picture, device, *settings):
    """Renders unless that was done before; returns the statistics."""
    stats = picture.with_suffix('.stats')
    if not stats.exists():
        unfinished = stats.with_suffix('.part')
        threads = ('--threads', '1') if device == 'cpu' else ()  # one scene for each processor is faster
        run('render', scene, *SETTINGS, '--device', device, *threads, *settings, '-o', picture, '--stats-json', unfinished)
        unfinished.rename(stats)
    return json.loads(stats.read_text())


def has_hidden_caustics(scene):
    """Whether path tracing may miss light: see docs/limits.md."""
    file = folder / f'{scene.stem}-explained.json'
    run('explain', scene, '--json', file)
    called = {e['key'] for e in json.loads(file.read_text())['effects'] if e['called_for']}
    return 'delta_lights' in called and bool(called & {'mirror', 'glass', 'conductor', 'plastic', 'thin_glass'})


def point(scene, passes, seed):
    picture = folder / f'{scene.stem}-{passes}-{seed}.exr'
    return picture, render(scene, picture, options.device, '--integrator', 'sppm', '--photons', PHOTONS, '--passes', passes,
                           '--seed', seed)


def seeds_of(passes):
    return LONG_SEEDS if passes in LONG else SEEDS


def reference_of(scene):
    """The picture that is as good as the truth, and its statistics."""
    last = point(scene, BUDGETS[-1], SEEDS[0])[1]
    if not has_hidden_caustics(scene):
        samples, error = SAMPLES, math.inf
        while error > WORST_REFERENCE * last['error'] and samples <= options.most_samples:
            picture = folder / f'{scene.stem}-pt-{samples}.exr'
            stats = render(scene, picture, options.device, '--integrator', 'pt', '--samples', samples, '--seed', 100)
            samples, error = 4 * samples, stats['error']
        return picture, stats
    picture = folder / f'{scene.stem}-sppm.exr'
    return picture, render(scene, picture, photon_device, '--integrator', 'sppm', '--photons', 200000, '--passes', 5000,
                           '--seed', 100, '-D', f"renderer.radius={last['first_radius'] / 10:.6g}",
                           '-D', 'renderer.alpha=0.99', '-D', 'renderer.schedule=global')


def render_all(scenes):
    """Everything that is measured, as many renders at a time as there are processors, the longest first."""
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        points = [pool.submit(point, scene, passes, seed) for passes in sorted((*BUDGETS, *LONG), reverse=True)
                  for scene in scenes for seed in seeds_of(passes)]
        for job in points:
            job.result()
        for job in [pool.submit(reference_of, scene) for scene in sorted(scenes, key=has_hidden_caustics, reverse=True)]:
            job.result()


def measure(scene):
    """Returns one row of the table, whether all shares are right, what they are, and the ratios of errors, of passes to
    half as told, and as whoever knew the true slope would tell."""
    reference, reference_stats = reference_of(scene)
    noise = reference_stats['error']
    covered, truth, estimate, half = {}, {}, {}, {}
    for passes in (*BUDGETS, *LONG):
        pictures = [point(scene, passes, seed) for seed in seeds_of(passes)]
        compared = []
        for picture, _ in pictures:
            file = picture.with_suffix('.compared')
            run('compare', picture, reference, '--json', file)
            compared.append(json.loads(file.read_text()))
        covered[passes] = statistics.mean(c['covered_90'] for c in compared)
        # Independent errors add up as squares. What was measured holds the reference's noise; `error_90`
        # does not.
        squares = statistics.mean(c.get('measured_error_90', c['error_90']) for c in compared) ** 2 - noise ** 2
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

    def half_by_slope(passes):
        """Where half the error would be if the true one went on as in the last two octaves."""
        before, now = truth[passes // 4], truth[passes]
        return passes * 4 ** (math.log(2) / math.log(before / now)) if 0 < now < before else math.inf

    def halved(told, passes):
        at = passes_at(truth[passes] / 2)
        return told / at if at and told else None

    halves = [halved(half[n], n) for n in BUDGETS[1:]]
    by_slope = [halved(half_by_slope(n), n) for n in BUDGETS[1:]]
    told = lambda ratio: '–' if ratio is None else f'{ratio:.2f}'

    row = lambda values, form: ', '.join(form.format(100 * values[n]) for n in BUDGETS)
    inside = all(0.85 <= covered[n] <= 0.97 for n in BUDGETS)
    kind = 'SPPM' if reference.stem.endswith('-sppm') else 'path tracing'
    text = (f"| `{scene.stem}` | {row(covered, '{:.1f}')}{'' if inside else ' *'} | {row(truth, '{:.3g}')} | "
            f"{row(estimate, '{:.3g}')} | {', '.join(map(told, halves))} | {kind}, {100 * noise:.2g} |")
    return (text, inside, [covered[n] for n in BUDGETS], [estimate[n] / truth[n] if truth[n] else math.inf for n in BUDGETS],
            [h for h in halves if h is not None], [h for h in by_slope if h is not None])


def main():
    scenes = options.scenes
    render_all(scenes)
    print(f'`scripts/calibration.sh` on {datetime.date.today()}, {os.cpu_count()} cores, device {options.device}; '
          f'48 × 36 pixels, {PHOTONS:,} photons a pass:\n')
    print('| scene | % of pixels within their 90% bound after 8, 32, 128 passes | true error, % | estimated error, % '
          '| after 32, 128: predicted / true passes to half of it | truth, and its error, % |\n|---|---|---|---|---|---|')
    inside, covered, errors, halves, by_slope = [], [], [], [], []
    for text, *measured in map(measure, scenes):
        print(text, flush=True)
        for values, value in zip((inside, covered, errors, halves, by_slope), measured):
            values.append(value)
    covered, errors, halves, by_slope = ([*itertools.chain(*values)] for values in (covered, errors, halves, by_slope))
    near = lambda ratios: f'{sum(0.7 <= ratio <= 1.3 for ratio in ratios)} of {len(ratios)}'
    print(f'\n{sum(inside)} of {len(scenes)} scenes lie between 85 and 97% throughout, and {100 * statistics.mean(covered):.0f}% is the '
          f'mean of all. The estimated error is within a factor of 1.25 of the true one in '
          f'{sum(1 / 1.25 <= e <= 1.25 for e in errors)} of {len(errors)} cases, the passes to half of it within 30% in '
          f'{near(halves)}; by the true slope over the last two octaves of passes they would be in {near(by_slope)}.')


if __name__ == '__main__':
    main()
