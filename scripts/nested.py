#!/usr/bin/env python3
"""Usage: scripts/nested.py [--quick] [--program build/causticl] [--samples N] [ARRANGEMENT...]

Renders dielectrics that touch, overlap or hold something, in an even sky of radiance 1, by path tracing and by
photons, at three scales and in two orders of the objects, and prints the means as a table of docs/numerics.md.
Arrangements that absorb nothing and hold nothing else are furnaces: every pixel is 1. --quick: one scale, one
order. The exit code is 1 where a mean is off by more than 0.5%.
"""
import argparse
import json
import math
import os
import subprocess
import sys
import tempfile

TOLERANCE = 0.005
TURNS = 24


def revolved(profile):
    """A closed mesh: the polygon `profile` of (radius, height), counter-clockwise, revolved about y."""
    vertices, faces, rings = [], [], []
    for radius, height in profile:
        if radius == 0:
            rings.append([len(vertices)] * TURNS)
            vertices.append((0.0, height, 0.0))
            continue
        rings.append(list(range(len(vertices), len(vertices) + TURNS)))
        for turn in range(TURNS):
            angle = 2 * math.pi * turn / TURNS
            vertices.append((radius * math.cos(angle), height, radius * math.sin(angle)))
    for lower, upper in zip(rings, rings[1:] + rings[:1]):
        for turn in range(TURNS):
            a, b, c, d = lower[turn], upper[turn], upper[(turn + 1) % TURNS], lower[(turn + 1) % TURNS]
            for face in ((a, b, c), (a, c, d)):
                if len(set(face)) == 3:
                    faces.append(face)
    return vertices, faces


def cylinder(radius, low, high):
    return [(0, low), (radius, low), (radius, high), (0, high)]


TUMBLER = [(0, 0), (0.5, 0), (0.5, 1.2), (0.45, 1.2), (0.45, 0.1), (0, 0.1)]
STONE = [(0, 0), (0.3, 0.3), (0.2, 0.4), (0, 0.4)]


class Builder:
    """Scenes in a folder, with every length times `scale`."""

    def __init__(self, folder, scale):
        self.folder, self.scale, self.meshes = folder, scale, 0

    def place(self, shift):
        s = self.scale
        return [{"type": "shift", "x": s * shift[0], "y": s * shift[1], "z": s * shift[2]}]

    def sphere(self, radius, at, material):
        return {"type": "sphere", "radius": self.scale * radius, "material": material, "transform": self.place(at)}

    def box(self, size, at, material):
        return {"type": "box", "size": [self.scale * x for x in size], "material": material, "transform": self.place(at)}

    def mesh(self, profile, material):
        name = f"mesh{self.meshes}_{self.scale:g}.obj"
        self.meshes += 1
        vertices, faces = revolved(profile)
        with open(os.path.join(self.folder, name), "w", encoding="ascii") as out:
            for vertex in vertices:
                out.write("v %.9g %.9g %.9g\n" % tuple(self.scale * x for x in vertex))
            for face in faces:
                out.write("f %d %d %d\n" % tuple(i + 1 for i in face))
        return {"type": "mesh", "path": name, "smooth": False, "material": material}

    def floor(self, material, at=0.0):
        s = self.scale
        return {"type": "rectangle", "material": material,
                "transform": [{"type": "scale", "x": 40 * s, "y": 40 * s, "z": 1},
                              {"type": "rotate", "axis": "x", "degree": -90},
                              {"type": "shift", "x": 0, "y": s * at, "z": 0}]}


def glass(ior=1.5, **keys):
    return {"type": "glass", "ior": ior, **keys}


WATER = glass(1.33)
WHITE = {"type": "diffuse", "color": [0.5, 0.5, 0.5]}
LAMP = {"type": "diffuse", "color": [0, 0, 0], "emission": [4, 4, 4]}
MIRROR = {"type": "mirror", "color": [1, 1, 1]}
GOLD = {"type": "conductor", "eta": [0.14, 0.37, 1.44], "k": [3.98, 2.39, 1.6]}


