//! Files with problems: what they say, and what is wrong with them and where.

mod contact;
mod damage;
mod market;
mod qps;
use lcp::{Lemke, Matrix, Solver};
use lcp_problems::io::{Position, Problem, ProblemFormat, ReadError, read, to_json};

fn problem(text: &str) -> Problem {
    read(text.as_bytes(), None).unwrap().problem
}

fn error(text: &str) -> ReadError {
    read(text.as_bytes(), None).unwrap_err()
}

fn error_as(format: ProblemFormat, text: &str) -> ReadError {
    read(text.as_bytes(), Some(format)).unwrap_err()
}

fn rows(matrix: &Matrix) -> Vec<Vec<f64>> {
    (0..matrix.nrows()).map(|i| (0..matrix.ncols()).map(|j| matrix[(i, j)]).collect()).collect()
}

/// `M` and `q` of a problem that has them.
fn parts(problem: &Problem) -> (Vec<Vec<f64>>, Vec<f64>) {
    match problem {
        Problem::Lcp(problem) => (rows(problem.m()), problem.q().to_vec()),
        Problem::Mixed(problem) => (rows(problem.m()), problem.q().to_vec()),
        other => panic!("no M and q in {other:?}"),
    }
}

fn at(line: usize, column: usize) -> Position {
    Position { line, column }
}

#[test]
fn plain_text_has_rows_and_comments() {
    let file = read(b"# order\n2\n1 2  # first row\n3 4\n-5 -6e0#q", None).unwrap();
    assert_eq!(file.format, ProblemFormat::Text);
    assert_eq!(parts(&file.problem), (vec![vec![1.0, 2.0], vec![3.0, 4.0]], vec![-5.0, -6.0]));
    assert_eq!(problem("0").order(), 0);
}

#[test]
fn plain_text_says_what_is_wrong_and_where() {
    let short = error_as(ProblemFormat::Text, "2\n1 2\n3 4\n5\n");
    let expected = ReadError::TooShort { at: at(1, 2), what: "M and q", needed: 6, left: 5 };
    assert_eq!(short, expected);
    for (text, place) in [
        ("", at(1, 1)),
        ("-1 2 3", at(1, 1)),
        ("1.5 2 3", at(1, 1)),
        ("1\n2 x", at(2, 3)),
        ("1\n2 inf", at(2, 3)),
        ("1\n2 1e999", at(2, 3)),
        ("1\n2 nan", at(2, 3)),
        ("1 2 3\n\n  4", at(3, 3)),
    ] {
        let error = error_as(ProblemFormat::Text, text);
        assert_eq!(error.position(), Some(place), "{text:?}: {error}");
    }
}

