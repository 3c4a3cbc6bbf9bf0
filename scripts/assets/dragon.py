"""A glass dragon, as an implicit surface of rods, ellipsoids and sheets that blend into each other."""

import numpy as np

from .implicit import polygonised


def dragon():
    """A winged dragon, 8 high and 11 long, as one smooth closed surface; it looks toward -x."""
    return polygonised(dragon_distance, (-6.4, -0.5, -3.9), (6.6, 9.4, 3.9), 0.19).moved((0, 0.16, 0))


def round_cone(p, a, b, ra, rb):
    """About the distance to a rod from a to b whose radius goes from ra to rb."""
    a, b = np.asarray(a, float), np.asarray(b, float)
    along = b - a
    t = np.clip((p - a) @ along / (along @ along), 0, 1)
    return np.linalg.norm(p - a - t[:, None] * along, axis=1) - (ra + (rb - ra) * t)


def ellipsoid(p, centre, radii):
    q = (p - centre) / radii
    k0, k1 = np.linalg.norm(q, axis=1), np.linalg.norm(q / radii, axis=1)
    return k0 * (k0 - 1) / np.maximum(k1, 1e-9)


def sheet(p, a, b, c, thickness):
    """The distance to a triangle, less half the thickness."""
    a, b, c = (np.asarray(v, float) for v in (a, b, c))
    n = np.cross(b - a, c - a)
    n /= np.linalg.norm(n)
    inside = np.ones(len(p), bool)
    edges = np.full(len(p), np.inf)
    for u, v in ((a, b), (b, c), (c, a)):
        inside &= (p - u) @ np.cross(n, v - u) > 0
        edges = np.minimum(edges, round_cone(p, u, v, 0, 0))
    return np.where(inside, abs((p - a) @ n), edges) - thickness / 2


def blend(a, b, k):
    """The smooth minimum of Quilez (cubic), which changes nothing farther than k from the seam."""
    h = np.maximum(k - abs(a - b), 0) / k
    return np.minimum(a, b) - h ** 3 * k / 6


class Blended:
    """The smooth union of parts at fixed points. A part is evaluated only where it can matter."""

    def __init__(self, p):
        self.p, self.distance = p, np.full(len(p), 1e9)

    def add(self, part, centre, radius, k):
        """Blends in part(points), which lies in the ball (centre, radius), over seams of width k."""
        near = np.linalg.norm(self.p - centre, axis=1) - radius < self.distance + k
        if near.any():
            self.distance[near] = blend(self.distance[near], part(self.p[near]), k)

    def rod(self, a, b, ra, rb, k):
        a, b = np.asarray(a, float), np.asarray(b, float)
        self.add(lambda q: round_cone(q, a, b, ra, rb), (a + b) / 2, np.linalg.norm(b - a) / 2 + max(ra, rb), k)

    def ball(self, centre, radii, k):
        self.add(lambda q: ellipsoid(q, centre, np.array(radii)), centre, max(radii) * 1.5, k)


SPINE = np.array([  # x, y, z, radius: from the tip of the tail to the nape
    (4.3, 2.6, -1.9, 0.19), (5.3, 1.9, -1.5, 0.22), (5.6, 1.0, -0.4, 0.26), (4.7, 0.75, 0.9, 0.42),
    (3.2, 1.0, 1.2, 0.62), (1.7, 1.7, 0.6, 0.92), (0.2, 2.25, -0.1, 1.12), (-1.3, 2.5, -0.3, 1.1),
    (-2.6, 2.85, 0.0, 1.02), (-3.4, 3.8, 0.25, 0.76), (-3.3, 4.9, 0.3, 0.58), (-3.25, 5.85, 0.3, 0.54),
    (-3.8, 6.55, 0.3, 0.55)])


def spine_curve(samples=5):
    points = np.concatenate([[2 * SPINE[0] - SPINE[1]], SPINE, [2 * SPINE[-1] - SPINE[-2]]])
    t = np.linspace(0, 1, samples, endpoint=False)[:, None]
    curve = [b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)))
             for a, b, c, d in zip(points, points[1:], points[2:], points[3:])]
    return np.concatenate(curve + [SPINE[-1:]])


