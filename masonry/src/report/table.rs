//! The report as text, at most 100 columns wide.

mod history;
mod loads;

use comfy_table::{CellAlignment, ContentArrangement, LineStyle, Table, TableStyle, presets};

use super::format::{InUnits, aligned, block_name, significant};
use super::moving::moving_part;
use super::summary::{
    self, CornerSum, ExtremeStress, Resultant, applied_load, corner_sums, extreme_film_stresses,
    extreme_stresses, largest_displacement, reason, total_reaction, weight,
};
use crate::analysis::outcome::Outcome;
use crate::data::info::SoftReport;
use crate::data::state::{FilmStress, State};
use crate::data::verdict::Evidence;
use crate::plan::{Choice, Plan};
use crate::scene::Route;

const WIDTH: u16 = 100;

/// The whole report: verdict, reactions, state, history and loads; then how they were found, what was built, and
/// times. If there is no solution, what this means.
pub fn report(outcome: &Outcome) -> String {
    let title = if outcome.title.is_empty() { "Untitled scene" } else { &outcome.title };
    let rule: String = title.chars().map(|_| '=').collect();
    let judgement = &outcome.judgement;
    let warnings = judgement.warnings.iter().map(|warning| head(&format!("Warning: {warning}")));
    let verdict = head(&judgement.sentence) + &warnings.collect::<String>();
    let mut text = format!("{verdict}\n{title}\n{rule}\n");
    if let Some(reason) = reason(outcome) {
        text += &section("No equilibrium found");
        text += &paragraph(&reason);
    }
    if let Some(rates) = &outcome.mechanism {
        text += &section("Mechanism");
        let is_proof = judgement.evidence == Evidence::NoAdmissibleForces;
        let what = if is_proof { "moves in the proof" } else { "moves" };
        text += &pairs(&[(what, moving_part(&outcome.model, rates))]);
    }
    if let Some(state) = &outcome.state {
        text += &section("Reactions on the structure");
        text += &reactions(outcome);
        text += &section("State");
        text += &pairs(&state_figures(outcome, state));
    }
    if let Some(history) = &outcome.history {
        text += &section("Load history");
        text += &history::history(history, InUnits(outcome.model.units));
    }
    if !outcome.model.loads.is_empty() {
        text += &section("Loads");
        text += &loads::loads(&outcome.model);
    }
    text += &section("Solution");
    text += &pairs(&solution(outcome));
    text += &section("What was built");
    text += &built(&outcome.plan);
    text += &section("Time");
    text += &pairs(&times(outcome));
    text
}

/// The plan: effects with their reasons, sizes, and the solver.
pub fn plan(plan: &Plan) -> String {
    let mut table = table(&["effect", "", "unknowns", "because", "expected cost"], &[2]);
    for effect in &plan.effects {
        table.add_row(vec![
            effect.name.to_owned(),
            if effect.on { "on" } else { "off" }.to_owned(),
            effect.unknowns.to_string(),
            effect.because.clone(),
            effect.cost.clone(),
        ]);
    }
    format!("{}\n\n{}", table.trim_fmt(), pairs(&figures(plan)))
}

/// The plan of a solve: what is off in one line.
fn built(plan: &Plan) -> String {
    let mut table = table(&["effect", "unknowns", "because", "expected cost"], &[1]);
    for effect in plan.effects.iter().filter(|effect| effect.on) {
        let unknowns = effect.unknowns.to_string();
        table.add_row(vec![effect.name, &unknowns, &effect.because, &effect.cost]);
    }
    let off: Vec<&str> =
        plan.effects.iter().filter(|effect| !effect.on).map(|effect| effect.name).collect();
    let mut lines = figures(plan);
    lines.insert(0, ("not used", off.join(", ")));
    format!("{}\n\n{}", table.trim_fmt(), pairs(&lines))
}

fn figures(plan: &Plan) -> Vec<(&'static str, String)> {
    let sizes = format!(
        "{}, {}, {}, {} ({} with friction), {}",
        count(plan.blocks, "block"),
        count(plan.nodes, "node"),
        count(plan.joints, "joint"),
        count(plan.contact_points, "contact point"),
        plan.frictional_points,
        count(plan.rigid_modes, "rigid amplitude")
    );
    let mut lines = vec![
        ("sizes", sizes),
        ("order", plan.order.to_string()),
        ("memory", memory(&plan.routes)),
        ("solver", format!("{}: {}", plan.solver, plan.because)),
    ];
    lines.extend(plan.refused.iter().map(|why| ("refused", why.clone())));
    for (index, choice) in plan.routes.iter().enumerate() {
        let head = if index == 0 { "route" } else { "" };
        lines.push((head, format!("{}: {}", choice.route.name(), choice.because)));
    }
    lines
}

fn count(number: usize, what: &str) -> String {
    format!("{number} {what}{}", if number == 1 { "" } else { "s" })
}

