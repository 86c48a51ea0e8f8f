"""The package ``lcp`` against scipy, numpy and closed forms."""

import concurrent.futures
import threading
import time

import numpy as np
import pytest
import scipy.optimize
import scipy.sparse

import lcp


def random_spd(n, seed):
    rng = np.random.default_rng(seed)
    a = rng.standard_normal((n, n))
    return a @ a.T + np.eye(n), rng.standard_normal(n)


def assert_solves(M, q, answer, tolerance=1e-9):
    z, w = answer.z, answer.w
    assert answer.is_solved and answer.residual <= 1e-8
    np.testing.assert_allclose(M @ z + q, w, atol=tolerance * max(1, abs(q).max()))
    assert z.min() >= -tolerance and w.min() >= -tolerance and abs(z * w).max() <= tolerance


@pytest.mark.parametrize("method", ["auto", "lemke", "newton", "interior", "qp", "pgs"])
@pytest.mark.parametrize("n", [1, 5, 40])
def test_all_methods_agree_with_nonnegative_least_squares(method, n):
    M, q = random_spd(n, n)
    root = np.linalg.cholesky(M).T
    expected, _ = scipy.optimize.nnls(root, -np.linalg.solve(root.T, q))
    answer = lcp.solve(M, q, method=method)
    assert_solves(M, q, answer, 1e-6 if method == "pgs" else 1e-9)
    np.testing.assert_allclose(answer.z, expected, atol=1e-6 if method == "pgs" else 1e-9)


def test_layouts_of_a_matrix_give_the_same_answer():
    M, q = random_spd(30, 3)
    M[0, 1] += 0.5
    expected = lcp.solve(M, q).z
    wide = np.zeros((60, 60))
    wide[::2, ::2] = M
    sparse = [scipy.sparse.csc_matrix(M), scipy.sparse.csr_array(M), scipy.sparse.coo_matrix(M)]
    for given in [np.asfortranarray(M), wide[::2, ::2], M.tolist(), *sparse]:
        np.testing.assert_allclose(lcp.solve(given, q).z, expected, atol=1e-10)


def test_a_sparse_matrix_with_duplicates_stays_as_it_is():
    columns = scipy.sparse.csc_matrix((np.ones(3), [0, 0, 1], [0, 2, 3]), shape=(2, 2))
    assert lcp.solve(columns, [-2, -1]).z.tolist() == [1.0, 1.0]
    assert columns.nnz == 3


def test_a_large_membrane_is_solved_sparse():
    side = 100
    line = scipy.sparse.diags([-1.0, 2.0, -1.0], [-1, 0, 1], shape=(side, side))
    eye = scipy.sparse.identity(side)
    M = (scipy.sparse.kron(line, eye) + scipy.sparse.kron(eye, line)).tocsc()
    q = np.linspace(-1.0, 1.0, side * side)
    assert_solves(M, q, lcp.solve(M, q))


def test_certificates_hold_where_a_linear_program_finds_none():
    rng = np.random.default_rng(7)
    proved = 0
    for _ in range(60):
        M = rng.integers(-3, 4, (4, 4)).astype(float)
        q = rng.integers(-3, 3, 4).astype(float)
        answer = lcp.solve(M, q)
        conditions = scipy.optimize.linprog(np.zeros(4), A_ub=-M, b_ub=q)
        if answer.status == "Infeasible":
            # w - M z = q has no solution: pi.q < 0 with pi >= 0 and M.T pi <= 0, or both signs changed.
            pi = np.array(answer.certificate["pi"])
            pi = pi if pi @ q < 0 else -pi
            assert pi @ q < 0 and pi.min() >= -1e-12 and (M.T @ pi).max() <= 1e-12
            proved += 1
        assert (conditions.status == 2) == (answer.status == "Infeasible")
    assert proved >= 10


def test_verdicts_are_those_of_a_mixed_integer_program():
    # z <= U b and w <= U (1 - b) with b of 0 or 1 are the choices of sides. A solution at a vertex is below U by Cramer's rule.
    rng = np.random.default_rng(11)
    n, U = 3, 200.0
    eye = np.eye(n)
    choice = scipy.optimize.LinearConstraint(np.hstack([eye, -U * eye]), ub=0.0)
    counts = dict.fromkeys(("Solved", "Infeasible", "NoSolution"), 0)
    for _ in range(150):
        M = rng.integers(-2, 3, (n, n)).astype(float)
        q = rng.integers(-2, 2, n).astype(float)
        answer = lcp.solve(M, q)
        w = scipy.optimize.LinearConstraint(np.hstack([M, 0 * eye]), lb=-q)
        other = scipy.optimize.LinearConstraint(np.hstack([M, U * eye]), ub=U - q)
        sides = scipy.optimize.milp(
            np.zeros(2 * n),
            integrality=np.repeat([0, 1], n),
            bounds=scipy.optimize.Bounds(0, np.repeat([U, 1], n)),
            constraints=[choice, w, other],
        )
        assert sides.status == (0 if answer.status == "Solved" else 2), (M, q, answer.status)
        counts[answer.status] += 1
    assert min(counts.values()) >= 5, counts


def test_a_game_has_the_equilibrium_of_its_matrix():
    # Matching pennies: both play half and half.
    a = np.array([[2.0, 1.0], [1.0, 2.0]])
    b = np.array([[1.0, 2.0], [2.0, 1.0]])
    M = np.block([[np.zeros((2, 2)), a], [b.T, np.zeros((2, 2))]])
    answer = lcp.lemke(M, -np.ones(4)).raise_if_unsolved()
    x, y = answer.z[:2], answer.z[2:]
    np.testing.assert_allclose([x / x.sum(), y / y.sum()], 0.5)


