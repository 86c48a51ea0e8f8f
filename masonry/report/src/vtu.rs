//! Meshes and fields for `ParaView`: VTK XML `UnstructuredGrid` with appended raw data.

use std::fmt::Write as _;

use nalgebra::Vector2;

use super::format::InUnits;
use super::summary::nodes;
use masonry::data::state::{ElementStress, State};
use masonry::model::Model;

const QUAD: u8 = 9;
const POLYGON: u8 = 7;

/// Returns the bytes of `panel.vtu`: every element as a quadrilateral, and every rigid block as one polygon.
///
/// Blocks share no points, so that joints can open. Point data: `displacement_m` (3 components). Cell data: `block`
/// (position in the model), `deformable` (0 for rigid blocks, whose stresses are unknown and written as zero), and
/// `sigma_x_kN/m2` and so on if stresses were recovered. The names carry the units of the scene. Without a state, the
/// file has the geometry alone.
pub fn vtu(model: &Model, state: Option<&State>) -> Vec<u8> {
    let units = InUnits(model.units);
    let grid = Grid::of(model);
    let mut file = Appended::default();

    let length = model.units.length_name();
    let point_data = state.map_or(String::new(), |state| {
        let moves = grid.displacements(model, state, units);
        file.floats(&format!("displacement_{length}"), 3, &moves)
    });
    let mut cell_data = file.integers("block", &grid.blocks);
    cell_data += &file.bytes("deformable", &grid.deformable);
    if let Some(state) = state
        && !state.stresses.is_empty()
    {
        for (name, component) in STRESSES {
            let values = grid.stresses(state, |stress| units.stress(component(stress)));
            cell_data += &file.floats(&format!("{name}_{}", model.units.stress_name()), 1, &values);
        }
    }
    let positions: Vec<f64> = grid.points.iter().map(|metres| units.length(*metres)).collect();
    let points = file.floats(&format!("position_{length}"), 3, &positions);
    let mut cells = file.integers("connectivity", &grid.connectivity);
    let count = grid.blocks.len();
    let ends: Vec<i64> = grid.ends.iter().map(|end| signed(*end)).collect();
    cells += &file.integers("offsets", &ends);
    cells += &file.bytes("types", &grid.types);

    let mut bytes = format!(
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" \
         header_type=\"UInt64\">\n<UnstructuredGrid>\n\
         <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{count}\">\n\
         <PointData>\n{point_data}</PointData>\n<CellData>\n{cell_data}</CellData>\n\
         <Points>\n{points}</Points>\n<Cells>\n{cells}</Cells>\n\
         </Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_",
        grid.points.len() / 3
    )
    .into_bytes();
    bytes.extend_from_slice(&file.data);
    bytes.extend_from_slice(b"\n</AppendedData>\n</VTKFile>\n");
    bytes
}

type Component = fn(&ElementStress) -> f64;

const STRESSES: [(&str, Component); 5] = [
    ("sigma_x", |stress| stress.sigma[0]),
    ("sigma_y", |stress| stress.sigma[1]),
    ("tau_xy", |stress| stress.sigma[2]),
    ("sigma_1", |stress| stress.principal.sigma_1),
    ("sigma_2", |stress| stress.principal.sigma_2),
];

/// The mesh of all blocks as one list of points and cells.
#[derive(Debug, Default)]
struct Grid {
    /// Three coordinates for each point \[m\].
    points: Vec<f64>,
    connectivity: Vec<i64>,
    /// The end of each cell in `connectivity`, which lists the points of all cells one after the other.
    ends: Vec<usize>,
    types: Vec<u8>,
    blocks: Vec<i64>,
    deformable: Vec<u8>,
    /// The index of the first cell of every block.
    first_cell: Vec<usize>,
}

impl Grid {
    fn of(model: &Model) -> Self {
        let mut grid = Self::default();
        for (index, block) in model.blocks.iter().enumerate() {
            let first_point = grid.points.len() / 3;
            grid.first_cell.push(grid.blocks.len());
            for node in nodes(block) {
                grid.points.extend([node.x, node.y, 0.0]);
            }
            let mut cell = |nodes: &mut dyn Iterator<Item = usize>, is_elastic: bool| {
                grid.connectivity.extend(nodes.map(|node| signed(first_point + node)));
                let count = grid.connectivity.len() - grid.ends.last().copied().unwrap_or(0);
                grid.ends.push(grid.connectivity.len());
                grid.types.push(if count == 4 { QUAD } else { POLYGON });
                grid.blocks.push(signed(index));
                grid.deformable.push(u8::from(is_elastic));
            };
            match &block.mesh {
                Some(mesh) => {
                    mesh.elements.iter().for_each(|it| cell(&mut it.iter().copied(), true));
                }
                None => cell(&mut (0..block.corners.len()), false),
            }
        }
        grid
    }

    fn displacements(&self, model: &Model, state: &State, units: InUnits) -> Vec<f64> {
        let mut values = Vec::with_capacity(self.points.len());
        for (index, block) in model.blocks.iter().enumerate() {
            let moves = state.displacements.get(index).map_or(&[][..], Vec::as_slice);
            for node in 0..nodes(block).len() {
                let u = moves.get(node).copied().unwrap_or_else(Vector2::zeros);
                values.extend([units.length(u.x), units.length(u.y), 0.0]);
            }
        }
        values
    }

    fn stresses(&self, state: &State, value: impl Fn(&ElementStress) -> f64) -> Vec<f64> {
        let mut values = vec![0.0; self.blocks.len()];
        for stress in &state.stresses {
            values[self.first_cell[stress.block.index()] + stress.element] = value(stress);
        }
        values
    }
}

/// The raw data after the XML, and the XML elements that refer to the data.
#[derive(Debug, Default)]
struct Appended {
    data: Vec<u8>,
}

impl Appended {
    fn floats(&mut self, name: &str, components: usize, values: &[f64]) -> String {
        let bytes = values.iter().flat_map(|value| value.to_le_bytes()).collect::<Vec<u8>>();
        self.array("Float64", name, components, &bytes)
    }

    fn integers(&mut self, name: &str, values: &[i64]) -> String {
        let bytes = values.iter().flat_map(|value| value.to_le_bytes()).collect::<Vec<u8>>();
        self.array("Int64", name, 1, &bytes)
    }

    fn bytes(&mut self, name: &str, values: &[u8]) -> String {
        self.array("UInt8", name, 1, values)
    }

    fn array(&mut self, kind: &str, name: &str, components: usize, bytes: &[u8]) -> String {
        let mut tag = String::new();
        // Writing to a String never fails.
        let _ = writeln!(
            tag,
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" \
             format=\"appended\" offset=\"{}\"/>",
            self.data.len()
        );
        self.data.extend_from_slice(&(bytes.len() as u64).to_le_bytes());
        self.data.extend_from_slice(bytes);
        tag
    }
}

/// Converts an index into a signed integer, which VTK requires; no scene comes near the limit of this type.
fn signed(index: usize) -> i64 {
    i64::try_from(index).unwrap_or(i64::MAX)
}
