//! Scenes of walls and arches, and their analyses, for Python.
#![expect(clippy::needless_pass_by_value, reason = "functions own what they take from Python")]

use std::ops::ControlFlow;
use std::path::PathBuf;
use std::time::Duration;

use lcp::Iteration;
use masonry::analysis::limit::{Directions, train_observed};
use masonry::analysis::study::{self, StudyError};
use masonry::scene::Combined;
use masonry::{Bracket, Event, Laws, LimitError, Plan};
use masonry_report::svg;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use serde_json::Value;

use crate::failure::{failed, wrong};
use crate::found::{Found, Studied};
use crate::outcome::Outcome;
use crate::watch::{Watch, detached};

/// A scene that was read and checked.
#[pyclass(frozen, name = "Scene")]
pub(crate) struct PyScene {
    pub(crate) scene: masonry::Scene,
}

#[pymethods]
impl PyScene {
    #[staticmethod]
    fn from_toml(text: &str) -> PyResult<Self> {
        Ok(Self { scene: masonry::Scene::from_toml(text).map_err(wrong)? })
    }

    #[staticmethod]
    fn read(path: PathBuf) -> PyResult<Self> {
        Ok(Self { scene: masonry_import::read_scene(&path).map_err(wrong)? })
    }

    /// Creates a scene from its keys as JSON.
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

    /// Returns the plan of the scene, as text and JSON.
    fn plan(&self) -> PyResult<Found> {
        let model = masonry::Model::from_scene(&self.scene).map_err(wrong)?;
        Found::plan(&Plan::of(&self.scene, &model))
    }

    fn picture(&self) -> PyResult<String> {
        let model = masonry::Model::from_scene(&self.scene).map_err(wrong)?;
        Ok(svg::scene(&self.scene.title, &model))
    }

    /// Solves the scene; `callback` receives iterations, and `steps` receives the number of each step of a load history
    /// and the number of all steps.
    #[pyo3(signature = (callback = None, steps = None))]
    fn solve(
        &self,
        py: Python<'_>,
        callback: Option<Py<PyAny>>,
        steps: Option<Py<PyAny>>,
    ) -> PyResult<Outcome> {
        let (mut watch, mut course) = (Watch::new(callback.as_ref()), Watch::new(steps.as_ref()));
        let outcome = detached(py, || {
            masonry::solve_observed(&self.scene, &mut |event| match event {
                Event::Step { number, of } => course.ask((number, of)),
                Event::Iteration { number, residual } => watch.ask((number, residual)),
                Event::Pivots(progress) => watch.ask((progress.pivots, progress.artificial)),
                Event::Phase(_) => ControlFlow::Continue(()),
            })
        })?;
        watch.finish()?;
        course.finish()?;
        Ok(Outcome { outcome: outcome.map_err(wrong)? })
    }

    /// Computes the limit load of a group by the named laws of friction, in one direction or in both.
    #[pyo3(signature = (group, law, both, callback = None))]
    fn limit(
        &self,
        py: Python<'_>,
        group: Option<&str>,
        law: &str,
        both: bool,
        callback: Option<Py<PyAny>>,
    ) -> PyResult<Found> {
        let laws = laws(law)?;
        let mut scene = self.scene.clone();
        if let Some(group) = group {
            scene = scene.limit_group(group);
        }
        let mut watch = Watch::new(callback.as_ref());
        let found = detached(py, || -> Result<_, LimitError> {
            let mut asked = 0;
            let mut ask = |known: Bracket| {
                asked += 1;
                watch.ask((asked, known.stands.unwrap_or(f64::NAN)))
            };
            let given = masonry::limit_observed(&scene, laws, &mut |known| ask(known))?;
            if !both || given.is_interrupted {
                return Ok(Found::limit(&given));
            }
            let opposite = Directions::opposite(&given, &scene, laws, &mut |known| ask(known))?;
            Ok(Found::directions(&Directions::of(given, opposite)))
        })?;
        watch.finish()?;
        found.map_err(wrong)?
    }

    /// Returns a scene for every combination, with the name of the combination.
    fn combined(&self) -> Vec<(String, Self)> {
        let scenes = self.scene.combined().into_iter();
        scenes.map(|Combined { name, of }| (name, Self { scene: of })).collect()
    }

