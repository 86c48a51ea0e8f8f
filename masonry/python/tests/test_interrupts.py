"""Ctrl-C ends work of any kind soon, and callbacks end what they follow."""

import os
import signal
import threading
import time
from contextlib import contextmanager

import numpy as np
import pytest

import lcp
import masonry


@pytest.fixture(autouse=True)
def interruptible():
    """Let Ctrl-C interrupt also where whoever started Python ignores it, as shells do in the background."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@contextmanager
def interrupt(seconds):
    """Interrupt the process after a while, unless the block has ended; the list has the time of the signal."""
    sent = []

    def send():
        sent.append(time.perf_counter())
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(seconds, send)
    timer.start()
    try:
        yield sent
    finally:
        timer.cancel()


def hard():
    """A problem that keeps all methods busy for a quarter of a minute at least."""
    rng = np.random.default_rng(0)
    M = rng.standard_normal((500, 500))
    np.fill_diagonal(M, abs(M.diagonal()) + 0.1)
    return M, rng.standard_normal(500)


def wall(columns, courses):
    """A wall of many rigid bricks that an earthquake pushes."""
    return masonry.Scene(
        thickness=1.0,
        gravity=[0, -10],
        units={"length": "m", "force": "kN"},
        materials={"stone": {"density": 1000}},
        joints={"bed": {"mu": 0.6}, "head": {"mu": 0.6}},
        walls=[
            {
                "name": "wall",
                "material": "stone",
                "width": 0.5 * columns,
                "courses": courses,
                "origin": [0, 0],
                "brick": {"length": 0.5, "height": 0.2},
            }
        ],
        supports=[
            {"name": f"ground {k}", "from": [k, 0], "to": [k + 1, 0], "joint": "bed"}
            for k in range(columns // 2)
        ],
        loads=[{"name": "quake", "acceleration": [1, 0]}],
    )


def arch(voussoirs):
    return masonry.Scene(
        thickness=1.0,
        gravity=[0, -10],
        units={"length": "m", "force": "kN"},
        materials={"stone": {"density": 1000}},
        joints={"radial": {"mu": 0.7}},
        arches=[
            {
                "name": "arch",
                "material": "stone",
                "shape": "semicircular",
                "span": 1.8,
                "thickness": 0.2,
                "voussoirs": voussoirs,
                "joint": "radial",
                "springing": "radial",
            }
        ],
    )


def long_work():
    M, q = hard()
    steps = lcp.Sequence(M)
    big, thin = wall(30, 30), arch(2000)
    return {
        "solve": lambda: lcp.solve(M, q),
        "solve_many": lambda: lcp.solve_many([(M, q)] * 8),
        "Sequence": lambda: steps.solve(q),
        "Scene.limit": lambda: big.limit(),
        "Scene.ranges": lambda: big.ranges(),
        "Scene.least_thickness": lambda: thin.least_thickness("arch"),
        "Scene.study": lambda: big.study(),
    }


@pytest.mark.parametrize("name", long_work())
def test_an_interrupt_ends_long_work(name):
    work = long_work()[name]
    with interrupt(0.5) as sent, pytest.raises(KeyboardInterrupt):
        work()
    # Without a look at signals each of these goes on for at least ten seconds more.
    assert time.perf_counter() - sent[0] < 5


def test_an_interrupt_ends_a_map_and_no_other_scene_begins():
    begun, over = [], threading.Event()

    def work(scene):
        begun.append(scene)
        return scene.limit(callback=lambda *_: over.is_set())

    scenes = [wall(30, 30) for _ in range(8)]
    try:
        with interrupt(0.5), pytest.raises(KeyboardInterrupt):
            list(masonry.map(scenes, work, workers=2))
        assert len(begun) == 2
    finally:
        over.set()


def test_after_an_interrupt_the_same_objects_go_on():
    M, q = hard()
    easy = lcp.Sequence(np.eye(3))
    with interrupt(0.3), pytest.raises(KeyboardInterrupt):
        lcp.solve_many([(M, q)] * 4)
    assert easy.solve([-1.0, 2.0, -3.0]).z.tolist() == [1.0, 0.0, 3.0]
    answers = lcp.solve_many([([[2.0]], [-1.0])] * 3)
    assert [it.z[0] for it in answers] == pytest.approx([0.5] * 3)


def test_callbacks_end_ranges_thicknesses_and_studies():
    def stop(*told):
        heard.append(told)
        return len(heard) >= 3

    heard = []
    ranges = wall(4, 4).ranges(callback=stop)
    assert len(heard) == 3 and ranges.sentence.startswith("Interrupted.")
    heard = []
    thickness = arch(20).least_thickness("arch", callback=stop)
    assert len(heard) == 3 and thickness.sentence.startswith("Interrupted.")
    heard = []
    study = wall(4, 4).study(routes=["lemke", "interior"], tolerances=[1e-6], callback=stop)
    assert study.is_interrupted and len(heard) == 3
    mesh, route, tolerance = heard[0]
    assert (mesh, route, tolerance) == (1, "lemke", 1e-6) or route in ("lemke", "interior")


def test_an_exception_of_a_callback_comes_through():
    def fail(*told):
        raise LookupError("enough")

    for call in (
        lambda: wall(4, 4).ranges(callback=fail),
        lambda: wall(4, 4).limit(callback=fail),
        lambda: arch(20).least_thickness("arch", callback=fail),
        lambda: wall(4, 4).study(callback=fail),
    ):
        with pytest.raises(LookupError, match="enough"):
            call()
