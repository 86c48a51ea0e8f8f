//! What can be wrong with a scene, and where.

mod contact;

use std::fmt;
use std::path::{Path, PathBuf};

pub use contact::ContactError;

use super::arch_error::ArchError;
use super::load::LoadError;
use super::opening::OpeningError;
use super::source::{Place, Source};
use super::{KeyPath, Scene};

/// Something is wrong with a scene: what, where, and how to mend it.
///
/// The message of a scene that was read from text shows the line with carets below the mistake.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneError(Box<Details>);

#[derive(Debug, Clone, PartialEq)]
struct Details {
    kind: SceneErrorKind,
    key: KeyPath,
    place: Option<Place>,
    file: Option<PathBuf>,
}

impl SceneError {
    /// What is wrong.
    pub fn kind(&self) -> &SceneErrorKind {
        &self.0.kind
    }

    /// The key of the value that is wrong, such as `walls[0].brick.length`; empty when the text is
    /// no TOML or does not fit the format.
    pub fn key(&self) -> String {
        self.0.key.to_string()
    }

    /// The line of the mistake, from 1; `None` when the scene was built or changed in Rust.
    pub fn line(&self) -> Option<usize> {
        self.0.place.as_ref().map(|place| place.line)
    }

    /// The column of the mistake in characters, from 1; `None` as [`SceneError::line`].
    pub fn column(&self) -> Option<usize> {
        self.0.place.as_ref().map(|place| place.column)
    }

    /// The file that the scene was read from.
    pub fn file(&self) -> Option<&Path> {
        self.0.file.as_deref()
    }

    pub(super) fn syntax(source: &Source, error: &toml::de::Error) -> Self {
        // An error without a place, such as a missing key of the whole scene, is shown at the top.
        let place = source.place(error.span().unwrap_or(0..0));
        let kind = SceneErrorKind::Syntax { message: with_nearest(error.message()) };
        Self::new(kind, KeyPath::default(), place, source.path().map(Path::to_owned))
    }

    pub(super) fn list(path: &Path, message: &str, place: Option<Place>) -> Self {
        let kind = SceneErrorKind::Syntax { message: with_nearest(message) };
        Self::new(kind, KeyPath::default(), place, Some(path.to_owned()))
    }

    pub(super) fn unreadable(path: &Path, message: &str) -> Self {
        let kind = SceneErrorKind::Read { message: message.to_owned() };
        Self::new(kind, KeyPath::default(), None, Some(path.to_owned()))
    }

    pub(super) fn unwritable(message: &str) -> Self {
        let kind = SceneErrorKind::Write { message: message.to_owned() };
        Self::new(kind, KeyPath::default(), None, None)
    }

    fn new(
        kind: SceneErrorKind,
        key: KeyPath,
        place: Option<Place>,
        file: Option<PathBuf>,
    ) -> Self {
        Self(Box::new(Details { kind, key, place, file }))
    }
}

impl std::error::Error for SceneError {}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Details { kind, key, place, file } = &*self.0;
        if let Some(file) = file {
            write!(f, "{}", file.display())?;
            f.write_str(if place.is_some() { ", " } else { ": " })?;
        }
        if let Some(place) = place {
            writeln!(f, "line {}, column {}\n{}", place.line, place.column, place.snippet())?;
        }
        if *key != KeyPath::default() {
            write!(f, "{key}: ")?;
        }
        write!(f, "{kind}")
    }
}

/// A mistake and the key at which it is, before its place in the text is known.
#[derive(Debug)]
pub(crate) struct Fault {
    key: KeyPath,
    kind: Box<SceneErrorKind>,
}

impl Fault {
    pub(crate) fn new(key: KeyPath, kind: SceneErrorKind) -> Self {
        Self { key, kind: Box::new(kind) }
    }

    /// The error with its place in the text, if the scene still says what the text says.
    pub(crate) fn locate(self, scene: &Scene) -> SceneError {
        let source = &scene.source;
        let unchanged = Scene::of(source).is_ok_and(|read| {
            // NaN differs from itself: what was written is compared, not what it is worth.
            format!("{read:?}") == format!("{:?}", scene.without_source())
        });
        if unchanged {
            let (file, place) = source.locate(&self.key);
            SceneError::new(*self.kind, self.key, place, file.map(Path::to_owned))
        } else {
            SceneError::new(*self.kind, self.key, None, None)
        }
    }
}

