//! The wall of the README: its commands print what the README says, with numbers to 1 %.

use crate::common::quoted;

use std::fs;
use std::path::Path;
use std::process::Command;

const README: &str = include_str!("../../../../README.md");

/// The only block of the README in this language.
fn block(language: &str) -> &'static str {
    let (_, rest) = README.split_once(&format!("```{language}\n")).unwrap();
    rest.split_once("```").unwrap().0
}

/// What the README has after a command of the wall, as a comment.
fn promised(command: &str) -> &'static str {
    let line = README.lines().find(|line| line.starts_with(command)).unwrap();
    line.split_once("# ").unwrap().1
}

#[test]
fn the_wall_of_the_readme_gives_the_sentences_of_the_readme() {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join("readme");
    fs::create_dir_all(&directory).unwrap();
    fs::write(directory.join("wall.toml"), block("toml")).unwrap();
    let commands = ["masonry solve wall.toml --out wall", "masonry limit wall.toml"];
    for command in commands {
        let output = Command::new(env!("CARGO_BIN_EXE_masonry"))
            .args(command.split(' ').skip(1))
            .current_dir(&directory)
            .output()
            .unwrap();
        let printed = String::from_utf8(output.stdout).unwrap();
        let first = printed.lines().next().unwrap();
        let promised = promised(command);
        assert!(quoted::says(first, promised), "{command}: {first:?}, not {promised:?}");
    }
    assert!(directory.join("wall/principal_stresses.svg").exists());
}

/// The last number of the row of the table of published answers that has `link`, or of the row behind it.
fn in_table(link: &str, behind: usize) -> f64 {
    let row = README.lines().position(|line| line.starts_with('|') && line.contains(link)).unwrap();
    let mut cells = README.lines().nth(row + behind).unwrap().trim_matches('|').split('|');
    cells.next_back().unwrap().trim().parse().unwrap()
}

#[test]
fn the_published_limits_of_the_readme_are_found() {
    for number in 1..=3 {
        let file = format!("scenes/ferris_wall_{number}.toml");
        let output = Command::new(env!("CARGO_BIN_EXE_masonry"))
            .args(["limit", "--json", &format!("../../{file}")])
            .output()
            .unwrap();
        let object: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        for (behind, law) in ["associative", "path"].into_iter().enumerate() {
            let (told, found) =
                (in_table(&file, behind), object[law]["load_factor"].as_f64().unwrap());
            assert!((told - found).abs() <= 1e-4, "{file}, {law}: {found}, and not {told}");
        }
    }
}
