//! SVG: paths, polygons, polylines, lines, rectangles and circles, with the transforms of the groups around them.
//!
//! Layers are groups with an Inkscape label; without one, the nearest group with an `id`. The y axis points down in the
//! file.

mod path;

use nalgebra::{Matrix3, Point2, Vector2};
use roxmltree::{Document, Node, ParsingOptions};
use svgtypes::{PointsParser, Transform, ViewBox};

use self::path::Part;
use super::curve::{Arc, Chords};
use super::error::shown;
use super::shapes::MOST_SHAPES;
use super::{Change, Drawing, DrawingError, DrawingErrorKind, DrawnLine, Outline, Place, Unit};

/// The deepest nesting of groups. Chosen: as for nested blocks in other formats, with room for the groups that editors
/// add, and small enough for the stack.
const DEEPEST: usize = 64;
const INKSCAPE: &str = "http://www.inkscape.org/namespaces/inkscape";

pub(super) fn read(text: &str) -> Result<Drawing, DrawingError> {
    let nodes_limit = u32::try_from(4 * MOST_SHAPES).unwrap_or(u32::MAX);
    let options = ParsingOptions { nodes_limit, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).map_err(|error| {
        let line = usize::try_from(error.pos().row).ok();
        DrawingErrorKind::Syntax { message: error.to_string() }.at(&Place::new("SVG", line))
    })?;
    let root = document.root_element();
    let (unit, scale) = size_of_unit(root);
    let mut drawing = Drawing::in_unit(unit);
    let upright = Matrix3::new_nonuniform_scaling(&Vector2::new(scale, -scale));
    let line_ends = text.match_indices('\n').map(|(at, _)| at).collect();
    let mut reader = Reader { drawing: &mut drawing, line_ends };
    let frame = Frame { map: upright, layer: "0", depth: 0, is_drawn: true, is_visible: true };
    reader.inside(root, &frame)?;
    Ok(drawing)
}

/// Returns the unit of the drawing's width, and the number of these units in one unit of the coordinates; `None` and 1
/// if the width has no unit.
fn size_of_unit(root: Node) -> (Option<Unit>, f64) {
    let width = root.attribute("width").unwrap_or_default().trim();
    let symbol = width.trim_start_matches(|c: char| c.is_ascii_digit() || "+-.".contains(c));
    let number = width[..width.len() - symbol.len()].parse::<f64>().ok();
    let view = root.attribute("viewBox").and_then(|text| text.parse::<ViewBox>().ok());
    match (Unit::of_symbol(symbol), number, view) {
        (Some(unit), Some(width), Some(view)) if width > 0.0 && view.w > 0.0 => {
            (Some(unit), width / view.w)
        }
        _ => (None, 1.0),
    }
}

struct Reader<'a> {
    drawing: &'a mut Drawing,
    /// Byte offsets of the line ends in the file.
    line_ends: Vec<usize>,
}

/// Properties that a group gives to its contents.
#[derive(Clone, Copy)]
struct Frame<'a> {
    map: Matrix3<f64>,
    layer: &'a str,
    depth: usize,
    /// Whether no group around has `display: none`.
    is_drawn: bool,
    /// Whether the nearest `visibility` makes the contents visible.
    is_visible: bool,
}