#[test]
fn sizes_beyond_the_content_are_refused() {
    let huge = usize::MAX;
    let block = "1 1000000000 1000000000 1 1 1 1000000000 1000000000 2 1 0 1 0 0";
    for text in [
        "1000000000 1 2 3".to_owned(),
        format!("{huge} 1 2 3"),
        "1000000000 0 1000000000 1000000000 1000000000 1000000000 1 2".to_owned(),
        format!("1000000000 {block}"),
        format!("2 500000000 {block}"),
        format!("2 {huge} {block}"),
        format!("1 1 {huge} {huge} 0 1"),
        "0 1 1000000000 1000000000 1".to_owned(),
        r#"{"kind": "lcp", "m": {"rows": 1000000000, "cols": 1000000000, "triplets": []}, "q": [1]}"#
            .to_owned(),
        format!(r#"{{"kind": "lcp", "m": {{"rows": 1, "cols": {huge}, "triplets": []}}, "q": [1]}}"#),
    ] {
        for format in ProblemFormat::ALL.map(Some).into_iter().chain([None]) {
            assert!(read(text.as_bytes(), format).is_err(), "{format:?} {text}");
        }
    }
}

#[test]
fn a_dense_matrix_of_siconos_stands_by_columns() {
    let file = read(b"2\n0\n2\n2\n2\t2\n1 2\n3 4\n-5 -6\n\nSome words 7 8", None).unwrap();
    assert_eq!(file.format, ProblemFormat::SiconosLcp);
    assert_eq!(parts(&file.problem), (vec![vec![1.0, 3.0], vec![2.0, 4.0]], vec![-5.0, -6.0]));
}

/// One matrix, `[[1, 0, 2], [0, 3, 4], [0, 0, 5]]`, in the storages of Siconos.
#[test]
fn all_storages_of_siconos_are_read() {
    let dense = "3 3  1 0 0  0 3 0  2 4 5";
    // Blocks of 1 and 2 rows and columns; the block (1, 0) is missing.
    let blocks = "3 2 2  1 3  1 3  3 3  0 2 3  0 1 1  0 1  1 0 2  2 3 0 4 5";
    let banner = "CSparse Version 3.1.4, Oct 10, 2014.  Copyright (c) Someone, 2006-2014";
    let triplets = format!(
        "1\n{banner}\ntriplet: 3-by-3, nzmax: 6 nnz: 5\n 0 0 : 1\n 1 1 : 3\n 0 2 : 2\n 1 2 : 4\n 2 2 : 5"
    );
    let columns = format!(
        "2\n{banner}\n3-by-3, nzmax: 5 nnz: 5, 1-norm: 1.1e+01\n col 0 : locations 0 to 0\n 0 : 1\n \
         col 1 : locations 1 to 1\n 1 : 3\n col 2 : locations 2 to 4\n 0 : 2\n 1 : 4\n 2 : 5"
    );
    let by_rows = format!(
        "3\n{banner}\n3-by-3, nzmax: 5 nnz: 5, 1-norm: 1.1e+01\n col 0 : locations 0 to 1\n 0 : 1\n \
         2 : 2\n col 1 : locations 2 to 3\n 1 : 3\n 2 : 4\n col 2 : locations 4 to 4\n 2 : 5"
    );
    let matrix = vec![vec![1.0, 0.0, 2.0], vec![0.0, 3.0, 4.0], vec![0.0, 0.0, 5.0]];
    for (storage, is_sparse, text) in [
        (0, false, dense),
        (1, true, blocks),
        (2, true, &triplets),
        (2, true, &columns),
        (2, true, &by_rows),
    ] {
        let file = read(format!("3 {storage} 3 3 {text}\n-1 -2 -3").as_bytes(), None).unwrap();
        assert_eq!(file.format, ProblemFormat::SiconosLcp);
        assert_eq!(file.problem.matrices()[0].1.is_sparse(), is_sparse);
        assert_eq!(parts(&file.problem), (matrix.clone(), vec![-1.0, -2.0, -3.0]), "{text}");
    }
}

#[test]
fn damaged_storages_are_refused_with_the_place() {
    // The wrong word is behind the mark.
    for marked in [
        "2 0 2 !3",
        "2 !3 2 2",
        "2 0 2 2 2 2 1 2 3 !x -5 -6",
        // Ends of blocks that do not reach the order, or go back.
        "2 1 2 2 1 1 1 !1 2 2 1 0 1 0 0 1 -1 -1",
        "2 1 2 2 1 2 1 2 !2 2 2 1 0 1 0 0 1 1",
        // Row pointers that do not begin at 0, or go back, and a block column that does not exist.
        "2 1 2 2 1 1 1 2 2 2 1 !1 1 0 0 1 1 1 1 -1 -1",
        "2 1 2 2 1 2 1 1 2 2 3 1 0 1 !0 0 0 1 1 -1 -1",
        "2 1 2 2 1 1 1 2 2 2 1 0 1 !1 0 1 1 1 1 -1 -1",
        // A second block where the first is expected.
        "2 1 2 2 1 1 1 2 2 2 1 0 1 0 !1 1 1 1 1 -1 -1",
        "1 2 1 1 1 triplet: !1-by-2, nzmax: 1 nnz: 1 0 0 : 1 1",
        "1 2 1 1 !2 triplet: 1-by-1, nzmax: 1 nnz: 1 0 0 : 1 1",
        "1 2 1 1 1 triplet: 1-by-1, nzmax: 1 nnz: 1 0 !1 : 1 1",
        "1 2 1 1 2 1-by-1, nzmax: 1 nnz: 1, 1-norm: 1 col 0 : locations 0 to !5 0 : 1 1",
    ] {
        let error = error_as(ProblemFormat::SiconosLcp, &marked.replace('!', ""));
        let column = marked.find('!').unwrap() + 1;
        assert_eq!(error.position(), Some(at(1, column)), "{marked}: {error}");
    }
}

/// The numbers of `2 u + 3 v + 4 = 0`, `w = 5 u + 6 v + 7`.
#[test]
fn mixed_problems_are_read_from_either_representation() {
    let one = "0 1 2  0 1  0 2 2 2 2  2 5 3 6  4 7";
    let four = "2 6 3 5 4 7";
    for text in
        [format!("1 0 1 1 {one}"), format!("0 1 1 1 {four}"), format!("1 1 1 1 {one} {four} 1 2 3")]
    {
        let file = read(text.as_bytes(), None).unwrap();
        assert_eq!(file.format, ProblemFormat::SiconosMlcp);
        assert_eq!(parts(&file.problem), (vec![vec![2.0, 3.0], vec![5.0, 6.0]], vec![4.0, 7.0]));
        let Problem::Mixed(mixed) = file.problem else { panic!("not mixed") };
        assert_eq!(mixed.free(), [true, false]);
    }
    // The complementarity first: the equalities come first in the four matrices all the same.
    let swapped = problem(&format!("1 1 1 1  0 1 2  1 0  0 2 2 2 2  6 3 5 2  7 4  {four}"));
    assert_eq!(parts(&swapped), (vec![vec![6.0, 5.0], vec![3.0, 2.0]], vec![7.0, 4.0]));
}

/// `w = M z + q` with `M = [[2, 1], [0, 2]]`, `q = (-1, 4)` and `-1 <= z1 <= 1`, `z2 <= 3`.
#[test]
fn relays_are_variables_between_bounds() {
    let text = "2  0 2 2 2 2  2 0 1 2  -1 4  -1 -inf  1 3  words";
    let file = read(text.as_bytes(), None).unwrap();
    assert_eq!(file.format, ProblemFormat::SiconosRelay);
    let Problem::Boxed(relay) = &file.problem else { panic!("not boxed") };
    assert_eq!(rows(relay.m()), [[2.0, 1.0], [0.0, 2.0]]);
    assert_eq!((relay.q(), relay.upper()), (&[-1.0, 4.0][..], &[1.0, 3.0][..]));
    assert_eq!(relay.lower(), [-1.0, f64::NEG_INFINITY]);
    let (z, w) = relay.variables(&Lemke::default().solve(relay).unwrap());
    assert_eq!((z, w), (vec![1.0, -2.0], vec![-1.0, 0.0]));
    for marked in [
        "2  0 2 2 2 2  2 0 1 2  -1 4  -1 !nan  1 3",
        "2  0 2 2 2 2  2 0 1 2  -1 4  -1 -2  1 3 !4",
        // No number between the bounds of the second variable.
        "2!  0 2 2 2 2  2 0 1 2  -1 4  -1 4  1 3",
    ] {
        let error = error_as(ProblemFormat::SiconosRelay, &marked.replace('!', ""));
        let column = marked.find('!').unwrap() + 1;
        assert_eq!(error.position(), Some(at(1, column)), "{marked}: {error}");
    }
}

#[test]
fn mixed_problems_that_contradict_themselves_are_refused() {
    let one = "0 1 2  0 1  0 2 2 2 2  2 5 3 6  4 7";
    let error = |text: &str| error_as(ProblemFormat::SiconosMlcp, text).to_string();
    let message = error(&format!("1 1 1 1 {one}\n2 6 3 5.1 4 7"));
    assert!(message.contains("expected M[1, 0] = 5"), "{message}");
    let message = error("1 0 1 1  0 1 2  1 1  0 2 2 2 2  2 5 3 6  4 7");
    assert!(message.contains("expected blocks with 1 equalities, found 0"), "{message}");
    let message = error("0 0 1 1 2 6 3 5 4 7");
    assert!(message.contains("storage types 0 and 0"), "{message}");
}

/// One contact with `W = [[2, 1], [1, 3]]`, `q = (-1, 4)`, `mu = 0.5`.
#[test]
fn friction_becomes_a_standard_problem() {
    let file = read(b"2 1 0 2 2 2 2  2 1 1 3  -1 4  0.5  1", None).unwrap();
    assert_eq!(file.format, ProblemFormat::SiconosFriction);
    let Problem::Friction(friction) = &file.problem else { panic!("not friction") };
    let expected = vec![vec![1.5, 1.0, 0.0], vec![-0.5, 3.0, 1.0], vec![1.0, -1.0, 0.0]];
    assert_eq!(rows(friction.standard().m()), expected);
    assert_eq!(friction.standard().q(), [-1.0, 4.0, 0.0]);
    // It slides: r_T = -mu r_N.
    let forces = friction.forces(&[2.0 / 3.0, 0.0, 0.0]);
    assert_eq!((forces.normal, forces.tangential), (vec![2.0 / 3.0], vec![-1.0 / 3.0]));
    let negative = error_as(ProblemFormat::SiconosFriction, "2 1 0 2 2 2 2  2 1 1 3  -1 4  -0.5");
    assert_eq!(negative.position(), Some(at(1, 31)), "{negative}");
}

/// Blocks that are all zero, and four numbers of `q`: as plain text all of them are the 21 numbers of a problem
/// of order 4.
#[test]
fn a_file_that_fits_two_formats_is_refused() {
    let text = "4  1 4 4  0 3 3  1 2 4  1 2 4  2 0  0 0  -1 -2 -3 -4";
    let expected =
        ReadError::Ambiguous { formats: vec![ProblemFormat::Text, ProblemFormat::SiconosLcp] };
    assert_eq!(error(text), expected);
    assert!(expected.to_string().contains("as text or as siconos-lcp"));
    let named = read(text.as_bytes(), Some(ProblemFormat::SiconosLcp)).unwrap();
    assert_eq!(parts(&named.problem).1, [-1.0, -2.0, -3.0, -4.0]);
}

/// One number short of a plain text file, and not a friction problem, although it begins with 2.
#[test]
fn a_file_that_is_nearly_complete_is_of_its_format() {
    let error = read(b"2\n1 0\n0 1\n-1\n", None).unwrap_err();
    assert!(
        matches!(&error, ReadError::Unrecognised { format: ProblemFormat::Text, .. }),
        "{error}"
    );
    assert!(error.to_string().contains("M and q needs 6 more numbers, but at most 5"), "{error}");
}

/// In no format is anything left over: numbers that no size announces are a mistake, and not for people.
#[test]
fn more_numbers_than_announced_are_refused() {
    for (format, text, place) in [
        (ProblemFormat::Text, "1 2 -3 4", at(1, 8)),
        (ProblemFormat::SiconosLcp, "1 0 1 1 1 1 2 -3 4 words", at(1, 18)),
        (ProblemFormat::SiconosFriction, "2 1 0 2 2 2 2  2 1 1 3  -1 4  0.5  1 2", at(1, 38)),
        // A known answer has n + 2 m numbers at most: here three.
        (ProblemFormat::SiconosMlcp, "0 1 1 1 2 6 3 5 4 7  1 2 3 4", at(1, 28)),
        (ProblemFormat::Json, r#"{"kind": "lcp", "m": [[1]], "q": [1]} 2"#, at(1, 39)),
    ] {
        let error = error_as(format, text);
        assert_eq!(error.position(), Some(place), "{text}: {error}");
    }
    for text in [
        "1 0 1 1 1 1 2 -3 words 4",
        "0 1 1 1 2 6 3 5 4 7  1 2 3",
        "0 1 1 1 2 6 3 5 4 7  1 2 3 words",
    ] {
        assert!(read(text.as_bytes(), None).is_ok(), "{text}");
    }
}

#[test]
fn unknown_formats_name_the_known_ones() {
    let names = "json, text, qps, siconos-lcp, siconos-mlcp, siconos-relay, siconos-friction, \
                 siconos-global-friction";
    let message = "xml".parse::<ProblemFormat>().unwrap_err().to_string();
    assert_eq!(message, format!("there is no format `xml`: take one of {names}"));
    let message = error("<lcp>").to_string();
    assert!(
        message.starts_with("line 1, column 1: expected") && message.contains(names),
        "{message}"
    );
    assert_eq!(ProblemFormat::ALL.map(|format| format.name().parse()), ProblemFormat::ALL.map(Ok));
}

#[test]
fn a_file_that_fits_no_format_names_the_one_that_comes_furthest() {
    let error = error("2 0 2 2 2 2\n1 2\n3 4\n-5 oops");
    let ReadError::Unrecognised { format, source } = &error else { panic!("{error}") };
    assert_eq!((*format, source.position()), (ProblemFormat::SiconosLcp, Some(at(4, 4))));
    // Numbers that were read to the last one, and overflow.
    let error = self::error("2  1e308 1e308 1 1  1e308 1");
    let ReadError::Unrecognised { format, source } = &error else { panic!("{error}") };
    assert_eq!(*format, ProblemFormat::Text);
    assert!(matches!(**source, ReadError::Refused { .. }), "{source}");
}

#[test]
fn every_kind_of_json_is_read() {
    let text = r#"{"kind": "boxed", "m": [[2, 0], [0, 1]], "q": [1, -1], "lower": [null, 0], "upper": [3, null]}"#;
    let Problem::Boxed(boxed) = problem(text) else { panic!("not boxed") };
    assert_eq!(boxed.lower(), [f64::NEG_INFINITY, 0.0]);
    assert_eq!(boxed.upper(), [3.0, f64::INFINITY]);
    let text = r#"{"kind": "horizontal", "a": [[1]], "c": [4], "b": {"rows": 1, "cols": 1, "triplets": [[0, 0, 2], [0, 0, 1]]}}"#;
    let Problem::Horizontal(horizontal) = problem(text) else { panic!("not horizontal") };
    assert_eq!(
        (horizontal.a()[(0, 0)], horizontal.b()[(0, 0)], horizontal.c()),
        (1.0, 3.0, &[4.0][..])
    );
    let text = r#"{"kind": "mixed", "m": [[2]], "q": [1], "free": [true]}"#;
    let Problem::Mixed(mixed) = problem(text) else { panic!("not mixed") };
    assert_eq!(mixed.free(), [true]);
    let text = r#"{"kind": "friction", "w": [[2, 1], [1, 3]], "q": [-1, 4], "mu": [0.5]}"#;
    assert_eq!(problem(text).order(), 3);
    assert_eq!(problem(r#"{"kind": "lcp", "m": [], "q": []}"#).order(), 0);
}

#[test]
fn json_says_what_is_wrong_and_where() {
    for (text, place, words) in [
        ("{", at(1, 1), "EOF"),
        ("{\"kind\": \"lpc\"}", at(1, 14), "unknown variant `lpc`"),
        ("{\"kind\": \"lcp\",\n \"M\": [[1]]}", at(2, 4), "unknown field `M`"),
        ("{\"kind\": \"lcp\", \"m\": [[1]]}", at(1, 27), "missing field `q`"),
        ("{\"m\": [[1]], \"q\": [1]}", at(1, 22), "missing field `kind`"),
        (
            "{\"kind\": \"lcp\", \"m\": [[1]],\n \"q\": [1], \"b\": 2}",
            at(2, 14),
            "unknown field `b`, expected one of `kind`, `m`, `q`",
        ),
        ("{\"kind\": \"lcp\", \"q\": [1, 2],\n \"m\": [\n  [1, 2],\n  [3]]}", at(4, 3), "row 1"),
        (
            "{\"kind\": \"lcp\", \"q\": [1],\n \"m\": [\n  [\"x\"]]}",
            at(3, 6),
            "invalid type: string",
        ),
        (
            "{\"kind\": \"lcp\", \"m\": [[1]],\n \"q\": [1, 2]}",
            at(1, 22),
            "M is 1 x 1, but must be 2 x 2",
        ),
        ("{\"kind\": \"lcp\", \"m\": [[1]], \"q\": [1e999]}", at(1, 39), "out of range"),
        (
            "{\"kind\": \"lcp\", \"q\": [1],\n \"m\": {\"rows\": 1, \"cols\": 1, \"triplets\": [[0, 1, 2]]}}",
            at(2, 43),
            "outside a matrix of 1 x 1",
        ),
        // A, which comes first, has such an entry too, and room for it.
        (
            "{\"kind\": \"qp\", \"q\": [1], \"l\": [0, 0], \"u\": [1, 1],\n \
             \"a\": {\"rows\": 2, \"cols\": 1, \"triplets\": [[1, 0, 2]]},\n \
             \"p\": {\"rows\": 1, \"cols\": 1, \"triplets\": [[1, 0, 2]]}}",
            at(3, 43),
            "outside a matrix of 1 x 1",
        ),
        (
            "{\"kind\": \"friction\", \"w\": [[1, 0], [0, 1]], \"q\": [0, 0],\n \"mu\": [-1]}",
            at(2, 8),
            "`mu` is -1, but must be from 0",
        ),
        (
            "{\"kind\": \"lcp\", \"m\": [[1]], \"m\": [[1]], \"q\": [1]}",
            at(1, 31),
            "duplicate field",
        ),
    ] {
        let error = error(text);
        assert!(error.to_string().contains(words), "{text}: {error}");
        assert_eq!(error.position(), Some(place), "{text}: {error}");
    }
}

#[test]
fn what_problems_refuse_has_a_place_too() {
    let text = r#" {"kind": "boxed", "m": [[2]], "q": [1], "lower": [1], "upper": [0]}"#;
    let ReadError::Refused { at: place, source } = error(text) else { panic!("not refused") };
    assert_eq!(place, at(1, 51));
    assert_eq!(source, lcp::Error::Bounds { what: "variable", index: 0, lower: 1.0, upper: 0.0 });
}

#[test]
fn text_that_is_not_unicode_is_read_up_to_where_it_matters() {
    let latin = b"1 0 1 1 1 1 2 -3 \xe4\xf6\xfc";
    assert_eq!(parts(&read(latin, None).unwrap().problem), (vec![vec![2.0]], vec![-3.0]));
    assert_eq!(
        read(b"1 \xe4 2", Some(ProblemFormat::Text)).unwrap_err().position(),
        Some(at(1, 3))
    );
    assert_eq!(problem("\u{feff}1 2 -3").order(), 1);
}

#[test]
fn json_gives_every_digit_back() {
    let file = read(b"2  0.1 1e-320  -0.0 1.7976931348623157e308  3 5e-324", None).unwrap();
    let json = to_json(&file.problem);
    let (m, q) = parts(&problem(&json));
    assert_eq!((&m, &q), (&parts(&file.problem).0, &parts(&file.problem).1));
    assert!(m[1][0].is_sign_negative());
}
