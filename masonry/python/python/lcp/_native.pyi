"""The native half, which the functions of the package call."""

from collections.abc import Sequence as Many
from typing import Any

import numpy as np
from numpy.typing import NDArray

_Vector = NDArray[np.float64]
_Matrix = NDArray[np.float64] | dict[str, Any]
_Options = dict[str, Any]

class Answer:
    status: str
    arrays: list[_Vector]
    def details(self) -> str: ...

class Sequence:
    def __init__(self, m: _Matrix, options: _Options) -> None: ...
    def solve(self, q: _Vector) -> Answer: ...

def solve_standard(m: _Matrix, q: _Vector, options: _Options) -> Answer: ...
def solve_horizontal(a: _Matrix, b: _Matrix, c: _Vector, options: _Options) -> Answer: ...
def solve_mixed(m: _Matrix, q: _Vector, free: list[bool], options: _Options) -> Answer: ...
def solve_boxed(
    m: _Matrix, q: _Vector, lower: _Vector, upper: _Vector, options: _Options
) -> Answer: ...
def solve_program(
    p: _Matrix,
    q: _Vector,
    a: _Matrix,
    l: _Vector,
    u: _Vector,
    bounds: list[_Vector],
    options: _Options,
) -> Answer: ...
def solve_contact(
    k: _Matrix,
    f: _Vector,
    c_n: _Matrix,
    c_t: _Matrix,
    gap: _Vector,
    slip: _Vector,
    mu: _Vector,
    compliance: _Vector,
    options: _Options,
) -> Answer: ...
def solve_many(problems: Many[tuple[_Matrix, _Vector]], options: _Options) -> list[Answer]: ...
