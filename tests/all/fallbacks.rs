//! No fallback without a case that it decides: what the table of the bench `corpus` does not name decides nothing, and goes.

use std::collections::BTreeSet;

/// The methods of the chains of `Auto`, and the kinds of attempts of Lemke's method: start, covering vector.
const DECIDE: [&str; 12] = [
    "Newton",
    "Interior",
    "Enumeration",
    "Lemke AllY Ones",
    "Lemke AllT Ones",
    "Lemke Found Ones",
    "Lemke Found Column",
    "Lemke AllY Column",
    "Lemke Found Random",
    "Lemke LastBasis Random",
    "Lemke Flipped Negative",
    "Lemke",
];

#[test]
fn every_method_and_kind_of_attempt_decides_a_case() {
    let table = include_str!("../../benches/corpus/table.txt");
    let mut by = BTreeSet::new();
    for line in table.lines() {
        let fields: Vec<&str> = line.split('|').map(str::trim).collect();
        let [case, end, _, method, _, _] = fields[..] else { panic!("{line}") };
        let is_lcp = !case.starts_with("walls/") && !case.starts_with("scenes/");
        if is_lcp && ["Solved", "Infeasible", "NoSolution"].iter().any(|it| end.starts_with(it)) {
            by.insert(method);
        }
    }
    assert_eq!(by, BTreeSet::from(DECIDE));
}
