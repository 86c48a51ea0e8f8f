"""Answers of solvers."""

from __future__ import annotations

import json
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from . import _native

Vector = NDArray[np.float64]
S = TypeVar("S", bound="Answer")


class Unsolved(RuntimeError):
    """The exception of :meth:`Answer.raise_if_unsolved`, with the answer as ``answer``."""

    def __init__(self, answer: Answer) -> None:
        super().__init__(answer)
        self.answer = answer

    def __str__(self) -> str:
        return f"{self.answer.status}: the largest residual is {self.answer.residual:.1e}"


class Answer:
    """The common part of answers to all problems.

    Attributes
    ----------
    status : str
        ``"Solved"`` if the residuals, recomputed from the data as given, are below the tolerance; ``"Infeasible"`` or
        ``"NoSolution"`` with a certificate that was checked; or the reason for neither, such as ``"TimeLimit"``.
    """

    __slots__ = ("_details", "_native", "status")

    def __init__(self, native: _native.Answer) -> None:
        self._native = native
        self._details: dict[str, Any] | None = None
        self.status: str = native.status

    @property
    def is_solved(self) -> bool:
        """Whether the status is ``"Solved"``."""
        return self.status == "Solved"

    @property
    def residuals(self) -> dict[str, float]:
        """Errors of the point, dimensionless: equation, feasibility, complementarity, natural and loads."""
        found: dict[str, float] = self._detail("residuals")
        return found

    @property
    def residual(self) -> float:
        """The largest of the residuals that decide the status."""
        it = self.residuals
        return max(_number(it[name]) for name in ("equation", "natural", "loads"))

    @property
    def certificate(self) -> dict[str, Any] | None:
        """The proof that there is no solution, or a ray; ``None`` for a solution."""
        found: dict[str, Any] | None = self._detail("certificate")
        return found

    @property
    def info(self) -> dict[str, Any]:
        """The method, its cost, and the methods that were tried before it."""
        found: dict[str, Any] = self._detail("info")
        return found

    def raise_if_unsolved(self: S) -> S:
        """Return the answer itself if it is a solution.

        Raises
        ------
        Unsolved
            If the status is not ``"Solved"``.
        """
        if not self.is_solved:
            raise Unsolved(self)
        return self

    def _detail(self, name: str) -> Any:
        if self._details is None:
            self._details = json.loads(self._native.details())
        return self._details[name]

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {self.status}>"


def _number(value: Any) -> float:
    return float("inf") if value is None else float(value)


class Solution(Answer):
    """The answer to a problem in ``z`` and ``w``.

    Attributes
    ----------
    z, w : numpy.ndarray
        The variables and ``w = M z + q``.
    """

    __slots__ = ("w", "z")

    def __init__(self, native: _native.Answer) -> None:
        super().__init__(native)
        self.z, self.w = native.arrays


class Pairs(Answer):
    """The answer to a problem in pairs.

    Attributes
    ----------
    t, y : numpy.ndarray
        The variables of every pair.
    """

    __slots__ = ("t", "y")

    def __init__(self, native: _native.Answer) -> None:
        super().__init__(native)
        self.t, self.y = native.arrays


class ProgramSolution(Answer):
    """The answer to a quadratic program.

    Attributes
    ----------
    x : numpy.ndarray
        The variables.
    rows, bounds : numpy.ndarray
        Multipliers of the rows of ``A`` and of the bounds of ``x``, positive at the lower side:
        ``P x + q = A.T @ rows + bounds``.
    objective : float
        ``x.P x / 2 + q.x``
    """

    __slots__ = ("bounds", "objective", "rows", "x")

    def __init__(self, native: _native.Answer) -> None:
        super().__init__(native)
        self.x, self.rows, self.bounds, objective = native.arrays
        self.objective = float(objective[0])


class ContactSolution(Answer):
    """The answer to a contact problem.

    Attributes
    ----------
    u : numpy.ndarray
        Displacements.
    t_n, t_t : numpy.ndarray
        Normal and tangential forces of the contact points.
    gap, slip : numpy.ndarray
        Gaps and slips of the contact points.
    """

    __slots__ = ("gap", "slip", "t_n", "t_t", "u")

    def __init__(self, native: _native.Answer) -> None:
        super().__init__(native)
        self.u, self.t_n, self.t_t, self.gap, self.slip = native.arrays
