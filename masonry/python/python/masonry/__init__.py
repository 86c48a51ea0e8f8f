"""Walls and arches of blocks with unilateral contact and Coulomb friction.

>>> import masonry
>>> scene = masonry.Scene.read('''
... title = "A block that is pushed"
... thickness = 1.0
... gravity = [0, -10]
... units = { length = "m", force = "kN" }
... materials.stone.density = 1000
... joints.floor.mu = 0.6
... blocks = [{ name = "block", material = "stone", corners = [[0, 0], [0.4, 0], [0.4, 0.5], [0, 0.5]] }]
... supports = [{ name = "ground", from = [-1, 0], to = [1, 0], joint = "floor" }]
... loads = [{ name = "push", block = "block", at = [0, 0.1], force = [1.1, 0] }]
... ''')
>>> scene.solve().verdict
'stands'
>>> scene["joints.floor.mu"] = 0.5
>>> scene.solve().verdict
'falls'

``Scene`` is read from a file or a text, or made from keys; :func:`import_drawing` and :func:`from_compas` make scenes from
drawings.
``solve``, ``limit``, ``ranges``, ``least_thickness``, ``study`` and ``plan`` are methods of a scene, and :func:`map` takes many scenes.
Results are in the units of the scene.
"""

from __future__ import annotations

from lcp._native import SceneError

from ._drawings import Imported, from_compas, import_drawing
from ._map import Done, map
from ._mesh import Mesh
from ._results import Limit, Outcome, Plan, Study
from ._scene import Scene

__all__ = [
    "Done",
    "Imported",
    "Limit",
    "Mesh",
    "Outcome",
    "Plan",
    "Scene",
    "SceneError",
    "Study",
    "from_compas",
    "import_drawing",
    "map",
]
