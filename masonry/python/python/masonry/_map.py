"""Many scenes on all cores, or on the machines of a cluster."""

from __future__ import annotations

import concurrent.futures
import os
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from ._progress import bar
from ._scene import Scene


@dataclass(frozen=True)
class Done:
    """A scene that is done.

    Attributes
    ----------
    index : int
        The place of the scene among the scenes.
    scene : Scene
        The scene.
    result : object
        The result of the work; ``None`` if the work raised an exception.
    error : BaseException or None
        The exception of the work, or that of the executor if the work is lost.
    """

    index: int
    scene: Scene
    result: Any
    error: BaseException | None


def map(
    scenes: Iterable[Scene],
    what: Callable[[Scene], Any] = Scene.solve,
    *,
    workers: int | None = None,
    executor: concurrent.futures.Executor | None = None,
    progress: bool = False,
) -> Iterator[Done]:
    """Work on scenes on all cores, and give each as soon as it is done.

    The work begins when the caller takes the first result. A scene that raises an exception does not stop the others. Solves
    release the lock of the interpreter, so that threads suffice on one machine. If the caller takes no more results, or after
    Ctrl-C, no other scene begins, but running scenes go on to their end in the background, and the process does not end
    before them.

    Parameters
    ----------
    scenes : iterable of Scene
        The scenes.
    what : callable
        The work on a scene, by default :meth:`Scene.solve`.
    workers : int, optional
        Threads, at least one; by default one for each core. An ``executor`` has workers of its own.
    executor : concurrent.futures.Executor, optional
        The executor that replaces threads, such as the ``get_executor()`` of a client of dask. Results of other processes have to
        be data: ``what`` then returns numbers, texts and arrays, not an :class:`Outcome`.
    progress : bool
        Show a bar, as :meth:`Scene.solve` does.

    Raises
    ------
    ValueError
        If there are no workers.

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
    if workers is not None and workers < 1:
        raise ValueError(f"workers is {workers}: give at least 1, or leave it out for one on each core")
    return _done(list(scenes), what, workers, executor, progress)


def _done(
    given: list[Scene],
    what: Callable[[Scene], Any],
    workers: int | None,
    executor: concurrent.futures.Executor | None,
    progress: bool,
) -> Iterator[Done]:
    """Give each scene as soon as it is done."""
    pool = executor or concurrent.futures.ThreadPoolExecutor(workers or os.cpu_count())
    waiting = {pool.submit(what, scene): index for index, scene in enumerate(given)}
    try:
        with bar(progress, "scenes", len(given)) as shown:
            for count, future in enumerate(concurrent.futures.as_completed(waiting), 1):
                # References to finished work are dropped here, so that the caller alone holds its memory.
                index = waiting.pop(future)
                if shown is not None:
                    shown.at(count)
                error = _error(future)
                result = None if error is not None else future.result()
                yield Done(index, given[index], result, error)
    finally:
        for future in waiting:
            future.cancel()
        # The scenes that still run after Ctrl-C are not waited for.
        if executor is None:
            pool.shutdown(wait=False)


def _error(future: concurrent.futures.Future[Any]) -> BaseException | None:
    """Give the exception of the work, or one for work that the executor has cancelled."""
    if future.cancelled():
        return concurrent.futures.CancelledError("the executor has cancelled the work on this scene")
    return future.exception()
