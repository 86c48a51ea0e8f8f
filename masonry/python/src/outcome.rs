//! The result of a solved scene for Python.
#![expect(clippy::needless_pass_by_value, reason = "functions own what they take from Python")]

use std::path::PathBuf;

use masonry_report::{self as report, csv, json, page, svg};
use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::{PyOSError, PyValueError};
use pyo3::prelude::*;

use crate::failure::failed;

/// The result of a solved scene.
#[pyclass(frozen)]
pub(crate) struct Outcome {
    pub(crate) outcome: masonry::Outcome,
}

#[pymethods]
impl Outcome {
    #[getter]
    fn verdict(&self) -> String {
        self.outcome.verdict().to_string().to_lowercase()
    }

    #[getter]
    fn sentence(&self) -> String {
        self.outcome.judgement.sentence.clone()
    }

    #[getter]
    fn status(&self) -> String {
        self.outcome.solve.status.to_string()
    }

    fn report(&self) -> String {
        report::table::report(&self.outcome)
    }

    fn json(&self) -> PyResult<String> {
        json::result(&self.outcome, &[]).map_err(failed)
    }

    fn page(&self) -> String {
        page::solved(&self.outcome, &[], None, None)
    }

    /// Returns the contact points as CSV; `None` without a state.
    fn contacts(&self) -> Option<String> {
        self.outcome.state.as_ref().map(|state| csv::contacts(&self.outcome.model, state))
    }

    /// Returns the steps of the load history as CSV; `None` without a load history.
    fn history(&self) -> Option<String> {
        self.outcome.history.as_ref().map(|history| csv::history(&self.outcome.model, history))
    }

    /// Returns a row for every node, or corner of a rigid block: index of the block, x, y, and displacements in x and
    /// y. `None` without a state.
    fn nodes(&self, py: Python<'_>) -> PyResult<Option<Py<PyArray2<f64>>>> {
        let masonry::Outcome { model, state, .. } = &self.outcome;
        let Some(state) = state else { return Ok(None) };
        let unit = model.units.length_to_si();
        let mut rows = Vec::new();
        for (number, (block, moved)) in (0_u32..).zip(model.blocks.iter().zip(&state.displacements))
        {
            let places = block.mesh.as_ref().map_or(&block.corners, |mesh| &mesh.nodes);
            for (place, u) in places.iter().zip(moved) {
                let lengths = [place.x, place.y, u.x, u.y].map(|it| it / unit);
                rows.push([&[f64::from(number)], &lengths[..]].concat());
            }
        }
        Ok(Some(PyArray2::from_vec2(py, &rows)?.unbind()))
    }

    /// Returns a row for every element: indices of block and element, x and y of the centre, two normal stresses and
    /// the shear stress, two principal stresses, and their direction \[rad\]. `None` without stresses.
    fn stresses(&self, py: Python<'_>) -> PyResult<Option<Py<PyArray2<f64>>>> {
        let masonry::Outcome { model, state, .. } = &self.outcome;
        let Some(state) = state.as_ref().filter(|state| !state.stresses.is_empty()) else {
            return Ok(None);
        };
        let (length, stress) = (model.units.length_to_si(), model.units.stress_to_si());
        let row = |it: &masonry::data::state::ElementStress| {
            let [x, y] = [it.centre.x, it.centre.y].map(|it| it / length);
            let [sx, sy, txy] = it.sigma.map(|it| it / stress);
            let [s1, s2] = [it.principal.sigma_1, it.principal.sigma_2].map(|it| it / stress);
            vec![
                it.block.index() as f64,
                it.element as f64,
                x,
                y,
                sx,
                sy,
                txy,
                s1,
                s2,
                it.principal.theta,
            ]
        };
        let rows: Vec<Vec<f64>> = state.stresses.iter().map(row).collect();
        Ok(Some(PyArray2::from_vec2(py, &rows)?.unbind()))
    }

