//! Files with any content: what is read is never larger than the file, and comes back from JSON.

use lcp_problems::io::{ProblemFormat, read, to_json};
use proptest::prelude::*;
use proptest::sample::{Index, select};
use proptest::test_runner::TestCaseError;

use super::{parts, problem};

/// Valid files of every kind, to be damaged.
const VALID: [&str; 15] = [
    "NAME\nROWS\n N f\n L r\nCOLUMNS\n x f -5 r 1\n y f -5 r 1\nRHS\n RHS r 3 f 1\nRANGES\n r 1\nBOUNDS\n UP B x 4\n FR y\nQUADOBJ\n x x 1\n y y 1\nENDATA\n",
    r#"{"kind": "qp", "p": [[2, 0], [0, 2]], "q": [-2, -5], "a": [[1, -2]], "l": [-2], "u": [null], "lower": [0, null], "constant": 3}"#,
    "2  0 2 2 2 2  2 0 1 2  -1 4  -1 -inf  1 3  words",
    "2\n1 2 # row\n3 4\n-5 -6e0\n",
    "2\n0\n2\n2\n2\t2\n1 2\n3 4\n-5 -6\n\nSome words",
    "3 1 3 3 3 2 2  1 3  1 3  3 3  0 2 3  0 1 1  0 1  1 0 2  2 3 0 4 5\n-1 -2 -3",
    "1 2 1 1 1\nbanner\ntriplet: 1-by-1, nzmax: 1 nnz: 1\n 0 0 : 1\n 1",
    "1 2 1 1 2\nbanner\n1-by-1, nzmax: 1 nnz: 1, 1-norm: 1\n col 0 : locations 0 to 0\n 0 : 1\n 1",
    "1 1 1 1  0 1 2  0 1  0 2 2 2 2  2 5 3 6  4 7  2 6 3 5 4 7",
    "2 1 0 2 2 2 2  2 1 1 3  -1 4  0.5  1",
    "2 1 0 2 2 2 2  3 0 0 0  0 2 2 2 2  0 1 1 0  0.4 -2  0.1 -0.2  0.5",
    r#"{"kind": "contact", "k": [[3, 0], [0, 0]], "f": [0.4, -2], "c_n": [[0, 1]], "c_t": [[1, 0]], "x_0": [0.1], "s_0": [-0.2], "mu": [0.5]}"#,
    r#"{"kind": "boxed", "m": [[2, 0], [0, 1]], "q": [1, -1], "lower": [null, 0], "upper": [3, null]}"#,
    r#"{"kind": "lcp", "m": {"rows": 2, "cols": 2, "triplets": [[0, 1, 2.5]]}, "q": [1, -1]}"#,
    r#"{"kind": "friction", "w": [[2, 1], [1, 3]], "q": [-1, 4], "mu": [0.5]}"#,
];

/// Reads in every format; what is read must not be larger than the content, and JSON must give it
/// back.
fn read_in_every_format(content: &[u8]) -> Result<(), TestCaseError> {
    for format in ProblemFormat::ALL.map(Some).into_iter().chain([None]) {
        let Ok(file) = read(content, format) else { continue };
        prop_assert!(file.problem.order() <= content.len());
        let json = to_json(&file.problem);
        let again = read(json.as_bytes(), None).map_err(|e| TestCaseError::fail(e.to_string()))?;
        prop_assert_eq!(to_json(&again.problem), json);
    }
    Ok(())
}

/// One word or byte of a file put in the place of another.
#[derive(Debug, Clone)]
enum Damage {
    Byte { at: Index, byte: u8 },
    Word { at: Index, word: &'static str },
    Cut { at: Index },
}

fn damage() -> impl Strategy<Value = Damage> {
    const WORDS: [&str; 10] =
        ["0", "1", "2", "-1", "1000000000", "18446744073709551615", "1e999", "nan", "null", "[]"];
    prop_oneof![
        (any::<Index>(), any::<u8>()).prop_map(|(at, byte)| Damage::Byte { at, byte }),
        (any::<Index>(), select(&WORDS)).prop_map(|(at, word)| Damage::Word { at, word }),
        any::<Index>().prop_map(|at| Damage::Cut { at }),
    ]
}

fn damaged(text: &str, damages: &[Damage]) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    for damage in damages {
        if bytes.is_empty() {
            break;
        }
        match damage {
            Damage::Byte { at, byte } => {
                let at = at.index(bytes.len());
                bytes[at] = *byte;
            }
            Damage::Cut { at } => bytes.truncate(at.index(bytes.len())),
            Damage::Word { at, word } => {
                let at = at.index(bytes.len());
                let is_number = |byte: &u8| byte.is_ascii_digit() || b".-+e".contains(byte);
                let begin = bytes[..at].iter().rposition(|b| !is_number(b)).map_or(0, |b| b + 1);
                let end =
                    bytes[at..].iter().position(|b| !is_number(b)).map_or(bytes.len(), |e| at + e);
                bytes.splice(begin..end.max(begin), word.bytes());
            }
        }
    }
    bytes
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn no_content_is_too_strange(content in proptest::collection::vec(any::<u8>(), 0..200)) {
        read_in_every_format(&content)?;
    }

    #[test]
    fn no_damage_is_too_strange(
        text in select(&VALID),
        damages in proptest::collection::vec(damage(), 1..4),
    ) {
        read_in_every_format(&damaged(text, &damages))?;
    }

    #[test]
    fn problems_come_back_from_json(
        (n, values) in (0..6_usize).prop_flat_map(|n| {
            (Just(n), proptest::collection::vec(proptest::num::f64::NORMAL | proptest::num::f64::ZERO, n * n + n))
        }),
    ) {
        // Sums of entries near the largest number overflow, and are refused.
        let values: Vec<f64> = values.into_iter().map(|v| v / 256.0).collect();
        let words: Vec<String> = values.iter().map(|v| format!("{v:e}")).collect();
        let file = read(format!("{n} {}", words.join(" ")).as_bytes(), None).unwrap();
        let (m, q) = parts(&problem(&to_json(&file.problem)));
        prop_assert_eq!(m.concat().into_iter().chain(q).collect::<Vec<_>>(), values);
    }
}
