"""Wrong input raises the exception of its kind, with the message of the library, and no panic of it reaches Python."""

import itertools
import pathlib
import warnings

import numpy as np
import pytest
import scipy.sparse

import lcp
import masonry
from lcp import _native
from walls import block

EYE = np.eye(2)
NAN, INFINITE = float("nan"), float("inf")


def foot(**changed):
    """A box on a floor, of whose contact something is wrong."""
    box = lcp.Contact2d(np.zeros((2, 2)), [0.0, -1.0])
    box.add_point(**{"normal": {1: 1.0}, "tangent": {0: 1.0}, **changed})
    return box


def endless():
    """A list that contains itself."""
    it = []
    it.append(it)
    return it


WRONG = [
    (lambda: lcp.solve([[1, 2]], [1]), ValueError, "1 x 2"),
    (lambda: lcp.solve(EYE, [1, 2, 3]), ValueError, "2 x 2"),
    (lambda: lcp.solve([1.0], [1.0]), ValueError, "two dimensions"),
    (lambda: lcp.solve(EYE, EYE), ValueError, "one dimension"),
    (lambda: lcp.solve([["a"]], [1.0]), ValueError, "could not convert"),
    (lambda: lcp.solve([[1, 2], [3]], [1.0, 1.0]), ValueError, "inhomogeneous"),
    (lambda: lcp.solve(None, [1.0]), ValueError, "two dimensions"),
    (lambda: lcp.solve([[1j]], [1.0]), ValueError, "matrix has complex entries"),
    (lambda: lcp.solve(np.array([[1 + 5j]]), [1.0]), ValueError, "matrix has complex entries"),
    (lambda: lcp.solve(np.array([[1 + 5j]], dtype=object), [1.0]), ValueError, "matrix has complex entries"),
    (lambda: lcp.solve(scipy.sparse.csc_matrix([[1 + 5j]]), [1.0]), ValueError, "matrix has complex entries"),
    (lambda: lcp.solve(scipy.sparse.coo_array([[1 + 5j]]), [1.0]), ValueError, "matrix has complex entries"),
    (lambda: lcp.solve([[1.0]], np.array([1 + 5j])), ValueError, "vector has complex entries"),
    (lambda: lcp.solve_boxed([[1.0]], [1.0], np.complex64(1j), None), ValueError, "vector has complex entries"),
    (lambda: lcp.solve([[NAN]], [1.0]), ValueError, "NaN"),
    (lambda: lcp.solve(EYE, [INFINITE, 0.0]), ValueError, "inf"),
    (lambda: lcp.solve(EYE, [0.0, 0.0], method="simplex"), ValueError, "must be one of: .*lemke"),
    (lambda: lcp.solve(EYE, [0.0, 0.0], tol=0), ValueError, "tolerance"),
    (lambda: lcp.solve(EYE, [0.0, 0.0], tol=NAN), ValueError, "tolerance"),
    (lambda: lcp.solve(EYE, [0.0, 0.0], time_limit=-1), ValueError, "time_limit is -1"),
    (lambda: lcp.solve(EYE, [0.0, 0.0], time_limit=NAN), ValueError, "time_limit is NaN"),
    (lambda: lcp.solve(EYE, [0.0, 0.0], max_iterations=3), ValueError, "time_limit instead"),
    (lambda: lcp.solve(EYE, [0.0, 0.0], method="pgs", max_iterations=-1), ValueError, "max_iterations is -1"),
    (lambda: lcp.solve(-EYE, [0.0, 0.0], method="newton"), ValueError, "positive"),
    (lambda: lcp.solve_mixed(EYE, [1.0, 1.0], [True]), ValueError, "free"),
    (lambda: lcp.solve_mixed(EYE, [1.0, 1.0], [True, False], method="pgs"), ValueError, "choose one of"),
    (lambda: lcp.solve_boxed(EYE, [0.0, 0.0], [1.0, 0.0], 0.0), ValueError, "lower"),
    (lambda: lcp.solve_boxed(EYE, [0.0, 0.0], [0.0], None), ValueError, "lower"),
    (lambda: lcp.solve_horizontal(EYE, np.eye(3), [0.0, 0.0]), ValueError, "3 x 3"),
    (lambda: lcp.qp(-EYE, [0.0, 0.0]), ValueError, "semidefinite"),
    (lambda: lcp.qp([[1, 2], [0, 1]], [0.0, 0.0]), ValueError, "symmetric"),
    (lambda: lcp.qp(EYE, [0.0, 0.0], A=[[1.0]], l=0.0), ValueError, "1 x 1"),
    (lambda: lcp.qp(EYE, [0.0, 0.0], A=EYE, l=1.0, u=0.0), ValueError, "1"),
    (lambda: lcp.solve_many([(EYE, [0.0, 0.0]), ([[1.0, 2.0]], [1.0])]), ValueError, "problem 1: "),
    (lambda: lcp.Sequence([[1.0, 2.0]]), ValueError, "1 x 2"),
    (lambda: lcp.Sequence(EYE).solve([1.0]), ValueError, "q"),
    (lambda: lcp.Sequence(EYE).solve([NAN, 0.0]), ValueError, "NaN"),
    (lambda: foot(mu=-1.0).solve(), ValueError, "mu"),
    (lambda: foot(gap=NAN).solve(), ValueError, "NaN"),
    (lambda: foot(compliance=(-1.0, 0.0)).solve(), ValueError, "compliance"),
    (lambda: foot(normal={7: 1.0}).solve(), ValueError, "from 0 to 1"),
    (lambda: foot(normal={-1: 1.0}).solve(), ValueError, "from 0 to 1"),
    (lambda: foot(normal={10**30: 1.0}).solve(), ValueError, "from 0 to 1"),
    (lambda: foot(normal={1.7: 1.0}), TypeError, "displacement 1.7: give its number as an integer"),
    (lambda: foot(tangent={"x": 1.0}), TypeError, "displacement 'x'"),
    (lambda: foot(normal={1: np.complex64(1j)}).solve(), ValueError, "vector has complex entries"),
    (lambda: foot(gap=np.complex64(1j)).solve(), ValueError, "point has complex entries"),
    (lambda: lcp.Contact2d(EYE, np.array([1j, 0.0])), ValueError, "vector has complex entries"),
    (lambda: foot().set_point(0, nu=1), TypeError, "has no nu"),
    (lambda: foot().set_point(3, mu=1), IndexError, "range"),
    (lambda: lcp.Contact2d(-EYE, [0.0, 0.0]).solve(), ValueError, "semidefinite"),
    (lambda: block(thicknes=1), masonry.SceneError, "thicknes"),
    (lambda: block(gravity=[0]), masonry.SceneError, "gravity"),
    (lambda: block(joints={"floor": {"mu": -1}}), masonry.SceneError, "mu"),
    (lambda: block(joints={"floor": {"mu": NAN}}), masonry.SceneError, "joints.floor.mu is nan"),
    (lambda: block(gravity=np.array([0.0, INFINITE])), masonry.SceneError, "gravity.1 is inf"),
    (lambda: block(loads=endless()), masonry.SceneError, "[Cc]ircular|recursion"),
    (lambda: block(thickness={1, 2}), TypeError, "set"),
    (lambda: masonry.Scene.read("no.toml"), masonry.SceneError, "no.toml"),
    (lambda: masonry.Scene.read("title = \n"), masonry.SceneError, "line 1"),
    (lambda: block().limit("wind"), masonry.SceneError, "wind"),
    (lambda: block().limit(law="plastic"), ValueError, "associative, path, both"),
    (lambda: block().least_thickness("arch"), masonry.SceneError, "arch"),
    (lambda: block().study(routes=["simplex"]), ValueError, "routes: unknown variant"),
    (lambda: block().study(tolerances=[2.0]), ValueError, "between 0 and 1"),
    (lambda: block().study(meshes=[]), ValueError, "mesh factor"),
    (lambda: block().study(time_limit=-1), ValueError, "time_limit is -1"),
    (lambda: block().solve().plot("video"), ValueError, "choose one of"),
    (lambda: masonry.map([block()], workers=0), ValueError, "workers is 0: give at least 1"),
    (lambda: masonry.import_drawing("no.dxf"), OSError, "no.dxf"),
    (lambda: masonry.import_drawing(__file__), masonry.SceneError, "test_refusals.py: a drawing must be"),
    (lambda: masonry.from_compas([1.0]), TypeError, "body 0 is of type float"),
    (lambda: masonry.from_compas([], mu=0.5), masonry.SceneError, "compas.json"),
    (lambda: masonry.from_compas([], colour="red"), TypeError, "no option 'colour'"),
    (lambda: masonry.from_compas([], unit="ell"), ValueError, "unit is \"ell\", but must be one of: mm"),
]


