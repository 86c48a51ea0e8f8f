//! `lcp enumerate`.

use std::fmt::Write as _;
use std::io::{Read, Write};

use serde::Serialize;

use super::args::EnumerateArgs;
use super::output::{Failure, NOT_SOLVED, SOLVED, show};
use crate::exact::{EnumerationSettings, ExactPoint, Face, RBig, enumerate};
use crate::io::Problem;

/// The object that `--json` prints.
#[derive(Debug, Serialize)]
struct Solutions {
    kind: &'static str,
    n: usize,
    /// Whether all of them were found within the time.
    complete: bool,
    /// Whether the conditions can be met without complementarity.
    feasible: bool,
    faces: Vec<Set>,
}

/// The solutions on the same sides of all pairs.
#[derive(Debug, Serialize)]
struct Set {
    /// Zero for one solution alone; else there are infinitely many.
    dimension: usize,
    /// The variable of every pair of the general form that may be positive.
    basis: String,
    vertices: Vec<Point>,
    rays: Vec<Point>,
}

/// Rational numbers, as text.
#[derive(Debug, Serialize)]
struct Point {
    z: Vec<String>,
    w: Vec<String>,
}

pub(super) fn run(
    args: &EnumerateArgs,
    input: &mut dyn Read,
    out: &mut dyn Write,
) -> Result<u8, Failure> {
    let problem = args.input.read(input)?.problem;
    let settings = EnumerationSettings {
        max_order: EnumerationSettings::LARGEST_ORDER,
        max_generators: 1_000_000,
        time_limit: Some(args.time_limit),
    };
    let all = enumerate(&problem.to_general(), &settings)?;
    let solutions = Solutions {
        kind: problem.kind(),
        n: problem.order(),
        complete: all.is_complete,
        feasible: all.is_feasible(),
        faces: all.faces.iter().map(|face| Set::of(&problem, face)).collect(),
    };
    show(out, args.input.json, &solutions, || solutions.report(args.time_limit.as_secs_f64()))?;
    Ok(if all.is_complete && all.is_solvable() { SOLVED } else { NOT_SOLVED })
}

impl Solutions {
    fn report(&self, seconds: f64) -> String {
        let Self { kind, n, complete, feasible, faces } = self;
        let mut text = format!("{kind} of order {n}\n");
        for (number, face) in faces.iter().enumerate() {
            let _ = write!(text, "\nsolution {}, on the sides {}", number + 1, face.basis);
            text += &face.report();
        }
        let isolated = faces.iter().filter(|face| face.dimension == 0).count();
        let _ = writeln!(text, "\nisolated solutions: {isolated}");
        let _ =
            writeln!(text, "polyhedra of infinitely many solutions: {}", faces.len() - isolated);
        let verdict = match (complete, faces.is_empty(), feasible) {
            (false, ..) => &format!(
                "The search was cut after {seconds} s, so that there may be more; --time-limit raises it."
            ),
            (true, false, _) => "These are all solutions.",
            (true, true, true) => {
                "There is no solution, although the conditions can be met without complementarity."
            }
            (true, true, false) => {
                "There is no solution: the conditions cannot be met, even without complementarity."
            }
        };
        text + verdict + "\n"
    }
}

impl Set {
    fn of(problem: &Problem, face: &Face) -> Self {
        let is_positive = |values: &dyn Fn(&ExactPoint) -> bool| {
            face.vertices.iter().chain(&face.rays).any(values)
        };
        let side = |i: usize| match i {
            _ if is_positive(&|point| point.t[i] > RBig::ZERO) => 't',
            _ if is_positive(&|point| point.y[i] > RBig::ZERO) => 'y',
            _ => '0',
        };
        let pairs = face.vertices.first().map_or(0, |vertex| vertex.t.len());
        Self {
            dimension: face.dimension,
            basis: (0..pairs).map(side).collect(),
            vertices: face.vertices.iter().map(|it| Point::of(problem, it, true)).collect(),
            rays: face.rays.iter().map(|it| Point::of(problem, it, false)).collect(),
        }
    }

    fn report(&self) -> String {
        let Self { dimension, vertices, rays, .. } = self;
        if *dimension == 0 {
            return format!("\n{}", vertices.iter().map(Point::report).collect::<String>());
        }
        let mut text = format!(
            ": a polyhedron of dimension {dimension}, of infinitely many solutions, where the basis is singular:\n\
             all mixtures of the vertices, plus multiples of the rays\n"
        );
        for (name, points) in [("vertex", vertices), ("ray", rays)] {
            for (number, point) in points.iter().enumerate() {
                let _ = write!(text, "{name} {}\n{}", number + 1, point.report());
            }
        }
        text
    }
}

impl Point {
    /// A point, in the variables of the problem; a direction is without the bounds.
    fn of(problem: &Problem, point: &ExactPoint, is_place: bool) -> Self {
        let origin = |bound: f64| RBig::try_from(bound).ok().filter(|_| is_place);
        let (z, w) = match problem.boxed() {
            Some(boxed) => {
                boxed.recover_in(&point.t, &point.y, |bound| origin(bound).unwrap_or_default())
            }
            None => (point.t.clone(), point.y.clone()),
        };
        let text = |values: Vec<RBig>| values.iter().map(ToString::to_string).collect();
        Self { z: text(z), w: text(w) }
    }

    fn report(&self) -> String {
        let mut lines = String::new();
        for (i, (z, w)) in self.z.iter().zip(&self.w).enumerate() {
            let _ = writeln!(lines, "{i:>5}  z = {z}, w = {w}");
        }
        lines
    }
}
