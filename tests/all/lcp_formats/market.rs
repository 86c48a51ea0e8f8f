//! The Matrix Market format.

use lcp::Matrix;
use lcp_problems::io::{ProblemFormat, ReadError, market, read};

use super::{at, rows};

fn matrix(text: &str, order: usize) -> Result<Matrix, ReadError> {
    market::read_matrix(text.as_bytes(), order, order)
}

fn file(header: &str, body: &str) -> String {
    format!("%%MatrixMarket matrix {header}\n% a comment\n{body}")
}

#[test]
fn arrays_stand_by_columns() {
    let read = |header: &str, body: &str| rows(&matrix(&file(header, body), 2).unwrap());
    assert_eq!(read("array real general", "2 2\n1\n2\n3\n4\n"), [[1.0, 3.0], [2.0, 4.0]]);
    assert_eq!(read("array integer symmetric", "2 2 1 2 4"), [[1.0, 2.0], [2.0, 4.0]]);
    assert_eq!(read("array real skew-symmetric", "2 2 -2"), [[0.0, 2.0], [-2.0, 0.0]]);
    assert_eq!(read("ARRAY Real General", "2 2 1 2 3 4"), [[1.0, 3.0], [2.0, 4.0]]);
}

#[test]
fn coordinates_begin_at_one_and_add_up() {
    let read = |header: &str, body: &str| {
        let matrix = matrix(&file(header, body), 2).unwrap();
        assert!(matrix.is_sparse());
        rows(&matrix)
    };
    let body = "2 2 3\n1 2 3\n2 2 4\n1 2 0.5\n";
    assert_eq!(read("coordinate real general", body), [[0.0, 3.5], [0.0, 4.0]]);
    let body = "2 2 2\n2 1 3\n2 2 4\n";
    assert_eq!(read("coordinate integer symmetric", body), [[0.0, 3.0], [3.0, 4.0]]);
    assert_eq!(read("coordinate real skew-symmetric", "2 2 1\n2 1 3"), [[0.0, -3.0], [3.0, 0.0]]);
    assert_eq!(read("coordinate pattern general", "2 2 1\n1 2"), [[0.0, 1.0], [0.0, 0.0]]);
}

#[test]
fn vectors_are_matrices_of_one_column() {
    let read = |text: String| market::read_vector(text.as_bytes());
    assert_eq!(read(file("array real general", "3 1 1 2 3")), Ok(vec![1.0, 2.0, 3.0]));
    let sparse = file("coordinate real general", "3 1 1\n2 1 -5\n");
    assert_eq!(read(sparse), Ok(vec![0.0, -5.0, 0.0]));
    let row = read(file("array real general", "1 3 1 2 3")).unwrap_err();
    assert_eq!(row.position(), Some(at(3, 3)), "{row}");
    let long = read(file("coordinate real general", "100000000000 1 0")).unwrap_err();
    assert!(matches!(long, ReadError::TooShort { .. }), "{long}");
}

#[test]
fn damaged_files_are_refused_with_the_place_and_the_remedy() {
    for (text, place, words) in [
        (
            "2 2 1 2 3 4".to_owned(),
            at(1, 1),
            "expected `%%MatrixMarket`, found `2`; the first line is",
        ),
        (String::new(), at(1, 1), "found the end of the file"),
        (
            "%%MatrixMarket matrix array complex general\n1 1 1 1".to_owned(),
            at(1, 29),
            "`real` or `integer`",
        ),
        (
            "%%MatrixMarket matrix array pattern general\n1 1".to_owned(),
            at(1, 29),
            "`real` or `integer`",
        ),
        (
            "%%MatrixMarket matrix coordinate real hermitian\n".to_owned(),
            at(1, 39),
            "skew-symmetric",
        ),
        (
            "%%MatrixMarket matrix array real general 2\n2 2 1 2 3 4".to_owned(),
            at(1, 42),
            "the end of the file",
        ),
        (
            file("array real general", "2 3 1 2 3 4 5 6"),
            at(3, 3),
            "expected the number of columns 2, found `3`",
        ),
        (file("array real general", "2 2 1 2 3"), at(3, 4), "needs 4 more numbers, but at most 3"),
        (
            file("array real general", "2 2 1 2 3 x"),
            at(3, 11),
            "expected an entry of the matrix, found `x`",
        ),
        (file("array real general", "2 2 1 2 3 inf"), at(3, 11), "finite decimal number"),
        (
            file("array real general", "2 2 1 2 3 4 5"),
            at(3, 13),
            "expected the end of the file, found `5`",
        ),
        (
            file("coordinate real general", "2 2 1\n1 3 1"),
            at(4, 3),
            "a column from 1 to 2, found `3`",
        ),
        (file("coordinate real general", "2 2 1\n0 1 1"), at(4, 1), "indices begin at 1"),
        (file("coordinate real general", "2 2 2\n1 1 1\n2 2"), at(3, 6), "needs 6 more numbers"),
        (file("coordinate real symmetric", "2 2 1\n1 2 1"), at(3, 6), "without its upper triangle"),
        (file("coordinate real skew-symmetric", "2 2 1\n1 1 1"), at(3, 6), "the lower triangle"),
        (file("coordinate real general", "2 2 999999999999\n1 1 1"), at(3, 17), "at most 3"),
    ] {
        let error = matrix(&text, 2).unwrap_err();
        assert!(error.to_string().contains(words), "{text}\n{error}");
        assert_eq!(error.position(), Some(place), "{text}\n{error}");
    }
}

#[test]
fn one_matrix_is_no_problem() {
    let text = file("array real general", "1 1 1");
    let error = read(text.as_bytes(), None).unwrap_err();
    assert_eq!(error, ReadError::OneMatrix);
    assert!(error.to_string().contains("--m M.mtx --q q.mtx"), "{error}");
    assert!(read(text.as_bytes(), Some(ProblemFormat::Text)).is_err());
}
