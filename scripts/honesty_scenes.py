"""The scenes of scripts/honesty.sh: small lamps, planes, motes in fog, hidden lamps, sun through windows, thin walls."""
WHITE = {'type': 'diffuse', 'color': [0.7, 0.7, 0.7]}


def turn(axis, degree):
    return {'type': 'rotate', 'axis': axis, 'degree': degree}


def shift(x, y, z):
    return {'type': 'shift', 'x': x, 'y': y, 'z': z}


def scale(x, y):
    return {'type': 'scale', 'x': x, 'y': y, 'z': 1}


def lamp(radius, place, power=150.0):
    radiance = power / (4 * 9.8696 * radius * radius)
    return {'type': 'sphere', 'radius': radius, 'transform': [shift(*place)],
            'material': {'type': 'diffuse', 'color': [0, 0, 0], 'emission': [radiance, 0.9 * radiance, 0.8 * radiance]}}


def plane(*transform):
    return {'type': 'plane', 'material': WHITE, 'transform': list(transform)}


def rectangle(width, height, *transform):
    return {'type': 'rectangle', 'material': WHITE, 'transform': [scale(width, height), *transform]}


def box(size, place):
    return {'type': 'box', 'size': size, 'material': WHITE, 'transform': [shift(*place)]}


def ball(radius, place, material='glass'):
    what = {'type': 'glass', 'ior': 1.5} if material == 'glass' else WHITE
    return {'type': 'sphere', 'radius': radius, 'transform': [shift(*place)], 'material': what}


def floor(y=0.0):
    return plane(turn('x', -90), shift(0, y, 0))


def planes_room():
    """6 x 4 x 10, of infinite planes."""
    return [floor(-2), plane(turn('x', 90), shift(0, 2, 0)), plane(turn('y', 90), shift(-3, 0, 0)),
            plane(turn('y', -90), shift(3, 0, 0)), plane(shift(0, 0, -4)), plane(turn('y', 180), shift(0, 0, 6))]


def scene(objects, camera=((0, 0, 5), (0, 0, 0)), **more):
    result = {'width': 24, 'height': 18, 'max_depth': 16,
              'renderer': {'type': 'sppm', 'photon_sample': 20000, 'view_point_sample': 2},
              'camera': {'position': camera[0], 'target': camera[1], 'fov': 60}, 'objects': objects}
    result.update(more)
    return result


def next_room(gap, thickness=0.6):
    """A room of 4 x 3 x 4 beside a lit hall, joined by a gap in the wall."""
    half = (4 - gap) / 2
    return scene([box([16, 3, 4], [8, 1.5, 2]), box([thickness, 3, half], [4.3, 1.5, half / 2]),
                  box([thickness, 3, half], [4.3, 1.5, 4 - half / 2]), lamp(0.3, [12, 2, 1], 900)],
                 ((3.6, 1.5, 3.6), (1.2, 1, 1)))


def two_rooms(thickness, first, second):
    """Two rooms on one floor, a wall between them, lamps of different power; the camera is in the first."""
    if thickness > 0:
        wall = box([thickness, 4, 10], [0, 0, 1])
    else:
        wall = rectangle(10, 4, turn('y', 90), shift(0, 0, 1))
    lamps = [lamp(0.2, [side * 1.5, 1.2, 0], power) for side, power in ((-1, first), (1, second)) if power > 0]
    return scene([*planes_room(), wall, *lamps], ((-1.5, 0, 5), (-1.5, -0.5, 0)))


def under_shade(opening):
    """A lamp in a box that is open below, by a share of its side."""
    side = 0.6
    strip = side * (1 - opening) / 2
    walls = [rectangle(side, side, turn('x', 90), shift(0, 1.5, 0))]
    for degree, x, z in ((0, 0, -side / 2), (180, 0, side / 2), (90, -side / 2, 0), (-90, side / 2, 0)):
        walls.append(rectangle(side, 0.5, turn('y', degree), shift(x, 1.25, z)))
    for x in (-1, 1) if strip > 0 else ():
        walls.append(rectangle(strip, side, turn('x', -90), shift(x * (side - strip) / 2, 1, 0)))
    return scene([*planes_room(), *walls, lamp(0.08, [0, 1.3, 0])])