    /// Computes the limit load of the train of the scene at all of its positions.
    #[pyo3(signature = (law, callback = None))]
    fn train(&self, py: Python<'_>, law: &str, callback: Option<Py<PyAny>>) -> PyResult<Found> {
        let laws = laws(law)?;
        let mut watch = Watch::new(callback.as_ref());
        let found = detached(py, || {
            let mut asked = 0;
            let mut ask = |known: Bracket| {
                asked += 1;
                watch.ask((asked, known.stands.unwrap_or(f64::NAN)))
            };
            train_observed(&self.scene, laws, &mut ask)
        })?;
        watch.finish()?;
        Found::train(&found.map_err(wrong)?)
    }

    #[pyo3(signature = (callback = None))]
    fn ranges(&self, py: Python<'_>, callback: Option<Py<PyAny>>) -> PyResult<Found> {
        let mut watch = Watch::new(callback.as_ref());
        let observer = &mut |at: &Iteration| watch.at(at);
        let range = detached(py, || masonry::ranges_observed(&self.scene, observer))?;
        watch.finish()?;
        Found::range(&range.map_err(wrong)?)
    }

    #[pyo3(signature = (arch, callback = None))]
    fn least_thickness(
        &self,
        py: Python<'_>,
        arch: &str,
        callback: Option<Py<PyAny>>,
    ) -> PyResult<Found> {
        let unit = self.scene.units.length_to_si();
        let mut watch = Watch::new(callback.as_ref());
        let found = detached(py, || {
            let mut asked = 0;
            let mut ask = |known: Bracket| {
                asked += 1;
                watch.ask((asked, known.stands.map_or(f64::NAN, |it| it / unit)))
            };
            masonry::least_thickness_observed(&self.scene, arch, &mut ask)
        })?;
        watch.finish()?;
        Found::thickness(&found.map_err(wrong)?)
    }

    /// Measures the cost of accuracy; `callback` receives the mesh, the route and the tolerance of the current solve.
    fn study(
        &self,
        py: Python<'_>,
        settings: StudySettings,
        callback: Option<Py<PyAny>>,
    ) -> PyResult<Studied> {
        let settings = settings.settings()?;
        let mut watch = Watch::new(callback.as_ref());
        let found = detached(py, || {
            let observer =
                &mut |at: study::StudyProgress| watch.ask((at.mesh, at.route.name(), at.tolerance));
            study::study(&self.scene, &settings, observer)
        })?;
        watch.finish()?;
        let study = found.map_err(|error| match error {
            StudyError::Scene(error) => wrong(error),
            other => PyValueError::new_err(other.to_string()),
        })?;
        Ok(Studied { study })
    }
}

/// Returns the laws of friction for `associative`, `path` or `both`.
fn laws(law: &str) -> PyResult<Laws> {
    match law {
        "associative" => Ok(Laws::Associative),
        "path" => Ok(Laws::Path),
        "both" => Ok(Laws::Both),
        other => Err(PyValueError::new_err(format!(
            "law is {other:?}, but must be one of: associative, path, both"
        ))),
    }
}

/// The settings that a study varies; `None` stands for the default.
#[derive(FromPyObject)]
pub(crate) struct StudySettings {
    #[pyo3(item)]
    routes: Option<Vec<String>>,
    #[pyo3(item)]
    tolerances: Option<Vec<f64>>,
    #[pyo3(item)]
    meshes: Option<Vec<u32>>,
    #[pyo3(item)]
    time_limit: Option<f64>,
    #[pyo3(item)]
    repeats: Option<usize>,
}

impl StudySettings {
    fn settings(self) -> PyResult<study::Settings> {
        let defaults = study::Settings::default();
        let routes = self.routes.map(|names| {
            let route = |name: String| serde_json::from_value(Value::String(name));
            names.into_iter().map(route).collect::<Result<Vec<_>, _>>()
        });
        let refused = |error: serde_json::Error| PyValueError::new_err(format!("routes: {error}"));
        let time_limit = self.time_limit.map(|seconds| {
            Duration::try_from_secs_f64(seconds).map_err(|_| {
                PyValueError::new_err(format!(
                    "time_limit is {seconds}, but must be a number of seconds, not negative"
                ))
            })
        });
        Ok(study::Settings {
            routes: routes.transpose().map_err(refused)?.unwrap_or(defaults.routes),
            tolerances: self.tolerances.unwrap_or(defaults.tolerances),
            meshes: self.meshes.unwrap_or(defaults.meshes),
            time_limit: time_limit.transpose()?.unwrap_or(defaults.time_limit),
            repeats: self.repeats.unwrap_or(defaults.repeats),
            ..study::Settings::default()
        })
    }
}

/// Removes keys without a value, since TOML has no null.
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
