//! The kinds of mistakes in a scene, each with the remedy that its message gives.

use std::path::PathBuf;

use super::{ContactError, Known};
use crate::scene::{ArchError, LoadError, OpeningError};

/// The kinds of mistakes in a scene, with the data of their messages.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SceneErrorKind {
    /// The file cannot be read; the value is the message of the operating system.
    #[error("cannot read the scene: {0}")]
    Read(String),
    /// The scene cannot be written as TOML; the value is the message of the writer.
    #[error("cannot write the scene as TOML: {0}")]
    Write(String),
    /// The file of `block_list` cannot be read. [`Scene::read`](crate::Scene::read) reads only JSON lists;
    /// [`Scene::read_with`](crate::Scene::read_with) takes a function that reads drawings.
    #[error("cannot read the list of blocks {}: {message}", path.display())]
    BlockList {
        /// The path of the file, as given in the scene.
        path: PathBuf,
        /// The message of the operating system, or of the reader of drawings, with the remedy.
        message: String,
    },
    /// The text is not TOML, or has unknown, missing or repeated keys, or values of a wrong type; the value is a
    /// message with the mistake and the expected form.
    #[error("{0}")]
    Syntax(String),
    /// A key is missing that other data of the scene require.
    #[error("`{key}` is missing, but needed {because}: add `{remedy}`")]
    Missing {
        /// The missing key.
        key: &'static str,
        /// The reason for which the key is needed.
        because: &'static str,
        /// An example of the key with a value.
        remedy: &'static str,
    },
    /// A key has no meaning beside other data of the scene.
    #[error("`{key}` {because}: remove it{otherwise}")]
    Unwanted {
        /// The key that has no meaning.
        key: &'static str,
        /// The reason for which the key has no meaning.
        because: &'static str,
        /// An alternative to the key.
        otherwise: &'static str,
    },
    /// Two keys are given of which exactly one is wanted.
    #[error("both `{first}` and `{second}` are given: keep one of them")]
    Both {
        /// The first of the two keys.
        first: &'static str,
        /// The other of the two keys.
        second: &'static str,
    },
    /// Neither of two keys is given of which exactly one is wanted.
    #[error("neither `{first}` nor `{second}` is given: add one of them")]
    Neither {
        /// The first of the two keys.
        first: &'static str,
        /// The other of the two keys.
        second: &'static str,
    },
    /// A number is not finite, or is out of its range.
    #[error("{} is not allowed: {wanted}", number(*value))]
    Value {
        /// The given number.
        value: f64,
        /// The allowed values, in words.
        wanted: &'static str,
    },
    /// A name is empty.
    #[error("the name is empty: give a name by which messages and files can refer to it")]
    EmptyName,
    /// A name or a title has this control character, which would act on terminals.
    #[error("the text has the control character {0:?}: remove it")]
    Control(char),
    /// A name occurs twice.
    #[error("the {what} name \"{name}\" is taken by {first}: choose another")]
    Duplicate {
        /// The kind of the named value: `wall`, `block`, `support`, `load`, `stage` or `combination`.
        what: &'static str,
        /// The name that occurs twice.
        name: String,
        /// The key of the first value with the name.
        first: String,
    },
    /// A name refers to something that does not exist.
    #[error(
        "there is no {what} \"{name}\" in the scene; {known}: correct the name or add {missing}"
    )]
    Unknown {
        /// The kind that the name should refer to: `material`, `joint class`, `load`, `load or group` or `support`.
        what: &'static str,
        /// The given name.
        name: String,
        /// The names of this kind in the scene.
        known: Known,
        /// The table to add to the scene, so that it defines the unknown name.
        missing: String,
    },
    /// The scene has neither walls nor arches nor blocks.
    #[error("the scene has no blocks: add [[walls]], [[arches]] or [[blocks]]")]
    Empty,
    /// A list has no items; the value is the remedy.
    #[error("the list is empty: {0}")]
    EmptyList(&'static str),
    /// The scene has no support.
    #[error(
        "the scene has no support, so that nothing holds it: add [[supports]], or `springing` to an arch"
    )]
    NoSupport,
    /// The two ends of a segment coincide.
    #[error("the segment has no length: `from` and `to` are both [{}, {}]", number(*x), number(*y))]
    NoLength {
        /// Coordinate x of both ends.
        x: f64,
        /// Coordinate y of both ends.
        y: f64,
    },
    /// There are more items than can be analysed.
    #[error("{count:.0} {what} are too many: at most {limit} are possible")]
    TooMany {
        /// The kind of item.
        what: &'static str,
        /// The number of items in the scene.
        count: f64,
        /// The largest possible number.
        limit: u32,
    },
    /// The corners of a block run clockwise.
    #[error(
        "the corners of block \"{block}\" run clockwise (area {} {unit}2): \
         list them counter-clockwise", number(*area)
    )]
    Clockwise {
        /// Name of the block.
        block: String,
        /// Signed area of the block in units of the scene; negative.
        area: f64,
        /// Symbol of the unit of length.
        unit: &'static str,
    },
    /// A block has fewer than three corners.
    #[error("block \"{block}\" has {count} corners: give at least three")]
    TooFewCorners {
        /// Name of the block.
        block: String,
        /// The number of corners of the block.
        count: usize,
    },
    /// The edges of a block, whose name is given, cross or touch each other.
    #[error(
        "the edges of block \"{0}\" cross or touch: list its corners in the order in which they follow each other, \
         counter-clockwise"
    )]
    CrossingEdges(String),
    /// A block of an elastic material is not star-shaped about its centroid.
    #[error(
        "block \"{block}\" has no mesh: its edge {edge}, counted from 0, cannot be seen from its centroid: give it a rigid \
         material (one without E), or divide it"
    )]
    NoMesh {
        /// Name of the block.
        block: String,
        /// The index of an edge that cannot be seen from the centroid, from 0.
        edge: usize,
    },
    /// Two numbers of elements are given for a block that is not a convex quadrilateral.
    #[error(
        "block \"{block}\" has two numbers of elements, which only a convex block with four corners can have: give one, such as \
         mesh = {}", mesh[0]
    )]
    UnevenMesh {
        /// Name of the block.
        block: String,
        /// The two given numbers of elements.
        mesh: [u32; 2],
    },
    /// The block has no width at a corner: its two edges lie on each other, or the corner coincides with the next one.
    #[error("block \"{block}\" has no width at corner {corner}: leave the corner out, or move it")]
    NoWidth {
        /// Name of the block.
        block: String,
        /// The number of the corner, from 1.
        corner: usize,
    },
    /// The tensile strength is larger than the cohesion divided by the coefficient of friction: it lies beyond the tip
    /// of the friction cone.
    #[error(
        "the tensile strength {} is larger than cohesion / mu = {}, the tip of the friction cone: lower \
         `tension`, or raise `cohesion`", number(*tension), number(*largest)
    )]
    TooMuchTension {
        /// The given tensile strength, in units of the scene.
        tension: f64,
        /// The largest possible tensile strength, in units of the scene.
        largest: f64,
    },
    /// Two blocks overlap.
    #[error(
        "blocks \"{first}\" and \"{second}\" overlap by an area of {} {unit}2: move one of them; if corners of \
         single blocks are rounded, set `contact.tolerance` to three times the error of rounding",
        number(*area)
    )]
    Overlap {
        /// Name of one block.
        first: String,
        /// Name of the other block.
        second: String,
        /// Area of the overlap in units of the scene.
        area: f64,
        /// Symbol of the unit of length.
        unit: &'static str,
    },
    /// A support runs through the inside of a block.
    #[error(
        "support \"{support}\" runs through the inside of block \"{block}\" for a length of {} {unit}: move it to an \
         edge; if corners of single blocks are rounded, set `contact.tolerance` to three times the error of rounding",
        number(*length)
    )]
    Pierced {
        /// Name of the support.
        support: String,
        /// Name of the block.
        block: String,
        /// Length inside the block in units of the scene.
        length: f64,
        /// Symbol of the unit of length.
        unit: &'static str,
    },
    /// Two supports hold the same part of an edge of a block.
    #[error(
        "supports \"{first}\" and \"{second}\" lie on each other along block \"{block}\" for a length of {} {unit}, so that \
         their joint would count twice: remove one of them, or let one begin where the other ends",
        number(*length)
    )]
    OverlappingSupports {
        /// Name of one support.
        first: String,
        /// Name of the other support.
        second: String,
        /// Name of the block.
        block: String,
        /// Length that both supports hold, in units of the scene.
        length: f64,
        /// Symbol of the unit of length.
        unit: &'static str,
    },
    /// The block of this name meets neither another block nor a support.
    #[error(
        "block \"{0}\" touches no other block and no support, so that it can move in every \
         direction: move it, or raise contact.gap_limit"
    )]
    LooseBlock(String),
    /// No block meets the support of this name.
    #[error(
        "no block touches support \"{0}\": move it to an edge of a block, raise \
         contact.gap_limit, or remove it"
    )]
    IdleSupport(String),
    /// No free edge lies on the segment of the load of this name.
    #[error(
        "load \"{0}\" acts on nothing: no free edge of a block lies on its segment (edges \
         within joints are not free): move the segment to a free edge, set `inside = true` for a \
         traction within joints, or remove the load"
    )]
    IdleLoad(String),
    /// Two blocks meet in a joint whose class is not given.
    #[error(
        "blocks \"{first}\" and \"{second}\" meet in a joint of class \"{class}\", which is \
         not given: add [joints.{class}] with `mu` or `phi_deg`"
    )]
    MissingClass {
        /// Name of the class that is not given.
        class: String,
        /// Name of one block.
        first: String,
        /// Name of the other block.
        second: String,
    },
    /// An arch cannot be built.
    #[error("{0}")]
    Arch(#[from] ArchError),
    /// An opening cannot be built.
    #[error("{0}")]
    Opening(#[from] OpeningError),
    /// A load has a mistake; the value describes it.
    #[error("{0}")]
    Load(#[from] LoadError),
    /// Contact points could not be placed; the value has the reason.
    #[error("{0}")]
    Contact(#[from] ContactError),
}

/// Formats a number as it was written, with an exponent instead of many zeros.
fn number(value: f64) -> String {
    let is_plain = value == 0.0 || (1e-6..1e16).contains(&value.abs());
    if is_plain { value.to_string() } else { format!("{value:e}") }
}
