//! QPS: programs with known optima, lines that leave out or repeat something, and what is refused.

use lcp::{Auto, Qp, QpPoint, QuadraticProgram, Solver};
use lcp_problems::io::{Problem, ProblemFormat, ReadError, read, read_file, to_json};

use super::at;

/// `min 0.01 x1^2 + x2^2 - 100`, `10 x1 - x2 >= 10`, `2 <= x1 <= 50`, `-50 <= x2 <= 50` (Hock and Schittkowski, 21).
const HS21: &str = "NAME          HS21
ROWS
 N  OBJ
 G  R1
COLUMNS
    X1        R1        10.0
    X2        R1        -1.0
RHS
    RHS       OBJ       100.0   R1        10.0
BOUNDS
 LO BND       X1        2.0
 UP BND       X1        50.0
 LO BND       X2        -50.0
 UP BND       X2        50.0
QUADOBJ
    X1        X1        0.02
    X2        X2        2.0
ENDATA
";

/// `min 9 - 8 x1 - 6 x2 - 4 x3 + 2 x1^2 + 2 x2^2 + x3^2 + 2 x1 x2 + 2 x1 x3`, `x1 + x2 + 2 x3 <= 3`, `x >= 0`
/// (Hock and Schittkowski, 35), with all entries of the matrix.
const HS35: &str = "NAME HS35
ROWS
 N cost
 L sum
COLUMNS
 x1 cost -8 sum 1
 x2 cost -6 sum 1
 x3 cost -4 sum 2
RHS
 cost -9 sum 3
QMATRIX
 x1 x1 4
 x1 x2 2
 x1 x3 2
 x2 x1 2
 x2 x2 4
 x3 x1 2
 x3 x3 2
ENDATA
";

/// `min x1^2 + x2^2 / 2 + x3^2 + x4^2 / 2 - x1 x3 + x3 x4 - x1 - 3 x2 + x3 - x4`, `x1 + 2 x2 + x3 + x4 <= 5`,
/// `3 x1 + x2 + 2 x3 - x4 <= 4`, `x2 + 4 x3 >= 1.5`, `x >= 0` (Hock and Schittkowski, 76).
const HS76: &str = "* a comment
NAME HS76
OBJSENSE
    MIN
ROWS
 N OBJ
 N UNUSED
 L R1
 L R2
 G R3
COLUMNS
 X1 OBJ -1 R1 1
 X1 R2 3
 X2 OBJ -3 R1 2
 X2 R2 1 R3 1
 X3 OBJ 1 R1 1
 X3 R2 2 R3 4
 X4 OBJ -1 R1 1
 X4 R2 -1 UNUSED 7
RHS
 RHS R1 5 R2 4
 RHS R3 1.5
QSECTION OBJ
 X1 X1 2 X3 -1
 X2 X2 1
 X3 X3 2 X4 1
 X4 X4 1
ENDATA
";

fn program(text: &str) -> Qp {
    let file = read(text.as_bytes(), None).unwrap();
    assert_eq!(file.format, ProblemFormat::Qps);
    let Problem::Qp(program) = file.problem else { panic!("not a program") };
    program
}

fn optimum(program: &Qp) -> QpPoint {
    let solution = Auto::default().solve(program.mixed()).unwrap();
    assert!(solution.is_solved(), "{solution:?}");
    program.variables(&solution)
}

#[test]
fn published_programs_have_their_optima() {
    for (text, objective, x) in [
        (HS21, -99.96, vec![2.0, 0.0]),
        (HS35, 1.0 / 9.0, vec![4.0 / 3.0, 7.0 / 9.0, 4.0 / 9.0]),
        (HS76, -4.681_818_181_818_182, vec![3.0 / 11.0, 23.0 / 11.0, 0.0, 6.0 / 11.0]),
    ] {
        let program = program(text);
        let by_method = QuadraticProgram::default().solve(program.mixed()).unwrap();
        assert!(by_method.is_solved());
        for found in [optimum(&program), program.variables(&by_method)] {
            assert!((found.objective - objective).abs() < 1e-10, "{found:?}");
            assert!(found.x.iter().zip(&x).all(|(x, y)| (x - y).abs() < 1e-9), "{found:?}");
            assert_stationary(&program, &found);
        }
        let json = to_json(&Problem::Qp(program));
        let again = read(json.as_bytes(), None).unwrap().problem;
        assert_eq!(to_json(&again), json);
        let Problem::Qp(again) = again else { panic!("{json}") };
        assert!((optimum(&again).objective - objective).abs() < 1e-10);
    }
}

