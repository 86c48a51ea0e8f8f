//! Questions about scenes and their answers, in JSON.
//!
//! A question is an object with `task` and, except for `begin`, the `text` of a scene in TOML:
//!
//! | task | further keys | answer |
//! |---|---|---|
//! | `solve` | `show`: `answer`, `forces`, `stresses`, `cracks`, `deformed`, `mechanism`, `scene`, `tables` or `report`; `step`: position of a step of the load history from zero, or null for the last; `beside`: texts of scenes whose pictures get the same scale | verdict, picture, tables or report, places in the text |
//! | `limit` | `law`: `associative`, `path` or `both` | limit load |
//! | `train` | `law` | limit load of a train where it governs |
//! | `range` | | least and largest reactions |
//! | `thickness` | `arch`: its name | least thickness of an arch |
//! | `change` | `label`, `edits`, `value`, `range` and `whole` of a number | values of the number between which the verdict changes |
//! | `study` | | errors and times of routes |
//! | `export` | `format`: `page`, `json`, `text` or `dxf` | the text of a file |
//! | `complete` | `at`: the place of the cursor | keys, words and names that fit there |
//! | `begin` | | scenes to begin with |
//!
//! An answer is an object. The object has `error` if there is a mistake: a message and, if the mistake has a place in
//! the text, `line` and `column` from 1. All other places in the text are in UTF-16 code units, in which scripts count.

mod change;
mod compare;
mod complete;
mod controls;
mod fault;
mod handles;
mod listed;
mod places;
mod schema;
mod solved;
mod text;
mod watch;
mod work;

use std::sync::{Arc, Mutex, PoisonError};

use masonry::{Laws, Scene};
use serde::{Deserialize, Serialize};

use crate::beginnings::BEGINNINGS;

use change::Tried;
use fault::Fault;
pub use listed::{Files, LONGEST_TEXT, ReadScene};
use solved::{Format, Seen, Show, Solved};
use text::Text;
pub use watch::Watch;

/// The number of solved scenes that are kept: the scene of the text, the scenes beside it, and the previous scene.
const RECENT: usize = 2 + compare::MOST_BESIDE;

/// Answers questions about scenes. The engine keeps the scenes that it solved last, so that it can draw other pictures
/// of these scenes at once.
#[derive(Debug, Default)]
pub struct Engine {
    files: Option<Files>,
    /// The solved scenes that are kept, the newest last.
    recent: Mutex<Vec<Arc<Solved>>>,
}

#[derive(Debug, Deserialize)]
#[serde(tag = "task", rename_all = "lowercase")]
enum Task {
    Solve {
        text: String,
        show: Show,
        step: Option<usize>,
        #[serde(default)]
        beside: Vec<String>,
    },
    Limit {
        text: String,
        law: Laws,
    },
    Train {
        text: String,
        law: Laws,
    },
    Range {
        text: String,
    },
    Thickness {
        text: String,
        arch: String,
    },
    Study {
        text: String,
    },
    Change {
        text: String,
        #[serde(flatten)]
        tried: Tried,
    },
    Export {
        text: String,
        format: Format,
    },
    Complete {
        text: String,
        at: usize,
    },
    Begin,
}

impl Engine {
    /// Creates an engine whose scenes may name files of a directory.
    pub fn with_files(files: Files) -> Self {
        Self { files: Some(files), ..Self::default() }
    }

    /// Answers a question; question and answer are JSON. A question that cannot be read has an error as its answer.
    pub fn answer(&self, question: &str, watch: &mut Watch<'_>) -> String {
        let answer = serde_json::from_str(question)
            .map_err(Fault::from)
            .and_then(|task| self.answer_to(task, watch));
        match answer {
            Ok(answer) => answer,
            Err(fault) => serde_json::json!({ "error": fault }).to_string(),
        }
    }

