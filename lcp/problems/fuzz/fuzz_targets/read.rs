//! Whatever the content of a file, it is read or refused; what is read is in proportion to the
//! content, and JSON gives it back.

#![no_main]

use libfuzzer_sys::fuzz_target;

use lcp_problems::io::{ProblemFormat, read, to_json};

fuzz_target!(|content: &[u8]| {
    for format in ProblemFormat::ALL.map(Some).into_iter().chain([None]) {
        let Ok(file) = read(content, format) else { continue };
        let problem = file.problem;
        assert!(problem.order() <= content.len());
        let json = to_json(&problem);
        let again = read(json.as_bytes(), None).expect("what was written is read");
        assert_eq!(again.format, ProblemFormat::Json);
        assert_eq!(to_json(&again.problem), json);
    }
});
