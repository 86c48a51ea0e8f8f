//! Tables of walls, which may be made in parts: a hundred courses take hours.

use std::fmt::Write as _;

use crate::row::{HEAD, Row};

/// Lines of walls, one after the other.
pub(crate) struct Table<'a> {
    lines: Vec<String>,
    cases: &'a [String],
    bricks: Vec<&'a str>,
}

impl<'a> Table<'a> {
    /// Of computed walls, and of those of the table `before` that were not. Cases and bricks are given in their order.
    pub(crate) fn new(
        computed: &[Row],
        before: &str,
        (cases, bricks): (&'a [String], &'a str),
    ) -> Self {
        let mut lines = merged(computed.iter().map(Row::to_string).collect(), before, is_same);
        let bricks: Vec<&str> = bricks.split(',').collect();
        lines.sort_by(|a, b| {
            let place = |line: &str| {
                let [case, _, of] = key(line);
                let of = bricks.iter().position(|it| *it == of);
                (of, cases.iter().position(|it| it == case))
            };
            mu(a).total_cmp(&mu(b)).then_with(|| place(a).cmp(&place(b)))
        });
        Self { lines, cases, bricks }
    }

    /// All lines.
    pub(crate) fn whole(&self) -> String {
        format!("{HEAD}{}\n", self.lines.join("\n"))
    }

    /// Friction along, walls and cases down.
    pub(crate) fn summary(&self) -> String {
        let mut friction: Vec<&str> = self.lines.iter().map(|line| key(line)[1]).collect();
        friction.dedup();
        let names: Vec<String> = friction.iter().map(|mu| format!("mu {mu}")).collect();
        let rule = "--:|".repeat(friction.len());
        let mut table = format!("| case | bricks | {} |\n|:--|:--|{rule}\n", names.join(" | "));
        let of_bricks = |bricks| self.cases.iter().map(move |case| (bricks, case));
        for (bricks, case) in self.bricks.iter().flat_map(of_bricks) {
            let line = |mu: &str| self.lines.iter().find(|it| key(it) == [&**case, mu, bricks]);
            if friction.iter().all(|mu| line(mu).is_none()) {
                continue;
            }
            let _ = write!(table, "| {case} | {bricks} |");
            for mu in &friction {
                let _ = write!(table, " {} |", line(mu).map_or_else(String::new, |it| brief(it)));
            }
            table.push('\n');
        }
        table
    }
}

/// Lines that were computed, and those of the table `before` that are of other walls.
pub(crate) fn merged(
    mut lines: Vec<String>,
    before: &str,
    is_same: fn(&str, &str) -> bool,
) -> Vec<String> {
    let rows = before.lines().skip_while(|line| !line.starts_with("|:--"));
    let of_walls = |line: &&str| line.starts_with("| ");
    let is_old = |line: &&str| lines.iter().all(|it| !is_same(it, line));
    let kept: Vec<&str> = rows.filter(of_walls).filter(is_old).collect();
    lines.extend(kept.into_iter().map(str::to_owned));
    lines
}

/// Whether they are of one wall, if it has one size.
pub(crate) fn is_same(a: &str, b: &str) -> bool {
    key(a) == key(b)
}

/// Case, friction and bricks.
pub(crate) fn key(line: &str) -> [&str; 3] {
    [1, 2, 3].map(|k| cell(line, k))
}

pub(crate) fn mu(line: &str) -> f64 {
    cell(line, 2).parse().expect("a coefficient of friction")
}

/// A letter for verdict and evidence, and the factorisations.
fn brief(line: &str) -> String {
    let letter = match (cell(line, 4), cell(line, 5)) {
        ("Stands", _) => 's',
        ("Falls", "Motion") => 'f',
        ("Falls", _) => 'F',
        _ => '?',
    };
    format!("{letter} {}", cell(line, 9))
}

pub(crate) fn cell(line: &str, k: usize) -> &str {
    line.split('|').nth(k).expect("a line of the table").trim()
}
