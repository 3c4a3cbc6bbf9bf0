"""The meshes of the scenes. Every model stands on y = 0 unless it says otherwise."""

import numpy as np

from .mesh import Mesh, joined, oriented, picture, revolved, rounded_box, tube


def knot():
    """A thick trefoil, centred on the origin, about 6 across: a closed tube for glass."""
    t = 2 * np.pi * np.arange(260) / 260
    curve = np.stack([(2 + np.cos(3 * t)) * np.cos(2 * t), (2 + np.cos(3 * t)) * np.sin(2 * t), np.sin(3 * t)], 1)
    return tube(curve, 0.62 + 0.06 * np.cos(3 * t), 26)


def goblet():
    """A wine glass of 2.9 height whose wall has two sides; closed, for glass."""
    return revolved([(0, 0), (0.45, 0), (0.8, 0.0), (0.86, 0.035), (0.8, 0.075), (0.45, 0.13), (0.17, 0.24),
                     (0.1, 0.45), (0.085, 0.8), (0.1, 1.1), (0.24, 1.3), (0.55, 1.5), (0.75, 1.8), (0.8, 2.15),
                     (0.75, 2.55), (0.69, 2.86), (0.665, 2.9), (0.64, 2.86), (0.69, 2.55), (0.735, 2.15),
                     (0.69, 1.83), (0.5, 1.58), (0.25, 1.43), (0, 1.38)], samples=3, segments=48)


def pawn():
    return revolved([(0, 0), (0.9, 0), (1.02, 0.12), (0.98, 0.3), (0.8, 0.42), (0.72, 0.52), (0.74, 0.62), (0.55, 0.85),
                     (0.38, 1.2), (0.32, 1.6), (0.34, 1.72), (0.62, 1.8), (0.64, 1.88), (0.4, 1.98), (0.42, 2.05),
                     (0.56, 2.3), (0.55, 2.52), (0.36, 2.78), (0, 2.88)], samples=3, segments=40)


def bishop():
    return revolved([(0, 0), (1.0, 0), (1.14, 0.14), (1.08, 0.34), (0.88, 0.5), (0.8, 0.62), (0.82, 0.72), (0.6, 1.0),
                     (0.42, 1.5), (0.36, 2.2), (0.38, 2.4), (0.72, 2.5), (0.74, 2.6), (0.44, 2.72), (0.4, 2.85),
                     (0.58, 3.15), (0.62, 3.4), (0.48, 3.8), (0.22, 4.12), (0.15, 4.2), (0.22, 4.32), (0.15, 4.45),
                     (0, 4.5)], samples=3, segments=40)


def queen():
    """A queen whose crown is a fluted cup with a ball: taller than the bishop, closed, for glass."""
    return revolved([(0, 0), (1.15, 0), (1.3, 0.16), (1.22, 0.4), (1.0, 0.58), (0.9, 0.7), (0.93, 0.82), (0.68, 1.15),
                     (0.46, 1.8), (0.38, 2.8), (0.4, 3.0), (0.82, 3.12), (0.84, 3.24), (0.52, 3.36), (0.46, 3.55),
                     (0.62, 4.1), (0.84, 4.5), (0.84, 4.6), (0.68, 4.56), (0.45, 4.62), (0.24, 4.8), (0.18, 4.9),
                     (0.28, 5.06), (0.2, 5.24), (0, 5.3)], samples=3, segments=40)


def planar_uvs(mesh, scale):
    """UVs by projection along y, in texture widths."""
    uvs = mesh.positions[:, [0, 2]] * [scale, -scale] + 0.5
    return Mesh(mesh.positions, mesh.normals, mesh.faces, uvs)


def turned_leg(height, radius):
    """A leg as from a lathe."""
    r, h = radius, height
    return revolved([(0, 0), (0.55 * r, 0), (0.62 * r, 0.02 * h), (0.5 * r, 0.06 * h), (0.62 * r, 0.3 * h),
                     (0.95 * r, 0.6 * h), (0.8 * r, 0.7 * h), (0.62 * r, 0.73 * h), (0.95 * r, 0.77 * h), (r, 0.82 * h),
                     (r, 0.97 * h), (r, h), (r, h), (0, h)], samples=3, segments=18)


