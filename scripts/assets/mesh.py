"""Triangle meshes made of formulas, and their PLY and OBJ files.

Every shape here is closed, wound counter-clockwise seen from outside, and has smooth unit normals.
"""

import numpy as np


class Mesh:
    """Vertices with normals (and uvs, where a texture needs them); `faces` are rows of 3 or 4 indices."""

    def __init__(self, positions, normals, faces, uvs=None):
        self.positions = np.asarray(positions, float)
        self.normals = unit(np.asarray(normals, float))
        self.faces = [tuple(int(i) for i in face) for face in faces]
        self.uvs = None if uvs is None else np.asarray(uvs, float)

    def moved(self, shift=(0, 0, 0), scale=1.0, turn=(0, 0, 0)):
        """Scaled, then turned about x, y, z (degrees), then shifted."""
        matrix = rotation(*turn)
        return Mesh(self.positions * scale @ matrix.T + shift, self.normals @ matrix.T, self.faces, self.uvs)


def unit(v):
    return v / np.maximum(np.linalg.norm(v, axis=-1, keepdims=True), 1e-30)


def rotation(x, y, z):
    """The matrix that turns about x, then y, then z, in degrees."""
    matrix = np.eye(3)
    for axis, degrees in enumerate((x, y, z)):
        c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
        a, b = (axis + 1) % 3, (axis + 2) % 3
        turn = np.eye(3)
        turn[a, a], turn[a, b], turn[b, a], turn[b, b] = c, -s, s, c
        matrix = turn @ matrix
    return matrix


def joined(*meshes):
    """One mesh of several; the parts keep their own vertices."""
    positions, normals, faces, uvs, first = [], [], [], [], 0
    for mesh in meshes:
        positions.append(mesh.positions)
        normals.append(mesh.normals)
        uvs.append(mesh.uvs)
        faces += [tuple(i + first for i in face) for face in mesh.faces]
        first += len(mesh.positions)
    uvs = np.concatenate(uvs) if all(uv is not None for uv in uvs) else None
    return Mesh(np.concatenate(positions), np.concatenate(normals), faces, uvs)


def profile_curve(points, samples):
    """A Catmull-Rom curve through `points` (radius, height), evenly sampled in each stretch.

    A point that is listed twice makes a corner: the curve is cut there.
    """
    points = np.asarray(points, float)
    parts, start = [], 0
    for i in range(1, len(points) + 1):
        if i == len(points) or np.array_equal(points[i], points[i - 1]):
            parts.append(points[start:i])
            start = i
    curve = []
    for part in parts:
        padded = np.concatenate([[2 * part[0] - part[1]], part, [2 * part[-1] - part[-2]]])
        stretch = []
        for a, b, c, d in zip(padded, padded[1:], padded[2:], padded[3:]):
            t = np.linspace(0, 1, samples, endpoint=False)[:, None]
            stretch.append(b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a))))
        curve.append(np.concatenate(stretch + [part[-1:]]))
    return curve


