//! Links between the pages of the repository lead somewhere, and pages are not too long to read.

use std::collections::{HashMap, HashSet};
use std::fs;
use std::path::{Component, Path, PathBuf};
use std::process::Command;

/// Ten minutes of reading.
const LONGEST_PAGE: usize = 2300;

/// These are for looking things up, or grow with the cases that are measured.
const NOT_READ_FROM_BEGINNING_TO_END: [&str; 9] = [
    "CHANGELOG.md",
    "docs/accuracy.md",
    "docs/effects.md",
    "docs/hard_cases.md",
    "docs/hard_problems.md",
    "docs/performance.md",
    "docs/reference/",
    "docs/scaling.md",
    "docs/stability.md",
];

#[test]
fn every_link_of_a_page_leads_to_a_file_and_every_anchor_to_a_heading() {
    let anchors: HashMap<PathBuf, HashSet<String>> =
        tracked("md").into_iter().map(|page| (page.clone(), anchors(&read(&page)))).collect();
    let mut broken = Vec::new();
    for page in anchors.keys() {
        for (line, text) in prose(&read(page)) {
            for target in targets(&text) {
                if let Some(why) = fault(page, &target, &anchors) {
                    broken.push(format!("{}:{line}: {target}: {why}", page.display()));
                }
            }
        }
    }
    broken.sort();
    assert!(broken.is_empty(), "broken links:\n{}", broken.join("\n"));
}

#[test]
fn pages_that_the_code_names_exist() {
    let mut missing = Vec::new();
    for file in tracked("rs") {
        for (number, line) in read(&file).lines().enumerate() {
            for (at, _) in line.match_indices("docs/") {
                let name: String = line[at..]
                    .chars()
                    .take_while(|it| it.is_ascii_alphanumeric() || "/_.".contains(*it))
                    .collect();
                let page = Path::new(name.trim_end_matches('.'));
                if page.extension().is_some_and(|it| it == "md") && !root().join(page).exists() {
                    let (file, page) = (file.display(), page.display());
                    missing.push(format!("{file}:{}: {page}", number + 1));
                }
            }
        }
    }
    assert!(missing.is_empty(), "no such pages:\n{}", missing.join("\n"));
}

#[test]
fn a_page_is_read_in_ten_minutes() {
    let mut long = Vec::new();
    for page in tracked("md") {
        let name = page.to_string_lossy().replace('\\', "/");
        if NOT_READ_FROM_BEGINNING_TO_END.iter().any(|it| name.starts_with(it)) {
            continue;
        }
        let words = words(&read(&page));
        if words > LONGEST_PAGE {
            long.push(format!("{name}: {words} words"));
        }
    }
    assert!(long.is_empty(), "longer than {LONGEST_PAGE} words:\n{}", long.join("\n"));
}

#[test]
fn headings_become_the_anchors_of_github() {
    let page = "# The library `lcp`: guide\n## 7. What a ray says\n```sh\n# no heading\n```\n## [A](b.md) `c_d`, e!\n## Again\n## Again\n";
    let expected = ["the-library-lcp-guide", "7-what-a-ray-says", "a-c_d-e", "again", "again-1"];
    assert_eq!(anchors(page), expected.map(String::from).into());
    assert_eq!(targets("![a](b.svg) and [c](d.md#e), `[f](g)`"), ["b.svg", "d.md#e"]);
    assert_eq!(
        words("Three words here.\n\n| a | table |\n\n```sh\ncode\n```\n[a link](to/a/page.md)\n"),
        5
    );
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn read(file: &Path) -> String {
    fs::read_to_string(root().join(file)).unwrap()
}

/// Files of the repository, and new ones that are not ignored, relative to the root.
fn tracked(extension: &str) -> Vec<PathBuf> {
    let output = Command::new("git")
        .args(["ls-files", "-z", "--cached", "--others", "--exclude-standard"])
        .current_dir(root())
        .output()
        .unwrap();
    assert!(output.status.success(), "this test needs a git repository");
    let names = String::from_utf8(output.stdout).unwrap();
    names
        .split('\0')
        .map(PathBuf::from)
        .filter(|it| it.extension().is_some_and(|it| it == extension))
        .filter(|it| root().join(it).exists())
        .collect()
}

/// The lines outside of blocks of code, with their numbers.
fn prose(page: &str) -> Vec<(usize, String)> {
    let mut code = false;
    let mut lines = Vec::new();
    for (number, line) in page.lines().enumerate() {
        if line.trim_start().starts_with("```") {
            code = !code;
        } else if !code {
            lines.push((number + 1, line.to_owned()));
        }
    }
    lines
}

/// The anchors that GitHub gives to the headings: lower case, no punctuation, hyphens for spaces.
fn anchors(page: &str) -> HashSet<String> {
    let mut found = HashSet::new();
    for (_, line) in prose(page) {
        let heading = line.trim_start_matches('#');
        if heading.len() == line.len() || !heading.starts_with(' ') {
            continue;
        }
        let slug: String = shown(heading.trim())
            .to_lowercase()
            .chars()
            .filter(|it| it.is_alphanumeric() || " -_".contains(*it))
            .map(|it| if it == ' ' { '-' } else { it })
            .collect();
        let mut anchor = slug.clone();
        let mut again = 0;
        while !found.insert(anchor.clone()) {
            again += 1;
            anchor = format!("{slug}-{again}");
        }
    }
    found
}

/// A line without the addresses of its links.
fn shown(line: &str) -> String {
    let mut text = String::new();
    let mut rest = line;
    while let Some((before, after)) = rest.split_once("](") {
        text.push_str(before);
        rest = after.split_once(')').map_or("", |(_, after)| after);
    }
    text + rest
}

/// The addresses of the links and pictures of a line, not those in code.
fn targets(line: &str) -> Vec<String> {
    let text: String = line
        .split('`')
        .enumerate()
        .filter(|(part, _)| part % 2 == 0)
        .map(|(_, text)| text)
        .collect();
    text.split("](")
        .skip(1)
        .filter_map(|it| it.split_once(')'))
        .map(|(target, _)| target.to_owned())
        .collect()
}

/// Why a link leads nowhere.
fn fault(
    page: &Path,
    target: &str,
    anchors: &HashMap<PathBuf, HashSet<String>>,
) -> Option<&'static str> {
    if target.contains("://") || target.starts_with("mailto:") {
        return None;
    }
    let (path, anchor) = target.split_once('#').unwrap_or((target, ""));
    let file =
        if path.is_empty() { page.to_owned() } else { plain(&page.with_file_name("").join(path)) };
    if !root().join(&file).exists() {
        return Some("no such file");
    }
    if anchor.is_empty() {
        return None;
    }
    match anchors.get(&file) {
        Some(headings) if headings.contains(anchor) => None,
        Some(_) => Some("no such heading"),
        None => Some("an anchor in a file that is no page"),
    }
}

/// A path without `..`.
fn plain(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir => {
                plain.pop();
            }
            Component::CurDir => {}
            part => plain.push(part),
        }
    }
    plain
}

/// Words outside of code and tables.
fn words(page: &str) -> usize {
    let mut words = 0;
    for (_, line) in prose(page) {
        if !line.trim_start().starts_with('|') && !line.starts_with("<!--") {
            let text = shown(&line);
            words +=
                text.split_whitespace().filter(|it| it.chars().any(char::is_alphanumeric)).count();
        }
    }
    words
}
