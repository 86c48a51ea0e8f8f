//! Checkpoints: the state after a step of a load history, as a file from which a run can continue.

use std::fs;
use std::path::{Path, PathBuf};

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

use crate::data::info::SolveInfo;
use crate::data::state::{PointState, State};
use crate::files::write_atomically;
use crate::forms::Start;
use crate::history::StepRecord;
use crate::model::Model;
use crate::recover;
use crate::scene::{Output, Scene, SceneError, SolverSettings};

/// The version of the format of checkpoint files.
const VERSION: u32 = 5;
/// The text between the data of a checkpoint file and their checksum.
const SEAL: &str = ",\"checksum\":\"";

/// The reasons for which a checkpoint cannot be read, written or continued.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CheckpointError {
    /// The checkpoint file cannot be read.
    #[error("cannot read the checkpoint {}: {source}; solve from the first step", path.display())]
    Read {
        /// Path of the file.
        path: PathBuf,
        /// The error of the operating system.
        source: std::io::Error,
    },
    /// The checkpoint file cannot be written.
    #[error("cannot write the checkpoint {}: {source}; choose another directory", path.display())]
    Write {
        /// Path of the file.
        path: PathBuf,
        /// The error of the operating system.
        source: std::io::Error,
    },
    /// The text of the file is not a checkpoint.
    #[error(
        "{}, line {}, column {}: this is not a checkpoint: {source}; solve from the first step",
        path.display(), source.line(), source.column()
    )]
    Syntax {
        /// Path of the file.
        path: PathBuf,
        /// The error of the JSON reader.
        source: serde_json::Error,
    },
    /// The checksum does not match: the file was changed after it was written.
    #[error("the checkpoint {} is damaged: solve from the first step", path.display())]
    Damaged {
        /// Path of the file.
        path: PathBuf,
    },
    /// The file has another version of the format than this program reads.
    #[error(
        "the checkpoint has format {found}, and this program reads {VERSION}: solve from the first step"
    )]
    Version {
        /// The version of the format in the file.
        found: u32,
    },
    /// The checkpoint belongs to another scene.
    #[error(
        "the checkpoint belongs to another scene: only stages that are still to come, the solver and \
         the output may change; solve from the first step"
    )]
    OtherScene,
    /// The scene has a stage that is done in the checkpoint, with other steps.
    #[error(
        "the checkpoint has another step {step} of stage \"{stage}\" than the scene: stages that are \
         done must stay as they were; solve from the first step"
    )]
    OtherSteps {
        /// Name of the stage with other steps.
        stage: String,
        /// Number of the step that differs in the stage, from 1.
        step: usize,
    },
    /// The scene has one step only, so that a checkpoint is of no use.
    #[error("the scene has one step, so a checkpoint is of no use: solve without one")]
    OneStep,
    /// A number in the checkpoint is not finite, or its forces and displacements are not those of an equilibrium.
    #[error(
        "the state in the checkpoint is not an equilibrium of the scene: solve from the first step"
    )]
    NoEquilibrium,
    /// A list in the checkpoint has another length than the scene needs.
    #[error(
        "the checkpoint has {found} {what} and the scene has {wanted}: solve from the first step"
    )]
    Size {
        /// The name of the list that is too long or too short.
        what: String,
        /// The number of entries in the checkpoint.
        found: usize,
        /// The number of entries that the scene needs.
        wanted: usize,
    },
}

/// A checkpoint: the data from which the next step of a load history starts, and the records of all steps before.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Checkpoint {
    version: u32,
    /// The scene as text (TOML), without stages, solver and output: it must be the same when a run continues.
    pub(crate) origin: String,
    /// The results of the steps that were solved.
    pub records: Vec<StepRecord>,
    /// The record of the last solve, without wall-clock times, so that the file does not depend on the machine.
    pub(crate) solve: SolveInfo,
    displacements: Vec<Vec<[f64; 2]>>,
    contacts: Vec<PointState>,
    /// The slip \[m\] of every contact point at the state from which the slips of the last step are measured.
    slips: Vec<f64>,
    strain_energy: f64,
    /// The basis from which the pivots of the next step start: for every pair, which variable is basic after the last
    /// pivot, `t` or `y`. `None` if the last step was not solved by pivots.
    basis: Option<String>,
}

/// The version of the format of a checkpoint file, read before all other data.
#[derive(Deserialize)]
struct Version {
    version: u32,
}

impl Checkpoint {
    pub(crate) fn new(
        origin: String,
        records: Vec<StepRecord>,
        mut solve: SolveInfo,
        state: &State,
        slips: &[f64],
        basis: Option<&Start>,
    ) -> Self {
        solve.routes.iter_mut().for_each(|route| route.seconds = 0.0);
        let side = |is_t: &bool| if *is_t { 't' } else { 'y' };
        Self {
            version: VERSION,
            origin,
            records,
            solve,
            displacements: state
                .displacements
                .iter()
                .map(|moved| moved.iter().map(|u| [u.x, u.y]).collect())
                .collect(),
            contacts: state.contacts.clone(),
            slips: slips.to_vec(),
            strain_energy: state.strain_energy,
            basis: basis.map(|basis| basis.t_basic.iter().map(side).collect()),
        }
    }

