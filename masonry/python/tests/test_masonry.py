"""The package ``masonry`` against published answers and closed forms."""

import concurrent.futures
import copy
import pathlib
import pickle

import numpy as np
import pytest

import masonry
from walls import block

SCENES = pathlib.Path(__file__).parents[3] / "scenes"


def pushed(force):
    return block(loads=[{"name": "push", "block": "block", "at": [0, 0.1], "force": [force, 0]}])


def test_a_block_slides_at_friction_times_weight():
    assert pushed(1.19).solve().verdict == "stands"
    fallen = pushed(1.21).solve()
    assert fallen.verdict == "falls" and fallen.plot("mechanism").startswith("<svg")
    found = pushed(1.0).limit("push")
    assert found.details["associative"]["load_factor"] == pytest.approx(1.2, rel=1e-6)
    assert "stands up to" in found.sentence


def test_walls_of_ferris_and_tin_loi():
    for number, published in [(1, 0.643), (2, 0.580), (3, 0.404)]:
        scene = masonry.Scene.read(SCENES / f"ferris_wall_{number}.toml")
        found = scene.limit(law="associative").details["associative"]["load_factor"]
        assert found == pytest.approx(published, abs=6e-4)


def test_both_directions_and_ranges():
    scene = masonry.Scene.read(SCENES / "ferris_wall_1.toml")
    both = scene.limit(law="associative", both=True)
    # The wall is the same from both sides.
    factors = [both.details[way]["associative"]["load_factor"] for way in ("given", "opposite")]
    assert factors == pytest.approx([0.642859, 0.642859], rel=1e-4)
    # The floor carries the weight, 2 kN, and nothing pushes to the side.
    floor = block().ranges().details["range"]["ground"]
    ends = [floor[part][end]["value"] for part in ("fx", "fy") for end in ("min", "max")]
    assert ends == pytest.approx([0.0, 0.0, 2.0, 2.0], abs=1e-9)


def test_results_are_arrays_in_units_of_the_scene():
    outcome = masonry.Scene.read(SCENES / "panel_square.toml").solve()
    assert outcome.verdict == "stands" and outcome.status == "Solved"
    contacts = outcome.contacts
    states, counts = np.unique(contacts["status"], return_counts=True)
    assert dict(zip(states, counts)) == outcome.details["contacts"]
    # 10 kN on top: the reactions are given in the units of the scene.
    assert sum(it["fy"] for it in outcome.details["reactions"].values()) == pytest.approx(10.0)
    stresses = outcome.stresses
    assert len(stresses) > 100 and (stresses["s1"] >= stresses["s2"]).all()
    nodes = outcome.nodes
    assert abs(nodes["ux"]).max() < 1e-2 and len(outcome.blocks) == nodes["block"].max() + 1
    for picture in ("scene", "deformed", "forces", "stresses"):
        assert outcome.plot(picture).startswith("<svg")
    assert outcome.sentence in outcome._repr_html_() and "<svg" in outcome._repr_html_()
    assert outcome.report().startswith(outcome.sentence[:20]) and "<html" in outcome.page()


def test_a_history_has_a_record_for_every_step():
    outcome = masonry.Scene.read(SCENES / "wall_settlement.toml").solve()
    history = outcome.history
    assert len(history) == len(outcome.details["history"]["records"])
    assert history["stage"].tolist() == ["weight"] + ["settlement"] * (len(history) - 1)
    assert (np.diff(history["right foundation y_m"]) <= 0).all()


def test_files_are_written(tmp_path):
    written = block().solve().save(tmp_path / "out")
    assert (tmp_path / "out" / "report.txt").exists() and len(written) >= 5


def test_names_in_tables_are_text():
    scene = block()
    scene["blocks.0.name"] = "1"
    assert scene.solve().contacts["b"].tolist()[0] == "1"
    scene["blocks.0.name"] = "a, b"
    assert scene.solve().contacts["b"].tolist()[0] == "a, b"


def test_keys_that_are_changed_in_place_count():
    scene = pushed(1.1)
    assert scene.solve().verdict == "stands"
    scene["joints"]["floor"]["mu"] = np.float64(0.5)
    assert scene.solve().verdict == "falls" and copy.copy(scene).solve().verdict == "falls"
    scene["blocks.0.corners"] = np.array([[0, 0], [0.8, 0], [0.8, 0.5], [0, 0.5]])
    assert scene.solve().verdict == "stands"


def test_keys_change_and_scenes_are_copied():
    scene = pushed(1.1)
    other = scene.copy()
    other["joints.floor.mu"] = 0.5
    other["blocks.0.corners.2"] = [0.4, 0.5]
    assert (scene["joints.floor.mu"], other["joints.floor.mu"]) == (0.6, 0.5)
    assert (scene.solve().verdict, other.solve().verdict) == ("stands", "falls")
    again = masonry.Scene.read(other.to_toml())
    assert again.solve().verdict == "falls"
    assert pickle.loads(pickle.dumps(other)).solve().verdict == "falls"


def test_a_path_that_leads_nowhere_is_a_wrong_key():
    with pytest.raises(KeyError):
        block()["joints.roof.mu"]


def test_a_callback_ends_a_solve():
    seen = []

    def stop(number, residual):
        seen.append(number)
        return True

    outcome = masonry.Scene.read(SCENES / "panel_square.toml").solve(callback=stop)
    assert outcome.status == "Cancelled" and outcome.verdict == "undecided" and len(seen) >= 1


def test_many_scenes_go_on_behind_one_that_fails():
    scenes = [pushed(0.1 * k) for k in range(1, 20)]
    scenes[3]["joints.floor.mu"] = "smooth"
    done = {it.index: it for it in masonry.map(scenes)}
    assert sorted(done) == list(range(19))
    assert isinstance(done[3].error, masonry.SceneError) and done[3].result is None
    verdicts = [done[k].result.verdict for k in range(19) if k != 3]
    assert verdicts == ["stands"] * 11 + ["falls"] * 7


class Careless(concurrent.futures.Executor):
    """An executor that cancels the second of all works."""

    def __init__(self):
        self.asked = 0

    def submit(self, what, scene):
        self.asked += 1
        future = concurrent.futures.Future()
        if self.asked == 2:
            future.cancel()
            future.set_running_or_notify_cancel()
        else:
            future.set_result(what(scene))
        return future


def test_many_scenes_go_on_behind_one_that_is_cancelled():
    executor = Careless()
    done = {it.index: it for it in masonry.map([pushed(0.1)] * 3, executor=executor)}
    assert isinstance(done[1].error, concurrent.futures.CancelledError) and done[1].result is None
    assert "cancelled" in str(done[1].error)
    assert [done[k].result.verdict for k in (0, 2)] == ["stands", "stands"]


def test_many_scenes_begin_with_the_first_result():
    executor = Careless()
    results = masonry.map([pushed(0.1)] * 3, executor=executor)
    assert executor.asked == 0
    next(results)
    assert executor.asked == 3