/// `P x + q = A^T rows + bounds`, with multipliers that are positive at lower bounds, negative at upper ones.
fn assert_stationary(program: &Qp, point: &QpPoint) {
    let QpPoint { x, rows, bounds, .. } = point;
    for j in 0..x.len() {
        let of_p: f64 = program.p().column(j).map(|(i, v)| v * x[i]).sum();
        let of_a: f64 = program.a().column(j).map(|(i, v)| v * rows[i]).sum();
        assert!((of_p + program.q()[j] - of_a - bounds[j]).abs() < 1e-9, "{point:?}");
    }
    let mut ax = vec![0.0; rows.len()];
    for (j, x) in x.iter().enumerate() {
        program.a().column(j).for_each(|(i, v)| ax[i] += v * x);
    }
    let [l, u] = program.row_bounds();
    let [lower, upper] = program.bounds();
    let both = |i: usize| (ax[i], l[i], u[i], rows[i]);
    let all = (0..x.len()).map(|j| (x[j], lower[j], upper[j], bounds[j]));
    for (value, lower, upper, multiplier) in all.chain((0..rows.len()).map(both)) {
        assert!(value >= lower - 1e-9 && value <= upper + 1e-9, "{point:?}");
        assert!(multiplier < 1e-9 || (value - lower).abs() < 1e-8, "{point:?}");
        assert!(multiplier > -1e-9 || (value - upper).abs() < 1e-8, "{point:?}");
    }
}

/// `min (x - 5)^2 / 2 + (y - 5)^2 / 2` with what `bounds`, `ranges` and `right` say of `x`, `y` and of `x + y`.
fn small(kind: char, right: &str, ranges: &str, bounds: &str) -> String {
    format!(
        "NAME\nROWS\n N f\n {kind} r\nCOLUMNS\n x f -5 r 1\n y f -5 r 1\nRHS\n{right}\nRANGES\n{ranges}\nBOUNDS\n\
         {bounds}\nQUADOBJ\n x x 1\n y y 1\nENDATA\n"
    )
}

#[test]
fn ranges_are_on_the_side_of_their_rows() {
    let (infinity, free) = (f64::INFINITY, f64::NEG_INFINITY);
    for (kind, ranges, limits) in [
        ('G', "", [3.0, infinity]),
        ('G', " RNG r -2", [3.0, 5.0]),
        ('L', "", [free, 3.0]),
        ('L', " r 2", [1.0, 3.0]),
        ('E', "", [3.0, 3.0]),
        ('E', " RNG r 2", [3.0, 5.0]),
        ('E', " r -2", [1.0, 3.0]),
    ] {
        // With and without the name of the set.
        for right in [" RHS r 3", " r 3"] {
            let program = program(&small(kind, right, ranges, ""));
            let [lower, upper] = program.row_bounds();
            assert_eq!(
                [lower, upper].map(<[f64]>::to_vec),
                limits.map(|it| vec![it]),
                "{kind} {ranges}"
            );
            let x = optimum(&program).x;
            let sum = 10.0_f64.clamp(limits[0], limits[1]);
            assert!((x[0] + x[1] - sum).abs() < 1e-9, "{kind} {ranges}: {x:?}");
        }
    }
}

#[test]
fn bounds_may_leave_out_the_set_and_have_a_value_too_many() {
    let (infinity, free) = (f64::INFINITY, f64::NEG_INFINITY);
    for (bounds, limits) in [
        ("", [0.0, infinity]),
        (" FR BND x", [free, infinity]),
        (" FR x", [free, infinity]),
        (" FR x 0", [free, infinity]),
        (" FR BND x 0.0", [free, infinity]),
        (" MI BND x", [free, infinity]),
        (" MI x 7", [free, infinity]),
        (" UP x 4\n PL x", [0.0, infinity]),
        (" UP BND x 4\n PL BND x 1e30", [0.0, infinity]),
        (" UP x 4", [0.0, 4.0]),
        (" UP BND x -4", [free, -4.0]),
        (" LO x -6\n UP x -4", [-6.0, -4.0]),
        (" UP x 1e30\n LO x -1e30", [free, infinity]),
        (" UP x inf", [0.0, infinity]),
        (" FX BND x 2", [2.0, 2.0]),
        (" FX x 0", [0.0, 0.0]),
        (" BV x", [0.0, 1.0]),
        (" BV BND x 1", [0.0, 1.0]),
    ] {
        let program = program(&small('N', " f 1", "", bounds));
        let [lower, upper] = program.bounds();
        assert_eq!(
            [[lower[0], upper[0]], [lower[1], upper[1]]],
            [limits, [0.0, infinity]],
            "{bounds}"
        );
        let found = optimum(&program);
        assert!(
            (found.x[0] - 5.0_f64.clamp(limits[0], limits[1])).abs() < 1e-9,
            "{bounds}: {found:?}"
        );
        assert_stationary(&program, &found);
        assert!((program.constant() + 1.0).abs() < 1e-15);
    }
}

/// Names with spaces and signs of several bytes stand in columns.
#[test]
fn names_in_columns_may_have_spaces() {
    let text = "NAME
ROWS
 N  my cost
 L  größe 1
COLUMNS
    x ä       my cost   -5.0           größe 1   1.0
    y         my cost   -5.0           größe 1   1.0
RHS
              größe 1   3.0
BOUNDS
 UP           x ä       1.0
QUADOBJ
    x ä       x ä       1.0
    y         y         1.0
ENDATA
";
    let found = optimum(&program(text));
    assert!((found.x[0] - 1.0).abs() < 1e-9 && (found.x[1] - 2.0).abs() < 1e-9, "{found:?}");
}

