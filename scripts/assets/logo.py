"""The logo: the name in strokes of even width under a cardioid, which is the caustic of light in a cup."""

import numpy as np

from .textures import pixels, srgb


def segment(x, y, ax, ay, bx, by):
    """The distance of the points (x, y) to a line segment."""
    dx, dy = bx - ax, by - ay
    t = np.clip(((x - ax) * dx + (y - ay) * dy) / max(dx * dx + dy * dy, 1e-12), 0, 1)
    return np.hypot(x - ax - t * dx, y - ay - t * dy)


def arc(x, y, cx, cy, rx, ry, start, end):
    """The distance to an elliptic arc from `start` to `end` degrees, as a polyline."""
    angles = np.radians(np.linspace(start, end, 33))
    px, py = cx + rx * np.cos(angles), cy + ry * np.sin(angles)
    return np.minimum.reduce([segment(x, y, *p) for p in zip(px, py, px[1:], py[1:])])


# Letters on a base line at 0, x-height 1, capitals 1.45: (advance, strokes). Four numbers are a segment, six
# an arc.
LETTERS = {
    "C": (1.2, [(0.55, 0.725, 0.5, 0.725, 48, 312)]),
    "a": (1.16, [(0.42, 0.5, 0.4, 0.5, 0, 360), (0.84, 0, 0.84, 1)]),
    "u": (1.02, [(0.02, 1, 0.02, 0.4), (0.41, 0.4, 0.39, 0.4, 180, 360), (0.8, 1, 0.8, 0)]),
    "s": (0.88, [(0.34, 0.745, 0.28, 0.255, 35, 270), (0.34, 0.245, 0.32, 0.245, -145, 90)]),
    "t": (0.8, [(0.3, 1.4, 0.3, 0.26), (0.54, 0.26, 0.24, 0.26, 180, 290), (0.02, 1, 0.62, 1)]),
    "i": (0.42, [(0.14, 1, 0.14, 0), (0.14, 1.4, 0.14, 1.4)]),
    "L": (0.95, [(0.08, 1.45, 0.08, 0), (0.08, 0, 0.78, 0)]),
}


def text_distance(x, y, text):
    """The distance to the strokes of the text, which starts at x = 0, and its width."""
    distance, pen = np.full(x.shape, np.inf), 0.0
    for letter in text:
        advance, strokes = LETTERS[letter]
        for s in strokes:
            d = segment(x, y, s[0] + pen, s[1], s[2] + pen, s[3]) if len(s) == 4 else \
                arc(x, y, s[0] + pen, *s[1:])
            distance = np.minimum(distance, d)
        pen += advance
    return distance, pen - 0.2


def logo(size, ink, gold, ground):
    """RGBA: the strokes have alpha 1, the rest the colour `ground` and alpha 0."""
    x, y = pixels(size, size)
    u, v = (x / size - 0.5) * 2, (y / size - 0.5) * 2
    result = np.concatenate([np.broadcast_to(ground, u.shape + (3,)), np.zeros(u.shape + (1,))], -1)

    def paint(mask, colour):
        result[mask] = np.append(colour, 1.0)

    # The rays of a cup's wall: chords from the angle a to 2 a, whose envelope is the cardioid.
    cx, cy, radius = 0.0, 0.26, 0.43
    for k in range(48):
        a = 2 * np.pi * (k + 0.5) / 48
        start, end = a + np.pi, 2 * a + np.pi
        d = segment(u, v, cx + radius * np.cos(start), cy + radius * np.sin(start), cx + radius * np.cos(end),
                    cy + radius * np.sin(end))
        paint(d < 0.0045, gold)
    paint(np.abs(np.hypot(u - cx, v - cy) - radius) < 0.018, ink)
    scale = 0.185
    distance, width = text_distance((u / scale) + 3.62, (v + 0.56) / scale, "CaustiCL")
    paint(distance < 0.12, ink)
    return result


INK = srgb(28, 54, 88)
GOLD = srgb(226, 132, 32)