def revolved(points, samples=4, segments=48, uvs=False):
    """The closed surface of revolution about y of a profile that starts and ends on the axis, bottom first.

    With `uvs`, u goes round and v along the profile, and the seam has two columns of vertices.
    """
    columns = segments + 1 if uvs else segments
    angle = 2 * np.pi * np.arange(columns) / segments
    if uvs:
        angle[-1] = 0  # the seam's two columns must meet exactly
    positions, normals, coordinates, faces = [], [], [], []
    curves = profile_curve(points, samples)
    lengths = [np.linalg.norm(np.diff(c, axis=0), axis=1).sum() for c in curves]
    total, done, first = sum(lengths), 0.0, 0
    for curve in curves:
        curve[:, 0] = np.maximum(curve[:, 0], 0)
        # One-sided parabolas at the ends: central differences would tilt the normals at corners.
        tangent = np.gradient(curve, axis=0, edge_order=2)
        normal = unit(np.stack([tangent[:, 1], -tangent[:, 0]], 1))
        along = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(curve, axis=0), axis=1))])
        rows = []
        for (r, y), (nr, ny), v in zip(curve, normal, (done + along) / total):
            pole = r < 1e-9 and not uvs
            turn = angle[:1] if pole else angle
            if r < 1e-9:
                nr, ny = 0.0, np.sign(ny)
            rows.append(first + np.arange(len(turn)) if not pole else np.full(columns, first))
            positions.append(np.stack([r * np.cos(turn), np.full_like(turn, y), -r * np.sin(turn)], 1))
            normals.append(np.stack([nr * np.cos(turn), np.full_like(turn, ny), -nr * np.sin(turn)], 1))
            coordinates.append(np.stack([np.arange(len(turn)) / segments, np.full_like(turn, v)], 1))
            first += len(turn)
        for (low, (r0, _)), (high, (r1, _)) in zip(zip(rows, curve), zip(rows[1:], curve[1:])):
            for i in range(segments):
                j = (i + 1) % columns
                if r0 < 1e-9:
                    faces.append((low[i], high[j], high[i]))
                elif r1 < 1e-9:
                    faces.append((low[i], low[j], high[i]))
                else:
                    faces.append((low[i], low[j], high[j], high[i]))
        done += along[-1]
    mesh = Mesh(np.concatenate(positions), np.concatenate(normals), faces,
                np.concatenate(coordinates) if uvs else None)
    return mesh


def tube(curve, radius, segments):
    """A closed tube round the closed curve (n points); the frame turns as little as it can and closes up."""
    n = len(curve)
    tangent = unit(np.roll(curve, -1, 0) - np.roll(curve, 1, 0))
    side = np.zeros_like(curve)
    side[0] = unit(np.cross(tangent[0], [0.3, 1, 0.2]))
    for i in range(1, n):
        side[i] = unit(side[i - 1] - tangent[i] * (side[i - 1] @ tangent[i]))
    last = unit(side[-1] - tangent[0] * (side[-1] @ tangent[0]))
    twist = np.arctan2(np.cross(last, side[0]) @ tangent[0], last @ side[0])
    up = np.cross(tangent, side)
    angle = 2 * np.pi * np.arange(segments)[None] / segments + twist * np.arange(n)[:, None] / n
    normal = np.cos(angle)[..., None] * side[:, None] + np.sin(angle)[..., None] * up[:, None]
    radius = np.broadcast_to(radius, n)[:, None, None]
    positions = (curve[:, None] + radius * normal).reshape(-1, 3)
    faces = []
    for i in range(n):
        for j in range(segments):
            k, l = (i + 1) % n, (j + 1) % segments
            faces.append((i * segments + j, k * segments + j, k * segments + l, i * segments + l))
    mesh = Mesh(positions, normal.reshape(-1, 3), faces)
    return oriented(mesh)


def rounded_box(size, radius, corner=4):
    """A box centred on the origin whose edges are rounded; `corner` faces span a quarter turn's half."""
    inner = np.asarray(size, float) / 2 - radius
    s = np.tan(np.linspace(-np.pi / 4, np.pi / 4, 2 * corner + 1))
    s = np.concatenate([s[:corner + 1], s[corner:]])  # the middle twice: the flat part lies between
    sign = np.where(np.arange(len(s)) <= corner, -1.0, 1.0)
    positions, normals, faces, seen = [], [], [], {}

    def vertex(direction, centre):
        normal = unit(direction)
        position = centre + radius * normal
        key = tuple(np.round(position, 7))
        if key not in seen:
            seen[key] = len(positions)
            positions.append(position)
            normals.append(normal)
        return seen[key]

    for axis in range(3):
        a, b = (axis + 1) % 3, (axis + 2) % 3
        for side in (-1.0, 1.0):
            grid = np.empty((len(s), len(s)), int)
            for i in range(len(s)):
                for j in range(len(s)):
                    direction, centre = np.empty(3), np.empty(3)
                    direction[[axis, a, b]] = side, s[i], s[j]
                    centre[[axis, a, b]] = side * inner[axis], sign[i] * inner[a], sign[j] * inner[b]
                    grid[i, j] = vertex(direction, centre)
            for i in range(len(s) - 1):
                for j in range(len(s) - 1):
                    face = (grid[i, j], grid[i + 1, j], grid[i + 1, j + 1], grid[i, j + 1])
                    if len(set(face)) == 4:
                        faces.append(face if side > 0 else face[::-1])
    return Mesh(positions, normals, faces)


