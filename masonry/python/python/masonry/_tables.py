"""Tables of the native half as structured arrays."""

from __future__ import annotations

import csv
import io
from typing import Any

import numpy as np
from numpy.typing import NDArray

#: Columns of texts, which may look like numbers, columns of whole numbers, and columns of flags.
_TEXTS = {"class", "a", "b", "status", "stage", "way", "route", "reason"}
_NUMBERS = {"index", "joint", "step", "factorisations", "open", "stick", "slip", "mesh"}
_FLAGS = {"overrun"}


def table(text: str) -> NDArray[np.void]:
    """Give a CSV table as records, whose fields are the columns."""
    names, *rows = csv.reader(io.StringIO(text))
    columns = {name: _column(name, [row[place] for row in rows]) for place, name in enumerate(names)}
    return gathered(columns, len(rows))


def gathered(columns: dict[str, NDArray[Any]], length: int) -> NDArray[np.void]:
    """Give columns of one length as records."""
    records = np.empty(length, dtype=[(name, it.dtype) for name, it in columns.items()])
    for name, column in columns.items():
        records[name] = column
    return records


def records(rows: NDArray[np.float64], names: list[tuple[str, type]]) -> NDArray[np.void]:
    """Give the rows of numbers as records of these fields."""
    columns: dict[str, NDArray[Any]] = {
        name: rows[:, place].astype(kind) for place, (name, kind) in enumerate(names)
    }
    return gathered(columns, len(rows))


def _column(name: str, values: list[str]) -> NDArray[Any]:
    if name in _TEXTS:
        return np.array(values, dtype=str)
    if name in _NUMBERS:
        return np.array(values, dtype=np.int64)
    if name in _FLAGS:
        return np.array([value == "true" for value in values])
    return np.array([float(value) if value else np.nan for value in values])
