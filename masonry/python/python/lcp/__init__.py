"""Linear complementarity problems: solvers with proofs of their answers.

Find ``z >= 0`` with ``w = M z + q >= 0`` and ``z.w = 0``:

>>> import lcp
>>> answer = lcp.solve([[2, 1], [1, 2]], [-5, -6])
>>> answer.status
'Solved'
>>> answer.z
array([1.33333333, 2.33333333])

A problem without a solution comes with a proof that was checked:

>>> lcp.solve([[1, -1], [-1, 1]], [-1, 0]).status
'Infeasible'

``solve``, ``solve_horizontal``, ``solve_mixed``, ``solve_boxed``, ``qp`` and ``Contact2d`` pose problems; ``solve_many`` and
``Sequence`` solve many. Matrices are arrays, lists of rows, or sparse matrices of scipy.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _native
from ._arrays import filled, matrix, vector
from ._contact import Contact2d
from ._options import options
from ._solution import Answer, ContactSolution, Pairs, ProgramSolution, Solution, Unsolved

__all__ = [
    "Answer",
    "Contact2d",
    "ContactSolution",
    "Pairs",
    "ProgramSolution",
    "Sequence",
    "Solution",
    "Unsolved",
    "enumerate",
    "lemke",
    "pgs",
    "qp",
    "solve",
    "solve_boxed",
    "solve_horizontal",
    "solve_many",
    "solve_mixed",
]

Callback = Callable[[int, float], Any]


def solve(
    M: Any,
    q: ArrayLike,
    *,
    method: str = "auto",
    tol: float | None = None,
    time_limit: float | None = None,
    max_iterations: int | None = None,
    callback: Callback | None = None,
) -> Solution:
    """Solve ``w = M z + q``, ``z >= 0``, ``w >= 0``, ``z.w = 0``.

    Parameters
    ----------
    M : array_like or sparse matrix
        Square matrix, of any class.
    q : array_like
        Vector.
    method : str
        ``"auto"`` chooses, and tries the next method if one fails; ``"lemke"``, ``"newton"`` (semismooth Newton),
        ``"interior"``, ``"qp"``, ``"pgs"`` (projected Gauss-Seidel), ``"enumeration"``.
    tol : float, optional
        Largest residual of an answer called ``"Solved"``: 1e-10, and 1e-8 for ``"pgs"``.
    time_limit : float, optional
        Seconds.
    max_iterations : int, optional
        Iterations of an iterative method, pivots of ``"lemke"``.
    callback : callable, optional
        Called with the number of the iteration and the residual; a true return value ends the solve.

    Returns
    -------
    Solution
        The answer with ``z``, ``w``, ``status``, ``residuals``, ``certificate`` and ``info``.

    Raises
    ------
    ValueError
        If the data or an option is wrong. Mathematical outcomes are in ``status``.

    Examples
    --------
    >>> answer = solve([[0, -1], [1, 0]], [2, -1]).raise_if_unsolved()
    >>> answer.z, answer.w
    (array([1., 2.]), array([0., 0.]))
    """
    settings = options(method, tol, time_limit, max_iterations, callback)
    return Solution(_native.solve_standard(matrix(M), vector(q), settings))


def lemke(M: Any, q: ArrayLike, **settings: Any) -> Solution:
    """Solve as :func:`solve` by Lemke's method.

    Examples
    --------
    >>> lemke([[2.0]], [-3.0]).z
    array([1.5])
    """
    return solve(M, q, method="lemke", **settings)


def pgs(M: Any, q: ArrayLike, **settings: Any) -> Solution:
    """Solve as :func:`solve` by projected Gauss-Seidel.

    Examples
    --------
    >>> pgs([[2.0, 1.0], [1.0, 2.0]], [-5.0, -6.0]).is_solved
    True
    """
    return solve(M, q, method="pgs", **settings)


def enumerate(M: Any, q: ArrayLike, **settings: Any) -> Solution:
    """Solve as :func:`solve` by branching over the sides of pairs, up to 100 of them, with a solution or a proof.

    Examples
    --------
    >>> enumerate([[0, 1], [1, 0]], [-1, -1]).z
    array([1., 1.])
    """
    return solve(M, q, method="enumeration", **settings)


def solve_horizontal(
    A: Any,
    B: Any,
    c: ArrayLike,
    *,
    method: str = "auto",
    tol: float | None = None,
    time_limit: float | None = None,
    max_iterations: int | None = None,
    callback: Callback | None = None,
) -> Pairs:
    """Solve ``A t + B y = c``, ``t >= 0``, ``y >= 0``, ``t.y = 0``.

    Parameters and exceptions are those of :func:`solve`.

    Examples
    --------
    >>> answer = solve_horizontal([[2, 1], [1, 2]], [[-1, 0], [0, -1]], [1, -1])
    >>> answer.t, answer.y
    (array([0.5, 0. ]), array([0. , 1.5]))
    """
    settings = options(method, tol, time_limit, max_iterations, callback)
    return Pairs(_native.solve_horizontal(matrix(A), matrix(B), vector(c), settings))


def solve_mixed(
    M: Any,
    q: ArrayLike,
    free: ArrayLike,
    *,
    method: str = "auto",
    tol: float | None = None,
    time_limit: float | None = None,
    max_iterations: int | None = None,
    callback: Callback | None = None,
) -> Solution:
    """Solve ``w = M z + q`` with ``w_i = 0`` for free variables, and complementary pairs for the others.

    Parameters
    ----------
    free : array_like of bool
        Flags of the variables without a sign. The other parameters are those of :func:`solve`.

    Examples
    --------
    >>> solve_mixed([[0, 1], [-1, 1]], [-1, 1], [True, False]).z
    array([2., 1.])
    """
    settings = options(method, tol, time_limit, max_iterations, callback)
    flags = np.asarray(free, dtype=bool).tolist()
    return Solution(_native.solve_mixed(matrix(M), vector(q), flags, settings))


def solve_boxed(
    M: Any,
    q: ArrayLike,
    lower: ArrayLike | None,
    upper: ArrayLike | None,
    *,
    method: str = "auto",
    tol: float | None = None,
    time_limit: float | None = None,
    max_iterations: int | None = None,
    callback: Callback | None = None,
) -> Solution:
    """Solve ``w = M z + q`` with ``lower <= z <= upper``: ``w_i >= 0`` at the lower bound, ``<= 0`` at the upper one, else 0.

    Parameters
    ----------
    lower, upper : array_like or float
        Bounds, which may be infinite; ``None`` is an infinite one. The other parameters are those of :func:`solve`.

    Examples
    --------
    >>> solve_boxed([[2, 1], [1, 2]], [-5, -6], 0, 2).z
    array([1.5, 2. ])
    """
    settings = options(method, tol, time_limit, max_iterations, callback)
    right = vector(q)
    low, high = filled(lower, len(right), -np.inf), filled(upper, len(right), np.inf)
    return Solution(_native.solve_boxed(matrix(M), right, low, high, settings))


def qp(
    P: Any,
    q: ArrayLike,
    A: Any = None,
    l: ArrayLike | None = None,
    u: ArrayLike | None = None,
    *,
    lower: ArrayLike | None = None,
    upper: ArrayLike | None = None,
    method: str = "auto",
    tol: float | None = None,
    time_limit: float | None = None,
    max_iterations: int | None = None,
    callback: Callback | None = None,
) -> ProgramSolution:
    """Minimise ``x.P x / 2 + q.x`` with ``l <= A x <= u`` and ``lower <= x <= upper``.

    Parameters
    ----------
    P : array_like or sparse matrix
        Symmetric positive semidefinite.
    q : array_like
        Linear part.
    A : array_like or sparse matrix, optional
        Rows of the constraints.
    l, u : array_like or float, optional
        Bounds of the rows; missing ones are infinite, equal ones an equation.
    lower, upper : array_like or float, optional
        Bounds of the variables; missing ones are infinite. The other parameters are those of :func:`solve`.

    Examples
    --------
    >>> answer = qp([[2, 0], [0, 2]], [-2, -6], A=[[1, 1]], l=1, u=1, lower=0)
    >>> answer.x, answer.objective
    (array([0., 1.]), -5.0)
    """
    settings = options(method, tol, time_limit, max_iterations, callback)
    linear = vector(q)
    rows = np.zeros((0, len(linear))) if A is None else matrix(A)
    count = rows["shape"][0] if isinstance(rows, dict) else rows.shape[0]
    sides = filled(l, count, -np.inf), filled(u, count, np.inf)
    bounds = [filled(lower, len(linear), -np.inf), filled(upper, len(linear), np.inf)]
    return ProgramSolution(
        _native.solve_program(matrix(P), linear, rows, sides[0], sides[1], bounds, settings)
    )


def solve_many(
    problems: Iterable[tuple[Any, ArrayLike]],
    *,
    tol: float | None = None,
    time_limit: float | None = None,
) -> list[Solution]:
    """Solve many problems ``(M, q)`` on all cores, in their order.

    Parameters
    ----------
    problems : iterable of pairs
        Matrices and vectors as for :func:`solve`, whose parameters ``tol`` and ``time_limit`` hold for each problem.

    Examples
    --------
    >>> answers = solve_many(([[2, 1], [1, 2]], [-k, -1]) for k in range(1, 4))
    >>> [round(float(answer.z[0]), 3) for answer in answers]
    [0.333, 1.0, 1.5]
    """
    settings = options("auto", tol, time_limit, None, None)
    given = [(matrix(M), vector(q)) for M, q in problems]
    return [Solution(answer) for answer in _native.solve_many(given, settings)]


class Sequence:
    """A matrix with one ``q`` after the other: each solve reuses sides, factors and memory of the solve before.

    Parameters
    ----------
    M : array_like or sparse matrix
        The matrix, as for :func:`solve`.

    Examples
    --------
    >>> steps = Sequence([[2, 1], [1, 2]])
    >>> [round(float(steps.solve([-k, -1]).z.sum()), 9) for k in (2, 3)]
    [1.0, 1.5]
    """

    def __init__(self, M: Any, *, tol: float | None = None, time_limit: float | None = None) -> None:
        self._native = _native.Sequence(matrix(M), options("auto", tol, time_limit, None, None))

    def solve(self, q: ArrayLike) -> Solution:
        """Solve the problem for this ``q``."""
        return Solution(self._native.solve(vector(q)))
