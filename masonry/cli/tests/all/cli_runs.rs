//! The directory that a run writes into, and runs that are interrupted.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

/// An empty directory of this test alone.
fn directory(test: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("cli_runs").join(test);
    if path.exists() {
        fs::remove_dir_all(&path).unwrap();
    }
    fs::create_dir_all(&path).unwrap();
    path
}

/// A block of 4 kN on a floor, pushed to the side: it tips at a factor of 1.
fn block(push: f64, stages: &str) -> String {
    format!(
        "title = \"Block\"\nthickness = 1.0\ngravity = [0.0, -10.0]\n\
         units = {{ length = \"m\", force = \"kN\" }}\n\
         materials.stone.density = 2000.0\njoints.floor.mu = 0.7\n\
         [[blocks]]\nname = \"block\"\nmaterial = \"stone\"\n\
         corners = [[0.0, 0.0], [0.2, 0.0], [0.2, 1.0], [0.0, 1.0]]\n\
         [[supports]]\nname = \"floor\"\nfrom = [-1.0, 0.0]\nto = [1.0, 0.0]\njoint = \"floor\"\n\
         [[loads]]\nname = \"push\"\nfrom = [0.0, 0.0]\nto = [0.0, 1.0]\npressure = 0.8\nfactor = {push}\n{stages}"
    )
}

/// It is pushed step by step.
fn history(steps: u32) -> String {
    let stages = format!(
        "[[stages]]\nname = \"weight\"\n[[stages]]\nname = \"push\"\nsteps = {steps}\nloads = {{ push = 1.0 }}\n"
    );
    block(0.9, &stages)
}

fn written(directory: &Path, scene: &str) -> String {
    let path = directory.join("scene.toml");
    fs::write(&path, scene).unwrap();
    path.to_str().unwrap().to_owned()
}

fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_masonry"));
    command.args(arguments);
    command
}

fn masonry(arguments: &[&str]) -> Output {
    command(arguments).output().unwrap()
}

fn object(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|_| panic!("{}", String::from_utf8_lossy(&output.stderr)))
}

fn errors(output: &Output) -> &str {
    std::str::from_utf8(&output.stderr).unwrap()
}

/// The files that a user sees.
fn files(directory: &Path) -> Vec<String> {
    let names = fs::read_dir(directory).unwrap().map(|entry| entry.unwrap().file_name());
    let names = names.map(|name| name.to_string_lossy().into_owned());
    let mut names: Vec<String> = names.filter(|name| !name.starts_with('.')).collect();
    names.sort();
    names
}

