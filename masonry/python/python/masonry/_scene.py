"""Scenes: structures, and the loads on them."""

from __future__ import annotations

import copy
import json
import math
import os
from collections.abc import Callable, Iterable
from typing import Any

from lcp import _native

from ._progress import Bar, bar
from ._results import Limit, Outcome, Plan, Study

Callback = Callable[[int, float], Any]
#: The largest depth of nested tables and lists: a coordinate of a block is at depth five.
_DEPTH = 8


class Scene:
    """A scene, by the keys of a scene file.

    Parameters
    ----------
    **keys
        Tables, lists and numbers as in TOML; ``title`` may be left out.

    Raises
    ------
    masonry.SceneError
        If a key is wrong; the message has the place and the remedy.

    Examples
    --------
    >>> scene = Scene(
    ...     thickness=1.0,
    ...     gravity=[0, -10],
    ...     units={"length": "m", "force": "kN"},
    ...     materials={"stone": {"density": 1000}},
    ...     joints={"radial": {"mu": 0.7}},
    ...     arches=[{"name": "arch", "material": "stone", "shape": "semicircular", "span": 1.8,
    ...              "thickness": 0.2, "voussoirs": 40, "joint": "radial", "springing": "radial"}],
    ... )
    >>> scene.solve().verdict
    'stands'
    >>> round(scene.least_thickness("arch").details["stands"], 4)
    0.1022
    """

    def __init__(self, **keys: Any) -> None:
        self._keys: dict[str, Any] = {"title": "", **copy.deepcopy(keys)}
        self._native: _native.Scene | None = None
        self._text = ""
        self._checked()

    @classmethod
    def read(cls, source: str | os.PathLike[str]) -> Scene:
        """Read a scene from a file, or from TOML text of more than one line.

        Examples
        --------
        >>> try:
        ...     Scene.read("title = 'No units'\\nthickness = 1.0\\n")
        ... except ValueError as error:
        ...     print(str(error).splitlines()[-1])
        missing field `units`
        """
        text = os.fspath(source)
        is_text = "\n" in text
        return cls._of(_native.Scene.from_toml(text) if is_text else _native.Scene.read(text))

    @classmethod
    def _of(cls, native: _native.Scene) -> Scene:
        scene = cls.__new__(cls)
        scene._native = native
        scene._keys = json.loads(native.to_json(), object_hook=_given)
        scene._text = scene._written()
        return scene

    def __getitem__(self, path: str) -> Any:
        """Give the value of a key, such as ``"joints.bed.mu"`` or ``"walls.0.width"``."""
        value: Any = self._keys
        for part in path.split("."):
            value = value[int(part) if isinstance(value, list) else part]
        return value

    def __setitem__(self, path: str, value: Any) -> None:
        """Set the value of a key; the scene is checked at its next use."""
        place, _, last = path.rpartition(".")
        table: Any = self[place] if place else self._keys
        table[int(last) if isinstance(table, list) else last] = value

    def __copy__(self) -> Scene:
        return self.copy()

    def __deepcopy__(self, memo: Any) -> Scene:
        return self.copy()

    def __reduce__(self) -> tuple[Any, ...]:
        return Scene._from_keys, (self._keys,)

    @classmethod
    def _from_keys(cls, keys: dict[str, Any]) -> Scene:
        scene = cls.__new__(cls)
        scene._keys = keys
        scene._native = None
        scene._text = ""
        return scene

    def copy(self) -> Scene:
        """Give an independent scene, whose keys may be changed."""
        scene = Scene._from_keys(copy.deepcopy(self._keys))
        scene._native, scene._text = self._native, self._text
        return scene

    def to_toml(self) -> str:
        """Give the text of a scene file."""
        return self._checked().to_toml()

    def plan(self) -> Plan:
        """Give the plan of the scene: effects, unknowns, memory, and the method."""
        return Plan(self._checked().plan())

    def plot(self) -> str:
        """Draw blocks, supports, loads and contact points as SVG."""
        return self._checked().picture()

    def _repr_html_(self) -> str:
        return self.plot()

    def solve(self, *, callback: Callback | None = None, progress: bool = False) -> Outcome:
        """Solve the scene.

        Parameters
        ----------
        callback : callable, optional
            Called with the number of the iteration and the residual; a true return value ends the solve.
        progress : bool
            Show a bar: the steps of a load history, or else the iterations. The bar is one of tqdm if tqdm is installed, or else a
            line on standard error.
        """
        native = self._checked()
        with bar(progress, "solve") as shown:
            if shown is None:
                return Outcome(native.solve(callback))
            steps = 1

            def step(number: int, of: int) -> None:
                nonlocal steps
                steps = of
                if steps > 1:
                    shown.at(number - 1, total=of)

            def iteration(number: int, residual: float) -> Any:
                if steps == 1:
                    shown.at(number, f"residual {residual:.1e}")
                return callback and callback(number, residual)

            outcome = Outcome(native.solve(iteration, step))
            if steps > 1:
                shown.at(steps)
            return outcome

    def limit(
        self,
        group: str | None = None,
        *,
        law: str = "both",
        both: bool = False,
        callback: Callback | None = None,
        progress: bool = False,
    ) -> Limit:
        """Find the factor of a load at which the structure fails.

        Parameters
        ----------
        group : str, optional
            The load or group that grows, instead of that of the scene.
        law : str
            ``"associative"``: joints open by ``mu`` times their slip, with a proof; ``"path"``: Coulomb's friction; ``"both"``.
        both : bool
            Also take the opposite direction.
        callback : callable, optional
            Called with a number and the largest factor that was found to stand, NaN until there is one; a true return value
            ends the search.
        progress : bool
            Show a bar, as :meth:`solve` does.
        """
        with bar(progress, "limit") as shown:
            told = _told(callback, shown, "stands at")
            return Limit(self._checked().limit(group, law, both, told))

    def combined(self) -> dict[str, Scene]:
        """Give a scene for every combination of loads, by name; earthquakes come from both sides.

        Other methods take one set of loads, and refuse a scene with combinations.
        """
        return {name: Scene._of(native) for name, native in self._checked().combined()}

    def train(
        self, *, law: str = "both", callback: Callback | None = None, progress: bool = False
    ) -> Limit:
        """Find the limit load of the train of the scene at all of its positions.

        The ``details`` of the result have ``positions``, the one that ``governs``, and the ``limit`` there.

        Parameters
        ----------
        law : str
            The law, as for :meth:`limit`. The path is followed only at the worst position by associative flow with ``"both"``.
        callback : callable, optional
            As for :meth:`limit`.
        progress : bool
            Show a bar, as :meth:`solve` does.
        """
        with bar(progress, "train") as shown:
            told = _told(callback, shown, "stands at")
            return Limit(self._checked().train(law, told))

    def ranges(self, *, callback: Callback | None = None, progress: bool = False) -> Limit:
        """Find the least and the largest reactions that forces within friction allow.

        Parameters
        ----------
        callback : callable, optional
            Called with the number of the iteration and the residual; a true return value ends the search.
        progress : bool
            Show a bar, as :meth:`solve` does.
        """
        with bar(progress, "ranges") as shown:
            told = _told(callback, shown, "residual")
            return Limit(self._checked().ranges(told))

    def least_thickness(
        self, arch: str, *, callback: Callback | None = None, progress: bool = False
    ) -> Limit:
        """Find the least thickness of an arch under the loads of the scene.

        Parameters
        ----------
        arch : str
            The name of the arch.
        callback : callable, optional
            Called with a number and the smallest thickness that was found to stand, NaN until there is one; a true return value
            ends the search.
        progress : bool
            Show a bar, as :meth:`solve` does.
        """
        with bar(progress, "least thickness") as shown:
            told = _told(callback, shown, "stands at")
            return Limit(self._checked().least_thickness(arch, told))

    def study(
        self,
        *,
        routes: Iterable[str] | None = None,
        tolerances: Iterable[float] | None = None,
        meshes: Iterable[int] | None = None,
        time_limit: float | None = None,
        repeats: int | None = None,
        callback: Callable[[int, str, float], Any] | None = None,
        progress: bool = False,
    ) -> Study:
        """Find the cost of accuracy.

        Parameters
        ----------
        routes : iterable of str, optional
            ``"forces"``, ``"lemke"``, ``"interior"``, ``"qp"``, ``"pgs"``, ``"alm"``; all except the first if left out.
        tolerances : iterable of float, optional
            Largest residuals, from ``1e-2`` to ``1e-12`` if left out.
        meshes : iterable of int, optional
            Factors of the numbers of elements in each direction, 1, 2 and 4 if left out; the mesh of rigid blocks stays as it is.
        time_limit : float, optional
            Seconds of a solve, 20 if left out.
        repeats : int, optional
            The number of runs of a solve of less than a second, 3 if left out; its time is the median.
        callback : callable, optional
            Called with the factor of the mesh, the route and the tolerance of the solve that runs, many times in each solve; a
            true return value ends the study.
        progress : bool
            Show a bar, as :meth:`solve` does.

        Examples
        --------
        >>> import masonry
        >>> scene = Scene(
        ...     thickness=0.1, plane="stress", units={"length": "m", "force": "kN"},
        ...     materials={"brick": {"E": 1e6, "nu": 0.2}},
        ...     joints={"bed": {"mu": 0.6}, "head": {"mu": 0.6}},
        ...     walls=[{"name": "wall", "material": "brick", "width": 0.4, "courses": 2, "origin": [0, 0],
        ...             "brick": {"length": 0.2, "height": 0.1}, "mesh": [1, 1]}],
        ...     supports=[{"name": "floor", "from": [0, 0], "to": [0.4, 0], "joint": "bed"}],
        ...     loads=[{"name": "top", "from": [0, 0.2], "to": [0.4, 0.2], "pressure": 10}],
        ... )
        >>> study = scene.study(routes=["lemke", "interior"], tolerances=[1e-8], meshes=[1, 2])
        >>> study.records[["mesh", "route", "status"]].tolist()
        [(1, 'lemke', 'Solved'), (1, 'interior', 'Solved'), (2, 'lemke', 'Solved'), (2, 'interior', 'Solved')]
        >>> study.meshes["elements"].tolist()
        [5, 16]
        """
        settings = {
            "routes": _listed(routes),
            "tolerances": _listed(tolerances),
            "meshes": _listed(meshes),
            "time_limit": time_limit,
            "repeats": repeats,
        }
        native = self._checked()
        with bar(progress, "study") as shown:
            if shown is None:
                return Study(native.study(settings, callback))
            seen: set[tuple[int, str, float]] = set()

            def solve(mesh: int, route: str, tolerance: float) -> Any:
                seen.add((mesh, route, tolerance))
                shown.at(len(seen), f"mesh {mesh}, {route}, {tolerance:g}")
                return callback and callback(mesh, route, tolerance)

            return Study(native.study(settings, solve))

    def _written(self) -> str:
        """Give the keys as JSON, including arrays and numbers of numpy."""

        def plain(value: Any) -> Any:
            if hasattr(value, "tolist"):
                return value.tolist()
            raise TypeError(f"a scene has no values of type {type(value).__name__}")

        try:
            return json.dumps(self._keys, default=plain, allow_nan=False)
        except (ValueError, RecursionError) as error:
            raise _native.SceneError(_not_finite(self._keys) or str(error)) from None

    def _checked(self) -> _native.Scene:
        # Keys may have been changed in any way since the last check.
        text = self._written()
        if self._native is None or text != self._text:
            self._native, self._text = _native.Scene.from_json(text), text
        return self._native


