"""Meshes for other programs that draw or calculate."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lcp import _native

#: The numbers of a triangle, a polygon and a quadrilateral in VTK.
_VTK = {"triangle": 5, "polygon": 7, "quad": 9}
_NAMES = {3: "triangle", 4: "quad"}
_STRESSES = ("sigma_x", "sigma_y", "tau_xy", "sigma_1", "sigma_2")


@dataclass(frozen=True)
class Mesh:
    """Elements of elastic blocks, and rigid blocks as polygons, in the units of the scene.

    Blocks share no points, so that joints can open. The fields are those of :class:`meshio.Mesh`, which takes them as
    ``meshio.Mesh(mesh.points, mesh.cells, mesh.point_data, mesh.cell_data)``.

    Attributes
    ----------
    points : numpy.ndarray
        Places without displacements, three coordinates each.
    cells : list of (str, numpy.ndarray)
        The kind of cells, ``"triangle"``, ``"quad"`` or ``"polygon"``, and the points of each cell. All cells of an entry have
        as many points.
    point_data : dict of str to numpy.ndarray
        ``displacement``.
    cell_data : dict of str to list of numpy.ndarray
        An array for every entry of ``cells``: ``block``, the index in :attr:`Outcome.blocks`, and the stresses ``sigma_x``,
        ``sigma_y``, ``tau_xy``, ``sigma_1``, ``sigma_2``, which are not a number in rigid blocks.
    """

    points: NDArray[np.float64]
    cells: list[tuple[str, NDArray[np.int64]]]
    point_data: dict[str, NDArray[np.float64]]
    cell_data: dict[str, list[NDArray[Any]]]

    @classmethod
    def _of(cls, native: _native.Mesh) -> Mesh:
        nodes, ends, blocks = (
            it.astype(np.int64) for it in (native.nodes, native.ends, native.blocks)
        )
        starts = np.concatenate([[0], ends[:-1]])
        sizes = ends - starts
        # Cells of one size are an entry.
        groups = [np.flatnonzero(sizes == size) for size in np.unique(sizes)]
        columns: dict[str, NDArray[Any]] = {"block": blocks}
        columns.update({name: native.stresses[:, k] for k, name in enumerate(_STRESSES)})
        return cls(
            points=_in_space(native.points),
            cells=[
                (
                    _NAMES.get(int(sizes[group[0]]), "polygon"),
                    nodes[starts[group][:, None] + np.arange(sizes[group[0]])],
                )
                for group in groups
            ],
            point_data={"displacement": _in_space(native.displacements)},
            cell_data={
                name: [values[group] for group in groups] for name, values in columns.items()
            },
        )

    def vtk(self) -> tuple[NDArray[np.int64], NDArray[np.uint8]]:
        """Give cells and their types, the first arguments of :class:`pyvista.UnstructuredGrid`, before the points.

        Examples
        --------
        With pyvista installed::

            mesh = outcome.mesh()
            grid = pyvista.UnstructuredGrid(*mesh.vtk(), mesh.points)
            grid.cell_data["sigma_1"] = numpy.concatenate(mesh.cell_data["sigma_1"])
        """
        counted = [
            np.insert(nodes, 0, nodes.shape[1], axis=1).ravel() for _, nodes in self.cells
        ]
        types = [np.full(len(nodes), _VTK[kind], dtype=np.uint8) for kind, nodes in self.cells]
        return np.concatenate(counted), np.concatenate(types)


def _in_space(plane: NDArray[np.float64]) -> NDArray[np.float64]:
    """Give points of the plane with the coordinate zero across it."""
    return np.column_stack([plane, np.zeros(len(plane))])