@pytest.mark.parametrize(("call", "kind", "message"), WRONG, ids=range(len(WRONG)))
def test_wrong_input_is_refused_with_its_place(call, kind, message):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        with pytest.raises(kind, match=message):
            call()


ODD = [
    np.zeros((0, 0)),
    np.zeros((0, 3)),
    np.zeros((3, 0)),
    np.full((2, 2), NAN),
    np.full((2, 2), 1e308),
    np.full((2, 2), 5e-324),
    np.array([[0.0, -0.0], [-1e-300, 1e300]]),
    np.eye(3)[::-1],
    np.asfortranarray(np.eye(4))[1:, ::2],
    scipy.sparse.csc_matrix((0, 0)),
    scipy.sparse.csr_matrix((3, 3)),
    scipy.sparse.random(3, 3, 0.5, random_state=1, format="coo"),
    np.eye(2, dtype=bool),
    np.eye(2, dtype=np.float32),
    np.array([[2**63 - 1, 0], [0, -(2**63)]]),
    "text",
    {},
    [[]],
]
SIDES = [[], [1.0], [1.0, -1.0], [-1.0, 1e308], [NAN, 1.0], [0.0] * 3, [-1.0] * 4, "text", None]


@pytest.mark.parametrize("method", ["auto", "lemke", "newton", "interior", "qp", "pgs", "enumeration"])
def test_odd_data_are_solved_or_refused_without_a_panic(method):
    # A panic would be a BaseException, which this does not catch.
    for M, q in itertools.product(ODD, SIDES):
        try:
            answer = lcp.solve(M, q, method=method, time_limit=1.0)
        except (ValueError, TypeError, OverflowError):
            continue
        assert not answer.is_solved or np.isfinite([answer.z, answer.w]).all()


