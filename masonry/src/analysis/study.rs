//! The cost of accuracy: the errors and times of a scene by several routes, to several tolerances, on several meshes.
//!
//! Two errors are distinguished. The *algebraic* error of a solution is the error of the solver: the distance of the
//! solution from the [`Reference`] on the same mesh, which is the most accurate solution there. The error of the
//! *mesh*, which no solver can reduce, is the distance of this reference from the reference on the finest mesh.
//!
//! ```
//! use masonry::scene::{Brick, Joint, Load, Material, Route, Scene, Support, Wall};
//! use masonry::model::Plane;
//! use masonry::analysis::study::{Settings, study};
//! use masonry::units::Units;
//!
//! let brick = Brick { length: 0.2, height: 0.1 };
//! let scene = Scene::new("Two courses", Units::SI)
//!     .plane(Plane::Stress)
//!     .thickness(0.1)
//!     .material("brick", Material::elastic(1e9, 0.2))
//!     .joint("bed", Joint::mu(0.6))
//!     .joint("head", Joint::mu(0.6))
//!     .wall(Wall::running_bond("wall", "brick", brick, 0.4, 2).mesh([1, 1]))
//!     .support(Support::new("floor", [0.0, 0.0], [0.4, 0.0], "bed"))
//!     .load(Load::pressure("top", [0.0, 0.2], [0.4, 0.2], 1e4));
//! let settings = Settings {
//!     routes: vec![Route::Lemke, Route::Alm],
//!     tolerances: vec![1e-4, 1e-8],
//!     meshes: vec![1, 2],
//!     ..Settings::default()
//! };
//! let study = study(&scene, &settings, &mut |_| std::ops::ControlFlow::Continue(()))?;
//! assert_eq!(study.records.len(), 8);
//! let [exact, iterated] = [&study.records[1], &study.records[3]];
//! assert!(exact.errors.unwrap().worst() < iterated.errors.unwrap().worst());
//! # Ok::<(), masonry::analysis::study::StudyError>(())
//! ```

mod figures;
mod machine;
mod mesh;
mod reference;
mod runs;
mod verified;

use std::ops::ControlFlow;
use std::time::Duration;

use lcp::Status;
use serde::Serialize;

pub use figures::Errors;
pub use machine::machine;
pub use mesh::{Mesh, MeshErrors, Values, refined};
pub use reference::{Confirmation, Reference};
pub use verified::{Exact, Verification};

use crate::model::Model;
use crate::scene::{Route, Scene, SceneError};
use crate::units::Units;
use figures::Figures;
use runs::Runner;

/// The settings of a study: routes, tolerances, meshes, and limits of the solves.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// The routes. If a route does not treat the scene, its record has the reason.
    pub routes: Vec<Route>,
    /// The tolerances of the solves \[-\], between 0 and 1.
    pub tolerances: Vec<f64>,
    /// Refinement factors of the meshes: the numbers of elements of all walls and blocks per direction are multiplied
    /// by each. A scene of rigid blocks has no elements, and is studied as it is.
    pub meshes: Vec<u32>,
    /// Names of the meshes in reports, in the order of [`meshes`](Self::meshes); a mesh without a name is named by its
    /// factor.
    pub mesh_names: Vec<String>,
    /// Limit of the wall-clock time of one solve. The observer checks the limit between iterations, so that a single
    /// factorisation or program is never interrupted: [`Record::overrun`] marks the solves that took longer.
    pub time_limit: Duration,
    /// Number of times that a solve of less than a second is repeated in all; the median time is recorded.
    pub repeats: usize,
    /// The machine on which times are measured, as text for reports: [`machine`], for example.
    pub machine: Option<String>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            routes: vec![Route::Lemke, Route::Interior, Route::Qp, Route::Pgs, Route::Alm],
            tolerances: vec![1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12],
            meshes: vec![1, 2, 4],
            mesh_names: Vec::new(),
            time_limit: Duration::from_secs(20),
            repeats: 3,
            machine: None,
        }
    }
}

impl Settings {
    fn validate(&self) -> Result<(), StudyError> {
        let lists = [
            ("route", self.routes.is_empty()),
            ("tolerance", self.tolerances.is_empty()),
            ("mesh factor", self.meshes.is_empty()),
        ];
        if let Some((what, _)) = lists.into_iter().find(|(_, is_empty)| *is_empty) {
            return Err(StudyError::Empty { what });
        }
        let out_of_range = |value: &&f64| !(**value > 0.0 && **value < 1.0);
        if let Some(&tolerance) = self.tolerances.iter().find(out_of_range) {
            return Err(StudyError::Tolerance(tolerance));
        }
        if self.meshes.contains(&0) { Err(StudyError::NoElements) } else { Ok(()) }
    }

    /// Returns the name of a mesh in reports: "mesh 4 (4 times as fine)", unless the settings have another name.
    fn mesh_name(&self, factor: u32) -> String {
        let position = self.meshes.iter().position(|it| *it == factor);
        match position.and_then(|position| self.mesh_names.get(position)) {
            Some(name) => name.clone(),
            None if factor == 1 => "mesh 1 (that of the scene)".to_owned(),
            None => format!("mesh {factor} ({factor} times as fine)"),
        }
    }
}

/// The reasons for which a study is refused.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StudyError {
    /// The scene is wrong.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A list in the settings is empty.
    #[error("a study needs at least one {what}: name one, or leave the list out")]
    Empty {
        /// Name of the list that is empty.
        what: &'static str,
    },
    /// A tolerance is not between 0 and 1.
    #[error("a tolerance lies between 0 and 1, and {0} does not: correct it")]
    Tolerance(f64),
    /// A refinement factor is zero, so that the mesh would have no elements.
    #[error("a mesh factor is at least 1, and 0 leaves no elements: correct it")]
    NoElements,
}

