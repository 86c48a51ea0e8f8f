//! Scenes of walls and arches, and what becomes of them.
#![expect(clippy::needless_pass_by_value, reason = "functions own what they take from Python")]

use std::ops::ControlFlow;
use std::path::PathBuf;

use masonry::analysis::limit::Directions;
use masonry::report::{self, csv, json, page, svg};
use masonry::{Bracket, Event, Laws, LimitError, Plan};
use numpy::PyArray2;
use pyo3::create_exception;
use pyo3::exceptions::{PyOSError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use serde_json::Value;

use crate::watch::Watch;

create_exception!(
    lcp._native,
    SceneError,
    PyValueError,
    "A scene that is wrong, with the place and the remedy."
);

fn wrong(error: impl std::fmt::Display) -> PyErr {
    SceneError::new_err(error.to_string())
}

fn failed(error: impl std::fmt::Display) -> PyErr {
    PyRuntimeError::new_err(error.to_string())
}

/// A scene that was read and checked.
#[pyclass(frozen, name = "Scene")]
pub(crate) struct PyScene {
    scene: masonry::Scene,
}

#[pymethods]
impl PyScene {
    #[staticmethod]
    fn from_toml(text: &str) -> PyResult<Self> {
        Ok(Self { scene: masonry::Scene::from_toml(text).map_err(wrong)? })
    }

    #[staticmethod]
    fn read(path: PathBuf) -> PyResult<Self> {
        Ok(Self { scene: masonry::Scene::read(&path).map_err(wrong)? })
    }

    /// A scene from its keys as JSON.
    #[staticmethod]
    fn from_json(keys: &str) -> PyResult<Self> {
        let mut keys: Value = serde_json::from_str(keys).map_err(wrong)?;
        leave_out_nulls(&mut keys);
        Self::from_toml(&toml::to_string(&keys).map_err(wrong)?)
    }

    fn to_toml(&self) -> PyResult<String> {
        self.scene.to_toml().map_err(wrong)
    }

    fn to_json(&self) -> PyResult<String> {
        serde_json::to_string(&self.scene).map_err(failed)
    }

    fn plan(&self) -> PyResult<String> {
        let model = masonry::Model::from_scene(&self.scene).map_err(wrong)?;
        Ok(report::table::plan(&Plan::of(&self.scene, &model)))
    }

    fn picture(&self) -> PyResult<String> {
        let model = masonry::Model::from_scene(&self.scene).map_err(wrong)?;
        Ok(svg::scene(&self.scene.title, &model))
    }

    #[pyo3(signature = (callback = None))]
    fn solve(&self, py: Python<'_>, callback: Option<Py<PyAny>>) -> PyResult<Outcome> {
        let mut watch = Watch::new(callback.as_ref());
        let outcome = py.detach(|| {
            masonry::solve_observed(&self.scene, &mut |event| match event {
                Event::Iteration { number, residual } => watch.ask(number, residual),
                Event::Pivots(progress) => watch.ask(progress.pivots, progress.artificial),
                _ => ControlFlow::Continue(()),
            })
        });
        watch.finish()?;
        Ok(Outcome { outcome: outcome.map_err(wrong)? })
    }

    /// The limit load of a group, by the laws of a name, in one direction or in both.
    #[pyo3(signature = (group, law, both, callback = None))]
    fn limit(
        &self,
        py: Python<'_>,
        group: Option<&str>,
        law: &str,
        both: bool,
        callback: Option<Py<PyAny>>,
    ) -> PyResult<Found> {
        let laws = match law {
            "associative" => Laws::Associative,
            "path" => Laws::Path,
            "both" => Laws::Both,
            other => {
                return Err(PyValueError::new_err(format!(
                    "law is {other:?}, but must be one of: associative, path, both"
                )));
            }
        };
        let mut scene = self.scene.clone();
        if let Some(group) = group {
            scene = scene.limit_group(group);
        }
        let mut watch = Watch::new(callback.as_ref());
        let found = py.detach(|| -> Result<_, LimitError> {
            let mut asked = 0;
            let mut ask = |known: Bracket| {
                asked += 1;
                watch.ask(asked, known.stands.unwrap_or(f64::NAN))
            };
            let given = masonry::limit_observed(&scene, laws, &mut |known| ask(known))?;
            if !both || given.is_interrupted {
                return Ok(Found::limit(&given));
            }
            let opposite = Directions::opposite(&given, &scene, laws, &mut |known| ask(known))?;
            Ok(Found::directions(&Directions::of(given, opposite)))
        });
        watch.finish()?;
        found.map_err(wrong)?
    }

    fn ranges(&self, py: Python<'_>) -> PyResult<Found> {
        let range = py.detach(|| masonry::ranges(&self.scene)).map_err(wrong)?;
        let text = report::limit::range_table(&range);
        Ok(Found { text, json: report::limit::range_json(&range).map_err(failed)?, page: None })
    }

    fn least_thickness(&self, py: Python<'_>, arch: &str) -> PyResult<Found> {
        let found = py.detach(|| masonry::least_thickness(&self.scene, arch)).map_err(wrong)?;
        let text = report::limit::thickness_table(&found);
        let json = report::limit::thickness_json(&found, &[]).map_err(failed)?;
        Ok(Found { text, json, page: Some(page::thickness(&found)) })
    }
}

/// TOML has no null: keys without a value are left out.
fn leave_out_nulls(value: &mut Value) {
    match value {
        Value::Object(members) => {
            members.retain(|_, value| !value.is_null());
            members.values_mut().for_each(leave_out_nulls);
        }
        Value::Array(values) => values.iter_mut().for_each(leave_out_nulls),
        _ => {}
    }
}

/// What an analysis has found, as text, JSON and a page.
#[pyclass(frozen, get_all)]
pub(crate) struct Found {
    text: String,
    json: String,
    page: Option<String>,
}

impl Found {
    fn limit(limit: &masonry::Limit) -> PyResult<Self> {
        let json = report::limit::json(limit, &[]).map_err(failed)?;
        Ok(Self { text: report::limit::table(limit), json, page: Some(page::limit(limit)) })
    }

    fn directions(both: &Directions) -> PyResult<Self> {
        let json = report::limit::json_both(both, &[]).map_err(failed)?;
        let page = Some(page::limit(both.governing()));
        Ok(Self { text: report::limit::table_both(both), json, page })
    }
}

/// What became of a scene.
#[pyclass(frozen)]
pub(crate) struct Outcome {
    outcome: masonry::Outcome,
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
        page::solved(&self.outcome, &[], None)
    }

    /// The contact points as CSV; `None` without a state.
    fn contacts(&self) -> Option<String> {
        self.outcome.state.as_ref().map(|state| csv::contacts(&self.outcome.model, state))
    }

    /// The steps of the load history as CSV; `None` without one.
    fn history(&self) -> Option<String> {
        self.outcome.history.as_ref().map(|history| csv::history(&self.outcome.model, history))
    }

    /// Block, place and displacement of every node, or corner of a rigid block.
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

    /// Block, element, centre, stresses (normal, normal, shear), principal stresses and direction of every element.
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

    /// Names and corners of all blocks.
    fn blocks(&self) -> Vec<(String, Vec<[f64; 2]>)> {
        let unit = self.outcome.model.units.length_to_si();
        let blocks = self.outcome.model.blocks.iter();
        let corners = |corners: &[nalgebra::Point2<f64>]| {
            corners.iter().map(|it| [it.x / unit, it.y / unit]).collect()
        };
        blocks.map(|block| (block.name.clone(), corners(&block.corners))).collect()
    }

    /// A picture as SVG; `None` if there is nothing to show.
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

    /// Writes all files into a directory, and gives their paths.
    fn save(&self, directory: PathBuf) -> PyResult<Vec<PathBuf>> {
        masonry::write_all(&self.outcome, &directory, &masonry::Options::default())
            .map_err(|error| PyOSError::new_err(error.to_string()))
    }
}
