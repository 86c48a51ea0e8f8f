"""Many scenes on the cores of one machine."""

from __future__ import annotations

import concurrent.futures
import os
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from ._scene import Scene


@dataclass(frozen=True)
class Done:
    """A scene that is done.

    Attributes
    ----------
    index : int
        Its place among the scenes.
    scene : Scene
        The scene.
    result : object
        What the work gave; ``None`` if it raised an exception.
    error : Exception or None
        The exception.
    """

    index: int
    scene: Scene
    result: Any
    error: Exception | None


def map(
    scenes: Iterable[Scene],
    what: Callable[[Scene], Any] = Scene.solve,
    *,
    workers: int | None = None,
) -> Iterator[Done]:
    """Work on scenes on all cores, and give each as soon as it is done.

    A scene that raises an exception does not stop the others. Solves release the lock of the interpreter, so that threads suffice.

    Parameters
    ----------
    scenes : iterable of Scene
        The scenes.
    what : callable
        The work on a scene, by default :meth:`Scene.solve`.
    workers : int, optional
        Threads, by default one for each core.

    Examples
    --------
    >>> base = Scene(thickness=1.0, gravity=[0, -10], units={"length": "m", "force": "kN"},
    ...     materials={"stone": {"density": 1000}}, joints={"bed": {"mu": 0.6}, "head": {"mu": 0.6}},
    ...     walls=[{"name": "wall", "material": "stone", "width": 2, "courses": 6, "origin": [0, 0],
    ...             "brick": {"length": 0.5, "height": 0.2}}],
    ...     supports=[{"name": "ground", "from": [0, 0], "to": [2, 0], "joint": "bed"}],
    ...     loads=[{"name": "quake", "acceleration": [1, 0]}])
    >>> scenes = []
    >>> for mu in (0.2, 0.4, 0.6):
    ...     scene = base.copy()
    ...     scene["joints.bed.mu"] = mu
    ...     scenes.append(scene)
    >>> done = sorted(map(scenes, lambda scene: scene.limit(law="associative")), key=lambda it: it.index)
    >>> [round(it.result.details["associative"]["load_factor"], 3) for it in done]
    [2.0, 4.0, 6.0]
    """

    def work(index: int, scene: Scene) -> Done:
        try:
            return Done(index, scene, what(scene), None)
        except Exception as error:  # Whatever it is, the others go on.
            return Done(index, scene, None, error)

    with concurrent.futures.ThreadPoolExecutor(workers or os.cpu_count()) as pool:
        waiting = [pool.submit(work, index, scene) for index, scene in enumerate(scenes)]
        try:
            for future in concurrent.futures.as_completed(waiting):
                yield future.result()
        finally:
            for future in waiting:
                future.cancel()