def window(width, with_ball=False):
    """The sun through a window into a room of walls 0.2 thick."""
    side = (6 - width) / 2
    walls = [box([6.4, 0.2, 6.4], [0, -1.6, 0]), box([6.4, 0.2, 6.4], [0, 1.6, 0]), box([6.4, 3, 0.2], [0, 0, -3.1]),
             box([6.4, 3, 0.2], [0, 0, 3.1]), box([0.2, 3, 6], [-3.1, 0, 0]),
             box([0.2, 3, side], [3.1, 0, -3 + side / 2]), box([0.2, 3, side], [3.1, 0, 3 - side / 2]),
             box([0.2, 1.5, width], [3.1, -0.75, 0])]
    if with_ball:
        walls.append(ball(0.5, [-0.5, -1, 0.3], 'diffuse'))
    return scene(walls, ((-2.5, 0.5, 2.6), (0.5, -0.6, -0.5)),
                 lights=[{'type': 'directional', 'direction': [-1, -0.6, 0.1], 'irradiance': [8, 7, 6]}])


def cap(radius, depth):
    """A large sphere of which a cap shines through the ceiling."""
    return scene([*planes_room(), lamp(radius, [0, 2 + radius - depth, 0], 150.0 * radius / depth)])


def fog(lamp_radius, scattering, g):
    return scene([floor(-2), lamp(lamp_radius, [0, 0.5, 0])], ((0, 0, 5), (0, -0.3, 0)),
                 medium={'absorption': [0.02] * 3, 'scattering': [scattering] * 3, 'g': g})


def scenes():
    """Name to scene; 30 of them."""
    result = {f'lamp_{r}': scene([*planes_room(), lamp(r, [0, 1, 0])]) for r in (0.0003, 0.003, 0.03, 0.3)}
    result['lamp_and_glass'] = scene([*planes_room(), lamp(0.02, [0, 1.4, 0]), ball(0.6, [0.5, -0.8, 0])])
    result['two_lamps'] = scene([*planes_room(), lamp(0.003, [-2, 1, 0], 20), lamp(0.2, [2, 1, 0])])
    result['floor_and_ball'] = scene([floor(-2), lamp(0.05, [1, 2, 1]), ball(0.8, [0, -1.2, 0], 'diffuse')])
    result['floor_and_glass'] = scene([floor(-2), lamp(0.05, [1, 2, 1]), ball(0.8, [0, -1.2, 0])])
    result['between_floors'] = scene([floor(-2), plane(turn('x', 90), shift(0, 2, 0)), lamp(0.01, [0, 1, 0])])
    result['corner'] = scene([floor(-2), plane(turn('y', 90), shift(-3, 0, 0)), plane(shift(0, 0, -4)), lamp(0.01, [0, 1, 0])])
    for name, radius, scattering, g in (('thin', 0.002, 0.05, 0.0), ('thick', 0.002, 0.4, 0.0), ('forward', 0.01, 0.2, 0.7),
                                        ('large', 0.2, 0.2, 0.0)):
        result[f'fog_{name}'] = fog(radius, scattering, g)
    for gap in (1.2, 0.5, 0.2):
        result[f'next_room_{gap}'] = next_room(gap)
    for opening in (1.0, 0.5, 0.2):
        result[f'shade_{opening}'] = under_shade(opening)
    for radius, depth in ((6, 0.05), (20, 0.01), (60, 0.005)):
        result[f'cap_{radius}'] = cap(radius, depth)
    result['window'] = window(1.5)
    result['narrow_window'] = window(0.4)
    result['window_and_ball'] = window(1.5, True)
    result['wall_0'] = two_rooms(0, 50, 50)
    result['wall_0_unequal'] = two_rooms(0, 5, 500)
    result['wall_thin'] = two_rooms(1e-3, 5, 500)
    result['wall_thick'] = two_rooms(0.2, 50, 50)
    return result