/// The outcome of one solve of a study.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum End {
    /// The solve ended with this status, which is [`Status::TimeLimit`] if it took longer than
    /// [`Settings::time_limit`].
    Ended(Status),
    /// The route does not treat the scene; the text is the reason.
    Refused(String),
    /// The solve was not tried; the text is the reason.
    Skipped(String),
}

impl End {
    /// Whether the solve ended with a solution.
    pub fn is_solved(&self) -> bool {
        *self == Self::Ended(Status::Solved)
    }

    /// Returns the outcome in one word.
    pub fn name(&self) -> String {
        match self {
            Self::Ended(status) => status.to_string(),
            Self::Refused(_) => "Refused".to_owned(),
            Self::Skipped(_) => "Skipped".to_owned(),
        }
    }

    /// Returns the reason for which the solve was refused or skipped; `None` if it ended.
    pub fn reason(&self) -> Option<&str> {
        match self {
            Self::Ended(_) => None,
            Self::Refused(reason) | Self::Skipped(reason) => Some(reason),
        }
    }
}

/// The record of one solve: one route, to one tolerance, on one mesh.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Record {
    /// The route of the solve.
    pub route: Route,
    /// The tolerance of the solve \[-\].
    pub tolerance: f64,
    /// The refinement factor of the mesh.
    pub mesh: u32,
    /// The outcome of the solve.
    pub end: End,
    /// The residual that was reached \[-\], recomputed from the original data (of the last step of a load history);
    /// `None` without a result.
    pub residual: Option<f64>,
    /// Wall-clock time from the scene to the checked solution, or to the failure \[s\]; `None` if the solve was
    /// skipped.
    pub seconds: Option<f64>,
    /// Whether `seconds` exceeds the time limit, because one factorisation, reduction or program was not interrupted.
    pub overrun: bool,
    /// Pivots of [`Route::Lemke`], or iterations of the other routes (of the last step of a load history).
    pub iterations: Option<usize>,
    /// Algebraic errors of the solution, relative to the reference on the same mesh; `None` without a solution or a
    /// reference.
    pub errors: Option<Errors>,
}

/// The results of a study.
#[derive(Debug, Clone, PartialEq)]
pub struct Study {
    /// Title of the scene.
    pub title: String,
    /// Units of the scene, for reports; all values of the study are in SI units.
    pub units: Units,
    /// Limit of the wall-clock time of one solve.
    pub time_limit: Duration,
    /// The machine on which times were measured; `None` if the settings have none.
    pub machine: Option<String>,
    /// Whether the observer ended the study early, so that solves were skipped.
    pub is_interrupted: bool,
    /// The records by mesh, route and tolerance, in the order of the settings.
    pub records: Vec<Record>,
    /// The meshes, in the order of the settings.
    pub meshes: Vec<Mesh>,
}

impl Study {
    /// Whether any route solved the scene on the first mesh.
    pub fn is_solved(&self) -> bool {
        self.on_first_mesh().any(|record| record.end.is_solved())
    }

    /// Returns the records on the first mesh.
    pub fn on_first_mesh(&self) -> impl Iterator<Item = &Record> {
        let first = self.meshes.first().map(|mesh| mesh.factor);
        self.records.iter().filter(move |record| Some(record.mesh) == first)
    }

    /// Returns the routes of the records, each once, in their order.
    pub fn routes(&self) -> Vec<Route> {
        let mut routes: Vec<Route> = Vec::new();
        for record in &self.records {
            if !routes.contains(&record.route) {
                routes.push(record.route);
            }
        }
        routes
    }
}

/// The solve of a study that is running.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StudyProgress {
    /// The refinement factor of the mesh.
    pub mesh: u32,
    /// The route of the solve.
    pub route: Route,
    /// The tolerance of the solve \[-\].
    pub tolerance: f64,
}

/// A function that is called with the running solve, many times in each solve; all further solves are skipped after
/// `Break`.
pub type StudyObserver<'a> = dyn FnMut(StudyProgress) -> ControlFlow<()> + 'a;

/// Studies a scene and reports the running solve to the observer.
///
/// The form and the limit of pivots in the scene are kept for [`Route::Lemke`]; the route, the tolerance and the
/// springs in the scene are replaced.
///
/// # Errors
/// [`StudyError`] if the scene is wrong or settings are out of range. A route or a mesh that fails is recorded without
/// an error.
pub fn study<'a>(
    scene: &Scene,
    settings: &'a Settings,
    observer: &'a mut StudyObserver<'a>,
) -> Result<Study, StudyError> {
    settings.validate()?;
    scene.check_single()?;
    let model = Model::from_scene(scene)?;
    let is_elastic = model.blocks.iter().any(|block| block.elasticity.is_some());
    let factors: &[u32] = if is_elastic { &settings.meshes } else { &[1] };
    let mut runner = Runner::new(settings, observer);
    let (mut records, mut meshes) = (Vec::new(), Vec::new());
    for &factor in factors {
        let finer = refined(scene, factor);
        let (mesh, figures) = mesh::studied(&finer, factor, &mut runner);
        for &route in &settings.routes {
            for &tolerance in &settings.tolerances {
                records.push(runner.record(
                    &finer,
                    StudyProgress { mesh: factor, route, tolerance },
                    figures.as_ref(),
                ));
            }
        }
        meshes.push(mesh);
    }
    Ok(Study {
        title: scene.title.clone(),
        units: scene.units,
        time_limit: settings.time_limit,
        machine: settings.machine.clone(),
        is_interrupted: runner.is_interrupted(),
        records,
        meshes: mesh::compared(meshes),
    })
}