def picture(width, height):
    """An upright rectangle in z = 0 with uvs from the lower left."""
    w, h = width / 2, height / 2
    return Mesh([(-w, -h, 0), (w, -h, 0), (w, h, 0), (-w, h, 0)], [(0, 0, 1)] * 4, [(0, 1, 2, 3)],
                [(0, 0), (1, 0), (1, 1), (0, 1)])


def oriented(mesh):
    """Turns the winding round where it disagrees with the normals."""
    faces = np.array(mesh.faces)
    a, b, c = (mesh.positions[faces[:, i]] for i in range(3))
    agree = np.einsum("ij,ij->i", np.cross(b - a, c - a), mesh.normals[faces].sum(1))
    faces[agree < 0] = faces[agree < 0][:, ::-1]
    return Mesh(mesh.positions, mesh.normals, faces, mesh.uvs)


def triangles(mesh):
    """The faces as triangles; four corners are cut along the shorter diagonal."""
    result = []
    for face in mesh.faces:
        if len(face) == 3:
            result.append(face)
            continue
        a, b, c, d = face
        p = mesh.positions
        if np.linalg.norm(p[a] - p[c]) <= np.linalg.norm(p[b] - p[d]):
            result += [(a, b, c), (a, c, d)]
        else:
            result += [(a, b, d), (b, c, d)]
    return np.array(result)


def write_ply(path, mesh):
    """Binary little-endian PLY: positions, normals, uvs if there are any, triangles."""
    names = ["x", "y", "z", "nx", "ny", "nz"] + (["u", "v"] if mesh.uvs is not None else [])
    columns = [mesh.positions, mesh.normals] + ([mesh.uvs] if mesh.uvs is not None else [])
    faces = triangles(mesh)
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(mesh.positions)}"]
    header += [f"property float {name}" for name in names]
    header += [f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header", ""]
    rows = np.empty(len(faces), np.dtype([("count", "u1"), ("index", "<i4", 3)]))
    rows["count"], rows["index"] = 3, faces
    with open(path, "wb") as out:
        out.write("\n".join(header).encode())
        out.write(np.concatenate(columns, 1).astype("<f4").tobytes())
        out.write(rows.tobytes())


def write_obj(path, mesh, digits=4):
    """OBJ with normals, uvs if there are any, and faces of any number of corners."""
    def row(key, values):
        return key + " " + " ".join(f"{v:.{digits}f}".rstrip("0").rstrip(".").replace("-0", "-0") or "0"
                                    for v in values)

    lines = [row("v", p) for p in mesh.positions]
    # Many vertices of a flat part share a normal: each is written once.
    numbers, seen = [], {}
    for n in mesh.normals:
        text = row("vn", n)
        if text not in seen:
            seen[text] = len(seen) + 1
            lines.append(text)
        numbers.append(seen[text])
    if mesh.uvs is not None:
        lines += [row("vt", uv) for uv in mesh.uvs]
    for face in mesh.faces:
        corners = (f"{i + 1}/{i + 1 if mesh.uvs is not None else ''}/{numbers[i]}" for i in face)
        lines.append("f " + " ".join(corners))
    with open(path, "w") as out:
        out.write("\n".join(lines) + "\n")
