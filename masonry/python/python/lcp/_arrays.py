"""Matrices and vectors in the form for the native half."""

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
        # The native half also takes compressed rows, so that no copy is needed here.
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
            "values": real(compressed.data, "a matrix"),
        }
    dense = real(given, "a matrix")
    if dense.ndim != 2:
        raise ValueError(f"a matrix has two dimensions, and this one has {dense.ndim}")
    return dense


def vector(given: ArrayLike) -> Vector:
    """Give a vector as an array of floats."""
    if type(given) is np.ndarray and given.dtype == np.float64 and given.ndim == 1:
        return given
    array = real(given, "a vector")
    if array.ndim != 1:
        raise ValueError(f"a vector has one dimension, and this one has {array.ndim}")
    return array


def filled(given: ArrayLike | None, length: int, value: float) -> Vector:
    """Give a vector for an argument that may be missing, or be one number for all entries."""
    if given is None:
        return np.full(length, value)
    array = real(given, "a vector")
    return np.full(length, float(array)) if array.ndim == 0 else vector(array)


def real(given: Any, what: str) -> Vector:
    """Give an array of floats, of any dimension."""
    array = np.asarray(given)
    # A conversion to floats would leave the imaginary parts out. Each entry of an array of objects has a type of its own.
    entries = array.flat if array.dtype == object else [array]
    if any(np.iscomplexobj(entry) for entry in entries):
        raise ValueError(f"{what} has complex entries, and must have real ones, such as those of numpy.real")
    return np.asarray(array, dtype=np.float64)
