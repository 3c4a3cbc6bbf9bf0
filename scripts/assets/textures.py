"""The pictures of the scenes, as arrays of linear RGB (or RGBA), top row first, from formulas and fixed seeds."""

import numpy as np


def srgb(*codes):
    """A linear colour from 8-bit sRGB."""
    c = np.array(codes, float) / 255
    return np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)


def pixels(width, height):
    """Pixel centres: x to the right, y upward, in pixels."""
    return np.meshgrid(np.arange(width) + 0.5, height - 0.5 - np.arange(height))


def noise(x, y, seed, period=(1 << 30, 1 << 30)):
    """Smooth value noise in [0, 1] on the unit lattice, repeating with `period`."""
    i, j = np.floor(x).astype(np.int64), np.floor(y).astype(np.int64)
    fx, fy = x - i, y - j
    fx, fy = fx ** 3 * (fx * (6 * fx - 15) + 10), fy ** 3 * (fy * (6 * fy - 15) + 10)

    def corner(a, b):
        h = ((a % period[0]) * 374761393 + (b % period[1]) * 668265263 + seed * 974634517) & 0xffffffff
        h = ((h ^ (h >> 13)) * 1274126177) & 0xffffffff
        return ((h ^ (h >> 16)) & 0xffffff) / 0xffffff

    low = corner(i, j) * (1 - fx) + corner(i + 1, j) * fx
    high = corner(i, j + 1) * (1 - fx) + corner(i + 1, j + 1) * fx
    return low * (1 - fy) + high * fy


def clouds(x, y, seed, octaves=5, period=(1 << 30, 1 << 30)):
    """Octaves of noise, in [0, 1]."""
    total, weight, amplitude = 0.0, 0.0, 1.0
    for k in range(octaves):
        f = 1 << k
        total = total + amplitude * noise(x * f, y * f, seed + k, (period[0] * f, period[1] * f))
        weight += amplitude
        amplitude *= 0.5
    return total / weight


def mix(a, b, t):
    t = np.clip(t, 0, 1)[..., None]
    return np.asarray(a) * (1 - t) + np.asarray(b) * t


def step(low, high, x):
    t = np.clip((x - low) / (high - low), 0, 1)
    return t * t * (3 - 2 * t)


def wood(width, height, planks, dark, light, seed):
    """Boards along x with grain; repeats."""
    x, y = pixels(width, height)
    u, v = x / width, y / height * planks
    board = np.floor(v).astype(int)
    shade = np.random.RandomState(seed).rand(planks)[board]
    shift = np.random.RandomState(seed + 1).rand(planks)[board]
    warp = clouds(u * 4, v * 2 + 7 * board, seed, 3, (4, 1 << 20))
    rings = 0.5 + 0.5 * np.sin(2 * np.pi * (3.0 * (v - board) + 5 * warp + 9 * shift))
    fibre = clouds(u * 16, v * 40, seed + 9, 3, (16, 40 * planks))
    tone = 0.45 * shade + 0.33 * rings + 0.34 * fibre - 0.06
    colour = mix(dark, light, tone)
    joint = np.minimum(v - board, 1 - (v - board)) * height / planks
    end = np.abs((u - shift + 0.5) % 1 - 0.5) * width
    gap = np.minimum(joint, end)
    return colour * (0.35 + 0.65 * step(0.6, 2.2, gap))[..., None]


def marble(width, height, base, vein, seed, period=4):
    x, y = pixels(width, height)
    u, v = x / width * period, y / height * period
    p = (period, period)
    turn = clouds(u, v, seed, 5, p)
    lines = np.abs(np.sin(np.pi * (u + v + 3.2 * turn)))
    fine = np.abs(2 * clouds(u * 2, v * 2, seed + 31, 4, (2 * period, 2 * period)) - 1)
    strength = 0.75 * (1 - step(0.0, 0.32, lines)) + 0.35 * (1 - step(0.0, 0.14, fine))
    return mix(base, vein, strength) * (0.9 + 0.2 * clouds(u * 2, v * 2, seed + 77, 3, (2 * period, 2 * period)))[..., None]


