"""Scenes from drawings and from COMPAS."""

from __future__ import annotations

import json
import os
import pathlib
from collections.abc import Iterable
from typing import Any

import numpy as np

from lcp import _native

from ._scene import Scene


class Imported:
    """A scene from a drawing.

    Attributes
    ----------
    scene : Scene
        The scene, in metres and kilonewtons.
    """

    def __init__(self, native: _native.Imported) -> None:
        self._native = native
        self.scene = Scene._of(native.scene())

    def report(self) -> str:
        """Give the changes, the parts left out, and the assumptions as text."""
        return self._native.report()

    def to_toml(self) -> str:
        """Give the text of a scene file with the report, and the place of each block in the drawing, as comments."""
        return self._native.to_toml()

    def plot(self) -> str:
        """Draw the blocks over the drawing as SVG."""
        return self._native.picture()

    def __repr__(self) -> str:
        return f"<Imported: {len(self.scene['blocks'])} blocks>"

    def _repr_html_(self) -> str:
        return self.plot()


def import_drawing(path: str | os.PathLike[str], **options: Any) -> Imported:
    """Make a scene from a drawing: DXF, SVG, OBJ, or JSON (COMPAS, or a list of blocks).

    Parameters
    ----------
    path : path
        The drawing.
    **options
        The options of the command ``masonry import``, by name: ``tolerance``, ``unit``, ``scale``, ``thickness``, ``joints``,
        ``density``, ``mu``, and ``ignore``, a list of layers; also ``title``.

    Raises
    ------
    masonry.SceneError
        If the drawing cannot be mended; the message has the place and the remedy. Remedies name options of the command:
        ``--tolerance 0.012`` is ``tolerance=0.012`` here.
    OSError
        If the file cannot be read.

    Examples
    --------
    >>> import json, pathlib, tempfile
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "two.json"
    >>> lower = {"material": "stone", "corners": [[0, 0], [2, 0], [2, 1], [0, 1]]}
    >>> upper = {"material": "stone", "corners": [[0, 0.999], [2, 0.999], [2, 2], [0, 2]]}
    >>> _ = path.write_text(json.dumps([lower, upper]))
    >>> imported = import_drawing(path, mu=0.7)
    >>> imported.scene["blocks.1.corners.0"]
    [0.0, 0.9995]
    >>> imported.scene.solve().verdict
    'stands'
    """
    file = pathlib.Path(path)
    return _imported(file.name, file.read_bytes(), {"title": file.stem, **options})


def from_compas(source: Any, **options: Any) -> Imported:
    """Make a scene from an assembly or meshes of COMPAS, which need not be installed.

    Bodies are projected on the upright plane across which all of them are prisms of one depth, with z up.

    Parameters
    ----------
    source : path, assembly, mesh, or iterable of meshes
        A file of COMPAS, an object with ``to_jsonstring()``, such as an assembly, or bodies, each with ``to_vertices_and_faces()``,
        with ``vertices`` and ``faces``, or a pair of these. A body whose attribute ``is_support`` is true does not move.
    **options
        The options of :func:`import_drawing`.

    Raises
    ------
    masonry.SceneError
        If bodies are not prisms of one depth across an upright plane; the message has the name of the first such body.
    TypeError
        If an object is not a body.

    Examples
    --------
    Two boxes of 1 m, one on the other, the lower one a support:

    >>> faces = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
    >>> def box(z):
    ...     return [[x, y, z + dz] for dz in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))], faces
    >>> imported = from_compas([box(0), box(1)], density=2000)
    >>> imported.scene.solve().verdict
    'stands'
    """
    if isinstance(source, (str, os.PathLike)):
        return import_drawing(source, **options)
    if hasattr(source, "to_jsonstring"):
        text = source.to_jsonstring()
    else:
        bodies = [source] if _is_body(source) else list(source)
        text = json.dumps({"meshes": [_body(it, place) for place, it in enumerate(bodies)]})
    return _imported("compas.json", text.encode(), {"title": "COMPAS", **options})


def _imported(name: str, data: bytes, options: dict[str, Any]) -> Imported:
    known: dict[str, Any] = {
        "title": "",
        "unit": None,
        "scale": 1.0,
        "tolerance": None,
        "thickness": None,
        "joints": None,
        "density": None,
        "mu": None,
        "ignore": [],
    }
    for option in options:
        if option not in known:
            raise TypeError(f"there is no option {option!r}: choose one of {', '.join(known)}")
    return Imported(_native.import_drawing(name, data, {**known, **options}))


def _is_body(it: Any) -> bool:
    return hasattr(it, "to_vertices_and_faces") or (hasattr(it, "vertices") and hasattr(it, "faces"))


def _body(it: Any, place: int) -> dict[str, Any]:
    """Give a body in the form of meshes of COMPAS."""
    if hasattr(it, "to_vertices_and_faces"):
        vertices, faces = it.to_vertices_and_faces()
    elif _is_body(it):
        vertices, faces = it.vertices, it.faces
    elif isinstance(it, (tuple, list)) and len(it) == 2:
        vertices, faces = it
    else:
        raise TypeError(
            f"body {place} is of type {type(it).__name__}: give meshes with to_vertices_and_faces(), or pairs of vertices and faces"
        )
    attributes = getattr(it, "attributes", None) or {}
    return {
        "name": str(getattr(it, "name", None) or f"block {place}"),
        "is_support": bool(attributes.get("is_support", getattr(it, "is_support", False))),
        "vertex": {
            str(number): dict(zip("xyz", np.asarray(point, dtype=float).tolist()))
            for number, point in enumerate(vertices)
        },
        "face": {
            str(number): [int(corner) for corner in face] for number, face in enumerate(faces)
        },
    }
