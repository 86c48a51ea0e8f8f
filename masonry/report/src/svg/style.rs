//! The style sheet of pictures, and sizes.
//!
//! An element looks as its class says, in a drawing and in a legend alike.

/// One element for all pictures, so that those of a page can share it.
pub(crate) const STYLE: &str = concat!("<style>\n", include_str!("picture.css"), "</style>\n");

/// Width of a picture, and what stays free at its edges.
pub(super) const WIDTH: f64 = 900.0;
pub(super) const EDGE: f64 = 18.0;
/// Heights of letters and of lines of them.
pub(super) const TITLE: f64 = 17.0;
pub(super) const TITLE_LINE: f64 = 22.0;
pub(super) const TEXT: f64 = 13.0;
pub(super) const TEXT_LINE: f64 = 17.0;
/// Half the length of marks at the ends of dimensions, and the length of those at the labels of axes.
pub(super) const TICK: f64 = 5.0;
/// How many classes of colours, and of materials, the style sheet has.
pub(super) const COLOURS: usize = 7;
pub(super) const MATERIALS: usize = 5;

/// Smallest and largest size of a brick in pixels that marks go with; a legend has that of the largest.
pub(super) const SMALLEST_BRICK: f64 = 14.0;
pub(super) const LARGEST_BRICK: f64 = 60.0;
/// Sizes in bricks: radius of contact points in a scene, of those that are open or slide, of the places of resultants, and of
/// hinges.
pub(super) const CONTACT: f64 = 0.032;
pub(super) const STATUS: f64 = 0.05;
pub(super) const PLACE: f64 = 0.035;
pub(super) const HINGE: f64 = 0.08;
