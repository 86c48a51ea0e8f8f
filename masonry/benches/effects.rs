//! What every effect costs: one wall with each of them switched off and on, by pivots and by interior points.
//!
//! `cargo bench --bench effects` prints two tables; with `-- --write` it also puts them into
//! `docs/data/effects.md`, and the ratios into the table of `docs/effects.md`. Times are medians of whole solves on one
//! thread, memory is what was allocated at the peak of one more; the allocator counts in all of them, which costs next to
//! nothing.

#[path = "../../benches/common/mod.rs"]
mod common;
#[path = "../../benches/common/machine.rs"]
mod machine;
#[path = "effects/wall.rs"]
mod wall;

use std::fmt::Write as _;
use std::time::Instant;

use allocation_counter::measure;
use lcp::Status;
use masonry::analysis::outcome::Outcome;
use masonry::analysis::solve::solve;
use masonry::forms::reduction::Reduction;
use masonry::forms::{DenseForm, FormKind, Sparse};
use masonry::model::Model;
use masonry::scene::{Route, Scene};
use masonry::system::System;
use wall::Wall;

/// Odd, for the median.
const RUNS: usize = 9;

/// A scene without an effect and with it.
struct Pair {
    effect: &'static str,
    scenes: [Scene; 2],
}

/// What a scene takes.
struct Taken {
    unknowns: [usize; 3],
    steps: usize,
    seconds: f64,
    bytes: u64,
    allocations: u64,
}

/// What both scenes of a pair take.
struct Row {
    effect: &'static str,
    taken: [Taken; 2],
}

impl Row {
    fn ratio(&self, of: fn(&Taken) -> f64) -> f64 {
        of(&self.taken[1]) / of(&self.taken[0])
    }
}

fn main() {
    if !common::is_bench() {
        return;
    }
    let mut page = machine::machine();
    let mut routes = Vec::new();
    for (route, wall) in [(Route::Lemke, Wall::small()), (Route::Interior, Wall::large())] {
        let rows: Vec<Row> = pairs(route, wall).into_iter().map(row).collect();
        let table = table(&rows);
        println!("{}\n{table}", wall.title(route));
        let _ = write!(page, "\n**{}**\n\n{table}", wall.title(route));
        routes.push(rows);
    }
    common::write_if_asked("docs/data/effects.md", "effects", &page);
    if std::env::args().any(|argument| argument == "--write") {
        let path = common::root().join("docs/effects.md");
        let text = std::fs::read_to_string(&path).expect("the page is part of the repository");
        std::fs::write(path, with_ratios(&text, &routes)).expect("the page can be written");
    }
}

/// Rows of the table of the page, and which measurement belongs into each.
const MEASURED: [(&str, &str); 12] = [
    ("contact", "contact pairs across a slot"),
    ("friction", "friction"),
    ("joint stiffness", "joint stiffness"),
    ("mortar films", "mortar films"),
    ("longitudinal film terms", "longitudinal film terms"),
    ("deformation", "deformation, eight elements a brick"),
    ("self weight", "self weight"),
    ("edge loads", "edge loads"),
    ("stresses", "stresses"),
    ("dense matrices", "dense matrices"),
    ("load history", "load history of five steps"),
    ("support movements", "a support that moves"),
];

/// The page with new ratios in the last two cells of its rows: time and memory, each by both routes.
fn with_ratios(page: &str, routes: &[Vec<Row>]) -> String {
    let ratios = |effect: &str, of: fn(&Taken) -> f64| {
        let rows = routes.iter().filter_map(|rows| rows.iter().find(|row| row.effect == effect));
        let ratios: Vec<String> = rows.map(|row| format!("{:.1}", row.ratio(of))).collect();
        ratios.join(", ")
    };
    let line = |line: &str| {
        let row = |(name, _): &&(&str, &str)| line.starts_with(&format!("| {name} | "));
        let Some((_, effect)) = MEASURED.iter().find(row) else { return format!("{line}\n") };
        let cells: Vec<&str> = line.trim_end_matches(" |").rsplitn(3, " | ").collect();
        let [time, memory] =
            [ratios(effect, |it| it.seconds), ratios(effect, |it| it.bytes as f64)];
        format!("{} | {time} | {memory} |\n", cells[2])
    };
    page.lines().map(line).collect()
}

