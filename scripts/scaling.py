"""How a pass's time grows with the size of what it works on: see scaling.sh."""
import argparse
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

RUNS = 3


def knot_mesh(file, triangles):
    """A torus knot as an OBJ file of about that many triangles."""
    around = max(6, round(math.sqrt(triangles / 2 / 8)))
    along = max(12, round(triangles / 2 / around))
    with open(file, "w", encoding="ascii") as out:
        for i in range(along):
            t = 2 * math.pi * i / along
            centre = [(2 + math.cos(3 * t)) * math.cos(2 * t), math.sin(3 * t), (2 + math.cos(3 * t)) * math.sin(2 * t)]
            ahead = t + 1e-4
            step = [(2 + math.cos(3 * ahead)) * math.cos(2 * ahead) - centre[0], math.sin(3 * ahead) - centre[1],
                    (2 + math.cos(3 * ahead)) * math.sin(2 * ahead) - centre[2]]
            length = math.hypot(*step)
            d = [x / length for x in step]
            side = [d[2], 0, -d[0]]
            length = math.hypot(*side)
            side = [x / length for x in side]
            up = [d[1] * side[2] - d[2] * side[1], d[2] * side[0] - d[0] * side[2], d[0] * side[1] - d[1] * side[0]]
            for j in range(around):
                a = 2 * math.pi * j / around
                out.write("v %.7g %.7g %.7g\n" % tuple(
                    c + 0.35 * (math.cos(a) * s + math.sin(a) * u) for c, s, u in zip(centre, side, up)))
        for i in range(along):
            for j in range(around):
                p = [i * around + j, i * around + (j + 1) % around, (i + 1) % along * around + (j + 1) % around,
                     (i + 1) % along * around + j]
                out.write("f %d %d %d\nf %d %d %d\n" % (p[0] + 1, p[1] + 1, p[2] + 1, p[0] + 1, p[2] + 1, p[3] + 1))
    return 2 * around * along


def mesh_scene(mesh):
    return {"width": 256, "height": 192, "max_depth": 6, "renderer": {"type": "sppm", "photon_sample": 100000},
            "camera": {"position": [0, 5, 8], "target": [0, 0, 0], "fov": 40},
            "objects": [
                {"type": "mesh", "path": mesh, "material": {"type": "diffuse", "color": [0.7, 0.6, 0.5]}},
                {"type": "rectangle",
                 "transform": [{"type": "scale", "x": 3, "y": 3, "z": 1}, {"type": "rotate", "axis": "x", "degree": 90}, {"type": "shift", "x": 0, "y": 6, "z": 0}],
                 "material": {"type": "diffuse", "color": [0, 0, 0], "emission": [8, 8, 8]}}]}


