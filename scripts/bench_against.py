"""Kernel times of two binaries on the same scenes, in turns: see bench_against.sh."""
import argparse
import datetime
import json
import os
import pathlib
import subprocess
import tempfile

PASSES = 6
RUNS = 5


def statistics(binary, scene, folder, options):
    """--stats-json of one render."""
    stats = folder / "stats.json"
    subprocess.run(
        [binary, "render", scene, "--size", "512x384", "--passes", str(PASSES), "--quiet", "--stats-json", stats,
         "-o", folder / "picture.pfm", *options],
        check=True)
    return json.loads(stats.read_text())


def measure(scene, variants):
    """{variant: {kernel: least milliseconds a pass}} and the device's name."""
    least = {name: {} for name in variants}
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(RUNS):
            for name, (binary, options) in variants.items():
                found = statistics(binary, scene, pathlib.Path(folder), options)
                times = {kernel: ms / PASSES for kernel, ms in found["kernels"].items()}
                times["all kernels"] = sum(times.values())
                for kernel, ms in times.items():
                    least[name][kernel] = min(ms, least[name].get(kernel, ms))
    return least, found["device"]


def table(scene, least):
    base, this, every = (least[name] for name in ("base", "this", "all effects"))
    print(f"\n| `{scene}`, ms a pass | base | this | this / base | all effects | all / this |\n|---|---|---|---|---|---|")
    for kernel, ms in sorted(this.items(), key=lambda item: item[1]):
        if ms < 0.01 * this["all kernels"]:
            continue
        before = base.get(kernel)
        print(f"| {kernel} | {'' if before is None else f'{before:.1f}'} | {ms:.1f} | "
              f"{'' if before is None else f'{ms / before:.2f}'} | {every[kernel]:.1f} | {every[kernel] / ms:.2f} |")


def append(file, entry):
    """Adds the entry to the array in `file`, which is replaced as a whole."""
    path = pathlib.Path(file)
    entries = json.loads(path.read_text()) if path.exists() else []
    new = path.with_name(path.name + ".new")
    new.write_text(json.dumps(entries + [entry], indent=1) + "\n")
    os.replace(new, path)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--base", nargs=2, metavar=("COMMIT", "BINARY"), required=True)
    parser.add_argument("--commit", nargs=2, metavar=("COMMIT", "BINARY"), required=True)
    parser.add_argument("--json")
    parser.add_argument("scenes", nargs="+")
    arguments = parser.parse_args()
    variants = {
        "base": (arguments.base[1], []),
        "this": (arguments.commit[1], []),
        "all effects": (arguments.commit[1], ["--effects", "all"]),
    }
    entry = {"date": datetime.date.today().isoformat(), "commit": arguments.commit[0], "base": arguments.base[0][:12],
             "milliseconds_a_pass": {}}
    for scene in arguments.scenes:
        least, entry["device"] = measure(scene, variants)
        name = pathlib.Path(scene).stem
        table(name, least)
        entry["milliseconds_a_pass"][name] = {
            variant: {kernel: round(ms, 3) for kernel, ms in times.items()} for variant, times in least.items()}
    if arguments.json:
        append(arguments.json, entry)


main()
