//! Principal stresses: a cross of two strokes in every element.

use nalgebra::{Point2, Vector2};

use super::bond_lines::ReferenceLines;
use super::canvas::open;
use super::legend;
use super::motion::Motion;
use super::sheet::{Bounds, LONGEST_BAR, Sheet, Shown, Sides, middling};
use super::structure;
use crate::format::{InUnits, round_down, stress_text};
use crate::summary::extreme_stresses;
use masonry::data::state::{ElementStress, State};
use masonry::geometry;
use masonry::model::Model;

/// The shortest bar in the legend, which small stresses have.
const SHORTEST_BAR: f64 = 14.0;
/// Smallest and largest size of an element in pixels on which line widths depend.
const SMALLEST: f64 = 6.0;
const LARGEST: f64 = 33.0;
/// The longest stroke, divided by the size of an element.
const LONGEST: f64 = 2.2;

/// The scale and room that pictures of stresses share, so that their strokes can be compared.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StressScale {
    /// The absolute stress that a twentieth of all elements exceed \[Pa\].
    large: f64,
    largest: f64,
    /// The side of a square as large as a median element \[m\].
    element: f64,
    bounds: Bounds,
}

impl StressScale {
    /// Returns the scale that pictures of the stresses of these states share.
    pub(crate) fn of(states: &[Shown<'_>]) -> Self {
        let ends = states.iter().flat_map(|it| structure::bounds(it.model).ends());
        let none = Self { large: 0.0, largest: 0.0, element: 0.0, bounds: Bounds::of(ends) };
        states.iter().fold(none, |all, it| {
            let [large, largest] = Self::sizes(&it.state.stresses);
            Self {
                large: all.large.max(large),
                largest: all.largest.max(largest),
                element: all.element.max(element_size(it.model, it.state)),
                ..all
            }
        })
    }

    /// Returns the absolute stress that a twentieth of the elements exceed, and the largest \[Pa\].
    fn sizes(stresses: &[ElementStress]) -> [f64; 2] {
        let size = |it: &ElementStress| it.principal.sigma_1.abs().max(it.principal.sigma_2.abs());
        let mut sizes: Vec<f64> = stresses.iter().map(size).collect();
        sizes.retain(|size| *size > 0.0 && size.is_finite());
        sizes.sort_by(f64::total_cmp);
        let large = sizes.get(sizes.len() * 19 / 20).copied().unwrap_or(0.0);
        [large, sizes.last().copied().unwrap_or(0.0)]
    }

    /// Returns pixels per pascal: large stresses fill an element; the largest stresses overlap the next one or two
    /// elements if a few stresses are far above the others.
    fn of_strokes(self, element: f64) -> f64 {
        if self.largest > 0.0 {
            (element / self.large).min(LONGEST * element / self.largest)
        } else {
            1.0
        }
    }
}

/// Draws the principal stresses of every element as crosses whose strokes are proportional to the stresses, with the
/// contact points that are open or slide.
///
/// Strokes of compression and of tension differ in colour. The legend shows the length of the stroke of a round stress.
pub fn principal_stresses(
    title: &str,
    model: &Model,
    state: &State,
    reference: Option<&ReferenceLines>,
) -> String {
    let shown = Shown { title, model, state };
    compared(&shown, reference, StressScale::of(&[shown]))
}

/// Draws the picture of [`principal_stresses`] with the scale that it shares with other pictures.
pub(crate) fn compared(
    shown: &Shown<'_>,
    reference: Option<&ReferenceLines>,
    scale: StressScale,
) -> String {
    let Shown { title, model, state } = *shown;
    let title = format!("{title}: principal stresses");
    let mut sheet = Sheet::new(title, model, scale.bounds, Sides::HATCH);
    structure::outlines(&mut sheet, "bricks", &model.blocks);
    draw_strokes(&mut sheet, model, state, scale);
    structure::supports(&mut sheet, model, Motion::NONE);
    if let Some(lines) = reference {
        let ends = lines.within(structure::bounds(model).high.y);
        sheet.layer("reference", |canvas, frame| {
            for line in ends {
                canvas.path(&open(line.map(|end| frame.at(end))), "");
            }
        });
        sheet.legend.add(&lines.label, "reference", legend::line);
    }
    structure::contact_marks(&mut sheet, model, &state.contacts);
    sheet.finish()
}

fn draw_strokes(sheet: &mut Sheet, model: &Model, state: &State, scale: StressScale) {
    let element = scale.element * sheet.frame.scale;
    let pixels_per_pascal = scale.of_strokes(element);
    let (compression, tension) = extreme_stresses(state);
    for (name, extreme, compressed) in
        [("compression", compression, true), ("tension", tension, false)]
    {
        sheet.layer_sized(name, element.clamp(SMALLEST, LARGEST), |canvas, frame| {
            for ElementStress { centre, principal, .. } in &state.stresses {
                let along = [principal.sigma_1, principal.sigma_2].into_iter();
                let turned = principal.theta + std::f64::consts::FRAC_PI_2;
                for (value, angle) in along.zip([principal.theta, turned]) {
                    if (value <= 0.0) == compressed {
                        let half = 0.5 * value.abs() * pixels_per_pascal;
                        let way = Vector2::new(angle.cos(), angle.sin());
                        let at = frame.at(*centre);
                        canvas.path(&open([-half, half].map(|it| at.along(way, it))), "");
                    }
                }
            }
        });
        if compression.is_some() || tension.is_some() {
            let most = extreme.map(|it| format!("largest {}", stress_text(it.value.abs())));
            let text = format!("{name}, {}", most.unwrap_or("none".to_owned()));
            sheet.legend.add(&text, name, legend::line);
        }
    }
    let extremes = [compression, tension].into_iter().flatten();
    let Some(largest) = extremes.map(|it| it.value.abs()).reduce(f64::max) else {
        return sheet.legend.note("no stress in any element");
    };
    let [shortest, longest] = [SHORTEST_BAR, LONGEST_BAR].map(|it| it / pixels_per_pascal);
    let units = InUnits(model.units);
    let round = round_down(units.stress(largest.max(shortest).min(longest)));
    let round = round * units.0.stress_to_si();
    let half = 0.5 * round * pixels_per_pascal;
    sheet.legend.add(&format!("stroke of {}", stress_text(round)), "bar", legend::bar(half));
}

/// Returns the side of a square as large as a median element \[m\].
fn element_size(model: &Model, state: &State) -> f64 {
    middling(state.stresses.iter().filter_map(|stress| {
        let mesh = model.blocks[stress.block.index()].mesh.as_ref()?;
        let corners: [Point2<f64>; 4] = mesh.elements[stress.element].map(|node| mesh.nodes[node]);
        Some(geometry::area(&corners))
    }))
}