def _given(table: dict[str, Any]) -> dict[str, Any]:
    """Give the table without the keys that have no value."""
    return {key: value for key, value in table.items() if value is not None}


def _not_finite(keys: dict[str, Any]) -> str | None:
    """Give a message with the key of a number that is not finite, down to the depth of scenes."""

    def found(value: Any, path: str, depth: int) -> str | None:
        if isinstance(value, float) and not math.isfinite(value):
            return f"{path} is {value}: give a finite number"
        members = value.tolist() if hasattr(value, "tolist") else value
        parts: Iterable[tuple[Any, Any]] = ()
        if isinstance(members, dict) and depth > 0:
            parts = members.items()
        elif isinstance(members, (list, tuple)) and depth > 0:
            parts = enumerate(members)
        inner = (found(it, f"{path}.{name}".lstrip("."), depth - 1) for name, it in parts)
        return next((it for it in inner if it is not None), None)

    return found(keys, "", _DEPTH)


def _listed(given: Iterable[Any] | None) -> list[Any] | None:
    return None if given is None else list(given)


def _told(callback: Callback | None, shown: Bar | None, what: str) -> Callback | None:
    """Give a callback that also moves a bar; ``None`` if there is neither callback nor bar."""
    if shown is None:
        return callback

    def told(number: int, value: float) -> Any:
        shown.at(number, "" if math.isnan(value) else f"{what} {value:.4g}")
        return callback and callback(number, value)

    return told