fn residuals(it: &lcp::Residuals) -> String {
    listed(&[
        ("equation", it.equation),
        ("feasibility", it.feasibility),
        ("complementarity", it.complementarity),
        ("natural", it.natural),
        ("loads", it.loads),
    ])
}

/// What the first route needs, and the one that needs most, if it is asked at all. In units of 10^6 bytes, which are few for the
/// smallest scenes.
fn memory(routes: &[Choice]) -> String {
    let megabytes = |it: &Choice| format!("{} MB", significant(it.memory_bytes as f64 / 1e6, 2));
    let most = routes.iter().max_by_key(|it| it.memory_bytes);
    let first = routes.first().map_or_else(String::new, megabytes);
    match most.filter(|most| routes[0].memory_bytes < most.memory_bytes) {
        Some(most) => {
            format!("about {first}; {} if {} is asked", megabytes(most), most.route.name())
        }
        None => format!("about {first}"),
    }
}

fn solution(outcome: &Outcome) -> Vec<(&'static str, String)> {
    let solve = &outcome.solve;
    let mut rows = vec![
        ("status", format!("{:?}", solve.status)),
        ("route", format!("{}: {}", solve.route.name(), solve.because)),
        ("form", format!("{}, order {}", solve.form, solve.order)),
    ];
    if solve.route == Route::Lemke {
        rows.push(("pivots", solve.pivots.to_string()));
    } else {
        rows.push(("iterations", solve.iterations.to_string()));
    }
    rows.push(("factorisations", solve.factorisations.to_string()));
    for (index, attempt) in solve.attempts.iter().enumerate() {
        rows.push((if index == 0 { "attempts" } else { "" }, attempt.clone()));
    }
    if let Some(soft) = &solve.soft {
        rows.push(("soft springs", bias(soft)));
    }
    if outcome.state.is_some() {
        rows.push(("residuals", residuals(&solve.residuals)));
    }
    if let Some(paper) = &solve.coulomb_residuals {
        rows.push(("(3.27)", format!("{}, of the same solution in this form", residuals(paper))));
    }
    rows
}

fn bias(soft: &SoftReport) -> String {
    let share = significant(soft.share, 3);
    let error = soft.displacement_error.map_or_else(String::new, |error| {
        format!(" and changed the displacements by a fraction of {}", significant(error, 3))
    });
    format!(
        "of stiffness {:.0e}, re-centred {} times; at first they carried {share} of the load{error}",
        soft.stiffness, soft.rounds
    )
}

fn reactions(outcome: &Outcome) -> String {
    let units = InUnits(outcome.model.units);
    let force = units.0.force_name();
    let energy = units.0.energy_name();
    let heads =
        ["support", &format!("fx [{force}]"), &format!("fy [{force}]"), &format!("m [{energy}]")];
    let mut table = table(&heads, &[1, 2, 3]);
    let (sum, load) = (total_reaction(outcome), applied_load(&outcome.model));
    let rest = Resultant { force: sum.force + load.force, moment: sum.moment + load.moment };
    let parts = |it: Resultant| [it.force.x, it.force.y, it.moment];
    let single = outcome.reactions.iter().map(|it| (it.support.clone(), [it.fx, it.fy, it.m]));
    let mut rows: Vec<(String, [f64; 3])> = single.collect();
    let mut totals = vec![("sum of reactions", sum)];
    let (weight, loads) = (weight(&outcome.model), summary::loads(&outcome.model));
    if weight != Resultant::default() && loads != Resultant::default() {
        totals.extend([("self weight", weight), ("loads", loads)]);
    }
    totals.extend([("applied load", load), ("unbalanced", rest)]);
    let corners = corner_sums(outcome);
    let together = |it: &CornerSum| (it.supports.join(" + "), parts(it.sum));
    rows.extend(corners.iter().map(together));
    rows.extend(totals.into_iter().map(|(name, it)| (name.to_owned(), parts(it))));
    let forces: Vec<f64> =
        rows.iter().flat_map(|(_, [fx, fy, _])| [*fx, *fy]).map(|it| units.force(it)).collect();
    let moments: Vec<f64> = rows.iter().map(|(_, [_, _, m])| units.energy(*m)).collect();
    let (forces, moments) = (aligned(&forces, 6), aligned(&moments, 6));
    for (index, (name, _)) in rows.iter().enumerate() {
        if index == outcome.reactions.len() {
            table.add_row(vec![""]);
        }
        let (fx, fy) = (&forces[2 * index], &forces[2 * index + 1]);
        table.add_row(vec![name.as_str(), fx, fy, &moments[index]]);
    }
    let mut text = table.trim_fmt() + "\n Moments are about the origin.\n";
    if !corners.is_empty() {
        text += " Of supports that meet in a corner only the sum (+) is unique.\n";
    }
    text
}

