"""What becomes of scenes."""

from __future__ import annotations

import csv
import io
import json
import os
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lcp import _native

_COLOURS = {"stands": "#1a7f37", "falls": "#b3261e", "undecided": "#8a6100"}


class Outcome:
    """What became of a scene that was solved.

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
        """Everything that ``result.json`` has."""
        if self._details is None:
            self._details = json.loads(self._native.json())
        return self._details

    @property
    def contacts(self) -> NDArray[np.void] | None:
        """Contact points with gaps, slips, forces and states, a record for each."""
        return _table(self._native.contacts())

    @property
    def history(self) -> NDArray[np.void] | None:
        """Steps of the load history, a record for each."""
        return _table(self._native.history())

    @property
    def blocks(self) -> list[tuple[str, NDArray[np.float64]]]:
        """Names and corners of all blocks."""
        return [(name, np.array(corners)) for name, corners in self._native.blocks()]

    @property
    def nodes(self) -> NDArray[np.void] | None:
        """Nodes of elastic blocks, and corners of rigid ones, with their displacements."""
        names = [("block", int), *((name, float) for name in ("x", "y", "ux", "uy"))]
        return _records(self._native.nodes(), names)

    @property
    def stresses(self) -> NDArray[np.void] | None:
        """Stresses at the centres of elements; tension is positive."""
        numbers = ("x", "y", "sx", "sy", "txy", "s1", "s2", "theta")
        names = [("block", int), ("element", int), *((name, float) for name in numbers)]
        return _records(self._native.stresses(), names)

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


class Limit:
    """What an analysis of limits has found.

    Attributes
    ----------
    details : dict
        Everything that ``limit.json`` has: factors and proofs by both laws, reactions, thicknesses.
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


def _escaped(text: str) -> str:
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def _table(text: str | None) -> NDArray[np.void] | None:
    """Give a CSV table as records, whose fields are its columns."""
    if text is None:
        return None
    names, *rows = csv.reader(io.StringIO(text))
    columns = [_column(name, [row[place] for row in rows]) for place, name in enumerate(names)]
    records = np.empty(len(rows), dtype=[(name, it.dtype) for name, it in zip(names, columns)])
    for name, column in zip(names, columns):
        records[name] = column
    return records


#: Columns that are text, whatever it looks like, and those of whole numbers.
_TEXTS = {"class", "a", "b", "status", "stage", "way", "route"}
_NUMBERS = {"index", "joint", "step", "factorisations", "open", "stick", "slip"}


def _column(name: str, values: list[str]) -> NDArray[Any]:
    if name in _TEXTS:
        return np.array(values, dtype=str)
    if name in _NUMBERS:
        return np.array(values, dtype=np.int64)
    return np.array([float(value) if value else np.nan for value in values])


def _records(
    rows: NDArray[np.float64] | None, names: list[tuple[str, type]]
) -> NDArray[np.void] | None:
    if rows is None:
        return None
    records = np.empty(len(rows), dtype=names)
    for column, (name, _) in enumerate(names):
        records[name] = rows[:, column]
    return records
