//! `lcp enumerate`.

use serde_json::Value;

use super::{Folder, Run};

fn faces(run: &Run) -> Vec<Value> {
    run.json()["faces"].as_array().unwrap().clone()
}

#[test]
fn all_solutions_are_printed_in_rational_numbers() {
    // A game with three equilibria.
    let game = "4  0 0 10 20  0 0 30 15  10 20 0 0  30 15 0 0  -1 -1 -1 -1";
    let run = Run::with_input(game, &["enumerate", "-", "--json"]);
    assert_eq!((run.code, &run.json()["complete"]), (0, &true.into()), "{}", run.out);
    let points: Vec<Value> =
        faces(&run).iter().map(|face| face["vertices"][0]["z"].clone()).collect();
    assert_eq!(points.len(), 3, "{points:?}");
    for expected in
        [["1/10", "0", "1/10", "0"], ["0", "1/15", "0", "1/15"], ["1/90", "2/45", "1/90", "2/45"]]
    {
        assert!(points.contains(&expected.into_iter().collect()), "{points:?}");
    }
    let report = Run::with_input(game, &["enumerate", "-"]).out;
    for words in [
        "z = 1/90, w = 0",
        "isolated solutions: 3",
        "infinitely many solutions: 0",
        "all solutions",
    ] {
        assert!(report.contains(words), "{words} in\n{report}");
    }
}

/// A segment, `w = (z1 + z2 - 1) (1, 1)`, and a half-line, `w = (z1 - z2 + 1) (1, -1)`.
#[test]
fn a_singular_basis_has_infinitely_many() {
    let run = Run::with_input("2  1 1  1 1  -1 -1", &["enumerate", "-", "--json"]);
    let faces = faces(&run);
    assert_eq!((run.code, faces.len(), &faces[0]["dimension"]), (0, 1, &1.into()));
    assert_eq!(
        (&faces[0]["basis"], faces[0]["vertices"].as_array().unwrap().len()),
        (&"tt".into(), 2)
    );
    let report = Run::with_input("2  1 -1  -1 1  1 -1", &["enumerate", "-"]).out;
    for words in [
        "polyhedron of dimension 1",
        "infinitely many solutions, where the basis is singular",
        "ray 1",
    ] {
        assert!(report.contains(words), "{words} in\n{report}");
    }
}

#[test]
fn variables_have_their_own_bounds() {
    let folder = Folder::new("enumerate");
    let boxed = r#"{"kind": "boxed", "m": [[3, 0, 0, 0], [0, 3, 0, 0], [0, 0, 3, 0], [0, 0, 0, 3]],
        "q": [-1, -9, 9, -1], "lower": [null, -1, null, 5], "upper": [null, 2, 2, 5]}"#;
    let run = Run::of(&["enumerate", &folder.file("boxed.json", boxed), "--json"]);
    let faces = faces(&run);
    let point = &faces[0]["vertices"][0];
    assert_eq!(point["z"], ["1/3", "2", "-3", "5"].into_iter().collect::<Value>());
    assert_eq!(point["w"], ["0", "-3", "0", "14"].into_iter().collect::<Value>());
}

#[test]
fn no_solution_and_no_time_are_told_apart() {
    let none = Run::with_input("1 -1 -1", &["enumerate", "-"]);
    assert!(none.code == 1 && none.out.contains("even without complementarity"), "{}", none.out);
    // w1 = z2 - 1 and w2 = z1 + 1 are not negative where z2 and w2 are positive.
    let none = Run::with_input("2  0 1  1 0  -1 1", &["enumerate", "-"]);
    assert!(none.code == 1 && none.out.contains("although the conditions"), "{}", none.out);
    let cut = Run::with_input("1 -1 1", &["enumerate", "-", "--time-limit", "0"]);
    assert!(cut.code == 1 && cut.out.contains("cut after 0 s"), "{}", cut.out);
    assert!(!cut.out.contains("all solutions"), "{}", cut.out);
    let cut = Run::with_input("1 -1 1", &["enumerate", "-", "--time-limit", "0", "--json"]);
    assert_eq!(cut.json()["complete"], false);
    let large = format!("40 {}", "1 ".repeat(40 * 41));
    let large = Run::with_input(&large, &["enumerate", "-"]);
    assert!(large.code == 2 && large.err.contains("allows 32"), "{}", large.err);
}
