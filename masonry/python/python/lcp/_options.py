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
    """Give the options as the native half takes them."""
    return {
        "method": method,
        "tol": tol,
        "time_limit": time_limit,
        "max_iterations": max_iterations,
        "callback": callback,
    }