#[test]
fn without_a_directory_a_run_prints_the_report_and_writes_nothing() {
    let directory = directory("no_out");
    let scene = written(&directory, &block(0.5, ""));
    let run = |more: &[&str]| {
        let mut command = command(&[&["solve", &scene], more].concat());
        command.current_dir(&directory).output().unwrap()
    };
    let output = run(&[]);
    let report = String::from_utf8(output.stdout.clone()).unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    assert!(report.starts_with("The wall stands: ") && !report.contains("wrote"), "{report}");
    let output = run(&["--json"]);
    assert_eq!(object(&output)["files"], serde_json::json!([]));
    assert_eq!(files(&directory), ["scene.toml"]);
    let output = run(&["--resume"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(errors(&output).contains("--out"), "{}", errors(&output));
    // Steps too need no directory.
    fs::write(&scene, history(3)).unwrap();
    assert_eq!(object(&run(&["--json"]))["history"]["solved"], 4);
    assert_eq!(files(&directory), ["scene.toml"]);
}

#[test]
fn what_an_earlier_run_has_left_is_removed_and_named() {
    let directory = directory("stale");
    let out = directory.join("out");
    let to = out.to_str().unwrap();
    let run = |arguments: &[&str], scene: &str| {
        let scene = written(&directory, scene);
        masonry(&[&[arguments[0], &scene, "--out", to, "--json"], &arguments[1..]].concat())
    };
    let listed = |output: &Output| -> Vec<String> {
        let mut names: Vec<String> =
            serde_json::from_value(object(output)["files"].clone()).unwrap();
        names.sort();
        names
    };
    let falls = run(&["solve"], &block(1.5, ""));
    assert_eq!((falls.status.code(), files(&out)), (Some(1), listed(&falls)));
    assert!(out.join("mechanism.svg").exists());
    fs::write(out.join("notes.txt"), "of the user").unwrap();
    let stands = run(&["solve"], &block(0.5, ""));
    assert!(errors(&stands).contains("removed in ") && errors(&stands).contains("mechanism.svg"));
    fs::remove_file(out.join("notes.txt")).unwrap();
    assert_eq!(files(&out), listed(&stands));
    // Another command has its own files.
    let limit = run(&["limit", "--law", "associative"], &block(0.5, ""));
    assert!(errors(&limit).is_empty(), "{}", errors(&limit));
    let mut both = [listed(&stands), listed(&limit)].concat();
    both.sort();
    // Of a file that both write, the last one stays.
    both.dedup();
    assert_eq!(files(&out), both);
    let again = run(&["solve"], &block(0.5, ""));
    assert!(errors(&again).is_empty(), "{}", errors(&again));
    assert_eq!(files(&out), both);
}

/// Before anything is computed, and without leaving anything.
/// A scene is somebody's work, and so is a file that no run has written.
#[test]
fn nothing_of_the_user_is_overwritten() {
    let directory = directory("kept");
    let scene = written(&directory, &block(0.5, ""));
    let out = directory.join("out");
    fs::create_dir(&out).unwrap();
    let (text, report) = (fs::read_to_string(&scene).unwrap(), out.join("report.txt"));
    fs::write(&report, "of the user").unwrap();
    let out = out.to_str().unwrap();
    for (arguments, why) in [
        (["solve", &scene, "--report", &scene], "is read for the scene: choose another --report"),
        (["limit", &scene, "--report", &scene], "is read for the scene: choose another --report"),
        (["draw", &scene, "--out", &scene], "is read for the scene: choose another --out"),
        (["solve", &scene, "--out", out], "report.txt in "),
        (["limit", &scene, "--out", out], "report.txt in "),
    ] {
        let output = masonry(&arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(errors(&output).contains(why), "{arguments:?}: {}", errors(&output));
        assert_eq!(fs::read_to_string(&scene).unwrap(), text);
        assert_eq!(fs::read_to_string(&report).unwrap(), "of the user");
        assert_eq!(files(Path::new(out)), ["report.txt"]);
    }
    fs::remove_file(report).unwrap();
    // A page takes the place of no other file of its run.
    let page = Path::new(out).join("result.json");
    let output = masonry(&["solve", &scene, "--out", out, "--report", page.to_str().unwrap()]);
    assert_eq!((output.status.code(), page.exists()), (Some(2), false));
    assert!(errors(&output).contains("the run writes a file of this name"), "{}", errors(&output));
    // What a run has written the next one may replace, another command too.
    for command in ["solve", "solve", "limit"] {
        let output = masonry(&[command, &scene, "--out", out]);
        assert_eq!(output.status.code(), Some(0), "{command}: {}", errors(&output));
    }
    let known = |name: &String| masonry_report::FILES.contains(&name.as_str());
    assert!(files(Path::new(out)).iter().all(known), "{:?}", files(Path::new(out)));
}

#[test]
fn a_directory_that_cannot_be_written_into_is_refused_before_the_work() {
    let directory = directory("refused");
    let scene = written(&directory, &block(0.5, ""));
    let file = directory.join("file");
    fs::write(&file, "").unwrap();
    for out in [file.clone(), file.join("out")] {
        for command in ["solve", "limit", "study"] {
            let output = masonry(&[command, &scene, "--out", out.to_str().unwrap()]);
            assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0));
            let message = errors(&output);
            assert!(
                message.contains("cannot write into") && message.contains("choose another --out")
            );
        }
    }
    // A run that does not come to write leaves no directory.
    let out = directory.join("new").join("deeper");
    let output = masonry(&["limit", &scene, "--group", "wind", "--out", out.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(files(&directory), ["file", "scene.toml"]);
}

#[test]
fn shells_get_their_completions() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let output = masonry(&["completions", shell]);
        assert_eq!((output.status.code(), errors(&output)), (Some(0), ""));
        let script = String::from_utf8(output.stdout).unwrap();
        for word in ["masonry", "solve", "limit", "resume", "thickness"] {
            assert!(script.contains(word), "{shell}: no `{word}`");
        }
    }
    let output = masonry(&["completions", "tcsh"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(errors(&output).contains("bash"), "{}", errors(&output));
}

#[cfg(unix)]
mod interrupted {
    use std::process::{Child, Stdio};
    use std::time::Duration;

    use super::*;

    /// Starts a run and waits for a file of it.
    fn started(arguments: &[&str], file: &Path) -> Child {
        let mut child =
            command(arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        while !file.exists() {
            assert!(child.try_wait().unwrap().is_none(), "the run is over");
            std::thread::sleep(Duration::from_millis(5));
        }
        child
    }

    /// What Ctrl-C does.
    fn interrupt(child: Child) -> Output {
        let id = child.id().to_string();
        assert!(Command::new("kill").args(["-INT", &id]).status().unwrap().success());
        child.wait_with_output().unwrap()
    }

    fn solved_steps(output: &Output) -> u64 {
        object(output)["history"]["solved"].as_u64().unwrap()
    }

    const STEPS: u32 = 50_000;

    #[test]
    fn a_history_keeps_its_last_step_and_says_how_to_go_on() {
        let directory = directory("history of a block");
        let scene = written(&directory, &history(STEPS));
        let out = directory.join("out");
        let to = out.to_str().unwrap();
        let arguments = ["solve", &scene, "--out", to, "--json"];
        let output = interrupt(started(&arguments, &out.join("checkpoint.json")));
        assert_eq!(output.status.code(), Some(1));
        let (result, solved) = (object(&output), solved_steps(&output));
        assert_eq!(
            (&result["status"], &result["verdict"]),
            (&"Cancelled".into(), &"undecided".into())
        );
        assert!(solved > 0 && solved < u64::from(STEPS));
        assert!(files(&out).contains(&"deformed.svg".to_owned()), "{:?}", files(&out));
        let message = errors(&output);
        let resume = format!("masonry solve '{scene}' --out '{to}' --resume --json");
        assert!(
            message.contains(&format!("interrupted after step {solved} of {}", STEPS + 1)),
            "{message}"
        );
        assert!(message.contains(&resume), "{message}");

        // The command goes on from there.
        let resumed = [&arguments[..], &["--resume"]].concat();
        let lock = out.join(".masonry.json");
        for name in files(&out).iter().filter(|name| *name != "checkpoint.json") {
            fs::remove_file(out.join(name)).unwrap();
        }
        fs::remove_file(&lock).unwrap();
        let output = interrupt(started(&resumed, &lock));
        assert!(solved_steps(&output) >= solved);
        assert!(out.join("checkpoint.json").exists());
    }

    /// The files of a directory, without how long the run took.
    fn contents(directory: &Path) -> Vec<(String, Vec<u8>)> {
        let read = |name: String| {
            let mut content = fs::read(directory.join(&name)).unwrap();
            match &name[..] {
                "report.txt" => {
                    let text = str::from_utf8(&content).unwrap();
                    content.truncate(text.find("\nTime\n----\n").unwrap());
                }
                "result.json" => {
                    let mut result: Value = serde_json::from_slice(&content).unwrap();
                    result.as_object_mut().unwrap().remove("time_s").unwrap();
                    for route in result["routes"].as_array_mut().unwrap() {
                        route.as_object_mut().unwrap().remove("seconds").unwrap();
                    }
                    content = result.to_string().into_bytes();
                }
                _ => {}
            }
            (name, content)
        };
        files(directory).into_iter().map(read).collect()
    }

    #[test]
    fn a_killed_history_writes_the_same_files_when_it_is_resumed() {
        let directory = directory("killed");
        let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/wall_settlement.toml");
        let scene = scene.to_str().unwrap();
        let [whole, parts] = ["whole", "parts"].map(|name| directory.join(name));
        let arguments =
            |out: &Path| ["solve", scene, "--out", out.to_str().unwrap()].map(str::to_owned);
        let arguments = [&whole, &parts].map(|out| arguments(out));
        let [first, second] = arguments.each_ref().map(|it| it.each_ref().map(String::as_str));
        assert_eq!(masonry(&first).status.code(), Some(0));
        let mut killed = started(&second, &parts.join("checkpoint.json"));
        killed.kill().unwrap();
        killed.wait().unwrap();
        // Killed somewhere on the way, and after the last step.
        for _ in 0..2 {
            assert_eq!(masonry(&[&second[..], &["--resume"]].concat()).status.code(), Some(0));
            let (whole, parts) = (contents(&whole), contents(&parts));
            assert!(whole.iter().any(|(name, _)| name == "history.csv"));
            for ((name, one), (other, two)) in whole.iter().zip(&parts) {
                assert!(name == other && one == two, "{name} and {other} differ");
            }
            assert_eq!(whole.len(), parts.len());
        }
    }

    #[test]
    fn two_runs_into_one_directory_are_refused_unless_one_was_killed() {
        let directory = directory("two");
        let scene = written(&directory, &history(STEPS));
        let out = directory.join("out");
        let to = out.to_str().unwrap();
        let arguments = ["solve", &scene, "--out", to, "--json"];
        let mut first = started(&arguments, &out.join("checkpoint.json"));
        for command in ["solve", "limit"] {
            let second = masonry(&[command, &scene, "--out", to]);
            assert_eq!((second.status.code(), second.stdout.len()), (Some(2), 0));
            let message = errors(&second);
            assert!(message.contains("another run is writing into"), "{message}");
        }
        first.kill().unwrap();
        first.wait().unwrap();
        fs::remove_file(out.join("checkpoint.json")).unwrap();
        let third = interrupt(started(&arguments, &out.join("checkpoint.json")));
        assert_eq!(third.status.code(), Some(1), "{}", errors(&third));
        assert!(solved_steps(&third) > 0);
    }

    /// A wall of some hundred bricks, whose path takes long.
    #[test]
    fn a_limit_load_keeps_what_is_known() {
        let directory = directory("limit");
        let out = directory.join("out");
        let scene = String::from_utf8(masonry(&["new", "wall"]).stdout).unwrap();
        let fine = scene
            .replace("length = 0.25, height = 0.125", "length = 0.125, height = 0.0625")
            .replace("courses = 16", "courses = 32");
        assert_ne!(fine, scene);
        let scene = written(&directory, &fine);
        let arguments = ["limit", &scene, "--out", out.to_str().unwrap(), "--json"];
        let output = interrupt(started(&arguments, &out.join(".masonry.json")));
        assert_eq!(output.status.code(), Some(1), "{}", errors(&output));
        let result = object(&output);
        let sentence = result["sentence"].as_str().unwrap();
        assert!(result["interrupted"] == true && sentence.starts_with("Interrupted"), "{sentence}");
        assert!(result["path"]["decided"] == false && errors(&output).contains("interrupted"));
        assert!(out.join("limit.json").exists());
    }

    #[test]
    fn a_study_keeps_what_was_solved() {
        let directory = directory("study");
        let out = directory.join("out");
        let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/panel_square.toml");
        let [scene, to] = [&scene, &out].map(|path| path.to_str().unwrap());
        let arguments = ["study", scene, "--out", to, "--json"];
        let output = interrupt(started(&arguments, &out.join(".masonry.json")));
        assert_eq!(output.status.code(), Some(1), "{}", errors(&output));
        let result = object(&output);
        assert_eq!(result["interrupted"], true);
        // Routes, tolerances and meshes.
        assert_eq!(result["records"].as_array().unwrap().len(), 5 * 6 * 3);
        assert!(result["summary"][0].as_str().unwrap().starts_with("Interrupted: "));
        assert!(out.join("study.json").exists());
    }

    /// Sweeps take minutes here.
    #[test]
    fn a_single_solve_ends_with_what_is_known() {
        let directory = directory("single");
        let out = directory.join("out");
        let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/panel_square.toml");
        let [scene, to] = [&scene, &out].map(|path| path.to_str().unwrap());
        let arguments = ["solve", scene, "--out", to, "--route", "pgs", "--json"];
        let output = interrupt(started(&arguments, &out.join(".masonry.json")));
        assert_eq!(output.status.code(), Some(1));
        let result = object(&output);
        assert_eq!(
            (&result["status"], &result["verdict"]),
            (&"Cancelled".into(), &"undecided".into())
        );
        assert!(result["sentence"].as_str().unwrap().contains("cancelled"), "{result}");
        assert!(errors(&output).contains("interrupted") && out.join("scene.svg").exists());
    }
}
