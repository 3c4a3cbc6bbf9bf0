"""A sky of clouds over the sea with a low sun, as radiance in a map of latitude and longitude, top row first."""

import numpy as np

from .textures import clouds, mix, step

SUN = np.array([0.62, 0.36, -0.7]) / np.linalg.norm([0.62, 0.36, -0.7])


def sky(width, height):
    u, v = np.meshgrid((np.arange(width) + 0.5) / width, (np.arange(height) + 0.5) / height)
    longitude, down = 2 * np.pi * (u - 0.5), np.pi * v
    d = np.stack([np.sin(down) * np.sin(longitude), np.cos(down), -np.sin(down) * np.cos(longitude)], -1)
    up, cosine = d[..., 1], d @ SUN

    colour = mix([0.62, 0.66, 0.7], [0.1, 0.22, 0.55], np.clip(up, 0, 1) ** 0.45)
    colour = colour + np.clip(cosine, 0, 1)[..., None] ** 6 * np.array([0.7, 0.38, 0.14])
    # A layer of clouds at height 1, seen to where it meets the horizon.
    away = 1 / np.maximum(up, 0.04)
    cover = step(0.5, 0.72, clouds(d[..., 0] * away * 1.1 + 40, d[..., 2] * away * 1.1 + 40, 5, 5))
    lit = np.array([0.95, 0.9, 0.85]) + np.clip(cosine, 0, 1)[..., None] ** 4 * np.array([1.6, 1.1, 0.7])
    cover = (cover * step(0.02, 0.18, up))[..., None]
    colour = colour * (1 - cover) + lit * cover * 0.9

    sea = mix([0.1, 0.15, 0.18], [0.3, 0.34, 0.36], np.clip(1 + 3 * up, 0, 1) ** 4)
    colour = np.where((up < 0)[..., None], sea, colour)
    # The sun is three degrees wide, so that a map this coarse holds it.
    glow = step(np.cos(0.05), np.cos(0.02), cosine)
    return colour + glow[..., None] * np.array([520.0, 400.0, 250.0])


def write_hdr(path, rgb):
    """Radiance's RGBE, rows of run lengths."""
    mantissa, exponent = np.frexp(rgb.max(-1))
    scale = np.where(rgb.max(-1) > 1e-32, np.ldexp(256.0, -exponent), 0)
    rgbe = np.concatenate([np.floor(rgb * scale[..., None]), (exponent + 128)[..., None]], -1).clip(0, 255).astype(np.uint8)
    height, width = rgb.shape[:2]
    data = bytearray(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (height, width))
    for row in rgbe:
        data += bytes([2, 2, width >> 8, width & 255])
        for channel in row.T:
            for start in range(0, width, 128):
                part = channel[start:start + 128].tobytes()
                data += bytes([128 + len(part), part[0]]) if len(set(part)) == 1 and len(part) < 128 else bytes([len(part)]) + part
    path.write_bytes(bytes(data))
