"""Matrices and vectors as the native half takes them."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

Vector = NDArray[np.float64]
#: A dense matrix, or the parts of a sparse one.
Matrix = NDArray[np.float64] | dict[str, Any]


def matrix(given: Any) -> Matrix:
    """Give a matrix as an array of floats, or a sparse one of scipy by its compressed columns or rows."""
    if type(given) is np.ndarray and given.dtype == np.float64 and given.ndim == 2:
        return given
    if hasattr(given, "tocsc"):
        # The native half takes rows as well, so that they need no copy here.
        compressed = given if given.format in ("csc", "csr") else given.tocsc()
        if not compressed.has_canonical_format:
            # sum_duplicates works in place, and the matrix may be the caller's.
            compressed = compressed.copy() if compressed is given else compressed
            compressed.sum_duplicates()
        return {
            "shape": list(compressed.shape),
            "by_rows": compressed.format == "csr",
            "starts": compressed.indptr,
            "indices": compressed.indices,
            "values": np.asarray(compressed.data, dtype=np.float64),
        }
    dense = np.asarray(given, dtype=np.float64)
    if dense.ndim != 2:
        raise ValueError(f"a matrix has two dimensions, and this one has {dense.ndim}")
    return dense


def vector(given: ArrayLike) -> Vector:
    """Give a vector as an array of floats."""
    if type(given) is np.ndarray and given.dtype == np.float64 and given.ndim == 1:
        return given
    array = np.asarray(given, dtype=np.float64)
    if array.ndim != 1:
        raise ValueError(f"a vector has one dimension, and this one has {array.ndim}")
    return array


def filled(given: ArrayLike | None, length: int, value: float) -> Vector:
    """Give a vector that may be left out, or be one number for all entries."""
    if given is None:
        return np.full(length, value)
    array = np.asarray(given, dtype=np.float64)
    return np.full(length, float(array)) if array.ndim == 0 else vector(array)
