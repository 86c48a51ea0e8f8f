//! The command-line program `lcp`: what it prints, where, and its exit code.

mod enumerate;
mod input;
mod methods;
mod programs;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

use serde_json::Value;

/// What a run printed, and its exit code.
struct Run {
    code: u8,
    out: String,
    err: String,
}

impl Run {
    fn of(args: &[&str]) -> Self {
        Self::with_input("", args)
    }

    fn with_input(input: &str, args: &[&str]) -> Self {
        let (mut out, mut err) = (Vec::new(), Vec::new());
        let args = std::iter::once("lcp").chain(args.iter().copied()).map(OsString::from);
        let code = lcp_problems::cli::run(args, &mut input.as_bytes(), &mut out, &mut err);
        let text = |bytes| String::from_utf8(bytes).unwrap();
        Self { code, out: text(out), err: text(err) }
    }

    /// The one JSON object on standard output.
    fn json(&self) -> Value {
        assert_eq!(self.err, "");
        let value: Value = serde_json::from_str(&self.out).unwrap();
        assert!(value.is_object());
        value
    }
}

/// A folder of its own for the files of a test.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("lcp_cli").join(name);
        std::fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    fn path(&self, name: &str) -> String {
        self.0.join(name).to_str().unwrap().to_owned()
    }

    fn file(&self, name: &str, content: &str) -> String {
        std::fs::write(self.0.join(name), content).unwrap();
        self.path(name)
    }
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

fn assert_near(found: &Value, expected: &[f64]) {
    let found = numbers(found);
    let near = found.len() == expected.len()
        && found.iter().zip(expected).all(|(x, y)| (x - y).abs() <= 1e-12);
    assert!(near, "{found:?}, but expected {expected:?}");
}

/// `z = (4/3, 7/3)`, `w = 0`.
const TEXT: &str = "2   2 1  1 2   -5 -6";

#[test]
fn a_solved_problem_is_one_object() {
    let folder = Folder::new("solved");
    let run = Run::of(&["solve", &folder.file("problem.txt", TEXT), "--json"]);
    assert_eq!(run.code, 0);
    let answer = run.json();
    assert_eq!((&answer["status"], &answer["solver"]), (&"Solved".into(), &"newton".into()));
    assert_eq!((&answer["n"], &answer["certificate"]), (&2.into(), &Value::Null));
    assert_near(&answer["z"], &[4.0 / 3.0, 7.0 / 3.0]);
    assert_near(&answer["w"], &[0.0, 0.0]);
    assert!(answer["time_s"].as_f64().unwrap() >= 0.0 && answer["cpu_s"].as_f64().unwrap() >= 0.0);
    assert!(answer["factorisations"].as_u64().unwrap() >= 1);
    for name in ["equation", "feasibility", "complementarity", "natural"] {
        assert!(answer["residuals"][name].as_f64().unwrap() <= 1e-12, "{name}");
    }
}

/// `w = -z - 1` is negative for every `z >= 0`.
#[test]
fn a_problem_without_solution_says_why() {
    let folder = Folder::new("unsolved");
    let file = folder.file("problem.txt", "1  -1  -1");
    let run = Run::of(&["solve", &file, "--json"]);
    assert_eq!(run.code, 1);
    let answer = run.json();
    assert_ne!(answer["status"], "Solved");
    assert!(answer["certificate"]["kind"].is_string(), "{answer}");
    let run = Run::of(&["solve", &file]);
    assert_eq!((run.code, run.err.as_str()), (1, ""));
    assert!(run.out.contains(answer["status"].as_str().unwrap()), "{}", run.out);
}

#[test]
fn the_report_is_short_and_readable() {
    let folder = Folder::new("report");
    let run = Run::of(&["solve", &folder.file("problem.txt", TEXT), "--solver", "lemke"]);
    assert_eq!((run.code, run.err.as_str()), (0, ""));
    for words in
        ["lcp of order 2, read as text", "Solved: Lemke's method", "equation", "1.33333333e0"]
    {
        assert!(run.out.contains(words), "{words} in\n{}", run.out);
    }
}

#[test]
fn free_and_bounded_variables_come_back_as_they_were_put() {
    let folder = Folder::new("kinds");
    let mixed = r#"{"kind": "mixed", "m": [[0, 1], [-1, 1]], "q": [-1, 1], "free": [true, false]}"#;
    let run = Run::of(&["solve", &folder.file("mixed.json", mixed), "--json"]);
    assert_near(&run.json()["z"], &[2.0, 1.0]);
    let boxed = r#"{"kind": "boxed", "m": [[2, 1], [1, 2]], "q": [-9, 2], "lower": [-1, -1],
        "upper": [3, null]}"#;
    let run = Run::of(&["solve", &folder.file("boxed.json", boxed), "--json"]);
    assert_near(&run.json()["z"], &[3.0, -1.0]);
    assert_near(&run.json()["w"], &[-4.0, 3.0]);
    let horizontal = r#"{"kind": "horizontal", "a": [[2]], "b": [[-1]], "c": [1]}"#;
    let run = Run::of(&["solve", &folder.file("horizontal.json", horizontal), "--json"]);
    assert_near(&run.json()["z"], &[0.5]);
}

