"""The package ``lcp`` against ``lcp_lemke`` of QuantEcon, an implementation of Lemke's method that shares nothing with it."""

import numpy as np
import pytest

import lcp

REASON = "QuantEcon is not installed: pip install quantecon"
lcp_lemke = pytest.importorskip("quantecon.optimize.lcp_lemke", reason=REASON).lcp_lemke
games = pytest.importorskip("quantecon.game_theory", reason=REASON)


def both(M, q):
    """Solve by both packages, and check that the other one has a solution."""
    M, q = np.asarray(M, dtype=float), np.asarray(q, dtype=float)
    other = lcp_lemke(M, q)
    assert other.success
    w = M @ other.z + q
    assert min(other.z.min(), w.min()) > -1e-9 and abs(other.z @ w) < 1e-8
    return lcp.solve(M, q).raise_if_unsolved(), other.z


@pytest.mark.parametrize("seed", range(20))
def test_definite_matrices_have_the_same_solution(seed):
    rng = np.random.default_rng(seed)
    n = int(rng.integers(1, 60))
    a = rng.standard_normal((n, n))
    # The symmetric part decides that there is one solution; the other part is arbitrary.
    M = a @ a.T + 0.1 * np.eye(n) + 3.0 * (a - a.T)
    ours, theirs = both(M, rng.standard_normal(n))
    np.testing.assert_allclose(ours.z, theirs, atol=1e-8 * max(1.0, theirs.max()))


@pytest.mark.parametrize("seed", range(10))
def test_p_matrices_that_are_not_definite_have_the_same_solution(seed):
    rng = np.random.default_rng(100 + seed)
    n = 12
    # A triangular matrix with a positive diagonal is a P-matrix whatever is below it.
    M = np.tril(4.0 * rng.standard_normal((n, n)), -1) + np.diag(rng.uniform(0.5, 1.5, n))
    ours, theirs = both(M, rng.standard_normal(n))
    np.testing.assert_allclose(ours.z, theirs, rtol=1e-6, atol=1e-6)


def test_an_obstacle_has_the_same_contact():
    n = 80
    M = 2.0 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1)
    q = 0.01 - 0.05 * np.sin(np.linspace(0.0, 3.0 * np.pi, n))
    ours, theirs = both(M, q)
    np.testing.assert_allclose(ours.z, theirs, atol=1e-10)
    assert 5 < (ours.z == 0.0).sum() < n


@pytest.mark.parametrize("seed", range(10))
def test_games_have_an_equilibrium_by_both(seed):
    rng = np.random.default_rng(seed)
    rows, columns = rng.integers(2, 8, 2)
    # Costs; QuantEcon takes payoffs, and has Lemke and Howson's method for games.
    a, b = rng.uniform(1.0, 2.0, (2, rows, columns))
    M = np.block([[np.zeros((rows, rows)), a], [b.T, np.zeros((columns, columns))]])
    z = lcp.lemke(M, -np.ones(rows + columns)).raise_if_unsolved().z
    ours = z[:rows] / z[:rows].sum(), z[rows:] / z[rows:].sum()
    players = [games.Player(3.0 - a), games.Player(3.0 - b.T)]
    theirs = games.lemke_howson(games.NormalFormGame(players))
    # Equilibria need not be unique: in each of them no other strategy costs less.
    for x, y in (ours, theirs):
        np.testing.assert_allclose(x @ a @ y, (a @ y).min(), rtol=1e-9)
        np.testing.assert_allclose(x @ b @ y, (x @ b).min(), rtol=1e-9)


def test_where_it_ends_on_a_ray_there_is_a_proof_or_a_solution():
    rng = np.random.default_rng(5)
    rays = proofs = 0
    for _ in range(40):
        M = rng.integers(-2, 3, (5, 5)).astype(float)
        q = rng.integers(-3, 2, 5).astype(float)
        theirs, ours = lcp_lemke(M, q), lcp.solve(M, q)
        rays += not theirs.success
        proofs += ours.status in ("Infeasible", "NoSolution")
        # What QuantEcon solves has a solution, so that there is no proof of the contrary.
        assert not (theirs.success and ours.status in ("Infeasible", "NoSolution"))
        assert ours.is_solved or ours.certificate is not None
    assert rays >= 10 and proofs >= 5
