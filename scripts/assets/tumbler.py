"""A tumbler of iced water and what stands about it, in centimetres, the tumbler standing on y = 0.

Water reaches a little into the glass that holds it, and below the top of the table: bodies of unlike priority may
overlap, and faces that overlap meet more surely than faces that touch.
"""

import numpy as np

from .mesh import Mesh, joined, rounded_box, unit
from .models import averaged
from .textures import clouds, mix, pixels, srgb, step

HEIGHT, FOOT, RIM, WALL, FLOOR = 9.6, 3.05, 3.85, 0.24, 1.05
WATER_LEVEL = 6.9


def outer_radius(y):
    return FOOT + (RIM - FOOT) * y / HEIGHT


def inner_radius(y):
    return outer_radius(y) - WALL


def rounded_profile(corners, steps):
    """Rows (radius, height, and their normal) of a polygon of (radius, height, rounding), bottom first.

    A corner of rounding 0 stays sharp: it has a row for either side.
    """
    points = np.array([c[:2] for c in corners], float)
    along = unit(np.diff(points, axis=0))
    normals = np.stack([along[:, 1], -along[:, 0]], 1)
    rows = [(*points[0], *normals[0])]
    for i in range(1, len(points) - 1):
        before, after, rounding = along[i - 1], along[i], corners[i][2]
        turn = np.arctan2(before[0] * after[1] - before[1] * after[0], before @ after)
        if rounding == 0:
            rows += [(*points[i], *normals[i - 1]), (*points[i], *normals[i])]
            continue
        start = points[i] - before * rounding * np.tan(abs(turn) / 2)
        centre = start - np.sign(turn) * rounding * normals[i - 1]
        for angle in np.linspace(0, turn, steps + 1):
            c, s = np.cos(angle), np.sin(angle)
            normal = np.array([[c, -s], [s, c]]) @ normals[i - 1]
            rows.append((*(centre + np.sign(turn) * rounding * normal), *normal))
    rows.append((*points[-1], *normals[-1]))
    return np.array(rows)


def turned(rows, segments, uvs=False):
    """The closed surface of revolution about y of rows that start and end on the axis.

    With `uvs`, u goes round and v is the length along the rows.
    """
    columns = segments + 1 if uvs else segments
    angle = 2 * np.pi * (np.arange(columns) % segments) / segments
    c, s = np.cos(angle), np.sin(angle)
    positions, normals, coordinates, faces, rings, first, length = [], [], [], [], [], 0, 0.0
    for k, (r, y, nr, ny) in enumerate(rows):
        length += np.hypot(*(rows[k, :2] - rows[k - 1, :2])) if k else 0
        pole = r < 1e-9 and not uvs
        count = 1 if pole else columns
        rings.append(np.full(columns, first) if pole else first + np.arange(columns))
        positions.append(np.stack([r * c, np.full(columns, y), -r * s], 1)[:count])
        normals.append(np.stack([nr * c, np.full(columns, ny), -nr * s], 1)[:count])
        coordinates.append(np.stack([np.arange(columns) / segments, np.full(columns, length)], 1)[:count])
        first += count
    for k in range(len(rows) - 1):
        if np.allclose(rows[k, :2], rows[k + 1, :2]):
            continue
        low, high = rings[k], rings[k + 1]
        for i in range(segments):
            j = (i + 1) % columns
            if rows[k, 0] < 1e-9:
                faces.append((low[i], high[j], high[i]))
            elif rows[k + 1, 0] < 1e-9:
                faces.append((low[i], low[j], high[i]))
            else:
                faces.append((low[i], low[j], high[j], high[i]))
    return Mesh(np.concatenate(positions), np.concatenate(normals), faces,
                np.concatenate(coordinates) if uvs else None)


def tumbler():
    """A tumbler whose wall widens upward, with a thick floor and a round rim."""
    low = inner_radius(FLOOR)
    return turned(rounded_profile([(0, 0.16, 0), (FOOT - 0.75, 0.16, 0.3), (FOOT - 0.6, 0, 0.12), (FOOT, 0, 0.22),
                                   (RIM, HEIGHT, 0.119), (RIM - WALL, HEIGHT, 0.119), (low, FLOOR, 0.5),
                                   (0, FLOOR - 0.12, 0)], 3), 64)


def water():
    """The water in the tumbler: it reaches into the wall and the floor, and climbs the wall by a meniscus."""
    sunk, level = 0.09, WATER_LEVEL
    low, high = inner_radius(FLOOR) + sunk, inner_radius(level + 0.5) + sunk
    return turned(rounded_profile([(0, FLOOR - 0.12 - sunk, 0), (low, FLOOR - sunk, 0.5), (high, level + 0.5, 0),
                                   (inner_radius(level) - 0.09, level, 0.32), (0, level, 0)], 4), 64)