def test_horizontal_mixed_and_boxed_forms():
    A, B = np.array([[2.0, 1.0], [1.0, 2.0]]), -np.eye(2)
    answer = lcp.solve_horizontal(A, B, [1, -1])
    np.testing.assert_allclose([answer.t, answer.y], [[0.5, 0.0], [0.0, 1.5]], atol=1e-14)
    mixed = lcp.solve_mixed([[0, 1], [-1, 1]], [-1, 1], [True, False])
    assert mixed.z.tolist() == [2.0, 1.0] and mixed.is_solved
    boxed = lcp.solve_boxed(np.eye(3), [-5, 0.5, 3], [-1, -1, -1], [2, 2, 2])
    assert boxed.z.tolist() == [2.0, -0.5, -1.0] and boxed.w.tolist() == [-3.0, 0.0, 2.0]


def test_programs_agree_with_scipy():
    rng = np.random.default_rng(5)
    for _ in range(10):
        P, q = random_spd(6, rng.integers(1000))
        A = rng.standard_normal((3, 6))
        answer = lcp.qp(P, q, A, -1.0, 1.0, lower=-2.0, upper=2.0).raise_if_unsolved()
        found = scipy.optimize.minimize(
            lambda x: 0.5 * x @ P @ x + q @ x,
            np.zeros(6),
            jac=lambda x: P @ x + q,
            bounds=[(-2, 2)] * 6,
            constraints=scipy.optimize.LinearConstraint(A, -1, 1),
            method="trust-constr",
            options={"gtol": 1e-10, "xtol": 1e-12, "maxiter": 3000},
        )
        assert answer.objective <= found.fun + 1e-6
        np.testing.assert_allclose(P @ answer.x + q, A.T @ answer.rows + answer.bounds, atol=1e-8)


def test_a_stack_of_boxes_carries_its_weight():
    # Three boxes of weight 1 on each other: joints carry 3, 2 and 1.
    stack = lcp.Contact2d(np.zeros((6, 6)), [0, -1] * 3)
    for box in range(3):
        below = {2 * box - 1: -1.0} if box else {}
        beside = {2 * box - 2: -1.0} if box else {}
        stack.add_point({2 * box + 1: 1.0, **below}, {2 * box: 1.0, **beside}, mu=0.6)
    state = stack.solve().raise_if_unsolved()
    np.testing.assert_allclose(state.t_n, [3, 2, 1], atol=1e-9)
    # The upper box is pushed by more than friction holds.
    stack.f[4] = 0.7
    assert not stack.solve().is_solved
    stack.set_point(2, mu=0.8)
    np.testing.assert_allclose(stack.solve().raise_if_unsolved().t_t, [-0.7] * 3, atol=1e-9)


def test_sequences_and_batches_agree_with_single_solves():
    M, _ = random_spd(12, 11)
    rng = np.random.default_rng(2)
    right = rng.standard_normal((50, 12))
    single = [lcp.solve(M, q).z for q in right]
    steps = lcp.Sequence(M)
    np.testing.assert_allclose([steps.solve(q).z for q in right], single, atol=1e-12)
    batch = lcp.solve_many((M, q) for q in right)
    np.testing.assert_array_equal([answer.z for answer in batch], single)


def test_threads_share_a_sequence():
    M, q = random_spd(20, 1)
    steps = lcp.Sequence(M)
    expected = lcp.solve(M, q).z
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        for answer in pool.map(lambda _: steps.solve(q), range(50)):
            np.testing.assert_allclose(answer.z, expected, atol=1e-12)


def test_bounds_may_be_left_out():
    assert lcp.solve_boxed(np.eye(2), [-3, 2], 0, None).z.tolist() == [3.0, 0.0]
    assert lcp.solve_boxed(np.eye(2), [-3, 2], None, 1).z.tolist() == [1.0, -2.0]


def test_an_answer_that_is_none_raises_if_asked():
    answer = lcp.solve([[1, -1], [-1, 1]], [-1, 0])
    assert answer.certificate["kind"] == "farkas"
    with pytest.raises(lcp.Unsolved, match="Infeasible") as raised:
        answer.raise_if_unsolved()
    assert raised.value.answer is answer


def long_problem():
    """A problem whose path has 2^22 pivots (Murty 1988)."""
    n = 22
    return np.tril(2.0 * np.ones((n, n)), -1) + np.eye(n), -np.ones(n)


def test_a_callback_sees_the_iterations_and_ends_them():
    seen = []
    M, q = random_spd(200, 9)

    def stop(iteration, residual):
        seen.append((iteration, residual))
        return iteration >= 3

    answer = lcp.solve(M, q, method="pgs", callback=stop)
    assert answer.status == "Cancelled" and [at for at, _ in seen] == [0, 1, 2, 3]

    def fail(iteration, residual):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        lcp.solve(M, q, method="pgs", callback=fail)


def test_a_limit_of_time_is_kept():
    M, q = long_problem()
    began = time.perf_counter()
    answer = lcp.lemke(M, q, time_limit=0.2, max_iterations=10**9)
    assert answer.status == "TimeLimit" and 0.15 < time.perf_counter() - began < 2


def test_other_threads_run_during_a_solve():
    ticks = []
    done = threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    M, q = random_spd(1200, 4)
    began = time.perf_counter()
    lcp.lemke(M, q)
    ended = time.perf_counter()
    done.set()
    thread.join()
    within = [at for at in ticks if began < at < ended]
    assert len(within) >= 10