/// One contact that sticks: `W = [[2, 0], [0, 1]]`, `q = (-2, -0.25)`.
#[test]
fn contacts_have_their_forces() {
    let folder = Folder::new("friction");
    let file = folder.file("contact.dat", "2 1 0 2 2 2 2  2 0 0 1  -2 -0.25  0.5");
    let answer = Run::of(&["solve", &file, "--json"]).json();
    assert_eq!((&answer["kind"], &answer["n"]), (&"friction".into(), &3.into()));
    assert_near(&answer["contacts"]["normal"], &[1.0]);
    assert_near(&answer["contacts"]["tangential"], &[0.25]);
    let report = Run::of(&["solve", &file]).out;
    assert!(report.contains("tangential") && report.contains("2.50000000e-1"), "{report}");
}

#[test]
fn limits_and_tolerances_reach_the_solver() {
    let folder = Folder::new("limits");
    let file = folder.file("problem.txt", TEXT);
    let run = Run::of(&["solve", &file, "--json", "--max-pivots", "0"]);
    assert_eq!((run.code, &run.json()["status"]), (1, &"PivotLimit".into()));
    let run = Run::of(&["solve", &file, "--json", "--solver", "lemke", "--time-limit", "0"]);
    assert_eq!((run.code, &run.json()["status"]), (1, &"TimeLimit".into()));
    for (option, value, words) in [
        ("--tol", "2", "tolerance"),
        ("--time-limit", "-1", "--time-limit"),
        ("--time-limit", "nan", "--time-limit"),
    ] {
        let option = format!("{option}={value}");
        let run = Run::of(&["solve", &file, "--json", &option]);
        assert_eq!((run.code, run.out.as_str()), (2, ""), "{option}");
        assert!(run.err.contains(words), "{}", run.err);
    }
}

#[test]
fn the_trace_has_a_record_for_every_pivot() {
    let folder = Folder::new("trace");
    let (file, trace) = (folder.file("problem.txt", TEXT), folder.path("trace.json"));
    let answer = Run::of(&["solve", &file, "--json", "--trace", &trace]).json();
    let trace: Value = serde_json::from_str(&std::fs::read_to_string(trace).unwrap()).unwrap();
    assert_eq!(trace.as_array().unwrap().len() as u64, answer["pivots"].as_u64().unwrap());
}

