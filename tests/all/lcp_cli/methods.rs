//! The option `--solver`: every method on every kind of problem, and what it does not treat.

use serde_json::Value;

use super::{Folder, Run, TEXT, assert_near, numbers};

/// The names for programs and for people.
const METHODS: [(&str, &str); 5] = [
    ("lemke", "Lemke's method"),
    ("pgs", "projected Gauss-Seidel"),
    ("qp", "quadratic programming"),
    ("newton", "semismooth Newton"),
    ("interior", "the interior-point method"),
];

/// A tridiagonal matrix with 4 on and -1 off the diagonal, of which `z = (1, 2, 1)` is a solution.
const TRIDIAGONAL: &str = "3  4 -1 0  -1 4 -1  0 -1 4  -2 -6 -2";

#[test]
fn every_method_solves_what_is_for_all_of_them() {
    let folder = Folder::new("methods");
    let file = folder.file("problem.txt", TRIDIAGONAL);
    for (option, full_name) in METHODS {
        let run = Run::of(&["solve", &file, "--json", "--solver", option, "--tol", "1e-12"]);
        assert_eq!(run.code, 0, "{option}");
        let answer = run.json();
        assert_eq!(answer["solver"], option);
        assert_near(&answer["z"], &[1.0, 2.0, 1.0]);
        assert_eq!(answer["pivots"].is_u64(), option == "lemke");
        assert_eq!(answer["iterations"].is_u64(), option != "lemke");
        assert_eq!(answer["factorisations"].is_u64(), option != "lemke");
        assert!(answer.get("runs").is_none());
        let report = Run::of(&["solve", &file, "--solver", option]).out;
        let unit = if option == "lemke" { "pivot" } else { "iteration" };
        let line = report.lines().nth(1).unwrap();
        assert!(
            line.starts_with(&format!("Solved: {full_name}, ")) && line.contains(unit),
            "{line}"
        );
        assert!(!report.contains("auto"), "{report}");
    }
}

#[test]
fn every_kind_comes_back_right_from_the_methods_that_treat_it() {
    let folder = Folder::new("kinds_and_methods");
    let mixed =
        r#"{"kind": "mixed", "m": [[2, -1], [1, 1]], "q": [-2, -1], "free": [true, false]}"#;
    let mixed = folder.file("mixed.json", mixed);
    for option in ["auto", "lemke", "qp", "interior"] {
        let answer = Run::of(&["solve", &mixed, "--json", "--solver", option]).json();
        assert_near(&answer["z"], &[1.0, 0.0]);
        assert_near(&answer["w"], &[0.0, 0.0]);
    }
    let boxed = r#"{"kind": "boxed", "m": [[2, 1], [1, 2]], "q": [-9, 2], "lower": [-1, -1],
        "upper": [3, null]}"#;
    let boxed = folder.file("boxed.json", boxed);
    for option in ["auto", "lemke", "pgs"] {
        let answer = Run::of(&["solve", &boxed, "--json", "--solver", option]).json();
        assert_near(&answer["z"], &[3.0, -1.0]);
        assert_near(&answer["w"], &[-4.0, 3.0]);
    }
    let horizontal = r#"{"kind": "horizontal", "a": [[2]], "b": [[-1]], "c": [1]}"#;
    let horizontal = folder.file("horizontal.json", horizontal);
    for option in ["auto", "lemke", "pgs", "qp", "newton", "interior"] {
        let answer = Run::of(&["solve", &horizontal, "--json", "--solver", option]).json();
        assert_near(&answer["z"], &[0.5]);
    }
    let contact = folder.file("contact.dat", "2 1 0 2 2 2 2  2 0 0 1  -2 -0.25  0.5");
    for option in ["auto", "lemke", "pgs", "interior"] {
        let answer = Run::of(&["solve", &contact, "--json", "--solver", option]).json();
        assert_near(&answer["contacts"]["normal"], &[1.0]);
        assert_near(&answer["contacts"]["tangential"], &[0.25]);
    }
}

#[test]
fn a_method_says_what_it_does_not_treat() {
    let folder = Folder::new("not_treated");
    let mixed = r#"{"kind": "mixed", "m": [[0, 1], [-1, 1]], "q": [-1, 1], "free": [true, false]}"#;
    let games = r#"{"kind": "lcp", "m": [[0, 2], [1, 0]], "q": [-1, -1]}"#;
    let (mixed, games) = (folder.file("mixed.json", mixed), folder.file("games.json", games));
    for (file, option, words) in [
        (&mixed, "newton", "semismooth Newton cannot treat this problem: it cannot be converted"),
        (&mixed, "pgs", "projected Gauss-Seidel cannot treat this problem"),
        (&games, "newton", "M[0, 0] is 0, but every diagonal entry must be positive: take Lemke"),
        (&games, "pgs", "row 0 has the diagonal entry 0"),
        (&games, "qp", "skew between them, but M[1, 0] is 1 and M[0, 1] is 2"),
    ] {
        let run = Run::of(&["solve", file, "--json", "--solver", option]);
        assert_eq!((run.code, run.out.as_str()), (2, ""), "{option}");
        assert!(run.err.starts_with("error: ") && run.err.contains(words), "{}", run.err);
    }
}

