//! Contact problems with the displacements of the bodies.

use lcp::faer::mat;
use lcp::faer::sparse::SparseColMat;
use lcp::{Contact2d, Lemke, Solver};
use lcp_problems::io::{Problem, ProblemFormat, ReadError, read, to_json};

use super::{at, error, error_as, problem};

/// A body of weight 2 above a plane, pushed by 0.4, with the stiffness 3 behind it.
const CONTACT: &str = r#"{"kind": "contact", "k": [[3, 0], [0, 0]], "f": [0.4, -2], "c_n": [[0, 1]],
 "c_t": [[1, 0]], "x_0": [0.1], "s_0": [-0.2], "mu": [0.5]}"#;

fn contact(problem: &Problem) -> &Contact2d {
    let Problem::Contact(contact) = problem else { panic!("not contact: {problem:?}") };
    contact
}

/// The same numbers, with the sparse parts as triplets that add up.
#[test]
fn json_has_the_matrices_dense_or_as_triplets() {
    let triplets = CONTACT
        .replace("[[0, 1]]", r#"{"rows": 1, "cols": 2, "triplets": [[0, 1, 0.25], [0, 1, 0.75]]}"#);
    for text in [CONTACT, &triplets] {
        let problem = problem(text);
        let contact = contact(&problem);
        assert_eq!((contact.displacements(), contact.points()), (2, 1));
        assert_eq!((contact.loads(), contact.mu()), (&[0.4, -2.0][..], &[0.5][..]));
        assert_eq!((contact.initial_gaps(), contact.initial_slips()), (&[0.1][..], &[-0.2][..]));
        // It sinks by 0.1 and stands on the plane, which carries the weight.
        let state = contact.variables(&Lemke::default().solve(contact).unwrap());
        assert!((state.u[1] + 0.1).abs() < 1e-15 && (state.t_n[0] - 2.0).abs() < 1e-14);
    }
}

/// On a spring of the stiffness 8 it sinks further.
#[test]
fn json_may_have_compliances() {
    let text = CONTACT.replace(r#""mu": [0.5]"#, r#""mu": [0.5], "compliance": [[0.125, 0.25]]"#);
    let problem = problem(&text);
    let contact = contact(&problem);
    assert_eq!(contact.compliance(), [[0.125, 0.25]]);
    let state = contact.variables(&Lemke::default().solve(contact).unwrap());
    assert!((state.u[1] + 0.35).abs() < 1e-15 && (state.t_n[0] - 2.0).abs() < 1e-14);
    let written = to_json(&problem);
    assert!(written.contains(r#""compliance":[[0.125,0.25]]"#), "{written}");
    assert_eq!(to_json(&super::problem(&written)), written);
    assert!(!to_json(&super::problem(CONTACT)).contains("compliance"));
    for (pairs, place, words) in [
        ("[]", at(2, 75), "`compliance` has 0 entries, but must have 1"),
        ("[[0.125]]", at(2, 82), "invalid length 1"),
        ("[[-0.125, 0]]", at(1, 1), "contact point 0 has the normal compliance -0.125"),
    ] {
        let error = error(&text.replace("[[0.125, 0.25]]", pairs));
        assert!(error.to_string().contains(words), "{pairs}: {error}");
        assert_eq!(error.position(), Some(place), "{pairs}: {error}");
    }
}

#[test]
fn json_says_what_is_wrong_with_a_contact() {
    for (from, to, place, words) in [
        (
            r#""c_n": [[0, 1]]"#,
            r#""c_n": [[0, 1, 2]]"#,
            at(1, 67),
            "C_n is 1 x 3, but must be 1 x 2",
        ),
        (r#""x_0": [0.1]"#, r#""x_0": []"#, at(2, 26), "`x_0` has 0 entries, but must have 1"),
        (r#""mu": [0.5]"#, r#""mu": [-0.5]"#, at(2, 54), "`mu` is -0.5, but must be from 0"),
        ("[3, 0], [0, 0]", "[3, 0], [1, 0]", at(1, 26), "K must be symmetric"),
        (r#", "mu": [0.5]"#, "", at(2, 46), "missing field `mu`"),
    ] {
        let text = CONTACT.replacen(from, to, 1);
        assert_ne!(text, CONTACT, "{from}");
        let error = error(&text);
        assert!(error.to_string().contains(words), "{to}: {error}");
        assert_eq!(error.position(), Some(place), "{to}: {error}");
    }
}

/// `M v = q + H r`, `u = H^T v + b`, with `H` by columns: the normal one first.
#[test]
fn global_friction_of_siconos_is_a_contact_of_velocities() {
    let dense = "2 1  0 2 2 2 2  3 0 0 1  0 2 2 2 2  0 1 1 0  0.4 -2  0.1 -0.2  0.5";
    let h = "2 2 2 1 banner\ntriplet: 2-by-2, nzmax: 2 nnz: 2\n 1 0 : 1\n 0 1 : 1\n";
    let sparse = format!("2 1  0 2 2 2 2  3 0 0 1  {h}  0.4 -2  0.1 -0.2  0.5");
    for text in [dense, &sparse] {
        let file = read(text.as_bytes(), None).unwrap();
        assert_eq!(file.format, ProblemFormat::SiconosGlobalFriction);
        let contact = contact(&file.problem);
        let dense = |m: &SparseColMat<usize, f64>| m.to_dense();
        assert_eq!(dense(contact.stiffness()), mat![[3.0, 0.0], [0.0, 1.0]]);
        assert_eq!(dense(contact.normal()), mat![[0.0, 1.0]]);
        assert_eq!(dense(contact.tangent()), mat![[1.0, 0.0]]);
        assert_eq!((contact.initial_gaps(), contact.initial_slips()), (&[0.1][..], &[-0.2][..]));
        assert_eq!((contact.loads(), contact.mu()), (&[0.4, -2.0][..], &[0.5][..]));
    }
}

/// More bodies than contacts: `H` is not square. Each body may move to and fro, and meets a wall.
#[test]
fn global_friction_has_any_number_of_velocities() {
    let text = "2 1  0 3 3 3 3  1 0 0 0 1 0 0 0 1  0 3 2 3 2  -1 0 0  0 1 0  4 5 6  2 0  0.3";
    let problem = problem(text);
    let contact = contact(&problem);
    assert_eq!((contact.displacements(), contact.points()), (3, 1));
    assert_eq!(
        (contact.normal().to_dense()[(0, 0)], contact.tangent().to_dense()[(0, 1)]),
        (-1.0, 1.0)
    );
}

#[test]
fn damaged_global_friction_is_refused_with_the_place() {
    for marked in [
        "!3 1  0 2 2 2 2  3 0 0 1  0 2 2 2 2  0 1 1 0  0.4 -2  0.1 -0.2  0.5",
        "2 1  0 2 2 2 2  3 0 0 1  0 2 !3 2 3  0 1 1 0  0.4 -2  0.1 -0.2  0.5",
        "2 1  0 2 2 2 2  3 0 0 1  0 2 2 2 2  0 1 1 0  0.4 -2  0.1 -0.2  !-0.5",
        "2 1  0 2 2 2 2  3 0 0 1  0 2 2 2 2  0 1 1 0  0.4 -2  0.1 -0.2  0.5  !1",
        // M is not symmetric.
        "2 1!  0 2 2 2 2  3 1 0 1  0 2 2 2 2  0 1 1 0  0.4 -2  0.1 -0.2  0.5",
    ] {
        let error = error_as(ProblemFormat::SiconosGlobalFriction, &marked.replace('!', ""));
        let column = marked.find('!').unwrap() + 1;
        assert_eq!(error.position(), Some(at(1, column)), "{marked}: {error}");
    }
    let short = error_as(ProblemFormat::SiconosGlobalFriction, "2 1 0 1000000000 1000000000 1");
    assert!(matches!(short, ReadError::TooShort { .. }), "{short}");
}
