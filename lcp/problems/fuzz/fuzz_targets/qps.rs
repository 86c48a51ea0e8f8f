//! Lines of a convex program, behind those that name its rows and variables: they are read or refused, and JSON gives
//! back what is read.

#![no_main]

use libfuzzer_sys::fuzz_target;

use lcp_problems::io::{ProblemFormat, read, to_json};

const BEGIN: &str = "NAME\nROWS\n N f\n L r\n G s\n E t\nCOLUMNS\n x f 1 r 1\n y s 1 t 1\n";

fuzz_target!(|lines: &str| {
    let text = format!("{BEGIN}{lines}\nENDATA\n");
    let Ok(file) = read(text.as_bytes(), Some(ProblemFormat::Qps)) else { return };
    assert!(file.problem.order() <= text.len());
    let json = to_json(&file.problem);
    let again = read(json.as_bytes(), None).expect("what was written is read");
    assert_eq!(to_json(&again.problem), json);
});
