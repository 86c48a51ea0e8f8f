//! Parts of a structure that several pictures draw: blocks, hatched supports, contact points.

use nalgebra::{Point2, Vector2};

use super::canvas::{Canvas, Pixel, closed, open, parts};
use super::labels::Labels;
use super::motion::Motion;
use super::names;
use super::sheet::{Bounds, Frame, Sheet};
use super::style::{LARGEST_BRICK, STATUS};
use masonry::data::state::{PointState, PointStatus};
use masonry::ids::{JointId, SupportId};
use masonry::model::mesh::BlockMesh;
use masonry::model::{Body, JointPoint, Model, PlacedBlock, PlacedSupport};

/// Length of the strokes of a hatch, and the largest distance between strokes, in pixels.
const TICK: f64 = 7.0;
/// SVG attribute of the line of a support, which is wider than its hatch.
const LINE: &str = "class=\"line\"";

/// Returns the box around all blocks.
pub(super) fn blocks(model: &Model) -> Bounds {
    Bounds::of(model.blocks.iter().flat_map(|block| block.corners.iter().copied()))
}

/// Returns the box around all blocks and supports.
pub(super) fn bounds(model: &Model) -> Bounds {
    let ends = model.supports.iter().flat_map(|support| [support.from, support.to]);
    let corners = model.blocks.iter().flat_map(|block| block.corners.iter().copied());
    Bounds::of(corners.chain(ends))
}

/// Draws all blocks and supports as they are in the scene.
pub(super) fn draw(sheet: &mut Sheet, model: &Model) {
    outlines(sheet, "bricks", &model.blocks);
    supports(sheet, model, Motion::NONE);
}

/// Draws blocks at their places before any displacement.
pub(super) fn outlines<'a>(
    sheet: &mut Sheet,
    class: &str,
    blocks: impl IntoIterator<Item = &'a PlacedBlock>,
) {
    sheet.layer(class, |canvas, frame| {
        for block in blocks {
            let corners = block.corners.iter().map(|corner| frame.at(*corner));
            canvas.path(&closed(corners), &names::block(block));
        }
    });
}

/// Draws joints as lines of a class of the style sheet.
pub(super) fn joints(
    sheet: &mut Sheet,
    class: &str,
    model: &Model,
    list: impl Iterator<Item = JointId>,
) {
    sheet.layer(class, |canvas, frame| {
        for id in list {
            let joint = &model.joints[id.index()];
            let ends = [joint.from, joint.to].map(|end| frame.at(end));
            canvas.path(&open(ends), &names::joint(model, id));
        }
    });
}

/// Draws all supports at their displaced places, hatched on the side away from the structure, and adds their legend
/// entry.
pub(super) fn supports(sheet: &mut Sheet, model: &Model, motion: Motion) {
    if model.supports.is_empty() {
        return;
    }
    sheet.layer("supports", |canvas, frame| {
        for (index, support) in model.supports.iter().enumerate() {
            let inward = side_of_structure(model, SupportId::new(index), support);
            let ends = |factor: f64| {
                [support.from, support.to]
                    .map(|end| frame.at(end + support.displacement_at(end) * factor))
            };
            let ticks = parts(ends(0.0), TICK);
            canvas.group(&names::support(support), |canvas| {
                motion.path(canvas, LINE, |factor| open(ends(factor)));
                motion.path(canvas, "", |factor| hatch(ends(factor), ticks, inward));
            });
        }
    });
    sheet.legend.add("support", "supports", |symbol| {
        let ends = [Pixel::new(-22.0, -3.0), Pixel::new(22.0, -3.0)];
        symbol.path(&open(ends), LINE);
        symbol.path(&hatch(ends, parts(ends, TICK), Vector2::y()), "");
    });
}

