"""Bodies in unilateral contact with Coulomb friction."""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._arrays import matrix, real, vector
from ._options import options
from ._solution import ContactSolution

Row = Mapping[int, float]


class Contact2d:
    """Bodies of stiffness or mass ``K`` under loads ``f``, with contact points.

    A gap opens by ``C_n u``, and a point slips by ``C_t u``; normal forces are not negative, and tangential ones at most ``mu``
    times as large and opposite to the slip.

    A solve begins with the states of the contacts in the solution before, which saves most of the work if few of them change.
    Forces and slips that are not unique may depend on these states: :meth:`forget` begins anew.

    Parameters
    ----------
    K : array_like or sparse matrix
        Symmetric positive semidefinite, one row for every displacement. The matrix is read only at the first solve.
    f : array_like
        Loads.

    Examples
    --------
    A body of weight 2 on a plane, pushed by 0.4, with a spring of stiffness 3 behind it:

    >>> body = Contact2d([[3, 0], [0, 0]], [0.4, -2])
    >>> foot = body.add_point(normal={1: 1.0}, tangent={0: 1.0}, mu=0.5)
    >>> state = body.solve().raise_if_unsolved()
    >>> round(float(state.t_n[foot]), 9), round(float(state.t_t[foot]), 9)
    (2.0, -0.4)
    >>> body.f[0] = 2.0
    >>> round(float(body.solve().t_t[foot]), 9)
    -1.0
    """

    def __init__(self, K: Any, f: ArrayLike) -> None:
        self._k = matrix(K)
        self._native: _native.Contact | None = None
        self._is_changed = False
        #: Loads, which may be changed between solves.
        self.f: NDArray[np.float64] = vector(f).copy()
        self._rows: list[tuple[Row, Row]] = []
        self._data: list[tuple[float, float, float, float, float]] = []

    def add_point(
        self,
        normal: Row,
        tangent: Row,
        *,
        gap: float = 0.0,
        slip: float = 0.0,
        mu: float = 0.0,
        compliance: tuple[float, float] = (0.0, 0.0),
    ) -> int:
        """Add a contact point.

        Parameters
        ----------
        normal, tangent : dict of int to float
            Entries of the rows of ``C_n`` and ``C_t``.
        gap, slip : float
            Values at zero displacements.
        mu : float
            Coefficient of friction.
        compliance : pair of float
            Compliances of springs in series with the point.

        Returns
        -------
        int
            The number of the point, its index in the solution.
        """
        self._rows.append((_row(normal), _row(tangent)))
        self._data.append((gap, slip, mu, *compliance))
        self._is_changed = True
        return len(self._rows) - 1

    def set_point(self, number: int, **changed: float) -> None:
        """Change ``gap``, ``slip`` or ``mu`` of a point between solves."""
        names = ("gap", "slip", "mu")
        values = list(self._data[number])
        for name, value in changed.items():
            if name not in names:
                raise TypeError(f"a point has no {name}: it has {', '.join(names)}")
            values[names.index(name)] = value
        self._data[number] = tuple(values)  # type: ignore[assignment]
        self._is_changed = True

    def forget(self) -> None:
        """Forget the states of the contacts in the solution before."""
        if self._native is not None:
            self._native.forget()

    def solve(
        self,
        *,
        method: str = "auto",
        tol: float | None = None,
        time_limit: float | None = None,
        max_iterations: int | None = None,
        callback: Callable[[int, float], Any] | None = None,
    ) -> ContactSolution:
        """Solve with the present loads and points; parameters are those of :func:`lcp.solve`.

        All methods except ``"enumeration"`` begin with the states of the contacts in the solution before.
        """
        settings = options(method, tol, time_limit, max_iterations, callback)
        return ContactSolution(self._current().solve(vector(self.f), settings))

    def _current(self) -> _native.Contact:
        """Give the native problem with the present points."""
        if self._native is None:
            self._native = _native.Contact(self._k, vector(self.f), self._points())
        elif self._is_changed:
            self._native.renew(self._points())
        self._is_changed = False
        return self._native

    def _points(self) -> dict[str, Any]:
        """Give the points in the form for the native half."""
        data = real(self._data, "a contact point").reshape(-1, 5)
        gap, slip, mu = (np.ascontiguousarray(data[:, k]) for k in range(3))
        return {
            "c_n": self._sparse(0),
            "c_t": self._sparse(1),
            "gap": gap,
            "slip": slip,
            "mu": mu,
            "compliance": np.ascontiguousarray(data[:, 3:]),
        }

    def _sparse(self, side: int) -> dict[str, Any]:
        """Give the rows of all points as compressed columns."""
        entries = sorted(
            (column, row, value)
            for row, sides in enumerate(self._rows)
            for column, value in sides[side].items()
        )
        size = len(self.f)
        if entries and not 0 <= entries[0][0] <= entries[-1][0] < size:
            raise ValueError(f"a contact point refers to a displacement that is not from 0 to {size - 1}")
        columns = np.array([column for column, _, _ in entries], dtype=np.int64)
        return {
            "shape": [len(self._rows), size],
            "by_rows": False,
            "starts": np.searchsorted(columns, np.arange(size + 1)),
            "indices": np.array([row for _, row, _ in entries], dtype=np.int64),
            "values": vector([value for _, _, value in entries]),
        }


def _row(given: Row) -> dict[int, float]:
    """Give a row with its displacements as integers of Python."""
    row = {}
    for displacement, entry in given.items():
        try:
            row[operator.index(displacement)] = entry
        except TypeError:
            raise TypeError(
                f"a contact point refers to displacement {displacement!r}: give its number as an integer"
            ) from None
    return row
