//! `lcp solve` of convex programs.

use super::{Folder, Run, assert_near};

/// Hock and Schittkowski, 21.
const PROGRAM: &str = "NAME
ROWS
 N OBJ
 G R1
COLUMNS
 X1 R1 10
 X2 R1 -1
RHS
 RHS OBJ 100 R1 10
BOUNDS
 LO BND X1 2
 UP BND X1 50
 LO BND X2 -50
 UP BND X2 50
QUADOBJ
 X1 X1 0.02
 X2 X2 2
ENDATA
";

#[test]
fn programs_have_their_objective() {
    let folder = Folder::new("programs");
    let file = folder.file("hs21.qps", PROGRAM);
    for command in ["solve", "qp"] {
        for solver in ["auto", "qp", "interior", "lemke"] {
            let run = Run::of(&[command, &file, "--json", "--solver", solver]);
            let answer = run.json();
            assert_eq!((run.code, &answer["kind"]), (0, &"qp".into()), "{command} {solver}");
            let objective = answer["program"]["objective"].as_f64().unwrap();
            assert!((objective + 99.96).abs() < 1e-10, "{command} {solver}: {objective}");
            let check = Run::with_input(&run.out, &["check", &file, "-"]);
            assert_eq!(check.code, 0, "{}{}", check.out, check.err);
        }
    }
    assert_near(&Run::of(&["solve", &file, "--json"]).json()["program"]["x"], &[2.0, 0.0]);
    let report = Run::of(&["qp", &file]).out;
    assert!(
        report.contains("qp of order ") && report.contains("objective: -9.99600000"),
        "{report}"
    );
    let info = Run::of(&["info", &file]).out;
    assert!(info.contains("P: 2 x 2") && info.contains("A: 1 x 2"), "{info}");
    // Nothing below the line, and nothing above it.
    let infeasible = PROGRAM.replace(" LO BND X1 2\n UP BND X1 50", " FX X1 0");
    let infeasible = infeasible.replace(" LO BND X2 -50", " LO BND X2 -9");
    let run = Run::of(&["solve", &folder.file("infeasible.qps", &infeasible), "--json"]);
    assert_eq!((run.code, &run.json()["status"]), (1, &"Infeasible".into()));
}
