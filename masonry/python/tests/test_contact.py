"""Bodies in contact that are solved again and again."""

import concurrent.futures

import numpy as np
import pytest

import lcp


def pile(boxes, k=0.0):
    """Boxes of weight 1 on each other, each held by springs."""
    stack = lcp.Contact2d(k * np.eye(2 * boxes), [0.0, -1.0] * boxes)
    for box in range(boxes):
        below = {2 * box - 1: -1.0} if box else {}
        beside = {2 * box - 2: -1.0} if box else {}
        stack.add_point({2 * box + 1: 1.0, **below}, {2 * box: 1.0, **beside}, mu=0.6)
    return stack


def test_states_of_the_solve_before_save_work():
    stack = pile(60, k=1.0)
    rng = np.random.default_rng(4)
    push = np.zeros(120)
    push[::2] = rng.uniform(-1.0, 1.0, 60)
    cold = warm = 0
    for step in range(1, 6):
        stack.f[:] = np.tile([0.0, -1.0], 60) + 0.2 * step * push
        other = pile(60, k=1.0)
        other.f[:] = stack.f
        ours, anew = stack.solve().raise_if_unsolved(), other.solve().raise_if_unsolved()
        # Springs on all displacements make the solution unique.
        np.testing.assert_allclose(ours.u, anew.u, atol=1e-9)
        np.testing.assert_allclose(ours.t_n, anew.t_n, atol=1e-8)
        if step > 1:
            warm += ours.info["factorisations"]
            cold += anew.info["factorisations"]
    assert 2 * warm < cold
    stack.forget()
    assert stack.solve().info["factorisations"] > warm / 4


def test_points_are_added_and_changed_between_solves():
    box = lcp.Contact2d(np.diag([3.0, 1.0]), [1.4, -2.0])
    left = box.add_point({1: 1.0}, {0: 1.0}, mu=0.5)
    assert box.solve().raise_if_unsolved().t_n[left] == pytest.approx(2.0)
    right = box.add_point({1: 1.0}, {0: 1.0}, mu=0.5)
    state = box.solve().raise_if_unsolved()
    # Both feet carry together what one has carried, and slide against all of their friction.
    assert state.t_n.sum() == pytest.approx(2.0) and state.t_t.sum() == pytest.approx(-1.0)
    assert state.u[0] == pytest.approx(0.4 / 3.0) and len(state.gap) == 2
    box.set_point(left, gap=0.1)
    box.set_point(right, gap=-0.2)
    state = box.solve().raise_if_unsolved()
    assert state.u[1] == pytest.approx(0.2) and state.gap.tolist() == pytest.approx([0.3, 0.0])
    assert state.t_n.tolist() == pytest.approx([0.0, 2.2])


def test_integers_of_numpy_name_displacements():
    box = lcp.Contact2d(np.diag([3.0, 1.0]), [1.4, -2.0])
    x, y = np.arange(2)
    foot = box.add_point({y: 1.0}, {x: 1.0}, mu=0.5)
    assert box.solve().raise_if_unsolved().t_n[foot] == pytest.approx(2.0)


def test_gaps_and_slips_are_those_of_the_displacements():
    stack = pile(3, k=2.0)
    stack.f[0] = 5.0
    state = stack.solve().raise_if_unsolved()
    x, y = state.u[::2], state.u[1::2]
    np.testing.assert_allclose(state.gap, np.diff(y, prepend=0.0), atol=1e-12)
    np.testing.assert_allclose(state.slip, np.diff(x, prepend=0.0), atol=1e-12)


def test_a_load_of_another_length_is_named():
    stack = pile(2)
    assert stack.solve().is_solved
    stack.f = np.zeros(3)
    with pytest.raises(ValueError, match="`f` has 3 entries, but must have 4"):
        stack.solve()


def test_threads_share_bodies():
    stack = pile(5, k=1.0)
    expected = stack.solve().u
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        for state in pool.map(lambda _: stack.solve(), range(40)):
            np.testing.assert_allclose(state.raise_if_unsolved().u, expected, atol=1e-10)
