//! What `Auto` and the walls of masonry come to, case by case: no decided case is lost, and the cost does not grow unseen.
//!
//! `cargo bench --bench corpus` solves all cases and compares them with `benches/corpus/table.txt`: what is lost, turned, gained
//! and what costs more or less. It fails if a case that was decided is not, or is decided otherwise. With `-- --write` the
//! table is written anew. `-- --only games` chooses the groups whose name begins so. Published problems, whose files
//! are not part of the repository, are left out if they are not at hand.

#[allow(dead_code, reason = "shared with other benches")]
mod common;
#[path = "../tests/all/lcp_files/forms.rs"]
#[allow(unreachable_pub, clippy::unwrap_used, reason = "shared with a test")]
mod forms;
#[path = "corpus/line.rs"]
mod line;
#[path = "corpus/problems.rs"]
mod problems;
#[path = "../tests/all/lcp_files/transform.rs"]
#[allow(unreachable_pub, dead_code, clippy::unwrap_used, reason = "shared with a test")]
mod transform;
#[path = "corpus/masonry.rs"]
mod wall_cases;
#[path = "scaling/walls.rs"]
#[allow(dead_code, reason = "shared with another bench")]
mod walls;

use std::collections::BTreeMap;
use std::fmt::Write as _;

use line::Line;

const TABLE: &str = "benches/corpus/table.txt";
/// Costs of a group that grow by less are not told.
const TOLD: f64 = 0.05;

fn main() {
    if !common::is_bench() {
        return;
    }
    let path = common::root().join(TABLE);
    let text = std::fs::read_to_string(&path).unwrap_or_default();
    let before: BTreeMap<String, Line> =
        text.lines().filter_map(Line::read).map(|line| (line.case.clone(), line)).collect();
    let only = option("--only");
    let is_chosen = |case: &str| case.starts_with(&only);
    let mut now = BTreeMap::new();
    let mut keep = |line: Line| {
        if let Some(was) = before.get(&line.case)
            && let Some(change) = line.change_from(was)
        {
            println!("{change}");
        }
        now.insert(line.case.clone(), line);
    };
    problems::solve(&is_chosen, &mut keep);
    wall_cases::solve(&is_chosen, &mut keep);
    println!("{}", costs(&before, &now));
    if common::is_asked("--write") {
        // Cases that were left out keep their lines.
        let mut all = before.clone();
        all.extend(now.clone());
        let lines: String = all.values().fold(String::new(), |mut text, line| {
            let _ = writeln!(text, "{line}");
            text
        });
        std::fs::write(path, lines).expect("the table can be written");
        return;
    }
    let lost = now.values().filter(|line| before.get(&line.case).is_some_and(|it| line.loses(it)));
    let lost: Vec<&str> = lost.map(|line| line.case.as_str()).collect();
    assert!(lost.is_empty(), "lost or turned: {}", lost.join(", "));
}

/// The costs of every group, before and now.
fn costs(before: &BTreeMap<String, Line>, now: &BTreeMap<String, Line>) -> String {
    let mut groups: BTreeMap<&str, [usize; 6]> = BTreeMap::new();
    for line in now.values() {
        let group = groups.entry(line.group()).or_default();
        let was = before.get(&line.case).unwrap_or(line);
        for (sum, add) in group.iter_mut().zip([
            1,
            usize::from(line.is_decided()),
            was.pivots,
            line.pivots,
            was.factorisations,
            line.factorisations,
        ]) {
            *sum += add;
        }
    }
    let mut table =
        String::from("group | cases | decided | pivots before, now | factorisations before, now\n");
    for (group, [cases, decided, pivots, pivots_now, lu, lu_now]) in groups {
        let mark = |was: usize, now: usize| {
            let grows = now as f64 > (1.0 + TOLD) * was as f64;
            if grows { " (grows)" } else { "" }
        };
        let (of_pivots, of_lu) = (mark(pivots, pivots_now), mark(lu, lu_now));
        let _ = writeln!(
            table,
            "{group} | {cases} | {decided} | {pivots}, {pivots_now}{of_pivots} | {lu}, {lu_now}{of_lu}"
        );
    }
    table
}

fn option(name: &str) -> String {
    std::env::args().skip_while(|argument| argument != name).nth(1).unwrap_or_default()
}