def tiles(size, light, dark, grout, seed):
    """A 2 x 2 chequer of marble tiles with joints; repeats."""
    x, y = pixels(size, size)
    half = size / 2
    odd = ((x // half + y // half) % 2)[..., None]
    white = marble(size, size, light, light * 0.62, seed)
    black = marble(size, size, dark, dark * 2.6 + 0.02, seed + 5)
    colour = white * (1 - odd) + black * odd
    gap = np.minimum(np.minimum(x % half, half - x % half), np.minimum(y % half, half - y % half))
    return mix(grout, colour, step(1.0, 2.5, gap))


def wallpaper(size, ground, figure, accent):
    """A damask of leaves on a half-drop repeat."""
    x, y = pixels(size, size)
    result = np.broadcast_to(ground, (size, size, 3)).copy()
    stripe = 0.5 + 0.5 * np.cos(2 * np.pi * x / size * 8)
    result = result * (0.97 + 0.03 * stripe[..., None])
    for cx, cy in ((0.25, 0.25), (0.75, 0.75)):
        u = ((x / size - cx + 0.5) % 1 - 0.5) * 2.2
        v = ((y / size - cy + 0.5) % 1 - 0.5) * 2.2
        r, a = np.hypot(u, v * 0.82), np.arctan2(u, v)
        outer = 0.46 + 0.13 * np.cos(4 * a) + 0.05 * np.cos(12 * a)
        ring = 0.30 + 0.08 * np.cos(4 * a + np.pi) + 0.03 * np.cos(8 * a)
        heart = 0.16 + 0.045 * np.cos(8 * a)
        result = mix(result, figure, (1 - step(outer - 0.012, outer + 0.012, r)) * step(ring - 0.012, ring + 0.012, r))
        result = mix(result, accent, 1 - step(heart - 0.012, heart + 0.012, r))
        result = mix(result, accent, 1 - step(0.010, 0.024, np.abs(r - outer - 0.06)))
    return result


def seascape(width, height, seed):
    """A mural: dusk over a bay with ranges of hills."""
    x, y = pixels(width, height)
    u, v = x / width, y / height
    sky = mix(srgb(252, 196, 128), srgb(112, 160, 196), step(0.32, 0.95, v))
    sky = mix(sky, srgb(250, 140, 110), 0.55 * np.exp(-((v - 0.47) / 0.09) ** 2))
    wisps = clouds(u * 5 + 0.3 * v, v * 22, seed, 5)
    sky = mix(sky, srgb(255, 226, 196), 0.75 * step(0.54, 0.78, wisps) * step(0.4, 0.6, v))
    sun = np.hypot((u - 0.66) * width / height, v - 0.535)
    sky = mix(sky, srgb(255, 226, 160), 0.8 * np.exp(-(sun / 0.16) ** 2))
    sky = mix(sky, srgb(255, 250, 226), 1 - step(0.052, 0.056, sun))
    result = sky
    for k, (base, rise, scale, near) in enumerate(((0.46, 0.16, 3.0, 0.12), (0.41, 0.15, 4.2, 0.38),
                                                   (0.36, 0.12, 6.0, 0.66))):
        ridge = base + rise * (clouds(u * scale + 3.7 * k, 0 * u + k, seed + 20 + k, 6) - 0.42) * (1.2 - 0.5 * u)
        hill = mix(srgb(206, 150, 150), srgb(40, 74, 96), near + 0.25 * (ridge - v) * 6)
        result = mix(result, hill, step(-0.0015, 0.0015, ridge - v))
    shore = 0.335
    wave = clouds(u * 9 + 0.4 * np.sin(v * 60), v * 90 / (0.25 + shore - np.minimum(v, shore)), seed + 50, 4)
    water = mix(srgb(58, 108, 130), srgb(238, 176, 136), step(0.0, 1.0, v / shore) * 0.8)
    water = mix(water, srgb(255, 226, 170), step(0.52, 0.7, wave) * (0.18 + 0.7 * np.exp(-((u - 0.66) / 0.09) ** 2)))
    return mix(result, water, step(-0.001, 0.001, shore - v))


def abstract(width, height, seed):
    """A painting: overlapping discs and arcs in warm and cool colours on raw canvas."""
    x, y = pixels(width, height)
    u, v = x / height, y / height
    result = mix(srgb(238, 226, 202), srgb(222, 206, 176), clouds(u * 6, v * 6, seed, 4))
    for cx, cy, r, colour in ((0.52, 0.55, 0.36, srgb(214, 84, 52)), (0.95, 0.42, 0.27, srgb(30, 88, 116)),
                              (0.80, 0.72, 0.15, srgb(240, 186, 70)), (0.25, 0.24, 0.13, srgb(34, 52, 70)),
                              (1.26, 0.74, 0.11, srgb(196, 120, 104)), (1.22, 0.2, 0.07, srgb(240, 186, 70))):
        d = np.hypot(u - cx, v - cy) + 0.006 * (clouds(u * 12, v * 12, seed + 3, 4) - 0.5)
        texture = 0.82 + 0.3 * clouds(u * 3 + cx * 9, v * 40, seed + 8, 4)
        cover = 0.92 * (1 - step(r - 0.003, r + 0.003, d))
        blended = np.where((cover > 0.5)[..., None], 0.35 * result * colour * 2 + 0.65 * colour, colour)
        result = mix(result, blended * texture[..., None], cover)
    for cx, cy, r, w in ((0.52, 0.55, 0.43, 0.008), (0.95, 0.42, 0.33, 0.005)):
        d = np.abs(np.hypot(u - cx, v - cy) - r)
        result = mix(result, srgb(30, 34, 44), 0.9 * (1 - step(w - 0.002, w + 0.002, d)))
    return result


def carpet(width, height):
    """An oriental rug: borders and a medallion, symmetric both ways."""
    x, y = pixels(width, height)
    u, v = np.abs(x - width / 2) / height * 2, np.abs(y - height / 2) / height * 2
    aspect = width / height
    red, blue, cream, gold = srgb(150, 44, 38), srgb(30, 52, 92), srgb(232, 214, 178), srgb(206, 150, 72)
    edge = np.minimum(aspect - u, 1 - v)
    lattice = np.cos(16 * np.pi * u) * np.cos(16 * np.pi * v)
    result = mix(np.broadcast_to(red, u.shape + (3,)), gold, step(0.72, 0.78, lattice))
    r = np.hypot(u / 1.12, v) + 0.05 * np.cos(8 * np.arctan2(v, u))
    for radius, colour in ((0.66, cream), (0.63, blue), (0.44, gold), (0.42, red), (0.24, cream), (0.21, blue),
                           (0.08, gold)):
        result = mix(result, colour, 1 - step(radius - 0.006, radius + 0.006, r))
    petals = np.cos(12 * np.arctan2(v, u)) * step(0.46, 0.5, r) * (1 - step(0.58, 0.62, r))
    result = mix(result, cream, step(0.5, 0.6, petals))
    corner = np.hypot(aspect - u - 0.2, 1 - v - 0.2)
    result = mix(result, blue, 1 - step(0.33, 0.34, corner))
    result = mix(result, gold, 1 - step(0.012, 0.02, np.abs(corner - 0.26)))
    for low, high, colour in ((0.0, 0.04, gold), (0.04, 0.2, blue), (0.2, 0.22, cream)):
        result = np.where(((edge >= low) & (edge < high))[..., None], colour, result)
    along = np.where(aspect - u < 1 - v, v, u)
    diamond = np.abs((along * 7) % 1 - 0.5) * 2 + np.abs(edge - 0.12) / 0.06
    result = mix(result, cream, 1 - step(0.92, 1.0, diamond))
    result = mix(result, red, 1 - step(0.45, 0.52, diamond))
    result = np.where((edge < 0.012)[..., None], cream * 0.8, result)
    return result * (0.9 + 0.1 * np.cos(np.pi * y)[..., None] * np.cos(np.pi * x * 0.5)[..., None] ** 2)


def pottery(width, height):
    """Bands for a vase, u round it and v from foot to lip: waves, a key pattern, leaves."""
    x, y = pixels(width, height)
    u, v = x / width, y / height
    clay, ink, cream, blue = srgb(196, 104, 62), srgb(36, 32, 40), srgb(240, 224, 192), srgb(34, 92, 120)
    result = np.broadcast_to(clay, u.shape + (3,)).copy()

    def band(low, high, colour):
        inside = (v >= low) & (v < high)
        result[inside] = np.broadcast_to(colour, result.shape)[inside]

    band(0.0, 0.08, ink)
    band(0.08, 0.1, cream)
    wave = 0.18 + 0.035 * np.sin(2 * np.pi * 12 * u)
    band(0.10, 0.26, blue)
    result[(np.abs(v - wave) < 0.012)] = cream
    result[(np.abs(v - wave - 0.035) < 0.005)] = cream
    band(0.26, 0.275, cream)
    band(0.275, 0.29, ink)
    # Leaves round the belly.
    a = (u * 14) % 1 - 0.5
    leaf = np.abs(a + 0.35 * (v - 0.42)) / (0.30 * np.sqrt(np.clip(1 - ((v - 0.42) / 0.12) ** 2, 0, 1)) + 1e-9)
    result[(leaf < 1) & (np.abs(v - 0.42) < 0.118)] = ink
    result[(leaf < 0.16) & (np.abs(v - 0.42) < 0.1)] = clay * 1.25
    band(0.55, 0.565, ink)
    # The key: a meander on a 8 x 8 lattice a period.
    band(0.565, 0.70, cream)
    i, j = np.floor((u * 16 * 8) % 8).astype(int), np.floor((v - 0.575) / (0.115 / 7)).astype(int)
    rows = ["11111110", "10000010", "10111010", "10101010", "10100010", "10111110", "10000000"]
    key = np.array([[c == "1" for c in row] for row in rows[::-1]])
    inside = (j >= 0) & (j < 7)
    result[inside & key[np.clip(j, 0, 6), i]] = ink
    band(0.70, 0.715, ink)
    rays = (np.abs((u * 28) % 1 - 0.5) * 2 < (0.84 - v) / 0.12) & (v > 0.72) & (v < 0.84)
    result[rays] = cream
    band(0.86, 0.88, cream)
    band(0.88, 1.01, blue)
    return result


def planet(size, seed):
    """A seamless-looking disc for a ball: swirls of a gas giant."""
    x, y = pixels(size, size)
    u, v = x / size, y / size
    swirl = clouds(u * 3, v * 7, seed, 5)
    bands = 0.5 + 0.5 * np.sin(2 * np.pi * (v * 5.5 + 0.55 * swirl))
    colour = mix(srgb(228, 178, 118), srgb(156, 84, 56), bands)
    colour = mix(colour, srgb(246, 228, 198), step(0.55, 0.8, clouds(u * 4 + 5, v * 12, seed + 7, 5)))
    spot = np.hypot((u - 0.64) / 1.7, v - 0.36)
    return mix(colour, srgb(190, 62, 40), 1 - step(0.05, 0.075, spot + 0.02 * swirl))
