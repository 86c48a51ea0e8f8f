//! Paths of values in a scene, such as `walls[0].brick.length`.

use std::fmt;

/// The path from the top of a scene to a value, as a list of keys and indices.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct KeyPath(Vec<PathStep>);

/// One step of a path: a key of a table, or an index of an array.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum PathStep {
    Key(String),
    Index(usize),
}

impl KeyPath {
    /// Returns the path of a key at the top of the scene.
    pub(crate) fn of(key: &str) -> Self {
        Self::default().key(key)
    }

    /// Returns the path of a key in the table at this path.
    pub(crate) fn key(&self, key: &str) -> Self {
        self.then(PathStep::Key(key.to_owned()))
    }

    /// Returns the path of an item of the array at this path.
    pub(crate) fn item(&self, index: usize) -> Self {
        self.then(PathStep::Index(index))
    }

    pub(super) fn steps(&self) -> &[PathStep] {
        &self.0
    }

    fn then(&self, step: PathStep) -> Self {
        let mut steps = self.0.clone();
        steps.push(step);
        Self(steps)
    }
}

impl fmt::Display for KeyPath {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (position, step) in self.0.iter().enumerate() {
            match step {
                PathStep::Index(index) => write!(f, "[{index}]")?,
                PathStep::Key(key) => {
                    if position > 0 {
                        f.write_str(".")?;
                    }
                    if is_bare(key) { f.write_str(key)? } else { write!(f, "{key:?}")? }
                }
            }
        }
        Ok(())
    }
}

fn is_bare(key: &str) -> bool {
    !key.is_empty() && key.chars().all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '-')
}
