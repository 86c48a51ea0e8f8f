"""Options that all solvers share."""

from __future__ import annotations

from typing import Any


def options(
    method: str,
    tol: float | None,
    time_limit: float | None,
    max_iterations: int | None,
    callback: Any,
) -> dict[str, Any]:
    """Give the options in the form for the native half."""
    if max_iterations is not None and max_iterations < 0:
        raise ValueError(f"max_iterations is {max_iterations}, but must be a number of iterations, not negative")
    return {
        "method": method,
        "tol": tol,
        "time_limit": time_limit,
        "max_iterations": max_iterations,
        "callback": callback,
    }
