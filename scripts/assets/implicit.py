"""Smooth closed meshes of implicit surfaces: f(p) < 0 inside."""

import numpy as np

from .mesh import Mesh, unit


def gradient(f, p, h=1e-4):
    """Central differences of f at the points p (n x 3)."""
    steps = h * np.eye(3)
    return np.stack([f(p + s) - f(p - s) for s in steps], 1) / (2 * h)


def polygonised(f, low, high, cell, relaxation=6):
    """The surface f = 0 in a box as a closed mesh with normals along the gradient of f.

    Marching tetrahedra over cubes of edge `cell` cut into six, so that the mesh is a closed manifold
    (Doi & Koide 1991); then the vertices slide along the surface toward the middle of their neighbours,
    which removes the slivers of that method, and are put back on f = 0 by Newton steps.
    """
    axes = [np.arange(a, b + cell, cell) for a, b in zip(low, high)]
    shape = tuple(len(a) for a in axes)
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 3)
    value = np.concatenate([f(part) for part in np.array_split(grid, max(1, len(grid) // 50000))])
    value[value == 0] = 1e-12  # no vertex of the surface falls on a grid point

    index = np.arange(len(grid)).reshape(shape)
    steps = [(1, 0, 0), (0, 1, 0), (0, 0, 1)]
    tetrahedra = []
    for order in ((0, 1, 2), (0, 2, 1), (1, 0, 2), (1, 2, 0), (2, 0, 1), (2, 1, 0)):
        corner, corners = np.zeros(3, int), []
        for axis in (None,) + order:
            if axis is not None:
                corner = corner + steps[axis]
            x, y, z = corner
            corners.append(index[x:shape[0] - 1 + x, y:shape[1] - 1 + y, z:shape[2] - 1 + z].reshape(-1))
        tetrahedra.append(np.stack(corners, 1))
    tetrahedra = np.concatenate(tetrahedra)
    inside = value[tetrahedra] < 0
    tetrahedra = tetrahedra[inside.any(1) & ~inside.all(1)]

    # Corners sorted inside first: one inside gives one triangle, three likewise, two give a quadrilateral.
    order = np.argsort(value[tetrahedra] >= 0, axis=1, kind="stable")
    tetrahedra = np.take_along_axis(tetrahedra, order, 1)
    count = (value[tetrahedra] < 0).sum(1)
    a, b, c, d = tetrahedra.T
    pieces = []
    for k, triangle_edges in ((1, [((a, b), (a, c), (a, d))]), (3, [((a, d), (b, d), (c, d))]),
                              (2, [((a, c), (a, d), (b, d)), ((a, c), (b, d), (b, c))])):
        chosen = count == k
        for edges in triangle_edges:
            pieces.append(np.stack([np.stack([u[chosen], v[chosen]], 1) for u, v in edges], 1))
    edges = np.sort(np.concatenate(pieces).reshape(-1, 2), 1)
    edges, corner_of = np.unique(edges, axis=0, return_inverse=True)
    faces = corner_of.reshape(-1, 3)
    u, v = value[edges[:, 0]], value[edges[:, 1]]
    t = (u / (u - v))[:, None]
    positions = grid[edges[:, 0]] * (1 - t) + grid[edges[:, 1]] * t

    p = positions[faces]
    crossed = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
    # Exactly in the sense of the tetrahedron, since a sliver's own normal says little: f grows outward.
    outward = gradient(f, p.mean(1), 0.05 * cell)
    flip = np.einsum("ij,ij->i", crossed, outward) < 0
    faces[flip] = faces[flip][:, ::-1]
    faces = consistently_wound(faces)

    links = np.unique(np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), 1), axis=0)
    degree = np.bincount(links.reshape(-1), minlength=len(positions))[:, None]
    for i in range(relaxation + 2):
        g = gradient(f, positions)
        normal = unit(g)
        moved = positions - g * (f(positions) / np.maximum((g * g).sum(1), 0.25))[:, None]
        if i < relaxation:
            total = np.zeros_like(positions)
            np.add.at(total, links[:, 0], positions[links[:, 1]])
            np.add.at(total, links[:, 1], positions[links[:, 0]])
            slide = 0.5 * (total / degree - positions)
            moved += slide - normal * np.einsum("ij,ij->i", slide, normal)[:, None]
        # A vertex whose triangles would fold over stays where it was.
        p = moved[faces]
        folded = np.einsum("ij,ij->i", unit(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])),
                           unit(normal[faces].sum(1))) < 0.3
        moved[faces[folded]] = positions[faces[folded]]
        positions = moved
    return Mesh(positions, agreeing(unit(gradient(f, positions)), positions, faces), faces)


def agreeing(normals, positions, faces):
    """The normals, but the mean of the triangles round a vertex where one of them turns away from its normal.

    That happens in creases which are finer than the mesh.
    """
    p = positions[faces]
    crossed = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
    facing = np.einsum("ij,ikj->ik", unit(crossed), normals[faces])
    doubtful = np.unique(faces[facing < 0.4])
    mean = np.zeros_like(normals)
    for corner in range(3):
        np.add.at(mean, faces[:, corner], unit(crossed))
    normals = normals.copy()
    normals[doubtful] = unit(mean[doubtful])
    return normals


def consistently_wound(faces):
    """Winds neighbours alike, by walking over shared edges; each part keeps the sense of its majority."""
    sides = {}
    for t, (a, b, c) in enumerate(faces):
        for edge in ((a, b), (b, c), (c, a)):
            sides.setdefault((min(edge), max(edge)), []).append((t, edge[0] < edge[1]))
    neighbours = [[] for _ in faces]
    for (t, up), (s, up_too) in sides.values():
        neighbours[t].append((s, up == up_too))
        neighbours[s].append((t, up == up_too))
    turned = np.full(len(faces), -1)
    for start in range(len(faces)):
        if turned[start] >= 0:
            continue
        part, stack = [start], [start]
        turned[start] = 0
        while stack:
            t = stack.pop()
            for s, differs in neighbours[t]:
                if turned[s] < 0:
                    turned[s] = turned[t] ^ differs
                    part.append(s)
                    stack.append(s)
        if turned[part].sum() > len(part) / 2:
            turned[part] ^= 1
    faces = faces.copy()
    faces[turned == 1] = faces[turned == 1][:, ::-1]
    return faces