/// Makes labels avoid the lines of the supports.
pub(super) fn avoid_supports(frame: &Frame, model: &Model, labels: &mut Labels) {
    for (index, support) in model.supports.iter().enumerate() {
        let inward = side_of_structure(model, SupportId::new(index), support);
        let ends = [support.from, support.to].map(|end| frame.at(end));
        labels.avoid(ends);
        labels.avoid(ends.map(|end| end.along(-inward, TICK)));
    }
}

/// Returns a vector (y up) from the support to the structure.
fn side_of_structure(model: &Model, id: SupportId, support: &PlacedSupport) -> Vector2<f64> {
    match model.joints.iter().find(|joint| joint.a == Body::Support(id)) {
        Some(joint) => joint.normal,
        None => blocks(model).middle() - nalgebra::center(&support.from, &support.to),
    }
}

/// Returns path data of the hatch of a support: strokes away from the structure; `inward` is the direction to the
/// structure, y up.
fn hatch([from, to]: [Pixel; 2], ticks: u32, inward: Vector2<f64>) -> String {
    let along = from.towards(to);
    let across = Vector2::new(along.y, -along.x);
    let outward = if across.dot(&inward) > 0.0 { -across } else { across };
    let stroke = |k: u32| {
        let foot = from.between(to, (f64::from(k) + 0.5) / f64::from(ticks));
        open([foot, foot.along(outward, TICK).along(-along, 0.6 * TICK)])
    };
    (0..ticks).map(stroke).collect()
}

/// Returns the nodes on the boundary of a block, as indices into the list of its nodes.
pub(super) fn rim(block: &PlacedBlock) -> Vec<usize> {
    let of_mesh = |mesh: &BlockMesh| mesh.rim().collect();
    block.mesh.as_ref().map_or_else(|| (0..block.corners.len()).collect(), of_mesh)
}

/// Draws contact points that are open (hollow circles) or slide (filled squares on a corner).
///
/// Each mark is moved along its joint by nearly two radii towards the middle of the joint, so that the marks of joints
/// that meet at one point stay apart.
pub(super) fn contact_marks(sheet: &mut Sheet, model: &Model, states: &[PointState]) {
    let radius = STATUS * sheet.marks();
    for (status, name, class) in
        [(PointStatus::Open, "open", "open"), (PointStatus::Slip, "sliding", "slip")]
    {
        let all = model.contacts.iter().zip(states);
        let found: Vec<_> = all.filter(|(_, state)| state.status == status).collect();
        if found.is_empty() {
            continue;
        }
        sheet.layer(class, |canvas, frame| {
            for (contact, _) in &found {
                draw_mark(canvas, status, mark_place(model, contact, frame, radius), radius);
            }
        });
        let text = format!("{name}: {}", counted(found.len(), "contact point"));
        sheet.legend.add(&text, class, |symbol| {
            draw_mark(symbol, status, Pixel::new(0.0, 0.0), STATUS * LARGEST_BRICK);
        });
    }
}

fn draw_mark(canvas: &mut Canvas, status: PointStatus, at: Pixel, radius: f64) {
    if status == PointStatus::Open {
        return canvas.circle(at, radius, "");
    }
    let tip = 1.35 * radius;
    let corners = [[tip, 0.0], [0.0, tip], [-tip, 0.0], [0.0, -tip]];
    canvas.path(&closed(corners.map(|[x, y]| Pixel::new(at.x + x, at.y + y))), "");
}

fn mark_place(model: &Model, contact: &JointPoint, frame: &Frame, radius: f64) -> Pixel {
    let joint = &model.joints[contact.joint.index()];
    let at = frame.at(contact.position);
    let middle: Point2<f64> = nalgebra::center(&joint.from, &joint.to);
    let middle = frame.at(middle);
    at.along(at.towards(middle), (1.7 * radius).min(at.distance(middle)))
}

/// Writes a number and a noun: `1 joint`, `2 joints`.
pub(crate) fn counted(count: usize, name: &str) -> String {
    if count == 1 { format!("1 {name}") } else { format!("{count} {name}s") }
}
