//! Where the problem comes from, and where a method starts.

use super::{Folder, Run, TEXT, assert_near};

const M: &str = "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 2\n2 1 1\n2 2 2\n";
const Q: &str = "%%MatrixMarket matrix array real general\n2 1\n-5\n-6\n";

/// A body of weight 2 on a plane, pushed by 0.4, with the stiffness 3 behind it.
const CONTACT: &str = r#"{"kind": "contact", "k": [[3, 0], [0, 0]], "f": [0.4, -2], "c_n": [[0, 1]],
    "c_t": [[1, 0]], "x_0": [0], "s_0": [0], "mu": [0.5]}"#;

#[test]
fn standard_input_is_a_file_too() {
    let run = Run::with_input(TEXT, &["solve", "-", "--json"]);
    assert_eq!(run.code, 0);
    assert_near(&run.json()["z"], &[4.0 / 3.0, 7.0 / 3.0]);
    let run = Run::with_input("2 1 x", &["info", "-", "--format", "text"]);
    assert_eq!((run.code, run.out.as_str()), (2, ""));
    assert!(
        run.err.starts_with("error: standard input: line 1, column 2: M and q needs 6"),
        "{}",
        run.err
    );
}

/// The point that another run prints, through a pipe.
#[test]
fn a_point_comes_from_standard_input() {
    let folder = Folder::new("piped");
    let problem = folder.file("problem.txt", TEXT);
    let solved = Run::of(&["solve", &problem, "--json"]);
    let check = Run::with_input(&solved.out, &["check", &problem, "-"]);
    assert_eq!(check.code, 0, "{}", check.err);
    let wrong = Run::with_input(r#"{"z": [1, 1]}"#, &["check", &problem, "-"]);
    assert_eq!(wrong.code, 1, "{}", wrong.err);
    let both = Run::with_input(TEXT, &["check", "-", "-"]);
    assert!(both.code == 2 && both.err.contains("cannot both"), "{}", both.err);
}

#[test]
fn messages_name_what_is_wrong() {
    let nan = Run::with_input("1 nan -1\n", &["solve", "-"]);
    assert!(nan.err.contains("column 3") && nan.err.contains("found `nan`"), "{}", nan.err);
    for (option, words) in [
        ("--tol", "'-1' for '--tol <T>': a tolerance is a number between 0 and 1"),
        ("--attempts", "'-1' for '--attempts <N>': it is a whole number, not negative"),
        ("--time-limit", "'-1' for '--time-limit <S>': it is a number of seconds, not negative"),
    ] {
        let run = Run::with_input(TEXT, &["solve", "-", option, "-1"]);
        assert!(run.code == 2 && run.err.contains(words), "{}", run.err);
    }
    let indefinite = CONTACT.replace("[3, 0]", "[-3, 0]");
    let run = Run::with_input(&indefinite, &["solve", "-"]);
    assert!(run.code == 2 && run.err.contains("K is not positive semidefinite"), "{}", run.err);
}

/// Of contacts reduced to themselves: one that sticks, one that slides, and too much friction.
#[test]
fn forces_at_contacts_are_checked() {
    let folder = Folder::new("forces");
    let file = r#"{"kind": "friction", "w": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]],
        "q": [-2, -0.25, -2, -3], "mu": [0.5, 0.5]}"#;
    let file = folder.file("friction.json", file);
    let check = |forces: &str| Run::with_input(forces, &["check", &file, "-", "--json"]);
    let right = check(r#"{"contacts": {"normal": [2, 2], "tangential": [0.25, 1]}}"#);
    assert_eq!((right.code, &right.json()["solves"]), (0, &true.into()));
    let wrong = check(r#"{"contacts": {"normal": [2, 2], "tangential": [0.25, 3]}}"#);
    assert_eq!((wrong.code, &wrong.json()["solves"]), (1, &false.into()));
    let short = check(r#"{"contacts": {"normal": [2], "tangential": [0.25, 1]}}"#);
    assert!(short.code == 2, "{}", short.out);
    assert!(short.err.contains("standard input: `contacts.normal` has 1 entries"), "{}", short.err);
    // The forces are a start, too: that of the solution takes no pivot.
    let start =
        folder.file("start.json", r#"{"contacts": {"normal": [2, 2], "tangential": [0.25, 1]}}"#);
    let solved = Run::of(&["solve", &file, "--solver", "lemke", "--start", &start, "--json"]);
    assert_eq!((solved.code, &solved.json()["pivots"]), (0, &0.into()));
}

#[test]
fn matrix_market_has_a_file_for_every_part() {
    let folder = Folder::new("market");
    let (m, q) = (folder.file("M.mtx", M), folder.file("q.mtx", Q));
    let run = Run::of(&["solve", "--m", &m, "--q", &q, "--json"]);
    assert_eq!(run.code, 0);
    assert_near(&run.json()["z"], &[4.0 / 3.0, 7.0 / 3.0]);
    // M t - y = -q
    let minus =
        M.replace("symmetric\n2 2 3\n1 1 2\n2 1 1\n2 2 2", "general\n2 2 2\n1 1 -1\n2 2 -1");
    let (b, c) = (folder.file("B.mtx", &minus), folder.file("c.mtx", &Q.replace('-', "")));
    let run = Run::of(&["solve", "--a", &m, "--b", &b, "--c", &c, "--json"]);
    assert_eq!((run.code, &run.json()["kind"]), (0, &"horizontal".into()));
    assert_near(&run.json()["z"], &[4.0 / 3.0, 7.0 / 3.0]);
    let solution = folder.file("answer.json", &run.out);
    let check = Run::of(&["check", "--a", &m, "--b", &b, "--c", &c, &solution]);
    assert_eq!(check.code, 0, "{}", check.err);
    let info = Run::of(&["info", "--m", &m, "--q", &q]);
    assert!(info.out.contains("lcp of order 2, read as matrix-market"), "{}", info.out);
}

#[test]
fn parts_that_are_missing_or_do_not_fit_are_bad_input() {
    let folder = Folder::new("market_input");
    let (m, q) = (folder.file("M.mtx", M), folder.file("q.mtx", Q));
    let long = folder.file("long.mtx", &Q.replace("2 1\n", "3 1\n1\n"));
    let missing = folder.path("missing.mtx");
    for (args, words) in [
        (vec!["--m", &m], "--q"),
        (vec!["--a", &m, "--b", &m], "--c"),
        (vec!["--m", &m, "--q", &q, "--a", &m, "--b", &m, "--c", &q], "cannot be used with"),
        (vec![m.as_str(), "--q", &q, "--m", &m], "cannot be used with"),
        (vec!["--m", &m, "--q", &long], "M.mtx: line 2, column 1: expected the number of rows 3"),
        (vec!["--m", &m, "--q", &missing], "missing.mtx"),
        (vec![&m], "--m M.mtx --q q.mtx"),
    ] {
        let run = Run::of(&[&["solve"], &args[..]].concat());
        assert_eq!((run.code, run.out.as_str()), (2, ""), "{args:?}");
        assert!(run.err.contains(words), "{args:?}: {}", run.err);
    }
}

#[test]
fn contact_problems_have_displacements_and_forces() {
    let folder = Folder::new("contact");
    let file = folder.file("contact.json", CONTACT);
    for solver in ["auto", "lemke", "interior", "qp"] {
        let run = Run::of(&["solve", &file, "--json", "--solver", solver]);
        assert_eq!(run.code, 0, "{solver}");
        let answer = run.json();
        assert_near(&answer["contact"]["u"], &[0.0, 0.0]);
        assert_near(&answer["contact"]["t_n"], &[2.0]);
        assert_near(&answer["contacts"]["tangential"], &[-0.4]);
        let solution = folder.file("answer.json", &run.out);
        let check = Run::of(&["check", &file, &solution, "--json"]);
        assert_eq!((check.code, &check.json()["solves"]), (0, &true.into()), "{solver}");
    }
    // More friction than mu allows.
    let wrong = r#"{"contact": {"u": [-0.4, 0], "t_n": [2], "t_t": [-1.6]}}"#;
    let check = Run::of(&["check", &file, &folder.file("wrong.json", wrong)]);
    assert_eq!(check.code, 1, "{}", check.out);
    let wrong = r#"{"contact": {"u": [0], "t_n": [2], "t_t": [-0.4]}}"#;
    let check = Run::of(&["check", &file, &folder.file("wrong.json", wrong)]);
    assert_eq!(check.code, 2);
    assert!(check.err.contains("`contact.u` has 1 entries, but must have 2"), "{}", check.err);
    let info = Run::of(&["info", &file]).out;
    assert!(info.contains("contacts: 1") && info.contains("C_n: 1 x 2, sparse"), "{info}");
}

#[test]
fn attempts_and_covering_vectors_reach_the_pivots() {
    let folder = Folder::new("attempts");
    // Every covering vector ends on a ray from all y.
    let file = folder.file("problem.txt", "2  0 1  1 0  -1 -1");
    let run = Run::of(&["solve", &file, "--json", "--attempts", "1", "--covering", "random:7"]);
    assert_eq!(run.json()["solver"], "lemke");
    assert_eq!(run.json()["attempts"].as_array().unwrap().len(), 1);
    assert_eq!(run.json()["attempts"][0]["covering"]["Random"]["seed"], 7);
    for (option, value, words) in [
        ("--covering", "twos", "`ones`, or `random:SEED`"),
        ("--covering", "random:x", "`ones`, or `random:SEED`"),
        ("--attempts", "0", "max_attempts"),
    ] {
        let run = Run::of(&["solve", &file, option, value]);
        assert_eq!((run.code, run.out.as_str()), (2, ""), "{option} {value}");
        assert!(run.err.contains(words), "{}", run.err);
    }
    // The chain goes on where attempts end.
    let run = Run::of(&["solve", &file, "--json", "--attempts", "1"]);
    assert_eq!((run.code, &run.json()["solver"]), (0, &"enumeration".into()), "{}", run.out);
    let run = Run::of(&["solve", &file, "--attempts", "2", "--solver", "pgs"]);
    assert!(run.code == 2 && run.err.contains("--attempts is about the pivots"), "{}", run.err);
}

#[test]
fn a_method_starts_where_it_is_told() {
    let folder = Folder::new("start");
    let file = folder.file("problem.txt", TEXT);
    let first =
        Run::of(&["solve", &file, "--json", "--solver", "lemke", "--start", "all-y"]).json();
    assert!(first["pivots"].as_u64().unwrap() > 0);
    // All t is the basis of the solution, and so is that of its point.
    let again = |start: &str| {
        Run::of(&["solve", &file, "--json", "--solver", "lemke", "--start", start]).json()
    };
    assert_eq!(again("all-t")["pivots"], 0);
    assert_eq!(again(&folder.file("answer.json", &first.to_string()))["pivots"], 0);
    let run = Run::of(&["solve", &file, "--start", &folder.path("missing.json")]);
    assert!(run.code == 2 && run.err.contains("missing.json"), "{}", run.err);
}
