//! The guide as a reader follows it: its scenes are saved, its commands run, and they answer what the guide quotes.
//!
//! `GUIDE=write cargo test -p masonry-cli --test all guide` writes the pictures of the guide anew.

use crate::common::quoted;

use std::fs::{self, OpenOptions};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

const GUIDE: &str = include_str!("../../../../docs/guide.md");

/// The pictures of the guide, and the files of its commands from which they come.
const PICTURES: [(&str, &str); 8] = [
    ("guide_stresses.svg", "wall/principal_stresses.svg"),
    ("guide_forces.svg", "door/forces.svg"),
    ("guide_settlement.svg", "settlement/deformed.svg"),
    ("guide_arch.svg", "arch/forces.svg"),
    ("guide_gate.svg", "gate/forces.svg"),
    ("guide_mechanism.svg", "limit/path_mechanism.svg"),
    ("guide_train.svg", "bridge/train.svg"),
    ("guide_bridge.svg", "bridge/path_mechanism.svg"),
];

/// Pages with larger pictures are slow to open.
const LARGEST_PICTURE: usize = 30_000;

#[test]
fn the_commands_of_the_guide_give_its_answers_and_its_pictures() {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join("guide");
    if directory.exists() {
        fs::remove_dir_all(&directory).unwrap();
    }
    fs::create_dir_all(&directory).unwrap();
    let mut output = String::new();
    let mut quoted = 0;
    for block in blocks() {
        match block.language {
            "toml" | "svg" => save(&directory, &block),
            "sh" => output = block.text.lines().map(|line| run(&directory, line)).collect(),
            "text" => {
                for line in block.text.lines() {
                    assert!(
                        quoted::says(&output, line),
                        "the guide quotes {line:?} from:\n{output}"
                    );
                    quoted += 1;
                }
            }
            "rust" => {} // run by `cargo test --doc`
            other => panic!("a block of {other:?}, which nothing checks"),
        }
    }
    assert!(quoted > 5, "only {quoted} quoted lines were found");
    check_pictures(&directory);
}

/// A block of code, and the words between it and the block before.
struct Block {
    language: &'static str,
    text: &'static str,
    before: &'static str,
}

fn blocks() -> Vec<Block> {
    let parts: Vec<&str> = GUIDE.split("```").collect();
    parts
        .chunks_exact(2)
        .map(|pair| {
            let (language, text) = pair[1].split_once('\n').unwrap();
            Block { language, text, before: pair[0] }
        })
        .collect()
}

/// Makes or extends the file that the words before a scene name.
fn save(directory: &Path, block: &Block) {
    let named = |words: &str| {
        let (_, rest) = block.before.rsplit_once(words)?;
        Some(directory.join(rest.split_once('`')?.0))
    };
    if let Some(file) = named("Save this as `") {
        fs::write(file, block.text).unwrap();
    } else if let Some(file) = named("at the end of `") {
        let mut file = OpenOptions::new().append(true).open(file).unwrap();
        file.write_all(block.text.as_bytes()).unwrap();
    } else {
        panic!("where should a reader save this?\n{}", block.text);
    }
}

fn run(directory: &Path, line: &str) -> String {
    let arguments = line.strip_prefix("masonry ").unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_masonry"))
        .args(arguments.split_whitespace())
        .current_dir(directory)
        .output()
        .unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{line}: {errors}");
    String::from_utf8(output.stdout).unwrap()
}

/// The pictures are those of the guide, small, and of the same scenes with the same verdicts.
fn check_pictures(directory: &Path) {
    let docs = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../docs/pictures");
    let shown: Vec<&str> =
        GUIDE.split("](pictures/").skip(1).map(|it| it.split_once(')').unwrap().0).collect();
    assert_eq!(shown, PICTURES.map(|(name, _)| name));
    for (name, file) in PICTURES {
        let drawn = fs::read_to_string(directory.join(file)).unwrap();
        if std::env::var_os("GUIDE").is_some_and(|it| it == "write") {
            fs::write(docs.join(name), &drawn).unwrap();
        }
        let kept = fs::read_to_string(docs.join(name)).unwrap();
        assert!(kept.len() <= LARGEST_PICTURE, "{name} has {} bytes", kept.len());
        assert!(
            title(&kept).is_some() && title(&kept) == title(&drawn),
            "{name} is not {file}; write it anew: GUIDE=write cargo test -p masonry-cli --test all guide"
        );
    }
}

fn title(picture: &str) -> Option<&str> {
    Some(picture.split_once("<title>")?.1.split_once("</title>")?.0)
}