    fn answer_to(&self, task: Task, watch: &mut Watch<'_>) -> Result<String, Fault> {
        Ok(match task {
            Task::Solve { text, show, step, beside } => {
                let seen = Seen { show, step };
                self.solve(&text, seen, &beside, watch)?
            }
            Task::Limit { text, law } => json(&work::limit(&self.scene(&text)?, law, watch)?)?,
            Task::Train { text, law } => json(&work::train(&self.single(&text)?, law, watch)?)?,
            Task::Range { text } => json(&work::range(&self.single(&text)?, watch)?)?,
            Task::Thickness { text, arch } => {
                json(&work::thickness(&self.single(&text)?, &arch, watch)?)?
            }
            Task::Study { text } => json(&work::study(&self.single(&text)?, watch)?)?,
            Task::Change { text, tried } => {
                let solve =
                    |text: &str, watch: &mut Watch<'_>| Solved::new(self.scene(text)?, watch);
                json(&change::change(&text, &tried, &solve, watch)?)?
            }
            Task::Export { text, format } => {
                let file = self.solved(&text, watch)?.file(format)?;
                json(&serde_json::json!({ "file": file }))?
            }
            Task::Complete { text, at } => {
                let units: Vec<u16> = text.encode_utf16().take(at).collect();
                let until = String::from_utf16_lossy(&units);
                json(&complete::complete(&until, &Text::read(&text)))?
            }
            Task::Begin => json(&BEGINNINGS)?,
        })
    }

    /// Returns verdict and picture, or the mistake; in both cases with the parts of the text that can be changed.
    fn solve(
        &self,
        text: &str,
        seen: Seen,
        beside: &[String],
        watch: &mut Watch<'_>,
    ) -> Result<String, Fault> {
        let read = Text::read(text);
        let (shown, error) = match self.solved(text, watch) {
            Ok(solved) => {
                let kept = beside.iter().take(compare::MOST_BESIDE);
                let kept = kept.map(|text| self.solved(text, watch)).collect();
                (Some(compare::shown(&solved, kept, seen)), None)
            }
            Err(fault) => (None, Some(fault)),
        };
        json(&Answer {
            numbers: read.numbers(),
            controls: controls::controls(&read),
            places: places::places(&read),
            handles: handles::handles(&read),
            has_train: read.get("limit").is_some_and(|it| text::value_of(it, "train").is_some()),
            shown,
            error,
        })
    }

    fn solved(&self, text: &str, watch: &mut Watch<'_>) -> Result<Arc<Solved>, Fault> {
        let scene = self.scene(text)?;
        let recent = || self.recent.lock().unwrap_or_else(PoisonError::into_inner);
        // A file that the text names may have changed, so that scenes are compared instead of texts.
        let known = recent().iter().find(|it| it.is_of(&scene)).cloned();
        let solved = match known {
            Some(solved) => solved,
            None => Arc::new(Solved::new(scene, watch)?),
        };
        if solved.is_complete() {
            let mut list = recent();
            list.retain(|it| !Arc::ptr_eq(it, &solved));
            list.push(solved.clone());
            let most = list.len().saturating_sub(RECENT);
            list.drain(..most);
        }
        Ok(solved)
    }

    /// Returns a scene with one set of loads; an error for a scene with combinations, which the question does not
    /// allow.
    fn single(&self, text: &str) -> Result<Scene, Fault> {
        let scene = self.scene(text)?;
        if scene.combinations.is_empty() {
            return Ok(scene);
        }
        let message = "the scene has combinations: verdict and limit load take all of them; remove \
                       [[combinations]] for other questions, and leave the loads of one";
        Err(Fault::new(&message))
    }

    fn scene(&self, text: &str) -> Result<Scene, Fault> {
        listed::scene(text, self.files.as_ref())
    }
}

/// The answer to a question with the task `solve`.
#[derive(Debug, Serialize)]
struct Answer {
    numbers: Vec<text::Number>,
    controls: Vec<controls::Control>,
    places: Vec<places::Place>,
    handles: Vec<handles::Handle>,
    /// Whether the scene has a train.
    has_train: bool,
    shown: Option<compare::Compared>,
    error: Option<Fault>,
}

fn json(answer: &impl Serialize) -> Result<String, Fault> {
    Ok(serde_json::to_string(answer)?)
}