/// Every effect that can be switched for itself, at a wall of elastic bricks with friction in dry joints, under
/// a load and its weight.
fn pairs(route: Route, wall: Wall) -> Vec<Pair> {
    let of = |effect, change: fn(Wall) -> [Wall; 2]| {
        let scenes = change(wall).map(|wall| wall.scene().route(route));
        Pair { effect, scenes }
    };
    let mut pairs = vec![
        of("contact pairs across a slot", |wall| {
            let slotted = Wall { slot: true, ..wall };
            [slotted, Wall { far_pairs: true, ..slotted }]
        }),
        of("friction", |wall| [Wall { friction: false, ..wall }, wall]),
        of("joint stiffness", |wall| [wall, Wall { stiffness: true, ..wall }]),
        of("mortar films", |wall| [wall, Wall { mortar: true, ..wall }]),
        of("longitudinal film terms", |wall| {
            let films = Wall { mortar: true, gauss: true, ..wall };
            [films, Wall { strips: true, ..films }]
        }),
        of("deformation, one element a brick", |wall| {
            let coarse = Wall { mesh: [1, 1], ..wall };
            [Wall { elastic: false, ..coarse }, coarse]
        }),
        of("deformation, eight elements a brick", |wall| {
            let fine = Wall { mesh: [4, 2], ..wall };
            [Wall { elastic: false, ..fine }, fine]
        }),
        of("self weight", |wall| [Wall { weight: false, ..wall }, wall]),
        of("edge loads", |wall| [Wall { load: false, ..wall }, wall]),
        of("stresses", |wall| [wall, Wall { stresses: true, ..wall }]),
        of("load history of five steps", |wall| [wall, Wall { steps: 5, ..wall }]),
        of("a support that moves", |wall| [wall, Wall { moves: true, ..wall }]),
    ];
    if route == Route::Lemke {
        let scenes = [Route::Interior, route].map(|route| wall.scene().route(route));
        pairs.push(Pair { effect: "dense matrices", scenes });
    }
    pairs
}

fn row(pair: Pair) -> Row {
    let Pair { effect, scenes } = pair;
    // The first solve of a thread leaves behind what products of matrices keep for it.
    let first = scenes.each_ref().map(answered);
    let mut seconds = [Vec::new(), Vec::new()];
    // In turns, so that a machine that becomes slower is so for both.
    for _ in 0..RUNS {
        for (scene, seconds) in scenes.iter().zip(&mut seconds) {
            let began = Instant::now();
            let outcome = solve(scene).expect("the scene is sound");
            seconds.push(began.elapsed().as_secs_f64());
            drop(outcome);
        }
    }
    let [off, on] = [0, 1].map(|k| taken(&scenes[k], &first[k], &mut seconds[k]));
    println!("{effect}: {:.2} times the time", on.seconds / off.seconds);
    Row { effect, taken: [off, on] }
}

fn taken(scene: &Scene, first: &Outcome, seconds: &mut [f64]) -> Taken {
    seconds.sort_by(f64::total_cmp);
    let memory = measure(|| drop(answered(scene)));
    let unknowns = built(scene);
    assert_eq!(first.plan.order, unknowns.iter().sum::<usize>(), "the plan says what is built");
    Taken {
        unknowns,
        steps: first.solve.pivots.max(first.solve.iterations),
        seconds: seconds[RUNS / 2],
        bytes: memory.bytes_max,
        allocations: memory.count_total,
    }
}

fn answered(scene: &Scene) -> Outcome {
    let outcome = solve(scene).expect("the scene is sound");
    assert_eq!(outcome.solve.status, Status::Solved, "{:?}", outcome.solve.attempts);
    outcome
}

/// Unknowns of the first problem of the route, counted where it is built: displacements, normal forces, and what
/// friction adds.
fn built(scene: &Scene) -> [usize; 3] {
    let model = Model::from_scene(scene).expect("the scene is sound");
    let system = System::new(&model).expect("the blocks are sound");
    if scene.solver.route == Route::Lemke.into() {
        let reduction = Reduction::new(&system, None).expect("no block is free");
        let form = DenseForm::new(FormKind::Coulomb, &system, &reduction).expect("all is finite");
        return [0, form.points(), form.order() - form.points()];
    }
    let problem = Sparse::new(&system).expect("all is finite").problem;
    [problem.displacements(), problem.points(), 2 * problem.frictional().len()]
}

fn table(rows: &[Row]) -> String {
    let mut table = String::from(
        "| effect | displacements + normal + friction | steps of the solver | time \\[ms\\] | ratio | peak memory \\[MB\\] | ratio | allocations |\n\
         |---|--:|--:|--:|--:|--:|--:|--:|\n",
    );
    for row in rows {
        let [off, on] = &row.taken;
        let _ = writeln!(
            table,
            "| {} | {} → {} | {} → {} | {:.1} → {:.1} | {:.2} | {:.2} → {:.2} | {:.2} | {} → {} |",
            row.effect,
            listed(off.unknowns),
            listed(on.unknowns),
            off.steps,
            on.steps,
            1e3 * off.seconds,
            1e3 * on.seconds,
            row.ratio(|it| it.seconds),
            off.bytes as f64 / 1e6,
            on.bytes as f64 / 1e6,
            row.ratio(|it| it.bytes as f64),
            off.allocations,
            on.allocations,
        );
    }
    table
}

fn listed(unknowns: [usize; 3]) -> String {
    unknowns.map(|number| number.to_string()).join(" + ")
}