#[test]
fn mistakes_have_their_places() {
    let whole = small('L', " r 3", " r 1", " UP x 4");
    for (from, to, place, words) in [
        (" r 3", " RHS s 3", at(9, 6), "expected the name of a row, found `s`"),
        (" r 3", " RHS r", at(9, 2), "the name of a row, found `RHS`"),
        (" r 3", " RHS r 3 f", at(9, 2), "the name of a row, found `RHS`"),
        (" r 3", " r x", at(9, 4), "expected a number, found `x`"),
        (" r 3", " r nan", at(9, 4), "found `nan`"),
        (" r 1\nB", " f 1\nB", at(11, 2), "other rows have no range"),
        (" UP x 4", " UP x", at(13, 2), "a variable and its bound"),
        (" UP x 4", " UP z 4", at(13, 5), "expected the name of a variable, found `z`"),
        (" UP x 4", " UP x four", at(13, 7), "expected a bound, found `four`"),
        (" UP x 4", " FR x four", at(13, 7), "expected a bound, found `four`"),
        (" UP x 4", " UI x 4", at(13, 2), "no integer variables"),
        (" UP x 4", " UP A x 4\n UP B y 4", at(14, 5), "expected `A`, found `B`"),
        (" UP x 4", " UP x -4\n LO x 0", at(18, 1), "between 0.0 and -4.0"),
        (" x x 1", " x x -1", at(17, 1), "P[0, 0] is -1: methods for convex programs"),
        (" y y 1", " x y 1\n y x 1", at(17, 4), "one triangle"),
        ("QUADOBJ", "QUADOBJ r", at(14, 9), "constraints are linear"),
        ("QUADOBJ", "QCMATRIX r", at(14, 1), "expected one of NAME, OBJSENSE"),
        (" x f -5 r 1", " M 'MARKER' 'INTORG'", at(6, 4), "no integer variables"),
        (" L r", " L", at(4, 2), "one name"),
        (" L r", " Q r", at(4, 2), "N, E, G or L"),
        (" L r", " L f", at(4, 4), "a new name"),
        ("ROWS", "OBJSENSE MAX\nROWS", at(2, 10), "expected MIN"),
        ("RHS\n r 3", "RHS r 3", at(8, 5), "expected a header alone"),
        ("ENDATA", "", at(17, 1), "the line ENDATA"),
    ] {
        let text = whole.replacen(from, to, 1);
        assert_ne!(text, whole, "{from}");
        let error = read(text.as_bytes(), Some(ProblemFormat::Qps)).unwrap_err();
        assert!(error.to_string().contains(words), "{text}\n{error}");
        assert_eq!(error.position(), Some(place), "{text}\n{error}");
        // It is recognised all the same.
        let error = read(text.as_bytes(), None).unwrap_err();
        assert!(
            matches!(error, ReadError::Unrecognised { format: ProblemFormat::Qps, .. }),
            "{text}\n{error}"
        );
    }
}

#[test]
fn the_name_of_the_file_names_the_format() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"));
    for name in ["broken.qps", "broken.MPS"] {
        let path = folder.join(name);
        std::fs::write(&path, "ROWS\n X a\n").unwrap();
        let error = read_file(&path, None).unwrap_err();
        assert_eq!(error.position(), Some(at(2, 2)), "{error}");
    }
}

#[test]
fn programs_are_read_from_json() {
    let text = r#"{"kind": "qp", "p": [[2, 0], [0, 2]], "q": [-2, -5], "a": [[1, -2], [1, 1]],
        "l": [-2, null], "u": [null, 3]}"#;
    let Problem::Qp(program) = read(text.as_bytes(), None).unwrap().problem else { panic!() };
    let found = optimum(&program);
    assert!((3.0 * found.x[0] - 4.0).abs() < 1e-9, "{found:?}");
    assert!((3.0 * found.x[1] - 5.0).abs() < 1e-9, "{found:?}");
    for (from, to, place, words) in [
        ("[[2, 0], [0, 2]]", "[[2, 1], [0, 2]]", at(1, 21), "P must be symmetric"),
        ("[[2, 0], [0, 2]]", "[[2, 0], [0, -2]]", at(1, 21), "not positive semidefinite"),
        ("[1, 1]]", "[1]]", at(1, 69), "row 1 has 1 entries"),
        ("\"u\": [null, 3]", "\"u\": [3]", at(2, 31), "`u` has 1 entries, but must have 2"),
        ("\"u\": [null, 3]", "\"u\": [-3, 3]", at(2, 14), "row 0 is to be between -2.0 and -3.0"),
        ("\"u\": [null, 3]", "\"v\": [3]", at(2, 28), "unknown field `v`"),
    ] {
        let error = read(text.replacen(from, to, 1).as_bytes(), None).unwrap_err();
        assert!(error.to_string().contains(words), "{to}: {error}");
        assert_eq!(error.position(), Some(place), "{to}: {error}");
    }
}
