"""What scenes give as data: plans, studies, meshes, bars."""

import pathlib
import sys

import numpy as np
import pytest

import masonry

SCENES = pathlib.Path(__file__).parents[3] / "scenes"


def column(elastic=True):
    """Three blocks of 1 m x 1 m on each other under a weight, whose stresses are known."""
    stone = {"E": 1e6, "nu": 0.0} if elastic else {}
    square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    mesh = {"mesh": [2, 3]} if elastic else {}
    return masonry.Scene(
        thickness=1.0,
        plane="stress",
        units={"length": "m", "force": "kN"},
        materials={"stone": stone},
        joints={"bed": {"mu": 0.6}},
        blocks=[
            {"name": f"block {k}", "material": "stone", "corners": square + [0, k], **mesh} for k in range(3)
        ],
        supports=[{"name": "ground", "from": [0, 0], "to": [1, 0], "joint": "bed"}],
        loads=[{"name": "top", "from": [0, 3], "to": [1, 3], "pressure": 50.0}],
    )


def area(points):
    x, y = points[:, 0], points[:, 1]
    return 0.5 * (x @ np.roll(y, -1) - y @ np.roll(x, -1))


def test_a_plan_is_data_and_text():
    plan = masonry.Scene.read(SCENES / "panel_square.toml").plan()
    # 10 courses of 10 bricks, and half a brick more in every other course.
    assert plan.details["blocks"] == 105 and not plan.is_refused
    on = {it["name"]: it["on"] for it in plan.details["effects"]}
    assert on["friction"] and not on["mortar films"]
    routes = plan.details["routes"]
    assert all(it["memory_bytes"] > 0 and it["because"] for it in routes)
    assert str(plan) == plan.report() and "friction" in plan.report() and "blocks 105" in repr(plan)


def test_a_mesh_has_the_stresses_and_displacements_of_a_column():
    mesh = column().solve().mesh()
    (kind, quads), = mesh.cells
    assert kind == "quad" and quads.shape == (18, 4) and mesh.points.shape == (3 * 12, 3)
    # 50 kN on 1 m2: stress -50 kN/m2 everywhere, and a shortening of 5e-5 of the height.
    np.testing.assert_allclose(mesh.cell_data["sigma_y"][0], -50.0, rtol=1e-6)
    np.testing.assert_allclose(mesh.cell_data["sigma_2"][0], -50.0, rtol=1e-6)
    np.testing.assert_allclose(mesh.cell_data["sigma_1"][0], 0.0, atol=1e-5)
    moved = mesh.point_data["displacement"]
    np.testing.assert_allclose(moved[:, 1], -5e-5 * mesh.points[:, 1], atol=1e-10)
    assert sum(area(mesh.points[cell]) for cell in quads) == pytest.approx(3.0)
    assert np.bincount(mesh.cell_data["block"][0]).tolist() == [6, 6, 6]


def test_rigid_blocks_are_polygons_without_stresses():
    scene = column(elastic=False)
    scene["blocks.2.corners"] = [[0, 2], [1, 2], [1, 3], [0.5, 3.5], [0, 3]]
    scene["loads.0.from"], scene["loads.0.to"] = [0.5, 3.5], [0, 3]
    mesh = scene.solve().mesh()
    assert [(kind, nodes.shape) for kind, nodes in mesh.cells] == [("quad", (2, 4)), ("polygon", (1, 5))]
    assert [it.tolist() for it in mesh.cell_data["block"]] == [[0, 1], [2]]
    assert all(np.isnan(it).all() for it in mesh.cell_data["sigma_y"])
    cells, types = mesh.vtk()
    assert types.tolist() == [9, 9, 7]
    assert cells.tolist() == [4, 0, 1, 2, 3, 4, 4, 5, 6, 7, 5, 8, 9, 10, 11, 12]


def test_meshio_takes_a_mesh(tmp_path):
    meshio = pytest.importorskip("meshio", reason="meshio is not installed: pip install meshio")
    mesh = column().solve().mesh()
    made = meshio.Mesh(mesh.points, mesh.cells, mesh.point_data, mesh.cell_data)
    made.write(tmp_path / "column.vtu")
    again = meshio.read(tmp_path / "column.vtu")
    np.testing.assert_array_equal(again.cells[0].data, mesh.cells[0][1])
    np.testing.assert_array_equal(again.cell_data["sigma_y"][0], mesh.cell_data["sigma_y"][0])