/// The kinds of mistakes in a scene.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SceneErrorKind {
    /// The file cannot be read.
    #[error("cannot read the scene: {message}")]
    Read {
        /// The operating system's message.
        message: String,
    },
    /// The scene cannot be written as TOML.
    #[error("cannot write the scene as TOML: {message}")]
    Write {
        /// The writer's message.
        message: String,
    },
    /// The list of blocks cannot be read.
    #[error("cannot read the list of blocks {}: {message}: name a JSON file, relative to the scene", path.display())]
    BlockList {
        /// The file, as the scene names it.
        path: PathBuf,
        /// The operating system's message.
        message: String,
    },
    /// The text is no TOML, or has unknown, missing or repeated keys, or values of a wrong type.
    #[error("{message}")]
    Syntax {
        /// What is wrong and what was expected.
        message: String,
    },
    /// A key is missing that other data of the scene call for.
    #[error("`{key}` is missing, but needed {because}: add `{remedy}`")]
    Missing {
        /// The missing key.
        key: &'static str,
        /// Why it is needed.
        because: &'static str,
        /// An example.
        remedy: &'static str,
    },
    /// A key has no meaning beside other data of the scene.
    #[error("`{key}` {because}: remove it{otherwise}")]
    Unwanted {
        /// The key.
        key: &'static str,
        /// Why it has no meaning.
        because: &'static str,
        /// An alternative.
        otherwise: &'static str,
    },
    /// Both of two keys are given of which exactly one is wanted.
    #[error("both `{first}` and `{second}` are given: keep one of them")]
    Both {
        /// One key.
        first: &'static str,
        /// The other.
        second: &'static str,
    },
    /// Neither of two keys is given of which exactly one is wanted.
    #[error("neither `{first}` nor `{second}` is given: add one of them")]
    Neither {
        /// One key.
        first: &'static str,
        /// The other.
        second: &'static str,
    },
    /// A number is not finite, or out of its range.
    #[error("{value} is not allowed: {wanted}")]
    Value {
        /// The number.
        value: f64,
        /// What is allowed.
        wanted: &'static str,
    },
    /// A name is empty.
    #[error("the name is empty: give a name by which messages and files can refer to it")]
    EmptyName,
    /// A name occurs twice.
    #[error("the {what} name \"{name}\" is taken by {first}: choose another")]
    Duplicate {
        /// `wall`, `block`, `support`, `load` or `stage`.
        what: &'static str,
        /// The name.
        name: String,
        /// Where the name occurs first.
        first: String,
    },
    /// A name refers to nothing.
    #[error(
        "there is no {what} \"{name}\" in the scene; {known}: correct the name or add {missing}"
    )]
    Unknown {
        /// `material`, `joint class`, `load`, `load or group` or `support`.
        what: &'static str,
        /// The name.
        name: String,
        /// The names that there are.
        known: Known,
        /// The table that would define it.
        missing: String,
    },
    /// Nothing to analyse.
    #[error("the scene has no blocks: add [[walls]], [[arches]] or [[blocks]]")]
    Empty,
    /// A list has no items.
    #[error("the list is empty: {remedy}")]
    EmptyList {
        /// The remedy.
        remedy: &'static str,
    },
    /// Nothing holds the structure.
    #[error(
        "the scene has no support, so that nothing holds it: add [[supports]], or `springing` to an arch"
    )]
    NoSupport,
    /// The two ends of a segment coincide.
    #[error("the segment has no length: `from` and `to` are both [{x}, {y}]")]
    NoLength {
        /// Coordinate of the ends.
        x: f64,
        /// Coordinate of the ends.
        y: f64,
    },
    /// More items than can be analysed.
    #[error("{count:.0} {what} are too many: at most {limit} are possible")]
    TooMany {
        /// The things that are too many.
        what: &'static str,
        /// How many.
        count: f64,
        /// How many are possible.
        limit: u32,
    },
    /// The corners of a block run clockwise.
    #[error(
        "the corners of block \"{block}\" run clockwise (area {area} {unit}2): \
         list them counter-clockwise"
    )]
    Clockwise {
        /// Name of the block.
        block: String,
        /// Signed area in units of the scene.
        area: f64,
        /// Unit of length.
        unit: &'static str,
    },
    /// A block with less than three corners.
    #[error("block \"{block}\" has {count} corners: give at least three")]
    TooFewCorners {
        /// Name of the block.
        block: String,
        /// How many there are.
        count: usize,
    },
    /// The edges of a block go around more than once.
    #[error(
        "the edges of block \"{block}\" cross: list its corners in the order in which they follow each other, \
         counter-clockwise"
    )]
    CrossingEdges {
        /// Name of the block.
        block: String,
    },
    /// A block of an elastic material that is no quadrilateral.
    #[error(
        "block \"{block}\" has {count} corners, but only blocks with four can be elastic: give it a rigid material \
         (one without E), or divide it into quadrilaterals"
    )]
    NoQuadrilateral {
        /// Name of the block.
        block: String,
        /// How many corners it has.
        count: usize,
    },
    /// A block is not strictly convex.
    #[error(
        "block \"{block}\" is not strictly convex at corner {corner}: move the corner outwards, or \
         split the block"
    )]
    NotConvex {
        /// Name of the block.
        block: String,
        /// The corner, from 1.
        corner: usize,
    },
    /// The tensile strength lies beyond the tip of the friction cone.
    #[error(
        "the tensile strength {tension} is larger than cohesion / mu = {largest}, where the friction cone ends: give \
         at most that, or more `cohesion`"
    )]
    TooMuchTension {
        /// The tensile strength, in units of the scene.
        tension: f64,
        /// The largest possible.
        largest: f64,
    },
    /// Two blocks occupy the same place.
    #[error(
        "blocks \"{first}\" and \"{second}\" overlap by an area of {area} {unit}2: move one of them"
    )]
    Overlap {
        /// Name of one block.
        first: String,
        /// Name of the other.
        second: String,
        /// Area of the overlap in units of the scene.
        area: f64,
        /// Unit of length.
        unit: &'static str,
    },
    /// A support runs through a block.
    #[error(
        "support \"{support}\" runs through the inside of block \"{block}\" for a length of {length} \
         {unit}: move it to an edge"
    )]
    Pierced {
        /// Name of the support.
        support: String,
        /// Name of the block.
        block: String,
        /// Length inside the block in units of the scene.
        length: f64,
        /// Unit of length.
        unit: &'static str,
    },
    /// A block meets neither another block nor a support.
    #[error(
        "block \"{block}\" touches no other block and no support, so that it can move in every \
         direction: move it, or raise contact.gap_limit"
    )]
    LooseBlock {
        /// Name of the block.
        block: String,
    },
    /// No block meets a support.
    #[error(
        "no block touches support \"{support}\": move it to an edge of a block, raise \
         contact.gap_limit, or remove it"
    )]
    IdleSupport {
        /// Name of the support.
        support: String,
    },
    /// No free edge lies on the segment of a load.
    #[error(
        "load \"{load}\" acts on nothing: no free edge of a block lies on its segment (edges \
         within joints are not free): move it to an edge, or remove it"
    )]
    IdleLoad {
        /// Name of the load.
        load: String,
    },
    /// Two blocks meet in a joint whose class is not given.
    #[error(
        "blocks \"{first}\" and \"{second}\" meet in a joint of class \"{class}\", which is \
         not given: add [joints.{class}] with `mu` or `phi_deg`"
    )]
    MissingClass {
        /// The class.
        class: String,
        /// Name of one block.
        first: String,
        /// Name of the other.
        second: String,
    },
    /// What is impossible about an arch.
    #[error("{0}")]
    Arch(#[from] ArchError),
    /// What is impossible about an opening.
    #[error("{0}")]
    Opening(#[from] OpeningError),
    /// What is wrong with a load.
    #[error("{0}")]
    Load(#[from] LoadError),
    /// Contact points could not be placed.
    #[error("{0}")]
    Contact(#[from] ContactError),
}

/// The names of a kind that a scene has.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Known {
    /// All of them.
    pub names: Vec<String>,
    /// The one that was probably meant.
    pub nearest: Option<String>,
}

impl Known {
    /// The names that there are where another one was given.
    pub(crate) fn near(given: &str, names: Vec<String>) -> Self {
        let nearest = nearest(given, names.iter().map(String::as_str)).map(str::to_owned);
        Self { names, nearest }
    }
}

impl fmt::Display for Known {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.names.is_empty() {
            return f.write_str("none is given");
        }
        if let Some(nearest) = &self.nearest {
            write!(f, "did you mean \"{nearest}\"? ")?;
        }
        let (first, more) = self.names.split_at(self.names.len().min(MOST_NAMES));
        let names: Vec<String> = first.iter().map(|name| format!("\"{name}\"")).collect();
        write!(f, "there is {}", names.join(", "))?;
        if more.is_empty() { Ok(()) } else { write!(f, " and {} more", more.len()) }
    }
}

/// So many names are listed.
const MOST_NAMES: usize = 12;
/// Names that differ by more than this part of their letters are different names.
const SIMILAR: f64 = 0.7;

/// The name that is most like another one, if one is like it at all.
fn nearest<'a>(given: &str, names: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let likeness = |name: &str| strsim::normalized_damerau_levenshtein(given, name);
    let like =
        names.map(|name| (likeness(name), name)).filter(|(likeness, _)| *likeness >= SIMILAR);
    like.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, name)| name)
}

/// The message of the reader, with the key that was probably meant.
fn with_nearest(message: &str) -> String {
    let quoted: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    let hint = message.starts_with("unknown ").then_some(&quoted[..]);
    match hint.and_then(<[&str]>::split_first) {
        Some((given, known)) => match nearest(given, known.iter().copied()) {
            Some(name) => format!("{message}; did you mean `{name}`?"),
            None => message.to_owned(),
        },
        None => message.to_owned(),
    }
}