def table_top():
    """A board of 84 x 4 x 44 with its under side at y = 0; uvs seen from above."""
    return planar_uvs(rounded_box((84, 4, 44), 1.2, 3).moved((0, 2, 0)), 1 / 84)


def table_legs():
    """Four turned legs of 34 and the apron between them, for table_top."""
    legs = [turned_leg(34, 3).moved((x, 0, z)) for x in (-36, 36) for z in (-16, 16)]
    aprons = [rounded_box((70, 5, 1.6), 0.4, 1).moved((0, 31.5, z)) for z in (-16, 16)]
    aprons += [rounded_box((1.6, 5, 30), 0.4, 1).moved((x, 31.5, 0)) for x in (-36, 36)]
    return joined(*legs, *aprons)


def chair():
    """A slatted chair: the seat at 24, the back up to 58, facing +z."""
    parts = [rounded_box((26, 3, 25), 1.2, 2).moved((0, 23, 0))]
    parts += [turned_leg(22, 1.7).moved((x, 0, 10)) for x in (-10.5, 10.5)]
    for x in (-10.8, 10.8):
        parts.append(rounded_box((2.4, 36, 2.4), 0.9, 2).moved((x, 40.5, -13), turn=(-8, 0, 0)))
        parts.append(rounded_box((2.4, 23, 2.4), 0.9, 2).moved((x, 11.4, -11.2), turn=(4, 0, 0)))
    parts += [rounded_box((21, 4.2, 1.3), 0.6, 2).moved((0, y, -13 - (y - 40.5) * 0.14), turn=(-8, 0, 0))
              for y in (36, 45, 54)]
    return joined(*parts)


def sofa():
    """A sofa of 92 x 40 x 42, facing +z, of soft cushions."""
    parts = [rounded_box((90, 11, 40), 2.5, 3).moved((0, 8.5, 0))]
    parts += [rounded_box((10, 25, 42), 4.5, 4).moved((x, 15.5, 0)) for x in (-43, 43)]
    parts += [rounded_box((75, 30, 9), 4, 4).moved((0, 25, -15), turn=(-9, 0, 0))]
    parts += [rounded_box((37, 10, 31), 4.2, 4).moved((x, 18.5, 3.5)) for x in (-18.7, 18.7)]
    parts += [rounded_box((35, 21, 9), 4.2, 4).moved((x, 32, -8.5), turn=(-13, 0, 0)) for x in (-18.4, 18.4)]
    parts += [rounded_box((4, 4, 4), 1, 1).moved((x, 2, z)) for x in (-40, 40) for z in (-15, 15)]
    return joined(*parts)


def cushion():
    """A scatter cushion: 17 x 17, thick in the middle, standing on its edge and facing +z."""
    box = rounded_box((17, 17, 6), 2.9, 8)
    x, y, z = box.positions.T
    edge = np.maximum(abs(x), abs(y)) / 8.5
    pinched = np.stack([x * (1 - 0.12 * (1 - (y / 8.5) ** 2) * abs(x) / 8.5),
                        y * (1 - 0.12 * (1 - (x / 8.5) ** 2) * abs(y) / 8.5) + 8.5, z * (1.15 - 0.55 * edge ** 2)], 1)
    mesh = Mesh(pinched, box.normals, box.faces)
    return averaged(mesh)


def averaged(mesh):
    """Normals as the area-weighted mean of the faces round each vertex."""
    normals = np.zeros_like(mesh.positions)
    for face in mesh.faces:
        p = mesh.positions[list(face)]
        n = np.cross(p[1] - p[0], p[2] - p[0])
        if len(face) == 4:
            n = n + np.cross(p[2] - p[0], p[3] - p[0])
        normals[list(face)] += n
    return Mesh(mesh.positions, normals, mesh.faces, mesh.uvs)


