#!/usr/bin/env python3
"""Makes the meshes and textures of the shipped scenes, in scenes/assets and scenes/stress/assets, always the same
bytes.

Needs Debian's python3-numpy and python3-pil. Usage: scripts/make_assets.py [NAME...]; without names, all.
"""

import pathlib
import sys

import numpy as np
from PIL import Image

from assets import dragon, logo, mesh, models, sky, stress, textures, tumbler
from assets.textures import srgb

SCENES = pathlib.Path(__file__).resolve().parent.parent / "scenes"
FOLDER = SCENES / "assets"


def save(name, linear, srgb_coded, colours=None):
    """Writes linear RGB(A) as 8 bits: by the sRGB curve, or as they are where the scene reads them undecoded.

    With `colours` a PNG has a palette of that many, which is a third of the size.
    """
    rgb = np.clip(linear[..., :3], 0, 1)
    if srgb_coded:
        rgb = np.where(rgb <= 0.0031308, 12.92 * rgb, 1.055 * rgb ** (1 / 2.4) - 0.055)
    alpha = linear[..., 3:]
    image = Image.fromarray(np.rint(255 * np.concatenate([rgb, alpha], -1)).astype(np.uint8))
    if colours:
        image = image.quantize(colours, dither=Image.Dither.NONE)
    if name.endswith(".jpg"):
        image.save(FOLDER / name, quality=88, subsampling=0)
    else:
        image.save(FOLDER / name, optimize=True)


def obj(build):
    return lambda name: mesh.write_obj(FOLDER / name, build())


def ply(build):
    return lambda name: mesh.write_ply(FOLDER / name, build())


def texture(build, srgb_coded=False, colours=None):
    return lambda name: save(name, build(), srgb_coded, colours)


OAK = srgb(120, 74, 40), srgb(206, 150, 92)
WALNUT = srgb(84, 50, 34), srgb(156, 100, 64)
SMOKED = srgb(44, 29, 22), srgb(112, 74, 50)
MAPLE = srgb(172, 136, 98), srgb(228, 202, 164)

ASSETS = {
    # Meshes. Glass ones are closed; OBJ where faces have more than three corners, PLY where there are many.
    "dragon.ply": ply(dragon.dragon),
    "knot.ply": ply(models.knot),
    "goblet.ply": ply(models.goblet),
    "queen.obj": obj(models.queen),
    "bishop.ply": ply(models.bishop),
    "pawn.obj": obj(models.pawn),
    "table_top.obj": obj(models.table_top),
    "table_legs.obj": obj(models.table_legs),
    "chair.ply": ply(models.chair),
    "sofa.ply": ply(models.sofa),
    "cushion.ply": ply(models.cushion),
    "floor_lamp.ply": ply(models.floor_lamp),
    "pendant_shade.ply": ply(models.pendant_shade),
    "painting_frame.obj": obj(models.painting_frame),
    "canvas.obj": obj(models.canvas),
    "rug.obj": obj(models.rug),
    "disc_lamp.obj": obj(models.disc_lamp),
    "mirror_ring.ply": ply(models.mirror_ring),
    "glass_prism.obj": obj(models.glass_prism),
    # A tumbler of iced water: bodies that overlap.
    "tumbler.ply": ply(tumbler.tumbler),
    "tumbler_water.ply": ply(tumbler.water),
    "ice_cube.ply": ply(lambda: tumbler.ice_cube(4)),
    "ice_bubbles.ply": ply(tumbler.ice_bubbles),
    "straw.ply": ply(tumbler.straw),
    "lemon_slice.ply": ply(tumbler.lemon_slice),
    "spilt_water.ply": ply(tumbler.spilt_water),
    "condensation.ply": ply(tumbler.condensation),
    # Textures for base-format scenes, which read texels undecoded: these hold linear values.
    "seascape.jpg": texture(lambda: textures.seascape(1000, 816, 4)),
    "wallpaper.png": texture(lambda: textures.wallpaper(256, srgb(214, 208, 190), srgb(188, 184, 160),
                                                        srgb(170, 140, 92)), colours=32),
    "tiles.jpg": texture(lambda: textures.tiles(512, srgb(226, 220, 208), srgb(66, 74, 84), srgb(120, 112, 104), 3)),
    "parquet.jpg": texture(lambda: textures.wood(800, 640, 8, *OAK, 11)),
    "marble.jpg": texture(lambda: textures.marble(512, 512, srgb(222, 226, 222), srgb(96, 120, 116), 21)),
    "table_wood.jpg": texture(lambda: textures.wood(640, 640, 5, *WALNUT, 5)),
    "pottery.png": texture(lambda: textures.pottery(768, 512), colours=32),
    "painting.jpg": texture(lambda: textures.abstract(600, 400, 2)),
    "carpet.png": texture(lambda: textures.carpet(660, 420), colours=64),
    "planet.jpg": texture(lambda: textures.planet(512, 8)),
    "logo.png": texture(lambda: logo.logo(512, logo.INK, logo.GOLD, srgb(250, 250, 250))),
    # Textures for the extended scenes, decoded from sRGB.
    "maple_srgb.jpg": texture(lambda: textures.wood(800, 640, 5, *MAPLE, 17), srgb_coded=True),
    "smoked_oak_srgb.jpg": texture(lambda: textures.wood(400, 400, 4, *SMOKED, 23), srgb_coded=True),
    "lemon.jpg": texture(lambda: tumbler.lemon(200), srgb_coded=True),
    "straw.png": texture(lambda: tumbler.stripes(64), srgb_coded=True, colours=16),
    # A sky, as radiance.
    "sky.hdr": lambda name: sky.write_hdr(FOLDER / name, sky.sky(384, 192)),
    # What the stress scenes compare: hard meshes, and easy ones of the same shapes.
    "../stress/assets/needle_box.ply": ply(stress.needle_box),
    "../stress/assets/cap.ply": ply(stress.cap),
    "../stress/assets/ball.ply": ply(stress.ball),
    "../stress/assets/goblet.ply": ply(stress.goblet),
    "../stress/assets/duplicates.obj": obj(stress.duplicates),
    "../stress/assets/prism.obj": obj(stress.prism),
}


def main(names):
    unknown = [name for name in names if name not in ASSETS]
    if unknown:
        sys.exit(f"make_assets.py: no asset {', '.join(unknown)}; there are {', '.join(ASSETS)}")
    for folder in (FOLDER, SCENES / "stress" / "assets"):
        folder.mkdir(parents=True, exist_ok=True)
    for name in names or ASSETS:
        ASSETS[name](name)
        print(f"{(FOLDER / name).stat().st_size:9,} {name}")
    print(f"{sum(f.stat().st_size for f in FOLDER.iterdir()):9,} bytes in all")


if __name__ == "__main__":
    main(sys.argv[1:])
