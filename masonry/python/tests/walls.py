"""Walls of several tests."""

import masonry


def block(**more):
    """A block of 2 kN on a floor with friction of 0.6."""
    keys = dict(
        thickness=1.0,
        gravity=[0, -10],
        units={"length": "m", "force": "kN"},
        materials={"stone": {"density": 1000}},
        joints={"floor": {"mu": 0.6}},
        blocks=[{"name": "block", "material": "stone", "corners": [[0, 0], [0.4, 0], [0.4, 0.5], [0, 0.5]]}],
        supports=[{"name": "ground", "from": [-1, 0], "to": [1, 0], "joint": "floor"}],
    )
    return masonry.Scene(**{**keys, **more})