def floor_lamp():
    """The stand of a lamp whose globe (a sphere of radius 7) is centred at y = 76."""
    return revolved([(0, 0), (9, 0), (9.6, 0.6), (9, 1.3), (4, 2), (1.2, 3.2), (0.8, 6), (0.8, 30), (0.8, 58), (1.0, 64),
                     (3.4, 66.2), (4.3, 67.2), (4.0, 67.9), (3.0, 68.1), (0, 68.2)], samples=3, segments=36)


def pendant_shade():
    """The bell of a pendant lamp, open below: its rim has the radius 15 at y = 0, its top is at 12."""
    return revolved([(0, 10.4), (3.5, 10.1), (8, 8.2), (11.6, 4.8), (14.2, 0.5), (14.7, 0), (15.1, 0.4), (12.6, 5.2),
                     (8.8, 9.2), (3.9, 11.5), (0, 12)], samples=3, segments=48)


def painting_frame():
    """A profile of four bars round a canvas of 48 x 32 in z = 0."""
    bars = [rounded_box((54, 3.4, 3), 1, 2).moved((0, y, 0)) for y in (-17.2, 17.2)]
    bars += [rounded_box((3.4, 38, 3), 1, 2).moved((x, 0, 0)) for x in (-25.2, 25.2)]
    return joined(*bars)


def canvas():
    return picture(48, 32)


def rug():
    """A rug of 110 x 70 lying 0.4 above the floor, uvs seen from above."""
    return picture(110, 70).moved((0, 0.4, 0), turn=(-90, 0, 0))


def disc_lamp():
    """A flat disc of radius 1 in y = 0 that faces down: one polygon of 48 corners."""
    angle = -2 * np.pi * np.arange(48) / 48
    return Mesh(np.stack([np.cos(angle), 0 * angle, -np.sin(angle)], 1), [(0, -1, 0)] * 48, [tuple(range(48))])


def mirror_ring(inner=0.94, outer=1.0, height=0.55, segments=128):
    """A polished band: a closed ring of rectangular section with rounded edges, radius 1, standing on y = 0."""
    bevel = 0.02
    section = []
    corners = [(inner + bevel, bevel, 180), (outer - bevel, bevel, 270), (outer - bevel, height - bevel, 0),
               (inner + bevel, height - bevel, 90)]
    for r, y, start in corners:
        for degrees in np.linspace(start, start + 90, 4):
            c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
            section.append((r + bevel * c, y + bevel * s, c, s))
    section = np.array(section)
    angle = 2 * np.pi * np.arange(segments) / segments
    c, s = np.cos(angle)[:, None], np.sin(angle)[:, None]
    r, y, nr, ny = (section[None, :, i] for i in range(4))
    positions = np.stack([r * c, y + 0 * c, -r * s], -1).reshape(-1, 3)
    normals = np.stack([nr * c, ny + 0 * c, -nr * s], -1).reshape(-1, 3)
    n = len(section)
    faces = [(i * n + j, (i + 1) % segments * n + j, (i + 1) % segments * n + (j + 1) % n, i * n + (j + 1) % n)
             for i in range(segments) for j in range(n)]
    return oriented(Mesh(positions, normals, faces))


def glass_prism():
    """An equilateral prism with edges of 1 about the z axis, an edge on top; flat faces."""
    angle = np.radians([90, 210, 330])
    ring = np.stack([np.cos(angle), np.sin(angle), 0 * angle], 1) / np.sqrt(3)
    front, back = ring + [0, 0, 0.5], ring - [0, 0, 0.5]
    positions, normals, faces = [], [], []
    sides = [(front, [0, 0, 1]), (back[::-1], [0, 0, -1])]
    for a, b in ((0, 1), (1, 2), (2, 0)):
        sides.append(([front[a], back[a], back[b], front[b]], ring[a] + ring[b]))
    for corners, normal in sides:
        faces.append(range(len(positions), len(positions) + len(corners)))
        positions.extend(corners)
        normals.extend([normal] * len(corners))
    return Mesh(positions, normals, faces)