def ice_cube(seed):
    """A block of about 2.3 that has begun to melt, centred on the origin."""
    random = np.random.RandomState(seed)
    box = rounded_box((2.35, 2.15, 2.3), 0.42, 3)
    p = box.positions
    dent = np.zeros(len(p))
    for _ in range(14):
        wave = random.normal(size=3) * 1.5
        dent += np.sin(p @ wave + random.rand() * 2 * np.pi)
    # Faces of molten ice are hollow or bulge: flat ones would be windows.
    waist = 1 - 0.02 * (p ** 2).sum(1)
    return averaged(Mesh(p * waist[:, None] + box.normals * 0.022 * dent[:, None], box.normals, box.faces))


def straw():
    """A drinking straw with a bend, along y and then toward +x; solid but for the recess at its upper end."""
    radius, knee = 0.3, 11.2
    corners = [(0, 0, 0), (radius, 0, 0.04), (radius, knee, 0.03)]
    for k in range(8):
        corners += [(radius + 0.07, knee + 0.1 + 0.2 * k, 0.03), (radius, knee + 0.2 + 0.2 * k, 0.03)]
    corners += [(radius, knee + 4.2, 0.02), (radius - 0.05, knee + 4.2, 0.02), (radius - 0.05, knee + 2.8, 0),
                (0, knee + 2.8, 0)]
    mesh = turned(rounded_profile(corners, 1), 12, uvs=True)
    # The axis is straight, then bends by 62 degrees over the ripples, and is straight again.
    height, bend, arc = mesh.positions[:, 1], np.radians(62), 1.6
    turn = np.clip((height - knee) / arc, 0, 1) * bend
    rest = np.maximum(height - knee - arc, 0)
    circle = arc / bend
    axis = np.stack([circle * (1 - np.cos(turn)) + rest * np.sin(bend),
                     np.minimum(height, knee) + circle * np.sin(turn) + rest * np.cos(bend), 0 * turn], 1)

    def bent(v, along):
        across = v[:, :1] * np.stack([np.cos(turn), -np.sin(turn), 0 * turn], 1)
        return across + v[:, 2:] * [0, 0, 1] + along[:, None] * np.stack([np.sin(turn), np.cos(turn), 0 * turn], 1)

    return Mesh(axis + bent(mesh.positions, 0 * turn), bent(mesh.normals, mesh.normals[:, 1]), mesh.faces, mesh.uvs)


def lemon_slice():
    """A wheel of lemon of radius 2.35 in z = 0, with the uvs of lemon()."""
    wheel = turned(rounded_profile([(0, -0.25, 0), (2.35, -0.25, 0.12), (2.35, 0.25, 0.12), (0, 0.25, 0)], 2), 36)
    wheel = wheel.moved(turn=(90, 0, 0))
    return Mesh(wheel.positions, wheel.normals, wheel.faces, wheel.positions[:, :2] / 4.8 + 0.5)


def drop_on_table(radius, height, seed, wobble, segments, rows=7):
    """Water that lies on a table at y = 0 and reaches a little below it; its outline is not quite round."""
    random = np.random.RandomState(seed)
    angle = 2 * np.pi * np.arange(segments) / segments
    outline = np.ones(segments)
    for k in range(2, 6):
        outline += wobble * random.normal() / k * np.cos(k * angle + random.rand() * 2 * np.pi)
    sunk, rings = 0.06, []
    for t in np.sin(np.linspace(np.pi / 2, 0, rows + 1))[:-1]:
        # Flat in the middle and steep at the edge, as surface tension shapes it.
        rings.append((t, height * np.sqrt(1 - t ** 4)))
    positions, faces = [(0, -sunk, 0)], []
    # The lowest ring comes twice: its edge is sharp.
    for t, y in [(1.0, -sunk), (1.0, -sunk)] + rings:
        positions += list(np.stack([t * radius * outline * np.cos(angle), np.full(segments, y),
                                    -t * radius * outline * np.sin(angle)], 1))
    positions.append((0, height, 0))
    for i in range(segments):
        j = (i + 1) % segments
        faces.append((0, 1 + j, 1 + i))
        for k in range(1, rows + 1):
            a, b = 1 + k * segments, 1 + (k + 1) * segments
            faces.append((a + i, a + j, b + j, b + i))
        a = 1 + (rows + 1) * segments
        faces.append((a + i, a + j, len(positions) - 1))
    positions = np.array(positions)
    return averaged(Mesh(positions, positions, faces))