#[test]
fn a_solution_passes_the_check_and_another_point_does_not() {
    let folder = Folder::new("check");
    let file = folder.file("problem.txt", TEXT);
    let answer = Run::of(&["solve", &file, "--json"]).out;
    let solution = folder.file("answer.json", &answer);
    let run = Run::of(&["check", &file, &solution, "--json"]);
    assert_eq!((run.code, &run.json()["solves"]), (0, &true.into()));
    // Without w it is M z + q.
    let wrong = folder.file("wrong.json", r#"{"z": [0, 0]}"#);
    let run = Run::of(&["check", &file, &wrong, "--json"]);
    assert_eq!((run.code, &run.json()["solves"]), (1, &false.into()));
    // A negative w is half of the terms of its row: the other half is q.
    assert_eq!(run.json()["residuals"]["feasibility"], 0.5);
    let run = Run::of(&["check", &file, &wrong]);
    assert!(run.out.contains("not a solution"), "{}", run.out);
    // A wrong w is found as well.
    let wrong = folder.file("wrong_w.json", r#"{"z": [1.5, 2], "w": [0, 0]}"#);
    let run = Run::of(&["check", &file, &wrong, "--json"]);
    assert!(run.json()["residuals"]["equation"].as_f64().unwrap() > 1e-2);
}

#[test]
fn a_point_that_misses_only_a_row_of_small_loads_is_told_apart() {
    let folder = Folder::new("small-row");
    let file = folder.file("problem.json", r#"{"kind":"lcp","m":[[1,1],[0,1]],"q":[-1,-2e-11]}"#);
    // The second row reads z_2 = 2e-11; the first one does not notice.
    let point = folder.file("point.json", r#"{"z": [1, 0], "w": [0, 0]}"#);
    let run = Run::of(&["check", &file, &point]);
    assert!(
        run.out.contains("not row by row: a row with small terms misses by 1.0e0"),
        "{}",
        run.out
    );
    assert_eq!(run.code, 1);
    let point = folder.file("point.json", r#"{"z": [0.99999999998, 2e-11], "w": [0, 0]}"#);
    let run = Run::of(&["check", &file, &point]);
    assert!(run.out.ends_with("the point is a solution to 1.0e-10\n"), "{}", run.out);
}

#[test]
fn points_that_do_not_fit_are_bad_input() {
    let folder = Folder::new("check_input");
    let file = folder.file("problem.txt", TEXT);
    let horizontal =
        folder.file("general.json", r#"{"kind": "horizontal", "a": [[2]], "b": [[-1]], "c": [1]}"#);
    for (file, point, words) in [
        (&file, r#"{"z": [1]}"#, "`z` has 1 entries, but must have 2"),
        (&file, r#"{"z": [1, 2], "w": []}"#, "`w` has 0 entries, but must have 2"),
        (&file, r#"{"w": [1, 2]}"#, "missing field `z`"),
        (&file, "[", "line 1 column 1"),
        (&horizontal, r#"{"z": [1]}"#, "`w` is missing"),
    ] {
        let point = folder.file("point.json", point);
        let run = Run::of(&["check", file, &point, "--json"]);
        assert_eq!((run.code, run.out.as_str()), (2, ""), "{words}");
        assert!(run.err.contains(words) && run.err.contains("point.json"), "{}", run.err);
    }
}

#[test]
fn info_says_what_a_file_holds() {
    let folder = Folder::new("info");
    let file = folder.file("problem.txt", "2   2 1  0 -2   -5 -6");
    let facts = Run::of(&["info", &file, "--json"]).json();
    assert_eq!((&facts["kind"], &facts["format"]), (&"lcp".into(), &"text".into()));
    let matrix = &facts["matrices"][0];
    assert_eq!((&matrix["storage"], &matrix["nonzeros"]), (&"dense".into(), &3.into()));
    assert_eq!((&matrix["asymmetry"], &matrix["negative_diagonal"]), (&0.5.into(), &1.into()));
    let run = Run::of(&["info", &file]);
    assert_eq!((run.code, run.err.as_str()), (0, ""));
    assert!(run.out.contains("M: 2 x 2, dense, 3 nonzeros"), "{}", run.out);
    let sparse = r#"{"kind": "boxed", "m": {"rows": 1, "cols": 1, "triplets": [[0, 0, 3]]},
        "q": [1], "lower": [0], "upper": [1]}"#;
    let facts = Run::of(&["info", &folder.file("sparse.json", sparse), "--json"]).json();
    assert_eq!((&facts["n"], &facts["pairs"], &facts["free"]), (&1.into(), &2.into(), &0.into()));
    assert_eq!(facts["matrices"][0]["storage"], "sparse");
}

/// A dense matrix of this order would take 80 GB.
#[test]
fn sparse_problems_stay_sparse() {
    let folder = Folder::new("sparse");
    let order = 100_000;
    let q = vec!["-1"; order].join(",");
    let entries: Vec<String> = (0..order).map(|i| format!("[{i},{i},2]")).collect();
    let m = format!(r#"{{"rows": {order}, "cols": {order}, "triplets": [{}]}}"#, entries.join(","));
    let text = format!(r#"{{"kind": "lcp", "m": {m}, "q": [{q}]}}"#);
    let run = Run::of(&["solve", &folder.file("large.json", &text), "--json"]);
    assert_eq!(run.code, 0);
    let answer = run.json();
    let z = answer["z"].as_array().unwrap();
    let is_half = |z: &Value| (z.as_f64().unwrap() - 0.5).abs() <= f64::EPSILON;
    assert!(z.len() == order && z.iter().all(is_half));
}

#[test]
fn bad_input_is_reported_on_standard_error_alone() {
    let folder = Folder::new("bad_input");
    let damaged = folder.file("damaged.dat", "2 0 2 2 2 2\n1 2\n3 4\n-5 oops");
    let missing = folder.path("missing.dat");
    for (args, words) in [
        (
            vec!["solve", &damaged, "--json"],
            "damaged.dat: line 4, column 4: expected number 2 in q, which has 2",
        ),
        (
            vec!["solve", &damaged, "--format", "siconos-mlcp"],
            "line 1, column 1: expected storage type 1",
        ),
        (vec!["solve", &missing, "--json"], "missing.dat"),
        (vec!["info", &missing], "cannot read"),
        (
            vec!["solve", &damaged, "--format", "xml"],
            "possible values: json, text, qps, siconos-lcp",
        ),
        (vec!["solve"], "required"),
        (vec!["slove", &damaged], "unrecognized subcommand"),
        (vec![], "Usage"),
    ] {
        let run = Run::of(&args);
        assert_eq!((run.code, run.out.as_str()), (2, ""), "{args:?}");
        assert!(run.err.contains(words), "{args:?}: {}", run.err);
    }
}

#[test]
fn help_and_version_are_not_errors() {
    for (option, words) in [("--help", "Usage: lcp"), ("--version", "lcp 0.1.0")] {
        let run = Run::of(&[option]);
        assert_eq!((run.code, run.err.as_str()), (0, ""));
        assert!(run.out.contains(words), "{}", run.out);
    }
}

/// A reader of the output that has gone away.
struct Closed;

impl std::io::Write for Closed {
    fn write(&mut self, _: &[u8]) -> std::io::Result<usize> {
        Err(std::io::ErrorKind::BrokenPipe.into())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_closed_pipe_is_not_a_failure() {
    let folder = Folder::new("pipe");
    let file = folder.file("problem.txt", TEXT);
    let args = ["lcp", "solve", &file, "--json"].map(OsString::from);
    let mut err = Vec::new();
    assert_eq!(lcp_problems::cli::run(args, &mut std::io::empty(), &mut Closed, &mut err), 0);
    assert!(err.is_empty() && Path::new(&file).exists());
}
