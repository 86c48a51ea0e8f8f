"""Scenes from drawings and from COMPAS."""

import json

import numpy as np
import pytest

import masonry

#: The faces of a prism with four corners at the front, then the same at the back.
PRISM = [[3, 2, 1, 0], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]


def prism(corners, depth=0.5, turn=0.0):
    """Corners in an upright plane, and those behind it; the plane is turned about the vertical axis."""
    x, z = np.array(corners, dtype=float).T
    front = np.column_stack([x, np.zeros(4), z])
    points = np.vstack([front, front + [0.0, depth, 0.0]])
    c, s = np.cos(turn), np.sin(turn)
    return points @ np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])


def voussoirs(thickness, count=20, turn=0.0):
    """A semicircular arch of the mean radius 1 in an upright plane."""
    angles = np.linspace(0.0, np.pi, count + 1)
    inner, outer = 1.0 - 0.5 * thickness, 1.0 + 0.5 * thickness
    for a, b in zip(angles, angles[1:]):
        section = [(r * np.cos(t), r * np.sin(t)) for r, t in ((inner, a), (outer, a), (outer, b), (inner, b))]
        yield prism(section, turn=turn), PRISM


def standing(thickness, **options):
    """An arch of COMPAS that begins on its springings."""
    imported = masonry.from_compas(voussoirs(thickness, **options), mu=0.8)
    return imported.scene.solve().verdict


class Body:
    """A mesh as COMPAS has it, as far as it is asked."""

    def __init__(self, vertices, faces, name, **attributes):
        self.name, self.attributes = name, attributes
        self._data = vertices, faces

    def to_vertices_and_faces(self):
        return self._data


def test_an_arch_stands_from_the_thickness_of_milankovitch():
    # 20 voussoirs: 0.10735 of the mean radius, by limit analysis (the limit of many is 0.1075, Milankovitch 1907).
    assert standing(0.109) == "stands" and standing(0.106) == "falls"
    assert standing(0.109, turn=0.7) == "stands"


#: Semicircular arches of compas_cra 0.8.0 (`Arch(height=5, span=10, depth=0.5, extra_support=True)`, mu = 0.7, density 1): number of
#: voussoirs, thickness, and the normal force at a springing that `cra_solve` found, or None if it ended as infeasible.
COMPAS_CRA = [
    (20, 0.50, None), (20, 0.55, None), (20, 0.56, None), (20, 0.57, 2.3563), (20, 0.60, 2.4873), (20, 0.70, 2.9292),
    (40, 0.60, 2.4950), (40, 0.80, 3.3894),
]  # fmt: skip


@pytest.mark.parametrize(("count", "thickness", "springing"), COMPAS_CRA)
def test_arches_of_compas_cra_have_its_answers(count, thickness, springing):
    radius = 5.0 + 0.5 * thickness
    bodies = [(radius * points, faces) for points, faces in voussoirs(thickness / radius, count)]
    scene = masonry.from_compas(bodies, mu=0.7, density=1000).scene
    outcome = scene.solve()
    assert outcome.verdict == ("falls" if springing is None else "stands")
    if springing is not None:
        # The depth of the bodies grew with the radius, and a unit of weight is 9.81 kN.
        points = outcome.contacts[outcome.contacts["a"] == "floor"]
        first = points["b"] == "block 0"
        assert points["t_n_kN"][first].sum() == pytest.approx(9.81 * radius * springing, rel=2e-4)


def test_supports_names_and_depth_come_from_the_bodies():
    square = [[0, 0], [1, 0], [1, 1], [0, 1]]
    base = Body(prism(square), PRISM, "base", is_support=True)
    top = Body(prism(np.array(square) + [0.2, 1]), PRISM, "top")
    imported = masonry.from_compas([base, top], density=2500)
    scene = imported.scene
    assert [it["name"] for it in scene["blocks"]] == ["top"] and scene["thickness"] == pytest.approx(0.5)
    # The body of 1 m x 1 m x 0.5 m weighs 12.26 kN.
    reactions = scene.solve().details["reactions"]
    assert sum(it["fy"] for it in reactions.values()) == pytest.approx(2.5 * 9.81 * 0.5, rel=1e-3)
    assert "2500" in imported.report() or "density" in imported.report()
    assert imported.plot().startswith("<svg") and "[[blocks]]" in imported.to_toml()


