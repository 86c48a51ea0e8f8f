//! The style sheet of pictures, and sizes.
//!
//! The class of an element determines its look, both in a drawing and in a legend.

/// The style sheet as one element, which the pictures of a page can share.
pub(crate) const STYLE: &str = concat!("<style>\n", include_str!("picture.css"), "</style>\n");

/// Width of a picture, and width of the free space at its edges.
pub(super) const WIDTH: f64 = 900.0;
pub(super) const EDGE: f64 = 18.0;
/// Heights of letters and of lines of text.
pub(super) const TITLE: f64 = 17.0;
pub(super) const TITLE_LINE: f64 = 22.0;
pub(super) const TEXT: f64 = 13.0;
pub(super) const TEXT_LINE: f64 = 17.0;
/// Half the length of the marks at the ends of dimensions, and the length of the marks at the labels of axes.
pub(super) const TICK: f64 = 5.0;
/// The numbers of colours of joint classes, and of materials, in the style sheet.
pub(super) const COLOURS: usize = 7;
pub(super) const MATERIALS: usize = 5;

/// The smallest and the largest size of a brick in pixels on which the sizes of marks depend; legends show marks of the
/// largest size.
pub(super) const SMALLEST_BRICK: f64 = 14.0;
pub(super) const LARGEST_BRICK: f64 = 60.0;
/// Radii in sizes of a brick: contact points in a scene, open or sliding contact points, points of application of
/// resultants, and hinges.
pub(super) const CONTACT: f64 = 0.032;
pub(super) const STATUS: f64 = 0.05;
pub(super) const PLACE: f64 = 0.035;
pub(super) const HINGE: f64 = 0.08;