fn state_figures(outcome: &Outcome, state: &State) -> Vec<(&'static str, String)> {
    let model = &outcome.model;
    let units = InUnits(model.units);
    let length = units.0.length_name();
    let place = |x: f64, y: f64| {
        let [x, y] = [x, y].map(|metres| significant(units.length(metres), 4));
        format!("({x}, {y}) {length}")
    };
    let mut rows = Vec::new();
    if let Some(checks) = &outcome.checks {
        let errors = [
            ("force", checks.force_balance),
            ("moment", checks.moment_balance),
            ("uncarried load", checks.uncarried),
            ("nodes", checks.nodal_balance),
            ("cone violation", checks.cone_violation),
            ("penetration", checks.penetration),
            ("complementarity", checks.complementarity),
            ("energy", checks.energy),
        ];
        rows.push(("balance", listed(&errors)));
        let counts = [("open", checks.open), ("stick", checks.stick), ("slip", checks.slip)];
        let counts = counts.map(|(name, count)| format!("{count} {name}"));
        rows.push(("contact points", counts.join(", ")));
    }
    if let Some(it) = largest_displacement(model, state) {
        let value = significant(units.length(it.value), 6);
        let (block, at) = (block_name(model, it.block), place(it.position.x, it.position.y));
        let text = format!("u_{} = {value} {length} in block {block} at {at}", it.component);
        rows.push(("largest displacement", text));
    }
    let energy =
        format!("{} {}", significant(units.energy(state.strain_energy), 6), units.0.energy_name());
    rows.push(("strain energy", energy));
    let stress = |it: Option<ExtremeStress>| {
        it.map_or("none".to_owned(), |it| {
            let value = significant(units.stress(it.value.abs()), 6);
            let (block, at) = (block_name(model, it.block), place(it.position.x, it.position.y));
            format!("{value} {} in block {block} at {at}", units.0.stress_name())
        })
    };
    if !state.stresses.is_empty() {
        let (compression, tension) = extreme_stresses(state);
        rows.push(("largest compression", stress(compression)));
        rows.push(("largest tension", stress(tension)));
    }
    if let Some(films) = extreme_film_stresses(state) {
        let text = |film: FilmStress, value: f64| {
            let at = model.contacts[film.contact.index()].position;
            let (value, at) = (significant(units.stress(value), 6), place(at.x, at.y));
            format!("{value} {} at {at}", units.0.stress_name())
        };
        let compression = text(films.compression, 0.0 - films.compression.sigma_y);
        rows.push(("film compression", compression));
        rows.push(("film shear", text(films.shear, films.shear.tau.abs())));
        if let Some(sigma_x) = films.along.sigma_x {
            let name = if sigma_x > 0.0 { "tension along films" } else { "pressure along films" };
            rows.push((name, text(films.along, sigma_x.abs())));
        }
    }
    rows
}

fn times(outcome: &Outcome) -> Vec<(&str, String)> {
    let seconds = |value: f64| format!("{:>9.3} ms", 1e3 * value);
    let mut rows: Vec<(&str, String)> = Vec::new();
    for time in &outcome.times {
        rows.push((&time.phase, seconds(time.seconds)));
    }
    rows.push(("total", seconds(outcome.times.iter().map(|time| time.seconds).sum())));
    rows
}

fn listed(values: &[(&str, f64)]) -> String {
    let texts: Vec<String> =
        values.iter().map(|(name, value)| format!("{name} {}", significant(*value, 3))).collect();
    texts.join(", ")
}

pub(super) fn section(title: &str) -> String {
    let rule: String = title.chars().map(|_| '-').collect();
    format!("\n{title}\n{rule}\n")
}

pub(super) fn paragraph(text: &str) -> String {
    let mut table = Table::new();
    table.load_style(presets::NOTHING).set_content_arrangement(ContentArrangement::Dynamic);
    table.set_width(WIDTH).add_row(vec![text]);
    table.trim_fmt() + "\n"
}

/// A paragraph of the head of the report.
pub(super) fn head(text: &str) -> String {
    paragraph(text).lines().map(|line| line.trim_start().to_owned() + "\n").collect()
}

/// Names and values in two columns.
pub(super) fn pairs(rows: &[(&str, String)]) -> String {
    let mut table = Table::new();
    table.load_style(presets::NOTHING).set_content_arrangement(ContentArrangement::Dynamic);
    table.set_width(WIDTH);
    for (name, value) in rows {
        table.add_row(vec![*name, value]);
    }
    table.trim_fmt() + "\n"
}

pub(super) fn table(heads: &[&str], right: &[usize]) -> Table {
    let mut table = Table::new();
    let rule = LineStyle::none().fill('-').junction('-');
    table.load_style(TableStyle::new().header_separator(rule));
    table.set_content_arrangement(ContentArrangement::Dynamic).set_width(WIDTH);
    table.set_header(heads.to_vec());
    for index in right {
        if let Some(column) = table.column_mut(*index) {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    table
}
