"""Results of scenes."""

from __future__ import annotations

import json
import os
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lcp import _native

from ._mesh import Mesh
from ._tables import gathered, records, table

_COLOURS = {"stands": "#1a7f37", "falls": "#b3261e", "undecided": "#8a6100"}


class Outcome:
    """The result of a scene that was solved.

    Attributes
    ----------
    verdict : str
        ``"stands"``, ``"falls"`` or ``"undecided"``.
    sentence : str
        The verdict with its evidence.
    status : str
        The status of the solver.
    """

    def __init__(self, native: _native.Outcome) -> None:
        self._native = native
        self.verdict: str = native.verdict
        self.sentence: str = native.sentence
        self.status: str = native.status
        self._details: dict[str, Any] | None = None

    @property
    def details(self) -> dict[str, Any]:
        """The contents of ``result.json``."""
        if self._details is None:
            self._details = json.loads(self._native.json())
        return self._details

    @property
    def contacts(self) -> NDArray[np.void] | None:
        """Contact points with gaps, slips, forces and states, a record for each."""
        text = self._native.contacts()
        return None if text is None else table(text)

    @property
    def history(self) -> NDArray[np.void] | None:
        """Steps of the load history, a record for each."""
        text = self._native.history()
        return None if text is None else table(text)

    @property
    def blocks(self) -> list[tuple[str, NDArray[np.float64]]]:
        """Names and corners of all blocks."""
        return [(name, np.array(corners)) for name, corners in self._native.blocks()]

    @property
    def nodes(self) -> NDArray[np.void] | None:
        """Nodes of elastic blocks, and corners of rigid ones, with their displacements."""
        names = [("block", int), *((name, float) for name in ("x", "y", "ux", "uy"))]
        rows = self._native.nodes()
        return None if rows is None else records(rows, names)

    @property
    def stresses(self) -> NDArray[np.void] | None:
        """Stresses at the centres of elements; tension is positive."""
        numbers = ("x", "y", "sx", "sy", "txy", "s1", "s2", "theta")
        names = [("block", int), ("element", int), *((name, float) for name in numbers)]
        rows = self._native.stresses()
        return None if rows is None else records(rows, names)

    def mesh(self) -> Mesh:
        """Give blocks and elements with displacements and stresses, for meshio and pyvista."""
        return Mesh._of(self._native.mesh())

    def plot(self, picture: str = "forces") -> str | None:
        """Draw a picture as SVG.

        Parameters
        ----------
        picture : str
            ``"scene"``, ``"deformed"``, ``"forces"``, ``"cracks"``, ``"stresses"``, ``"history"`` or ``"mechanism"``.

        Returns
        -------
        str or None
            ``None`` if there is nothing of the kind to show.
        """
        return self._native.picture(picture)

    def report(self) -> str:
        """Give the report as text."""
        return self._native.report()

    def page(self) -> str:
        """Give the report with its pictures as one page of HTML."""
        return self._native.page()

    def save(self, directory: str | os.PathLike[str]) -> list[str]:
        """Write pictures, tables, a mesh and the report into a directory, and give their paths."""
        return [str(path) for path in self._native.save(os.fspath(directory))]

    def __repr__(self) -> str:
        return f"<Outcome: {self.sentence}>"

    def _repr_html_(self) -> str:
        figure = self.plot("mechanism") or self.plot("forces") or self.plot("scene") or ""
        colour = _COLOURS[self.verdict]
        return f'<p style="color: {colour}; font-weight: bold">{_escaped(self.sentence)}</p>{figure}'