def test_real_compas_objects_give_the_same():
    compas = pytest.importorskip("compas.datastructures", reason="COMPAS is not installed: pip install compas")
    meshes = [compas.Mesh.from_vertices_and_faces(*it) for it in voussoirs(0.12)]
    scene = masonry.from_compas(meshes, mu=0.8).scene
    ours = masonry.from_compas(voussoirs(0.12), mu=0.8).scene
    for a, b in zip(scene["blocks"], ours["blocks"]):
        np.testing.assert_allclose(a["corners"], b["corners"], atol=1e-12)
    assembly = compas.Assembly()
    for mesh in meshes:
        assembly.add_part(compas.Part(geometry=mesh)) if hasattr(compas, "Part") else assembly.add_part(mesh)
    assert len(masonry.from_compas(assembly, mu=0.8).scene["blocks"]) == 20


def test_assemblies_of_compas_assembly_are_read():
    reason = "compas_assembly is not installed: pip install compas_assembly"
    assemblies = pytest.importorskip("compas_assembly.datastructures", reason=reason)
    assembly = assemblies.Assembly()
    for k, (vertices, faces) in enumerate(voussoirs(0.12)):
        block = assemblies.Block.from_vertices_and_faces(vertices, faces)
        assembly.add_block(block, node=k, is_support=k in (0, 19))
    scene = masonry.from_compas(assembly, mu=0.8).scene
    assert len(scene["blocks"]) == 18 and scene.solve().verdict == "stands"


def test_files_of_compas_are_read(tmp_path):
    bodies = [
        {
            "vertex": {str(k): dict(zip("xyz", map(float, it))) for k, it in enumerate(points)},
            "face": {str(k): face for k, face in enumerate(faces)},
        }
        for points, faces in voussoirs(0.12)
    ]
    path = tmp_path / "arch.json"
    path.write_text(json.dumps({"dtype": "compas.datastructures/Assembly", "data": bodies}))
    scene = masonry.from_compas(path, mu=0.8).scene
    assert len(scene["blocks"]) == 20 and scene["title"] == "arch"


def test_what_is_not_plane_is_refused_with_its_name():
    square = [[0, 0], [1, 0], [1, 1], [0, 1]]
    straight, leaning = prism(square), prism(np.array(square) + [0, 1])
    leaning[4:, 0] += 0.3
    with pytest.raises(masonry.SceneError, match='block "leaning".*prism'):
        masonry.from_compas([Body(straight, PRISM, "straight"), Body(leaning, PRISM, "leaning")])
    deeper = prism(np.array(square) + [0.2, 1], depth=0.8)
    with pytest.raises(masonry.SceneError, match='block "deeper"'):
        masonry.from_compas([Body(straight, PRISM, "straight"), Body(deeper, PRISM, "deeper")])


def test_drawings_are_mended_or_refused_with_a_remedy(tmp_path):
    lower = {"material": "stone", "corners": [[0, 0], [2, 0], [2, 1], [0, 1]]}
    upper = {"material": "stone", "corners": [[0, 0.9], [2, 0.9], [2, 2], [0, 2]]}
    path = tmp_path / "two.json"
    path.write_text(json.dumps([lower, upper]))
    with pytest.raises(masonry.SceneError, match=r"two.json: .*overlap.*--tolerance"):
        masonry.import_drawing(path)
    imported = masonry.import_drawing(path, tolerance=0.2, mu=0.5, title="Two stones")
    assert imported.scene["title"] == "Two stones" and "corners were moved" in imported.report()
    assert imported.scene.solve().verdict == "stands"
    svg = tmp_path / "one.svg"
    svg.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="2000mm" height="1000mm" viewBox="0 0 2000 1000">'
        '<rect x="0" y="0" width="2000" height="1000"/></svg>'
    )
    corners = masonry.import_drawing(svg).scene["blocks.0.corners"]
    assert np.ptp(corners, axis=0).tolist() == pytest.approx([2.0, 1.0])