def dragon_distance(p):
    body, curve = Blended(p), spine_curve()
    for a, b in zip(curve, curve[1:]):
        body.rod(a[:3], b[:3], a[3], b[3], 0.2)
    # The crest: a row of spikes along the back, upright across the spine.
    for i in range(7, len(curve) - 1, 3):
        direction = curve[i + 1, :3] - curve[i - 1, :3]
        direction /= np.linalg.norm(direction)
        side = np.cross(direction, [0, 1, 0] if abs(direction[1]) < 0.9 else [1, 0, 0])
        up = np.cross(side, direction) / np.linalg.norm(side)
        radius = curve[i, 3]
        root, tip = curve[i, :3] + 0.7 * radius * up, curve[i, :3] + (1.22 * radius + 0.32) * up - 0.25 * direction
        body.rod(root, tip, 0.27 + 0.12 * radius, 0.17, 0.22)
    body.add(head, (-4.5, 6.4, 0.3), 1.6, 0.4)
    for s in (-1, 1):  # nostrils, brows, horns, ears
        body.ball((-5.45, 6.62, 0.3 + 0.2 * s), (0.18, 0.15, 0.15), 0.14)
        body.ball((-4.4, 7.06, 0.3 + 0.34 * s), (0.3, 0.18, 0.18), 0.18)
        body.rod((-3.85, 7.0, 0.3 + 0.36 * s), (-2.9, 7.75, 0.3 + 0.62 * s), 0.24, 0.18, 0.25)
        body.rod((-2.9, 7.75, 0.3 + 0.62 * s), (-2.1, 7.95, 0.3 + 0.66 * s), 0.18, 0.16, 0.1)
        body.rod((-3.75, 6.5, 0.3 + 0.5 * s), (-3.0, 6.5, 0.3 + 1.05 * s), 0.27, 0.17, 0.2)
    for s in (-1, 1):  # four legs with three toes each
        for hip, knee, heel, foot, thick in (
                ((-2.4, 2.5, 0.65), (-2.0, 1.45, 1.25), (-2.5, 0.55, 1.3), (-3.0, 0.1, 1.35), 0.55),
                ((0.6, 2.0, 0.6), (-0.2, 1.5, 1.45), (0.85, 0.65, 1.55), (0.2, 0.1, 1.6), 0.72)):
            hip, knee, heel, foot = (np.array(joint) * (1, 1, s) for joint in (hip, knee, heel, foot))
            body.rod(hip, knee, thick, 0.7 * thick, 0.35)
            body.rod(knee, heel, 0.62 * thick, 0.3, 0.25)
            body.rod(heel, foot, 0.3, 0.24, 0.2)
            for spread in (-0.42, 0, 0.42):
                body.rod(foot, foot + (-0.55 + 0.2 * abs(spread), -0.04, spread), 0.23, 0.17, 0.12)
        body.add(lambda q: wing(q, s), (0.2, 5.6, 1.9 * s), 4.6, 0.3)
    return body.distance


def head(p):
    """Skull, muzzle and open jaw."""
    z = 0.3
    skull = ellipsoid(p, (-4.05, 6.7, z), (0.85, 0.58, 0.6))
    muzzle = blend(skull, round_cone(p, (-4.5, 6.66, z), (-5.35, 6.42, z), 0.42, 0.3), 0.35)
    return blend(muzzle, round_cone(p, (-4.1, 6.3, z), (-4.95, 5.72, z), 0.32, 0.2), 0.25)


def wing(p, s):
    """A raised wing on the side s: an arm, three fingers and the skin between them."""
    shoulder, wrist = np.array((-1.8, 3.2, 0.5 * s)), np.array((-2.2, 6.3, 2.0 * s))
    tips = [np.array((-0.4, 8.4, 3.0 * s)), np.array((1.9, 7.0, 3.0 * s)), np.array((3.0, 4.9, 2.5 * s)),
            np.array((0.9, 2.9, 0.8 * s))]
    result = round_cone(p, shoulder, wrist, 0.32, 0.24)
    for tip in tips[:3]:
        result = blend(result, round_cone(p, wrist, tip, 0.25, 0.18), 0.12)
    for a, b in zip(tips, tips[1:]):
        middle = 0.4 * (a + b) + 0.2 * wrist  # the skin sags between two fingers
        result = blend(result, sheet(p, wrist, a, middle, 0.36), 0.14)
        result = blend(result, sheet(p, wrist, middle, b, 0.36), 0.14)
    return blend(result, sheet(p, wrist, tips[3], shoulder, 0.36), 0.14)
