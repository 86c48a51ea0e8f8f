"""Scenes: what is built, and what acts on it."""

from __future__ import annotations

import copy
import json
import os
from collections.abc import Callable
from typing import Any

from lcp import _native

from ._results import Limit, Outcome

Callback = Callable[[int, float], Any]


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
        native = _native.Scene.from_toml(text) if is_text else _native.Scene.read(text)
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
        """Give a key a value; the scene is checked when it is used."""
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
        """Give a scene of its own, whose keys may be changed."""
        scene = Scene._from_keys(copy.deepcopy(self._keys))
        scene._native, scene._text = self._native, self._text
        return scene

    def to_toml(self) -> str:
        """Give the text of a scene file."""
        return self._checked().to_toml()

    def plan(self) -> str:
        """Say what the scene needs: effects, unknowns, memory, and the method."""
        return self._checked().plan()

    def plot(self) -> str:
        """Draw blocks, supports, loads and contact points as SVG."""
        return self._checked().picture()

    def _repr_html_(self) -> str:
        return self.plot()

    def solve(self, *, callback: Callback | None = None) -> Outcome:
        """Solve the scene.

        Parameters
        ----------
        callback : callable, optional
            Called with the number of the iteration and the residual; something true that it returns ends the solve.
        """
        return Outcome(self._checked().solve(callback))

    def limit(
        self,
        group: str | None = None,
        *,
        law: str = "both",
        both: bool = False,
        callback: Callback | None = None,
    ) -> Limit:
        """Find the factor of a load at which the structure fails.

        Parameters
        ----------
        group : str, optional
            The load or group that grows, in place of that of the scene.
        law : str
            ``"associative"``: joints open by ``mu`` times their slip, with a proof; ``"path"``: Coulomb's friction; ``"both"``.
        both : bool
            Also take the opposite direction.
        callback : callable, optional
            Called with a number and the largest factor that was found to stand; something true that it returns ends the search.
        """
        return Limit(self._checked().limit(group, law, both, callback))

    def ranges(self) -> Limit:
        """Find the least and the largest reactions that forces within friction allow."""
        return Limit(self._checked().ranges())

    def least_thickness(self, arch: str) -> Limit:
        """Find the least thickness of an arch under the loads of the scene."""
        return Limit(self._checked().least_thickness(arch))

    def _written(self) -> str:
        """Give the keys as JSON, arrays and numbers of numpy included."""

        def plain(value: Any) -> Any:
            if hasattr(value, "tolist"):
                return value.tolist()
            raise TypeError(f"a scene has no values of type {type(value).__name__}")

        return json.dumps(self._keys, default=plain)

    def _checked(self) -> _native.Scene:
        # Keys may have been changed in any way since the last check.
        text = self._written()
        if self._native is None or text != self._text:
            self._native, self._text = _native.Scene.from_json(text), text
        return self._native


def _given(table: dict[str, Any]) -> dict[str, Any]:
    """Leave out the keys without a value."""
    return {key: value for key, value in table.items() if value is not None}