#[test]
fn auto_says_what_it_chose_and_why() {
    let folder = Folder::new("auto");
    let file = folder.file("problem.txt", TRIDIAGONAL);
    let answer = Run::of(&["solve", &file, "--json"]).json();
    let runs = answer["runs"].as_array().unwrap();
    assert_eq!((&answer["solver"], runs.len()), (&"newton".into(), 1));
    assert_eq!(runs[0]["end"]["ended"]["status"], "Solved");
    let report = Run::of(&["solve", &file]).out;
    assert!(
        report.contains("auto chose semismooth Newton: order 3, dense: no entry off the positive diagonal is positive"),
        "{report}"
    );
    // No solution: one method stalls, the next one has the proof.
    let file = folder.file("none.txt", "2  1 -1 -1 1  -1 -1");
    let run = Run::of(&["solve", &file, "--json"]);
    let answer = run.json();
    let solvers: Vec<&Value> =
        answer["runs"].as_array().unwrap().iter().map(|run| &run["solver"]).collect();
    assert_eq!((run.code, solvers), (1, vec![&"newton".into(), &"lemke".into()]));
    assert_eq!(answer["certificate"]["kind"], "farkas");
    let report = Run::of(&["solve", &file]).out;
    for words in [
        "Infeasible: Lemke's method",
        "auto chose semismooth Newton",
        "Stalled",
        "then Lemke's method",
    ] {
        assert!(report.contains(words), "{words} in\n{report}");
    }
}

#[test]
fn options_of_one_method_are_not_for_another() {
    let folder = Folder::new("options");
    let (file, trace) = (folder.file("problem.txt", TEXT), folder.path("trace.json"));
    for option in ["pgs", "qp", "newton", "interior"] {
        for (name, value) in [("--max-pivots", "5"), ("--trace", trace.as_str())] {
            let run = Run::of(&["solve", &file, "--solver", option, name, value]);
            assert_eq!((run.code, run.out.as_str()), (2, ""), "{option} {name}");
            assert!(run.err.contains(name) && run.err.contains("--solver lemke"), "{}", run.err);
        }
    }
    for option in ["auto", "lemke"] {
        let run = Run::of(&["solve", &file, "--solver", option, "--max-iterations", "5"]);
        assert_eq!((run.code, run.out.as_str()), (2, ""), "{option}");
        assert!(run.err.contains("--solver pgs, qp, newton or interior"), "{}", run.err);
    }
    let args = ["solve", &file, "--solver", "pgs", "--max-iterations", "2", "--json"];
    let run = Run::of(&args);
    assert_eq!((run.code, &run.json()["status"]), (1, &"IterationLimit".into()));
    assert_eq!(run.json()["iterations"], 2);
    let report = Run::of(&args[..6]).out;
    assert!(report.contains("--max-iterations raises it"), "{report}");
}

#[test]
fn the_command_has_every_method_with_its_help() {
    let folder = Folder::new("all-methods");
    let file = folder.file("problem.txt", TEXT);
    let help = Run::of(&["solve", "--help"]).out;
    for method in lcp::Method::ALL {
        let name = method.name();
        let is_told = |line: &str| line.trim().strip_prefix(&format!("- {name}:")).is_some();
        assert!(help.lines().any(is_told), "no help of {name}: {help}");
        let run = Run::of(&["solve", &file, "--solver", name]);
        assert_eq!(run.code, 0, "{name}: {}{}", run.out, run.err);
    }
}

/// By every method, in whatever form it treats a problem: a boxed one becomes the general form, of which bounds that are
/// far away hide the right-hand side.
#[test]
fn what_is_called_solved_passes_the_check() {
    let folder = Folder::new("checked");
    let identity = |bound: f64| {
        format!(
            r#"{{"kind": "boxed", "m": [[1, 0], [0, 1]], "q": [-5, -3], "lower": [-{bound:e}, -{bound:e}],
                "upper": [{bound:e}, {bound:e}]}}"#
        )
    };
    let coupled = |bound: f64| {
        format!(
            r#"{{"kind": "boxed", "m": [[2, 1], [1, 2]], "q": [-5, -6], "lower": [-1, 0],
                "upper": [{bound:e}, {bound:e}]}}"#
        )
    };
    let mixed = r#"{"kind": "mixed", "m": [[0, 1], [-1, 1]], "q": [-1, 1], "free": [true, false]}"#;
    let friction = r#"{"kind": "friction", "w": [[2, 0], [0, 1]], "q": [-2, 0.5], "mu": [0.5]}"#;
    let horizontal = r#"{"kind": "horizontal", "a": [[2]], "b": [[-1]], "c": [1]}"#;
    let mut problems = vec![TEXT.to_owned(), mixed.into(), friction.into(), horizontal.into()];
    let bounds = [1e2, 1e8, 1e16, 1e20];
    let identities = bounds.map(identity);
    problems.extend(identities.iter().cloned().chain(bounds.map(coupled)));
    let mut solved = 0;
    for (number, problem) in problems.iter().enumerate() {
        let file = folder.file(&format!("{number}.json"), problem);
        for method in lcp::Method::ALL {
            let run =
                Run::of(&["solve", &file, "--json", "--tol", "1e-8", "--solver", method.name()]);
            if run.code != 0 {
                continue;
            }
            let answer = folder.file("answer.json", &run.out);
            let check = Run::of(&["check", "--tol", "1e-8", &file, &answer]);
            assert_eq!(check.code, 0, "{method}: {problem}\n{}\n{}", run.out, check.out);
            if identities.contains(problem) {
                let z = numbers(&run.json()["z"]);
                assert!((z[0] - 5.0).abs().max((z[1] - 3.0).abs()) <= 1e-7, "{method}: {z:?}");
            }
            solved += 1;
        }
    }
    assert!(solved >= 4 * problems.len(), "{solved}");
}
