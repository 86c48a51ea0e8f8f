//! Questions about scenes and their answers, in JSON.
//!
//! A question is an object with `task` and, except for `begin`, the `text` of a scene in TOML:
//!
//! | task | further keys | answer |
//! |---|---|---|
//! | `solve` | `show`: `answer`, `forces`, `stresses`, `cracks`, `deformed`, `mechanism`, `scene` or `report`; `step`: position of a step of the load history from zero, or null for the last | verdict, picture or report, places in the text |
//! | `limit` | `law`: `associative`, `path` or `both` | limit load |
//! | `range` | | least and largest reactions |
//! | `thickness` | `arch`: its name | least thickness of an arch |
//! | `change` | `label`, `edits`, `value`, `range` and `whole` of a number | values of the number between which the verdict changes |
//! | `study` | | errors and times of routes |
//! | `export` | `format`: `page`, `json`, `text` or `dxf` | the text of a file |
//! | `complete` | `at`: the place of the cursor | keys, words and names that fit there |
//! | `begin` | | scenes to begin with |
//!
//! An answer is an object. It has `error`, with a message and, if the mistake has a place, `line` and `column` from 1, when there
//! is nothing else to say. All other places in the text are in units of UTF-16, in which scripts count.

mod change;
mod complete;
mod controls;
mod fault;
mod handles;
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
use solved::{Format, Show, Solved};
use text::Text;
pub use watch::Watch;

/// The longest text of a scene \[bytes\]: that of a wall of 10 000 single blocks.
pub const LONGEST_TEXT: usize = 4 << 20;

/// Answers questions about scenes. It remembers the scene that it solved last, so that another picture of it is drawn at once.
#[derive(Debug, Default)]
pub struct Engine {
    last: Mutex<Option<Arc<Solved>>>,
}

#[derive(Debug, Deserialize)]
#[serde(tag = "task", rename_all = "lowercase")]
enum Task {
    Solve {
        text: String,
        show: Show,
        step: Option<usize>,
    },
    Limit {
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
    /// The answer to a question, both in JSON. A question that cannot be read is answered by an error too.
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
            Task::Solve { text, show, step } => self.solve(&text, show, step, watch)?,
            Task::Limit { text, law } => json(&work::limit(&scene(&text)?, law, watch)?)?,
            Task::Range { text } => json(&work::range(&scene(&text)?, watch)?)?,
            Task::Thickness { text, arch } => {
                json(&work::thickness(&scene(&text)?, &arch, watch)?)?
            }
            Task::Study { text } => json(&work::study(&scene(&text)?, watch)?)?,
            Task::Change { text, tried } => {
                let solve = |text: &str, watch: &mut Watch<'_>| {
                    Ok(Solved::new(text, &scene(text)?, watch)?)
                };
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

    /// Verdict and picture, or the mistake; in either case what the text has that can be changed.
    fn solve(
        &self,
        text: &str,
        show: Show,
        step: Option<usize>,
        watch: &mut Watch<'_>,
    ) -> Result<String, Fault> {
        let read = Text::read(text);
        let (shown, error) = match self.solved(text, watch) {
            Ok(solved) => (Some(solved.shown(show, step)), None),
            Err(fault) => (None, Some(fault)),
        };
        json(&Answer {
            numbers: read.numbers(),
            controls: controls::controls(&read),
            places: places::places(&read),
            handles: handles::handles(&read),
            shown,
            error,
        })
    }

    fn solved(&self, text: &str, watch: &mut Watch<'_>) -> Result<Arc<Solved>, Fault> {
        let last = self.last.lock().unwrap_or_else(PoisonError::into_inner).clone();
        if let Some(last) = last.filter(|it| it.is_of(text)) {
            return Ok(last);
        }
        let solved = Arc::new(Solved::new(text, &scene(text)?, watch)?);
        if solved.is_complete() {
            *self.last.lock().unwrap_or_else(PoisonError::into_inner) = Some(solved.clone());
        }
        Ok(solved)
    }
}

/// The answer to `solve`.
#[derive(Debug, Serialize)]
struct Answer {
    numbers: Vec<text::Number>,
    controls: Vec<controls::Control>,
    places: Vec<places::Place>,
    handles: Vec<handles::Handle>,
    shown: Option<solved::Shown>,
    error: Option<Fault>,
}

/// The scene of a text, which reads no other file.
fn scene(text: &str) -> Result<Scene, Fault> {
    if text.len() > LONGEST_TEXT {
        let message = format!(
            "the text has {} bytes, and the page treats at most {LONGEST_TEXT}: solve it with `masonry solve`",
            text.len()
        );
        return Err(Fault::new(&message));
    }
    let read = Text::read(text);
    if let Some(list) = read.get("block_list") {
        let message =
            "block_list: the page reads no other file: put the blocks into the scene as [[blocks]]";
        let line = Some(read.line(list.span().start));
        return Err(Fault { message: message.to_owned(), line, column: Some(1) });
    }
    Ok(Scene::from_toml(text)?)
}

fn json(answer: &impl Serialize) -> Result<String, Fault> {
    Ok(serde_json::to_string(answer)?)
}
