"""The meshes of scenes/stress: each hard one has an easy one of the same shape."""

import numpy as np

from .mesh import Mesh, oriented, unit


def grid_surface(points, normals):
    """A mesh of the grid points[i, j] as quads."""
    rows, columns = points.shape[:2]
    faces = [(i * columns + j, i * columns + j + 1, (i + 1) * columns + j + 1, (i + 1) * columns + j)
             for i in range(rows - 1) for j in range(columns - 1)]
    return oriented(Mesh(points.reshape(-1, 3), normals.reshape(-1, 3), faces))


def box_mesh(cuts):
    """The cube of edge 1 round the origin; each face is cut at `cuts` both ways, and its vertices are its own."""
    positions, normals, faces = [], [], []
    n = len(cuts)
    for axis in range(3):
        for side in (-0.5, 0.5):
            first = len(positions)
            normal = np.eye(3)[axis] * np.sign(side)
            for u in cuts:
                for v in cuts:
                    p = np.empty(3)
                    p[[axis, (axis + 1) % 3, (axis + 2) % 3]] = side, u, v
                    positions.append(p)
                    normals.append(normal)
            faces += [(first + i * n + j, first + (i + 1) * n + j, first + (i + 1) * n + j + 1, first + i * n + j + 1)
                      for i in range(n - 1) for j in range(n - 1)]
    return oriented(Mesh(positions, normals, faces))


def needle_box():
    """A cube whose faces are cut ever closer to their edges, into needles of 1 : 10^6 and slivers of 1e-12 area."""
    near = [10.0 ** -k for k in range(2, 7)]
    cuts = [-0.5] + [-0.5 + d for d in reversed(near)] + [0.0] + [0.5 - d for d in near] + [0.5]
    return box_mesh(cuts)


def cap():
    """What is seen of a sphere of radius 10^4 from a unit above its top, which is the origin: up to 170 units away,
    in rings so narrow that none is off the sphere by more than 1e-3."""
    radius = 1e4
    rings, turns = 48, 72
    r = 170 * np.linspace(0, 1, rings + 1)[:, None] * np.ones(turns + 1)
    angle = 2 * np.pi * (np.arange(turns + 1) % turns) / turns * np.ones((rings + 1, 1))
    height = np.sqrt(radius ** 2 - r ** 2) - radius
    points = np.stack([r * np.cos(angle), height, r * np.sin(angle)], -1)
    mesh = grid_surface(points, points + [0, radius, 0])
    return mesh


def ball():
    """A sphere of radius 1: an octahedron whose triangles are cut into 24 x 24."""
    n, positions, faces = 24, [], []
    for signs in np.ndindex(2, 2, 2):
        s = 1 - 2 * np.array(signs)
        first, index = len(positions), {}
        for i in range(n + 1):
            for j in range(n + 1 - i):
                index[i, j] = len(positions)
                positions.append(s * unit(np.sin(np.array([i, j, n - i - j]) * np.pi / 2 / n)))
        for i in range(n):
            for j in range(n - i):
                faces.append((index[i, j], index[i + 1, j], index[i, j + 1]))
                if i + j < n - 1:
                    faces.append((index[i + 1, j], index[i + 1, j + 1], index[i, j + 1]))
    return oriented(Mesh(positions, positions, faces))


GOBLET = [(0, 0), (2.4, -0.1), (-0.6, 0.5), (0.1, 1.6), (1.9, 1.9), (0.9, 3.2), (0.2, 1.2), (0, 1.5)]


def bezier(points, t):
    """Points of a Bezier curve and its derivative."""
    def de_casteljau(p):
        p = [np.asarray(q, float)[None] * np.ones((len(t), 1)) for q in p]
        while len(p) > 1:
            p = [(1 - t)[:, None] * a + t[:, None] * b for a, b in zip(p, p[1:])]
        return p[0]

    difference = (len(points) - 1) * np.diff(np.asarray(points, float), axis=0)
    return de_casteljau(points), de_casteljau(difference)


def goblet():
    """The curve of bezier_goblet.json revolved, in 128 x 60 quads, evenly along the curve."""
    fine = np.linspace(0, 1, 10001)
    length = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(bezier(GOBLET, fine)[0], axis=0), axis=1))])
    curve, tangent = bezier(GOBLET, np.interp(length[-1] * np.linspace(0, 1, 129), length, fine))
    angle = 2 * np.pi * (np.arange(61) % 60) / 60
    c, s = np.cos(angle), np.sin(angle)
    radius, normal = np.maximum(curve[:, :1], 0), unit(np.stack([tangent[:, 1], -tangent[:, 0]], 1))
    points = np.stack([radius * c, curve[:, 1:] + 0 * c, radius * s], -1)
    return grid_surface(points, np.stack([normal[:, :1] * c, normal[:, 1:] + 0 * c, normal[:, :1] * s], -1))


def prism(copies=1):
    """A hexagonal prism of radius 1 and height 1 on y = 0: each of its faces `copies` times."""
    angle = 2 * np.pi * np.arange(6) / 6
    ring = np.round(np.stack([np.cos(angle), 0 * angle, np.sin(angle)], 1), 4)
    positions, normals, faces = [], [], []

    def face(points):
        points = np.asarray(points)
        normal = unit(np.cross(points[1] - points[0], points[2] - points[0]))
        if normal @ (points.mean(0) - [0, 0.5, 0]) < 0:
            points, normal = points[::-1], -normal
        for copy in range(copies):
            first = len(positions)
            positions.extend(np.roll(points, copy, axis=0))  # another first corner: other triangles of the same plane
            normals.extend([normal] * len(points))
            faces.append(range(first, first + len(points)))

    face(ring)
    face(ring + [0, 1, 0])
    for a, b in zip(ring, np.roll(ring, -1, axis=0)):
        face([a, b, b + [0, 1, 0], a + [0, 1, 0]])
    return Mesh(positions, normals, faces)


def duplicates():
    """The prism with every face five times: coplanar triangles that overlap and duplicates to the bit."""
    return prism(copies=5)