def spilt_water():
    """A puddle round the foot of the tumbler, and drops that lie apart from it."""
    drops = [drop_on_table(4.5, 0.13, 3, 0.16, 40, 5).moved((0.5, 0, 0.35))]
    for k, (x, z, radius) in enumerate([(6.0, 3.4, 0.75), (-4.9, 4.2, 0.95), (4.1, 5.2, 0.5), (-6.6, 1.6, 0.45),
                                        (7.3, 1.0, 0.4), (1.1, 6.1, 0.36), (-2.2, 6.3, 0.55), (-6.3, 5.3, 0.3)]):
        drops.append(drop_on_table(radius, 0.12 + 0.12 * radius, 20 + k, 0.12, 12, 4).moved((x, 0, z)))
    return joined(*drops)


def small_drop():
    """A flattened ball of radius 1 about the plane y = 0, of few faces."""
    rows = [(0, -0.4, 0, -1), (0.9, -0.4, 0, -1), (0.9, -0.4, 0.9, -0.4), (1, 0, 1, 0.15), (0.76, 0.32, 0.7, 0.71),
            (0.4, 0.47, 0.3, 0.95), (0, 0.52, 0, 1)]
    return turned(np.array(rows, float), 8)


def apart(place, radius, placed, gap):
    """Whether a ball stands clear of those `placed`, and adds it to them if so."""
    if any(np.linalg.norm(place - other) < gap * (radius + r) for other, r in placed):
        return False
    placed.append((place, radius))
    return True


def condensation(count=16):
    """Drops on a quarter of the tumbler's outer wall; the foot of each is in the glass."""
    random, drops, placed = np.random.RandomState(8), [], []
    while len(drops) < count:
        angle, y, radius = random.uniform(0, np.pi / 2), random.uniform(0.8, 7), 0.045 + 0.1 * random.rand() ** 2
        wall = outer_radius(y)
        centre = np.array([wall * np.cos(angle), y, -wall * np.sin(angle)])
        if apart(centre, radius, placed, 1.6):
            turn = (0, 0, -90), (0, np.degrees(angle), 0)
            drops.append(small_drop().moved(scale=radius, turn=turn[0]).moved(centre, turn=turn[1]))
    return joined(*drops)


def ice_bubbles(count=11):
    """Bubbles of air about the middle of ice_cube(), drawn out as the ice grew inward."""
    random, bubbles, placed = np.random.RandomState(5), [], []
    ball = turned(np.array([(np.sin(t), -np.cos(t), np.sin(t), -np.cos(t)) for t in np.linspace(0, np.pi, 6)]), 7)
    ball = Mesh(ball.positions * [1, 1.5, 1], ball.normals / [1, 1.5, 1], ball.faces)
    while len(bubbles) < count:
        place, radius = random.normal(size=3) * 0.3, 0.035 + 0.08 * random.rand() ** 2
        if np.abs(place).max() < 0.7 and apart(place, radius, placed, 1.7):
            bubbles.append(ball.moved(place, radius, turn=random.uniform(-40, 40, 3)))
    return joined(*bubbles)


def lemon(size):
    """The cut face of a lemon, its rind at the edge of the picture's disc."""
    x, y = pixels(size, size)
    u, v = (x / size - 0.5) * 2.042, (y / size - 0.5) * 2.042
    r, angle = np.hypot(u, v), np.arctan2(v, u)
    cell = (angle / (2 * np.pi) * 9 + 0.13 * np.sin(3 * angle)) % 1
    across = np.minimum(cell, 1 - cell) * r * 2 * np.pi / 9
    # Juice sacs point at the middle.
    sacs = clouds(np.cos(angle) * 26 + 40, np.sin(angle) * 26 + 40 + 5 * r, 3, 3)
    flesh = mix(srgb(236, 196, 60), srgb(250, 232, 140), step(0.25, 0.75, sacs))
    pith = srgb(250, 244, 214)
    inside = step(0.022, 0.05, across) * step(0.07, 0.13, r) * (1 - step(0.80, 0.84, r))
    result = mix(np.broadcast_to(pith, flesh.shape), flesh, inside)
    rind = srgb(244, 196, 20) * (0.92 + 0.16 * clouds(u * 40 + 90, v * 40 + 90, 9, 2))[..., None]
    return mix(result, rind, step(0.93, 0.955, r))


def stripes(size):
    """The paper of a straw: two stripes that climb round it; repeats."""
    x, y = pixels(size, size)
    turn = 2 * (x / size) + y / size
    edge = np.abs((turn % 1) - 0.5)
    return mix(srgb(246, 242, 232), srgb(196, 30, 36), 1 - step(0.24, 0.26, edge))