def test_pyvista_takes_a_mesh():
    pyvista = pytest.importorskip("pyvista", reason="pyvista is not installed: pip install pyvista")
    mesh = column().solve().mesh()
    grid = pyvista.UnstructuredGrid(*mesh.vtk(), mesh.points)
    assert grid.n_cells == 18
    assert grid.compute_cell_sizes()["Area"].sum() == pytest.approx(3.0)


def test_a_study_has_a_record_for_every_solve():
    heard = set()
    study = column().study(
        routes=["lemke", "interior"],
        tolerances=[1e-6, 1e-10],
        meshes=[1, 2],
        repeats=1,
        callback=lambda *told: heard.add(told) and False,
    )
    records = study.records
    assert len(records) == 8 and (records["status"] == "Solved").all()
    assert records["route"].tolist() == (["lemke"] * 2 + ["interior"] * 2) * 2
    assert records["mesh"].tolist() == [1] * 4 + [2] * 4 and records["overrun"].dtype == bool
    assert (records["residual"] <= records["tolerance"]).all() and (records["time_s"] > 0).all()
    # The stress is the same everywhere, which elements have without an error.
    assert np.nanmax(records["error_stress"]) < 1e-6
    meshes = study.meshes
    assert meshes["elements"].tolist() == [18, 72]
    # sigma^2 / (2 E) times the volume: 2500 / 2e6 * 3 kNm.
    np.testing.assert_allclose(meshes["strain_energy"], 3.75e-3, rtol=1e-6)
    assert not study.is_interrupted and "lemke" in study.report() and repr(study) == "<Study: 8 of 8 solved>"
    assert study.plot().startswith("<svg")
    # The most accurate solution of each mesh, to a tighter tolerance, comes besides.
    assert {it[:2] for it in heard} == set(records[["mesh", "route"]].tolist())


def test_a_route_that_does_not_treat_a_scene_says_so():
    study = column(elastic=False).study(routes=["alm", "forces"], tolerances=[1e-8])
    assert study.records["status"].tolist() == ["Refused", "Solved"]
    assert "elastic" in study.records["reason"][0] and study.records["reason"][1] == ""


@pytest.fixture(params=["tqdm", "none"])
def bars(request, monkeypatch):
    """Bars of tqdm, and the lines of those who have none."""
    if request.param == "tqdm":
        pytest.importorskip("tqdm", reason="tqdm is not installed: pip install tqdm")
    else:
        monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    return request.param


def test_bars_are_shown_and_change_no_result(bars, capsys):
    scene = column()
    assert scene.solve(progress=True).verdict == scene.solve().verdict == "stands"
    assert "solve" in capsys.readouterr().err
    walls = masonry.Scene.read(SCENES / "ferris_wall_1.toml")
    assert walls.limit(law="associative", progress=True).sentence == walls.limit(law="associative").sentence
    assert "limit" in capsys.readouterr().err
    rigid = column(elastic=False)
    assert rigid.ranges(progress=True).details == rigid.ranges().details
    study = scene.study(routes=["lemke"], tolerances=[1e-6], meshes=[1], repeats=1, progress=True)
    assert len(study.records) == 1
    shown = capsys.readouterr().err
    assert "ranges" in shown and "study" in shown
    history = masonry.Scene.read(SCENES / "wall_settlement.toml")
    heard = []
    outcome = history.solve(progress=True, callback=lambda *told: heard.append(told))
    shown = capsys.readouterr().err
    assert f"/{len(outcome.history)}" in shown and heard
    assert sum(it.result.verdict == "stands" for it in masonry.map([rigid] * 5, progress=True)) == 5
    assert "5/5" in capsys.readouterr().err


def test_without_a_wish_nothing_is_printed(capsys):
    column().solve()
    list(masonry.map([column()] * 2))
    shown = capsys.readouterr()
    assert shown.out == shown.err == ""