def test_odd_data_of_the_other_forms_end_without_a_panic():
    calls = [
        lambda M, q: lcp.solve_horizontal(M, M, q, time_limit=1.0),
        lambda M, q: lcp.solve_mixed(M, q, [True] * len(q or []), time_limit=1.0),
        lambda M, q: lcp.solve_boxed(M, q, -1.0, 1.0, time_limit=1.0),
        lambda M, q: lcp.qp(M, q, M, -1.0, 1.0, time_limit=1.0),
        lambda M, q: lcp.solve_many([(M, q)], time_limit=1.0),
        lambda M, q: lcp.Sequence(M, time_limit=1.0).solve(q),
        lambda M, q: lcp.Contact2d(M, q).solve(time_limit=1.0),
    ]
    ended = 0
    for call, M, q in itertools.product(calls, ODD, SIDES):
        try:
            call(M, q)
        except (ValueError, TypeError, OverflowError):
            pass
        ended += 1
    assert ended == len(calls) * len(ODD) * len(SIDES)


def test_damaged_sparse_matrices_are_refused():
    def given(**damage):
        parts = {
            "shape": [2, 2],
            "by_rows": False,
            "starts": np.array([0, 1, 2]),
            "indices": np.array([0, 1]),
            "values": np.ones(2),
        }
        return {**parts, **damage}

    settings = {"method": "auto", "tol": None, "time_limit": None, "max_iterations": None, "callback": None}
    damages = [
        {"starts": np.array([0, 2, 1])},
        {"starts": np.array([0, 1, 3])},
        {"starts": np.array([1, 1, 2])},
        {"starts": np.array([], dtype=np.int64)},
        {"indices": np.array([0, -1])},
        {"indices": np.array([0, 2])},
        {"indices": np.array([0])},
        {"starts": np.array([0, 2, 2]), "indices": np.array([0, 0])},
        {"values": np.ones(3)},
        {"shape": [2, 5]},
    ]
    for damage, by_rows in itertools.product(damages, [False, True]):
        with pytest.raises(ValueError):
            _native.solve_standard(given(by_rows=by_rows, **damage), np.ones(2), settings)
    # Without damage it is a matrix.
    assert _native.solve_standard(given(), np.ones(2), settings).status == "Solved"


def test_texts_of_scenes_that_are_cut_anywhere_are_refused_or_read():
    text = (pathlib.Path(__file__).parents[3] / "scenes" / "wall_settlement.toml").read_text()
    for end in range(1, len(text), 37):
        try:
            masonry.Scene.read(text[:end] + "\n")
        except masonry.SceneError:
            pass
