"""Many walls on a cluster, as the example has them."""

import importlib.util
import os
import pathlib
import signal
import time

import numpy as np
import pytest

import masonry

distributed = pytest.importorskip("distributed", reason='dask is not installed: pip install "dask[distributed]"')
PATH = pathlib.Path(__file__).parents[3] / "examples" / "python" / "many_walls.py"
spec = importlib.util.spec_from_file_location("many_walls", PATH)
many_walls = importlib.util.module_from_spec(spec)
spec.loader.exec_module(many_walls)


@pytest.fixture(scope="module")
def client():
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster,
        distributed.Client(cluster) as client,
    ):
        # The example is a file, and no module that processes could import.
        client.upload_file(str(PATH))
        yield client


def slow_strength(scene):
    """Give the strength after a while, so that a process can die in between."""
    time.sleep(0.2)
    return scene.limit(law="associative").details["associative"]["load_factor"]


def test_walls_that_fail_and_processes_that_die_do_not_stop_the_rest(client):
    scenes = [many_walls.random_wall(seed) for seed in range(16)]
    scenes[5]["joints.bed.mu"] = "smooth"
    done, processes = {}, client.run(os.getpid)
    for it in masonry.map(scenes, slow_strength, executor=client.get_executor(retries=2)):
        done[it.index] = it
        if len(done) == 1:
            # Results come as they are, so that both processes have work left when the first is here.
            working = client.processing()
            assert all(working[address] for address in processes)
            os.kill(next(iter(processes.values())), signal.SIGKILL)
    assert sorted(done) == list(range(16))
    assert isinstance(done[5].error, masonry.SceneError) and "mu" in str(done[5].error)
    for index in set(done) - {5}:
        assert done[index].error is None
        assert done[index].result == pytest.approx(many_walls.strength(scenes[index]), rel=1e-9)


def test_a_fragility_curve_is_drawn(client, tmp_path):
    pytest.importorskip("matplotlib", reason="matplotlib is not installed: pip install matplotlib")
    scenes = [many_walls.random_wall(seed) for seed in range(12)]
    found, failed = many_walls.strengths(scenes, client)
    assert not failed and np.isfinite(found).all()
    # No wall stands an acceleration by which it slides on its base, nor one that tilts it as one piece: 3 m / 2.5 m.
    friction = np.array([scene["joints.bed.mu"] for scene in scenes])
    assert (found > 0).all() and (found <= np.minimum(friction, 1.2) + 1e-6).all()
    picture = tmp_path / "fragility.svg"
    many_walls.draw(found, picture)
    assert "median" in picture.read_text()