def lamps_scene(count):
    columns = math.ceil(math.sqrt(count))
    lamps = [{"type": "sphere", "radius": 2 / columns, "material": "lamp",
              "transform": [{"type": "shift", "x": 10 * (i % columns + 0.5) / columns - 5, "y": 4,
                             "z": 10 * (i // columns + 0.5) / columns - 5}]} for i in range(count)]
    return {"width": 256, "height": 192, "max_depth": 6, "renderer": {"type": "sppm", "photon_sample": 100000},
            "camera": {"position": [0, 4, 12], "target": [0, 1, 0], "fov": 40},
            "materials": {"lamp": {"type": "diffuse", "color": [0, 0, 0], "emission": [5, 5, 5]},
                          "floor": {"type": "diffuse", "color": [0.6, 0.6, 0.6]}},
            "objects": lamps + [
                {"type": "disk", "radius": 8, "material": "floor",
                 "transform": [{"type": "rotate", "axis": "x", "degree": -90}]},
                {"type": "sphere", "radius": 1, "material": "floor",
                 "transform": [{"type": "shift", "x": 0, "y": 1, "z": 0}]}]}


class Benchmark:
    def __init__(self, binary, folder):
        self.binary, self.folder = binary, folder

    def render(self, scene, *options, runs=RUNS):
        """The least of some renders' kernel milliseconds a pass, and the statistics of the last."""
        stats = self.folder / "stats.json"
        least = {}
        for _ in range(runs):
            subprocess.run([self.binary, "render", scene, "--passes", "3", "--quiet", "--stats-json", stats, "-o",
                            self.folder / "picture.pfm", *map(str, options)], check=True)
            found = json.loads(stats.read_text())
            for kernel, ms in found["kernels"].items():
                least[kernel] = min(ms / found["kernel_launches"][kernel], least.get(kernel, math.inf))
            least["pass"] = min(sum(found["kernels"].values()) / 3, least.get("pass", math.inf))
        return least, found

    def written(self, name, scene):
        path = self.folder / name
        path.write_text(json.dumps(scene))
        return path


def exponent(points):
    """Slope of the line of least squares through the logarithms."""
    xs, ys = [math.log(x) for x, _ in points], [math.log(y) for _, y in points]
    x0, y0 = sum(xs) / len(xs), sum(ys) / len(ys)
    return sum((x - x0) * (y - y0) for x, y in zip(xs, ys)) / sum((x - x0) ** 2 for x in xs)


def row(what, points, expected):
    cells = ", ".join(f"{size:,}: {value:.3g}" for size, value in points)
    print(f"| {what} | {cells} | {exponent(points):.2f} | {expected} |", flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binary")
    parser.add_argument("scenes", type=pathlib.Path)
    parser.add_argument("--quick", action="store_true")
    arguments = parser.parse_args()
    largest = -1 if arguments.quick else None
    with tempfile.TemporaryDirectory() as name:
        bench = Benchmark(arguments.binary, pathlib.Path(name))
        box = arguments.scenes / "cornell_box.json"
        print("| what grows | milliseconds by size | exponent | expected |\n|---|---|---|---|")

        tracing, sorting = [], []
        for photons in (10_000, 100_000, 1_000_000, 10_000_000, 100_000_000)[:-2 if arguments.quick else None]:
            try:
                times, found = bench.render(box, "--size", "64x64", "--photons", photons, "-D", "renderer.radius=0.02",
                                            runs=1 if photons > 10_000_000 else RUNS)
            except subprocess.CalledProcessError as fault:
                if fault.returncode != 2:  # other than "more than this device can store"
                    raise
                print(f"{photons:,} photons a pass are left out: see above", file=sys.stderr)
                continue
            if found["dropped"] > 0:
                print(f"{photons:,} photons a pass are left out: the device has no room for them", file=sys.stderr)
                continue
            tracing.append((photons, times["trace_photons"]))
            sorting.append((photons, times["count_photons"] + times["move_photons"] + times["scan_segments"]))
        row("photons a pass: tracing", tracing, "1")
        row("photons a pass: sorting", sorting, "1")

        camera, memory = [], []
        for side in (128, 256, 512, 1024, 2048, 4096)[:largest]:
            times, found = bench.render(box, "--size", f"{side}x{side}", "--photons", 100000, "-D",
                                        "renderer.radius=0.02", "-D", "renderer.view_point_sample=1")
            camera.append((side * side, times["pass"] - times["trace_photons"]))
            memory.append((side * side, found["bytes_per_pixel"]))
        row("pixels: camera paths and gather", camera[2:] if len(camera) > 3 else camera, "1")
        print("| bytes a pixel | " + ", ".join(f"{n:,}: {b:.0f}" for n, b in memory) + " | | 64 at most |")

        rays, trees = [], []
        for triangles in (1_000, 10_000, 100_000, 1_000_000, 10_000_000)[:largest]:
            mesh = bench.folder / "knot.obj"
            count = knot_mesh(mesh, triangles)
            times, found = bench.render(bench.written("knot.json", mesh_scene(str(mesh))))
            nanoseconds = (times["trace_photons"] + times["trace_camera"]) * 1e6 * 3 / found["rays"]
            rays.append((count, nanoseconds))
            trees.append((count, found["tree_build_seconds"] * 1000))
            mesh.unlink()
        row("triangles: nanoseconds a ray, shading included", rays, "below 0.2: a logarithm and caches")
        row("triangles: building the tree", trees, "1")

        lamps = []
        for count in (1, 10, 100, 1_000, 10_000)[:largest]:
            times, found = bench.render(bench.written("lamps.json", lamps_scene(count)))
            lamps.append((count, times["pass"]))
        row("lamps: a pass", lamps, "near 0")

        threads = []
        for count in range(1, (os.cpu_count() or 1) + 1):
            times, found = bench.render(box, "--threads", count, "--size", "256x256")
            threads.append((count, times["pass"]))
        if len(threads) > 1:
            row("threads: a pass", threads, "-1")


main()