def arrangements(b):
    """Name -> (objects, the radiance of every pixel if it is a furnace, camera position or None).

    Radiance over the squared index is the same everywhere in a furnace.
    """
    scale = b.scale
    tinted = glass(1.5, absorption=[0, 0.5 / scale, 1 / scale])
    return {
        "two boxes that share a face": (
            [b.box([1, 1, 1], (0, 1, 0), glass()), b.box([1, 1, 1], (0, 0, 0), WATER)], 1, None),
        "boxes of equal index": ([b.box([1, 1, 1], (0, 1, 0), glass()), b.box([1, 1, 1], (0, 0, 0), glass())], 1, None),
        "absorption across a contact": (
            [b.box([1, 1, 1], (0, 1, 0), tinted), b.box([1, 1, 1], (0, 0, 0), WATER)], None, None),
        "tumbler, water touches": ([b.mesh(TUMBLER, glass()), b.mesh(cylinder(0.45, 0.1, 0.8), WATER)], 1, None),
        "tumbler, water overlaps": (
            [b.mesh(TUMBLER, glass(priority=1)), b.mesh(cylinder(0.47, 0.05, 0.8), WATER)], 1, None),
        "the same without a priority": (
            [b.mesh(TUMBLER, glass()), b.mesh(cylinder(0.47, 0.05, 0.8), WATER)], 1, None),
        "tumbler, water with a gap": ([b.mesh(TUMBLER, glass()), b.mesh(cylinder(0.449, 0.101, 0.8), WATER)], 1, None),
        "tumbler of water on a floor": (
            [b.mesh(TUMBLER, glass()), b.mesh(cylinder(0.45, 0.1, 0.8), WATER), b.floor(WHITE)], None, None),
        "ice within water": ([b.box([1, 1, 1], (0, 0.5, 0), WATER), b.box([0.3, 0.3, 0.3], (0, 0.5, 0), glass(1.31))],
                             1, None),
        "ice that floats": ([b.box([1, 1, 1], (0, 0.5, 0), WATER), b.box([0.3, 0.3, 0.3], (0, 1, 0), glass(1.31))],
                            1, None),
        "three stacked lenses": (
            [b.mesh(cylinder(0.5, 0, 0.2), glass(1.5)), b.mesh(cylinder(0.5, 0.2, 0.5), glass(1.7)),
             b.mesh(cylinder(0.5, 0.5, 0.6), glass(1.6))], 1, None),
        "bulb with a filament": (
            [b.sphere(0.5, (0, 0.5, 0), tinted), b.sphere(0.45, (0, 0.5, 0), glass(1.0)),
             b.sphere(0.1, (0, 0.5, 0), LAMP)], None, None),
        "stone in a ring": (
            [b.mesh(STONE, glass(2.4)), b.mesh([(0.3, 0.3), (0.45, 0.3), (0.45, 0.2), (0.3, 0.2)][::-1], GOLD)],
            None, None),
        "tangent spheres": ([b.sphere(0.5, (0, 0.5, 0), glass()), b.sphere(0.5, (0, 1.5, 0), WATER)], 1, None),
        "sphere on a mirror": ([b.sphere(0.5, (0, 0.5, 0), glass()), b.floor(MIRROR)], 1, None),
        "cube on a floor": ([b.box([1, 1, 1], (0, 0.5, 0), glass()), b.floor(WHITE)], None, None),
        "coat of a millionth": ([b.sphere(0.5, (0, 0.5, 0), glass(1.7)), b.sphere(0.500001, (0, 0.5, 0), glass())],
                                1, None),
        "bubble in glass": ([b.sphere(0.6, (0, 0.6, 0), glass()), b.sphere(0.3, (0, 0.6, 0), glass(1.0))], 1, None),
        "camera in absorbing water": (
            [b.sphere(3, (0, 0, 0), glass(1.33, absorption=[0, 0.1 / scale, 0.2 / scale])),
             b.sphere(0.5, (0, 0.5, 0), glass()), b.sphere(0.2, (0, 1.5, 0), LAMP)], None, (0, 0.9, 2)),
        "camera in glass in water": (
            [b.sphere(30, (0, 0, 0), WATER), b.sphere(0.5, (0, 0.5, 2), glass()),
             b.sphere(0.5, (0, 0.5, 0), glass(1.7))], 1.5 ** 2, (0, 0.5, 2.2)),
    }


def render(program, scene, integrator, options, folder):
    picture = os.path.join(folder, "picture.pfm")
    command = [program, "render", scene, *os.environ.get("EXTRA", "").split(), "--integrator", integrator, "-o", picture, *options]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"{' '.join(command)}\n{done.stderr}")
    with open(picture, "rb") as file:
        data = file.read()
    header, size = 0, []
    for _ in range(3):
        end = data.index(b"\n", header)
        size.append(data[header:end])
        header = end + 1
    import array
    values = array.array("f", data[header:])
    mean = [sum(values[c::3]) / (len(values) // 3) for c in range(3)]
    worst = max(abs(x - 1) for x in values)
    return mean, worst


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--program", default="build/causticl")
    parser.add_argument("--samples", type=int, default=1024)
    parser.add_argument("names", nargs="*", metavar="ARRANGEMENT")
    arguments = parser.parse_args()
    scales = [1.0] if arguments.quick else [1e-3, 1.0, 1e3]
    failed = False
    print("| arrangement | path tracing | SPPM | worst of all scales and orders |")
    print("|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for name in arrangements(Builder(folder, 1.0)):
            if arguments.names and name not in arguments.names:
                continue
            shown, worst, where = None, 0.0, ""
            for scale in scales:
                for turned in (False,) if arguments.quick else (False, True):
                    objects, furnace, camera = arrangements(Builder(folder, scale))[name]
                    position = camera or (0.3, 1.4, 3.5)
                    target = (0.0, 0.55, 0.0)
                    scene = {
                        "width": 24, "height": 18, "max_depth": 256,
                        "renderer": {"type": "sppm"},
                        "camera": {"position": [scale * x for x in position], "target": [scale * x for x in target], "fov": 35},
                        "objects": objects[::-1] if turned else objects,
                        "lights": [{"type": "environment", "radiance": [1, 1, 1]}],
                    }
                    file = os.path.join(folder, "scene.json")
                    with open(file, "w", encoding="utf-8") as out:
                        json.dump(scene, out)
                    pt, _ = render(arguments.program, file, "pt", ["--samples", str(arguments.samples)], folder)
                    sppm, _ = render(arguments.program, file, "sppm",
                                     ["--passes", str(arguments.samples // 8), *([] if furnace else ["--photons", "250000"])], folder)
                    first = (pt, sppm, furnace)
                    shown = shown or first
                    truth = [furnace] * 3 if furnace else shown[0]
                    for mean in (pt, sppm):
                        off = max(abs(a / b - 1) for a, b in zip(mean, truth) if b > 1e-3)
                        if off > worst:
                            worst, where = off, f" (scale {scale:g}{', other order' if turned else ''})"
            failed = failed or worst > TOLERANCE
            text = lambda mean: " ".join("%.4f" % x for x in mean)
            kind = " (furnace)" if shown[2] else ""
            print(f"| {name}{kind} | {text(shown[0])} | {text(shown[1])} | {100 * worst:.2f}%{where if worst > TOLERANCE else ''} |",
                  flush=True)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
