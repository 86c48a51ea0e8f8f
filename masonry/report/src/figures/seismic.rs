//! Figures of the seismic check of a limit load.

use super::Figure;
use crate::format::{InUnits, acceleration_text, significant};
use masonry::analysis::limit::SeismicCheck;
use masonry::rounding::{BoundSide, outwards};

/// Returns the law of friction of the factor and the mechanism, as a key and in words.
fn law(it: &SeismicCheck) -> [&'static str; 2] {
    if it.is_of_path {
        ["path", "Coulomb's law, along the path"]
    } else {
        ["associative", "associative flow, a bound for Coulomb's law"]
    }
}

/// Writes an acceleration that is carried, never rounded upwards.
fn carried(value: f64) -> String {
    outwards(value, BoundSide::Below, |it| significant(it, 4))
}

/// Returns the answer of the check in words; without a demand, the capacity with which a demand is to be compared.
pub(crate) fn answer(it: &SeismicCheck) -> String {
    let [found, least] = [it.capacity, it.least_capacity].map(carried);
    let Some(demand) = it.demand else {
        return format!(
            "a_0* is {found}\u{a0}m/s² for this mechanism, and at least {least}\u{a0}m/s² for every mechanism of the same limit"
        );
    };
    // A ratio below one stays below one in text.
    let ratio = |value: f64, side| outwards(value / demand, side, |it| significant(it, 3));
    match it.is_satisfied() {
        Some(true) => format!(
            "satisfied: the least a_0* is {} times the demand",
            ratio(it.least_capacity, BoundSide::Below)
        ),
        Some(false) => {
            format!(
                "not satisfied: a_0* is {} times the demand",
                ratio(it.capacity, BoundSide::Above)
            )
        }
        None => format!(
            "satisfied by this mechanism, not by every mechanism of the same limit (e* = 1 gives {least}\u{a0}m/s²)"
        ),
    }
}

/// Returns the figures of the check, formula by formula.
pub(crate) fn seismic(it: &SeismicCheck, units: InUnits) -> Vec<Figure> {
    let [law, law_in_words] = law(it);
    let data = it.data;
    let shown = |value: f64| significant(value, 4);
    let [capacity, least] =
        [it.capacity, it.least_capacity].map(|it| format!("{}\u{a0}m/s²", carried(it)));
    let mut list = vec![
        Figure::new("law", law).text("law", law_in_words.to_owned()),
        Figure::new("alpha_0", it.multiplier)
            .text("alpha_0", format!("{}, acceleration across gravity / g", carried(it.multiplier)))
            .page("alpha_0", carried(it.multiplier)),
        Figure::new("weight", units.force(it.weight))
            .text("sum P", format!("{}, weights that move", units.force_text(it.weight))),
        Figure::new("mass", it.mass)
            .text("M*", format!("{} kg, (sum P d)^2 / (g sum P d^2)", shown(it.mass))),
        Figure::new("fraction", it.fraction)
            .text("e*", format!("{}, g M* / sum P", shown(it.fraction)))
            .page("e*", shown(it.fraction)),
        Figure::new("FC", data.confidence).text("FC", shown(data.confidence)),
        Figure::new("a_0", it.capacity)
            .text("a_0*", format!("{capacity}, alpha_0 g / (e* FC)"))
            .page("a_0*", format!("{capacity}, FC = {}", shown(data.confidence))),
        Figure::new("a_0_least", it.least_capacity)
            .text(
                "least a_0*",
                format!("{least}, alpha_0 g / FC, of every mechanism of the same limit"),
            )
            .page("least a_0*", format!("{least}, of every mechanism of the same limit")),
        Figure::new("a_g", data.ground),
        Figure::new("S", data.soil),
        Figure::new("q", data.behaviour),
        Figure::new("demand", it.demand),
        Figure::new("satisfied", it.is_satisfied()),
    ];
    if let (Some(demand), Some(ground), Some(soil)) = (it.demand, data.ground, data.soil) {
        let [ground, soil, q] = [ground, soil, data.behaviour].map(shown);
        let formula = format!("{}, a_g S / q", acceleration_text(demand));
        let site = format!("a_g = {ground} g, S = {soil}, q = {q}");
        list.push(Figure::new("", demand).text("site", site));
        list.push(Figure::new("", demand).text("demand", formula));
        list.push(Figure::new("", demand).both("seismic check", answer(it)));
    }
    list
}