impl Reader<'_> {
    fn inside(&mut self, parent: Node, frame: &Frame) -> Result<(), DrawingError> {
        for node in parent.children().filter(Node::is_element) {
            self.node(node, frame)?;
        }
        Ok(())
    }

    fn node(&mut self, node: Node, frame: &Frame) -> Result<(), DrawingError> {
        let is_drawn = frame.is_drawn && property(node, "display") != Some("none");
        let is_visible = property(node, "visibility")
            .filter(|it| *it != "inherit")
            .map_or(frame.is_visible, |it| it == "visible");
        let frame = &Frame { is_drawn, is_visible, ..*frame };
        let place = self.place(node);
        if frame.depth == DEEPEST {
            return Err(DrawingErrorKind::Nested { depth: DEEPEST }.at(&place));
        }
        let map = frame.map * if is_drawn { transform(node, &place)? } else { Matrix3::identity() };
        let parts = match node.tag_name().name() {
            // Elements that describe, style or define something are not drawn.
            "defs" | "metadata" | "title" | "desc" | "style" | "namedview" | "script" => {
                return Ok(());
            }
            "svg" if has_own_coordinates(node) => {
                let what = "<svg> with x, y or viewBox was left out: move its objects into a group";
                self.drawing.changes.push(Change::new(what, &place));
                return Ok(());
            }
            "g" | "a" | "svg" | "switch" => {
                let label = node.attribute((INKSCAPE, "label")).or_else(|| node.attribute("id"));
                let layer = label.unwrap_or(frame.layer);
                return self.inside(node, &Frame { map, layer, depth: frame.depth + 1, ..*frame });
            }
            _ if !(is_drawn && is_visible) => {
                let what =
                    format!("hidden objects of layer \"{}\" were left out", shown(frame.layer));
                self.drawing.changes.push(Change::new(what, &place));
                return Ok(());
            }
            "path" => path::parts(node.attribute("d").unwrap_or_default(), &place)?,
            "polygon" | "polyline" => vec![points(node)],
            "rect" => vec![rectangle(node, &place)?],
            "line" => vec![line(node, &place)?],
            "circle" => vec![circle(node, &place)?],
            name => {
                let what = format!(
                    "<{}> was left out: turn objects into paths, unlink clones",
                    shown(name)
                );
                self.drawing.changes.push(Change::new(what, &place));
                return Ok(());
            }
        };
        parts.into_iter().try_for_each(|part| self.add(&part, &Frame { map, ..*frame }, &place))
    }

    fn add(&mut self, part: &Part, frame: &Frame, place: &Place) -> Result<(), DrawingError> {
        if part.off > 0.0 {
            let by = part.off * frame.map.determinant().abs().sqrt();
            self.drawing.changes.push(Change::by("arcs became chords", place, by));
        }
        let points = part.points.iter().map(|it| frame.map.transform_point(it)).collect();
        let (layer, place) = (frame.layer.to_owned(), place.clone());
        if part.is_closed {
            let (name, is_fixed) = (None, false);
            self.drawing.add_outline(Outline { corners: points, layer, name, is_fixed, place })
        } else {
            self.drawing.add_line(DrawnLine { points, layer, place })
        }
    }

    fn place(&self, node: Node) -> Place {
        let id = node.attribute("id").map_or(String::new(), |id| format!(" id \"{}\"", shown(id)));
        let start = node.range().start;
        let line = 1 + self.line_ends.partition_point(|end| *end < start);
        Place::new(format!("<{}>{id}", shown(node.tag_name().name())), Some(line))
    }
}

/// Whether a nested drawing has its own origin or size.
fn has_own_coordinates(node: Node) -> bool {
    let is_moved = |name| node.attribute(name).is_some_and(|text| text.trim() != "0");
    node.has_attribute("viewBox") || ["x", "y"].into_iter().any(is_moved)
}

/// Returns the value of a property: that of the style, else that of the attribute with its name.
fn property<'a>(node: Node<'a, '_>, name: &str) -> Option<&'a str> {
    let of_style = node.attribute("style").unwrap_or_default().split(';').find_map(|it| {
        let (key, value) = it.split_once(':')?;
        (key.trim() == name).then(|| value.trim())
    });
    of_style.or_else(|| node.attribute(name)).map(|it| it.trim_end_matches("!important").trim())
}

fn transform(node: Node, place: &Place) -> Result<Matrix3<f64>, DrawingError> {
    let Some(text) = node.attribute("transform") else { return Ok(Matrix3::identity()) };
    let wrong = |error: svgtypes::Error| {
        let message = format!("transform \"{}\": {error}", shown(text));
        DrawingErrorKind::Syntax { message }.at(place)
    };
    let Transform { a, b, c, d, e, f } = text.parse().map_err(wrong)?;
    Ok(Matrix3::new(a, c, e, b, d, f, 0.0, 0.0, 1.0))
}

/// Returns the number of an attribute, zero if there is no such attribute. Lengths must be in units of the drawing.
fn number(node: Node, name: &str, place: &Place) -> Result<f64, DrawingError> {
    let text = node.attribute(name).unwrap_or("0").trim();
    text.parse().map_err(|_| DrawingErrorKind::Number { text: shown(text) }.at(place))
}

fn points(node: Node) -> Part {
    let list = PointsParser::from(node.attribute("points").unwrap_or_default());
    let points = list.map(|(x, y)| Point2::new(x, y)).collect();
    Part { points, is_closed: node.tag_name().name() == "polygon", off: 0.0 }
}

fn rectangle(node: Node, place: &Place) -> Result<Part, DrawingError> {
    let get = |name| number(node, name, place);
    let (x, y, width, height) = (get("x")?, get("y")?, get("width")?, get("height")?);
    let corners = [[x, y], [x + width, y], [x + width, y + height], [x, y + height]];
    Ok(Part { points: corners.map(Point2::from).to_vec(), is_closed: true, off: 0.0 })
}

fn line(node: Node, place: &Place) -> Result<Part, DrawingError> {
    let get = |name| number(node, name, place);
    let ends = [[get("x1")?, get("y1")?], [get("x2")?, get("y2")?]];
    Ok(Part { points: ends.map(Point2::from).to_vec(), is_closed: false, off: 0.0 })
}

fn circle(node: Node, place: &Place) -> Result<Part, DrawingError> {
    let get = |name| number(node, name, place);
    let centre = Point2::new(get("cx")?, get("cy")?);
    let Chords { mut points, off } = Arc::circle(centre, get("r")?).chords();
    points.pop();
    Ok(Part { points, is_closed: true, off })
}