class Plan:
    """The plan of a solve: effects, unknowns and routes.

    Attributes
    ----------
    details : dict
        Effects with the reasons why they are on or off, numbers of blocks, nodes, joints and unknowns, the routes in the order in
        which they are tried, each with its reason and its memory in bytes, and the reason why the scene is refused, if it is.
    """

    def __init__(self, native: _native.Found) -> None:
        self._text = native.text
        self.details: dict[str, Any] = json.loads(native.json)

    @property
    def is_refused(self) -> bool:
        """Whether the scene is too large for this machine."""
        return self.details["refused"] is not None

    def report(self) -> str:
        """Give the plan as text."""
        return self._text

    def __str__(self) -> str:
        return self._text

    def __repr__(self) -> str:
        names = "blocks", "joints", "contact_points", "order"
        numbers = ", ".join(f"{name} {self.details[name]}" for name in names)
        return f"<Plan: {numbers}, by {self.details['solver']}>"


class Study:
    """The cost of accuracy: a scene by several routes, to several tolerances, on several meshes.

    Attributes
    ----------
    records : numpy.ndarray
        A record for each mesh, route and tolerance: status, residual, time in seconds, iterations, and the errors of forces,
        stresses and energy relative to the most accurate solution on the same mesh.
    meshes : numpy.ndarray
        A record for each mesh: numbers of blocks, elements and contact points, values of its most accurate solution in the units
        of the scene, and their errors relative to those of the finest mesh.
    details : dict
        The contents of ``study.json``.
    """

    def __init__(self, native: _native.Studied) -> None:
        self._native = native
        self.details: dict[str, Any] = json.loads(native.json())
        self.records: NDArray[np.void] = table(native.records())
        self.meshes: NDArray[np.void] = _meshes(self.details["meshes"])

    @property
    def is_interrupted(self) -> bool:
        """Whether the callback has ended the study, so that solves were skipped."""
        return bool(self.details["interrupted"])

    def report(self) -> str:
        """Give the tables as text."""
        return self._native.report()

    def plot(self) -> str | None:
        """Draw residuals and errors over time as SVG; ``None`` if nothing was solved."""
        return self._native.picture()

    def __repr__(self) -> str:
        solved = int((self.records["status"] == "Solved").sum())
        return f"<Study: {solved} of {len(self.records)} solved>"

    def _repr_html_(self) -> str:
        return self.plot() or f"<pre>{_escaped(self.report())}</pre>"


class Limit:
    """The result of an analysis of limits.

    Attributes
    ----------
    details : dict
        The contents of ``limit.json``: factors and proofs by both laws, reactions, the seismic check, thicknesses.
    """

    def __init__(self, native: _native.Found) -> None:
        self._native = native
        self.details: dict[str, Any] = json.loads(native.json)

    @property
    def sentence(self) -> str | None:
        """The answer in one sentence, if there is one."""
        return self.details.get("sentence")

    def report(self) -> str:
        """Give the report as text."""
        return self._native.text

    def page(self) -> str | None:
        """Give the report with its pictures as one page of HTML."""
        return self._native.page

    def __repr__(self) -> str:
        return f"<Limit: {self.sentence or self.report().splitlines()[0]}>"


def _meshes(meshes: list[dict[str, Any]]) -> NDArray[np.void]:
    """Give meshes as records; unknown values are NaN."""

    def values(of: str, name: str, place: int | None = None) -> NDArray[np.float64]:
        found = [(it[of] or {}).get(name) for it in meshes]
        found = [it if place is None or it is None else it[place] for it in found]
        return np.array([np.nan if it is None else it for it in found], dtype=np.float64)

    names = ("factor", "blocks", "elements", "contact_points")
    columns: dict[str, NDArray[Any]] = {
        name: np.array([it[name] for it in meshes], dtype=np.int64) for name in names
    }
    columns.update({name: values("values", name) for name in ("strain_energy", "thrust")})
    columns.update({name: values("values", "displacement", k) for k, name in enumerate(("ux", "uy"))})
    errors = ("energy", "thrust", "displacement")
    columns.update({f"error_{name}": values("errors", name) for name in errors})
    return gathered(columns, len(meshes))


def _escaped(text: str) -> str:
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