    /// Returns the slip \[m\] of every contact point at the state from which the slips of the last step are measured.
    ///
    /// # Errors
    /// [`CheckpointError::Size`] if the number of slips is not that of `model`; [`CheckpointError::NoEquilibrium`] if a
    /// slip is not finite.
    pub(crate) fn slips(&self, model: &Model) -> Result<Vec<f64>, CheckpointError> {
        same("slips", self.slips.len(), model.contacts.len())?;
        if self.slips.iter().all(|slip| slip.is_finite()) {
            return Ok(self.slips.clone());
        }
        Err(CheckpointError::NoEquilibrium)
    }

    /// Returns the basis from which the pivots of the next step start; `None` if there is no basis, or if it does not
    /// have this order.
    pub(crate) fn basis(&self, order: usize) -> Option<Start> {
        let sides = self.basis.as_ref().filter(|sides| sides.len() == order)?;
        Some(Start::last(sides.chars().map(|it| it == 't').collect()))
    }

    /// Returns the part of a scene, as text, that must not change between a checkpoint and a run that continues from
    /// it.
    pub(crate) fn origin_of(scene: &Scene) -> Result<String, SceneError> {
        let mut origin = scene.clone();
        origin.stages = Vec::new();
        origin.solver = SolverSettings::default();
        origin.output = Output::default();
        origin.to_toml()
    }

    /// Reads a checkpoint file that [`write`](Self::write) has written; numbers are restored to the last digit.
    ///
    /// # Errors
    /// [`CheckpointError`] with the path, and with line and column if the text is not valid.
    pub fn read(path: &Path) -> Result<Self, CheckpointError> {
        let path_buf = || path.to_owned();
        let text = fs::read_to_string(path)
            .map_err(|source| CheckpointError::Read { path: path_buf(), source })?;
        let syntax = |source| CheckpointError::Syntax { path: path_buf(), source };
        // Only the version is read first, since files of another version may have other fields.
        let Version { version } = serde_json::from_str(&text).map_err(syntax)?;
        if version != VERSION {
            return Err(CheckpointError::Version { found: version });
        }
        let data = text.rsplit_once(SEAL).map(|(data, _)| data);
        let data = data.filter(|data| sealed(data) == text);
        let data = data.ok_or_else(|| CheckpointError::Damaged { path: path_buf() })?;
        serde_json::from_str(&format!("{data}}}")).map_err(syntax)
    }

    /// Writes a checkpoint file, either completely or not at all.
    ///
    /// # Errors
    /// [`CheckpointError::Write`] if the file cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), CheckpointError> {
        let failed = |source| CheckpointError::Write { path: path.to_owned(), source };
        let text = serde_json::to_string(self).map_err(|error| failed(error.into()))?;
        let data = text.strip_suffix('}').unwrap_or(&text);
        write_atomically(path, sealed(data).as_bytes()).map_err(failed)
    }

    /// Returns the state after the last step, for the model under the actions of this step.
    pub(crate) fn state(
        &self,
        model: &Model,
        with_stresses: bool,
    ) -> Result<State, CheckpointError> {
        same("blocks", self.displacements.len(), model.blocks.len())?;
        for (block, moved) in model.blocks.iter().zip(&self.displacements) {
            same(&format!("displacements of block \"{}\"", block.name), moved.len(), nodes(block))?;
        }
        same("contact points", self.contacts.len(), model.contacts.len())?;
        for record in &self.records {
            same("reactions in a record", record.reactions.len(), model.supports.len())?;
        }
        if !(self.strain_energy >= 0.0 && self.strain_energy.is_finite()) {
            return Err(CheckpointError::NoEquilibrium);
        }
        let displacements: Vec<Vec<Vector2<f64>>> = self
            .displacements
            .iter()
            .map(|moved| moved.iter().map(|u| Vector2::from(*u)).collect())
            .collect();
        let contacts = self.contacts.clone();
        let (stresses, films) =
            recover::wanted_stresses(model, &displacements, &contacts, with_stresses);
        Ok(State { displacements, contacts, films, stresses, strain_energy: self.strain_energy })
    }
}

/// Returns a JSON object that is given without its closing brace, completed by the checksum of its text (FNV-1a, 64
/// bits).
fn sealed(data: &str) -> String {
    let checksum = data.bytes().fold(0xcbf2_9ce4_8422_2325, |hash: u64, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    });
    format!("{data}{SEAL}{checksum:016x}\"}}")
}

fn nodes(block: &crate::model::PlacedBlock) -> usize {
    block.mesh.as_ref().map_or(block.corners.len(), |mesh| mesh.nodes.len())
}

fn same(what: &str, found: usize, wanted: usize) -> Result<(), CheckpointError> {
    let what = || what.to_owned();
    if found == wanted {
        Ok(())
    } else {
        Err(CheckpointError::Size { what: what(), found, wanted })
    }
}
