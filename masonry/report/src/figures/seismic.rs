//! Figures of the seismic check of a limit load.

use super::Figure;
use crate::format::{InUnits, acceleration_text, significant};
use masonry::analysis::limit::SeismicCheck;
use masonry::rounding::{BoundSide, outwards};

/// The law of the factor and of the mechanism.
fn law(it: &SeismicCheck) -> [&'static str; 2] {
    if it.is_of_path {
        ["path", "Coulomb's law, along the path"]
    } else {
        ["associative", "associative flow, a bound for Coulomb's law"]
    }
}

/// The check, formula by formula.
pub(crate) fn seismic(it: &SeismicCheck, units: InUnits) -> Vec<Figure> {
    let [law, law_in_words] = law(it);
    let data = it.data;
    let shown = |value: f64| significant(value, 4);
    // An acceleration that is carried is not rounded upwards.
    let carried = |value: f64| outwards(value, BoundSide::Below, shown);
    let capacity = format!("{}\u{a0}m/s²", carried(it.capacity));
    let mut list = vec![
        Figure::new("law", law).text("law", law_in_words.to_owned()),
        Figure::new("alpha_0", it.multiplier)
            .text("alpha_0", format!("{}, acceleration / g", carried(it.multiplier)))
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
        let is_satisfied = it.capacity >= demand;
        let result = if is_satisfied { "satisfied" } else { "not satisfied" };
        let ratio = it.capacity / demand;
        // A ratio below one stays below one in text.
        let side = if is_satisfied { BoundSide::Below } else { BoundSide::Above };
        let ratio = outwards(ratio, side, |it| significant(it, 3));
        let words = format!("{result}: a_0* is {ratio} times the demand");
        list.push(Figure::new("", demand).text("site", site));
        list.push(Figure::new("", demand).text("demand", formula));
        list.push(Figure::new("", demand).both("seismic check", words));
    }
    list
}