    /// Returns rigid blocks as polygons and elements as quadrilaterals; blocks share no points.
    fn mesh(&self, py: Python<'_>) -> PyResult<Mesh> {
        let masonry::Outcome { model, state, .. } = &self.outcome;
        let (unit, stress_unit) = (model.units.length_to_si(), model.units.stress_to_si());
        let mut mesh = MeshRows::default();
        for (number, block) in model.blocks.iter().enumerate() {
            let first = mesh.points.len();
            let places = block.mesh.as_ref().map_or(&block.corners, |mesh| &mesh.nodes);
            mesh.points.extend(places.iter().map(|it| vec![it.x / unit, it.y / unit]));
            let moved = state.as_ref().and_then(|state| state.displacements.get(number));
            for node in 0..places.len() {
                let u = moved.and_then(|moved| moved.get(node));
                mesh.moves.push(u.map_or(vec![0.0; 2], |u| vec![u.x / unit, u.y / unit]));
            }
            mesh.first_cells.push(mesh.blocks.len());
            let mut cell = |nodes: &mut dyn Iterator<Item = usize>| {
                mesh.nodes.extend(nodes.map(|node| first + node));
                mesh.ends.push(mesh.nodes.len());
                mesh.blocks.push(number);
            };
            match &block.mesh {
                Some(mesh) => mesh.elements.iter().for_each(|it| cell(&mut it.iter().copied())),
                None => cell(&mut (0..places.len())),
            }
        }
        // The stress in a rigid block is unknown.
        let mut stresses = vec![vec![f64::NAN; 5]; mesh.blocks.len()];
        for it in state.iter().flat_map(|state| &state.stresses) {
            let [x, y, shear] = it.sigma;
            let all = [x, y, shear, it.principal.sigma_1, it.principal.sigma_2];
            let place = mesh.first_cells[it.block.index()] + it.element;
            stresses[place] = all.iter().map(|it| it / stress_unit).collect();
        }
        Ok(Mesh {
            points: PyArray2::from_vec2(py, &mesh.points)?.unbind(),
            displacements: PyArray2::from_vec2(py, &mesh.moves)?.unbind(),
            nodes: PyArray1::from_vec(py, mesh.nodes).unbind(),
            ends: PyArray1::from_vec(py, mesh.ends).unbind(),
            blocks: PyArray1::from_vec(py, mesh.blocks).unbind(),
            stresses: PyArray2::from_vec2(py, &stresses)?.unbind(),
        })
    }

    /// Returns names and corners of all blocks.
    fn blocks(&self) -> Vec<(String, Vec<[f64; 2]>)> {
        let unit = self.outcome.model.units.length_to_si();
        let blocks = self.outcome.model.blocks.iter();
        let corners = |corners: &[nalgebra::Point2<f64>]| {
            corners.iter().map(|it| [it.x / unit, it.y / unit]).collect()
        };
        blocks.map(|block| (block.name.clone(), corners(&block.corners))).collect()
    }

    /// Draws a picture as SVG; `None` if there is nothing to show.
    fn picture(&self, name: &str) -> PyResult<Option<String>> {
        let masonry::Outcome { model, state, history, mechanism, title, .. } = &self.outcome;
        let state = state.as_ref();
        Ok(match name {
            "scene" => Some(svg::scene(title, model)),
            "deformed" => state.map(|it| svg::deformed(title, model, it)),
            "forces" => state.map(|it| svg::forces(title, model, &it.contacts)),
            "cracks" => state.and_then(|it| svg::cracks(title, model, &it.contacts)),
            "stresses" => state
                .filter(|it| !it.stresses.is_empty())
                .map(|it| svg::principal_stresses(title, model, it, None)),
            "history" => history.as_ref().and_then(|it| svg::history(title, model, it)),
            "mechanism" => mechanism.as_ref().map(|it| svg::mechanism(title, model, it)),
            other => {
                return Err(PyValueError::new_err(format!(
                    "there is no picture {other:?}: choose one of scene, deformed, forces, cracks, stresses, history, \
                     mechanism"
                )));
            }
        })
    }

    /// Writes all files of the result into a directory, and returns their paths.
    fn save(&self, directory: PathBuf) -> PyResult<Vec<PathBuf>> {
        masonry_report::write_all(
            &self.outcome,
            &directory,
            &masonry_report::ReportOptions::default(),
        )
        .map_err(|error| PyOSError::new_err(error.to_string()))
    }
}

/// Points and cells of all blocks, as rows from which arrays are made.
#[derive(Default)]
struct MeshRows {
    points: Vec<Vec<f64>>,
    moves: Vec<Vec<f64>>,
    nodes: Vec<usize>,
    ends: Vec<usize>,
    blocks: Vec<usize>,
    /// The index of the first cell of every block.
    first_cells: Vec<usize>,
}

/// The mesh of all blocks: points with their displacements, and cells with their blocks and stresses.
#[pyclass(frozen, get_all)]
pub(crate) struct Mesh {
    points: Py<PyArray2<f64>>,
    displacements: Py<PyArray2<f64>>,
    /// Indices of the points of all cells, one cell after the other.
    nodes: Py<PyArray1<usize>>,
    /// The end of each cell in `nodes`.
    ends: Py<PyArray1<usize>>,
    blocks: Py<PyArray1<usize>>,
    /// A row for each cell: two normal stresses, the shear stress and two principal stresses; NaN in a rigid block.
    stresses: Py<PyArray2<f64>>,
}
