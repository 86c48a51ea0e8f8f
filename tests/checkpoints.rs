//! Load histories that are broken off and taken up again.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod common;

use std::ops::ControlFlow;

use common::histories::{pushed, wall};
use masonry::analysis::checkpoint::{Checkpoint, CheckpointError};
use masonry::analysis::solve::{Run, SolveError, solve};
use masonry::scene::{Route, Scene};

/// A run of a scene, four steps on.
fn begun(scene: &Scene) -> Run {
    let go = &mut |_| ControlFlow::Continue(());
    let mut run = Run::new(scene, go).unwrap();
    for _ in 0..4 {
        assert!(run.advance(go).unwrap());
    }
    run
}

/// The checkpoint of a run as it comes back from a file.
fn through_a_file(run: &Run, name: &str, change: impl Fn(String) -> String) -> Checkpoint {
    let file = format!("masonry-{}-{name}.json", std::process::id());
    let path = std::env::temp_dir().join(file);
    run.checkpoint().unwrap().write(&path).unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::write(&path, change(text)).unwrap();
    let checkpoint = Checkpoint::read(&path).unwrap();
    std::fs::remove_file(&path).unwrap();
    checkpoint
}

fn resumed(scene: &Scene, checkpoint: &Checkpoint) -> Result<Run, SolveError> {
    Run::new(scene, &mut |_| ControlFlow::Continue(())).unwrap().resume(checkpoint)
}

/// A run that is broken off and taken up again ends with the same numbers to the last digit.
#[test]
fn checkpoints() {
    for route in [Route::Lemke, Route::Interior, Route::Qp, Route::Alm] {
        let scene = pushed(2).route(route).tolerance(1e-9);
        let whole = solve(&scene).unwrap();
        let first = begun(&scene);
        let checkpoint = through_a_file(&first, route.name(), |text| text);
        assert_eq!(Some(&checkpoint), first.checkpoint().as_ref());
        let mut second = resumed(&scene, &checkpoint).unwrap();
        while second.advance(&mut |_| ControlFlow::Continue(())).unwrap() {}
        let [whole, resumed] =
            [whole, second.finish()].map(|it| (it.state.unwrap(), it.history.unwrap().records));
        assert_eq!(resumed.1, whole.1, "{route:?}");
        assert_eq!(resumed.0.contacts, whole.0.contacts);
        assert_eq!(resumed.0.displacements, whole.0.displacements);
    }
}

/// What is to come may change, what is done may not, and neither may the wall.
#[test]
fn checkpoints_of_other_scenes() {
    let scene = pushed(2);
    let checkpoint = begun(&scene).checkpoint().unwrap();
    let mut longer = scene.clone();
    longer.stages[2].steps = 5;
    assert_eq!(resumed(&longer, &checkpoint).unwrap().finish().history.unwrap().steps, 9);
    let refused = |scene: &Scene| match resumed(scene, &checkpoint).unwrap_err() {
        SolveError::Checkpoint(error) => error,
        error => panic!("{error}"),
    };
    let mut other = scene.clone();
    other.stages[0].steps = 1;
    assert!(matches!(refused(&other), CheckpointError::OtherSteps { .. }));
    assert!(matches!(refused(&scene.thickness(0.2)), CheckpointError::OtherScene));
    assert!(matches!(refused(&wall()), CheckpointError::OneStep));
}

/// Numbers that were changed are refused, or change nothing.
#[test]
fn checkpoints_that_were_tampered_with() {
    let scene = pushed(2).route(Route::Lemke);
    let run = begun(&scene);
    let changed = |name: &str, from: &str, to: &str| {
        let checkpoint = through_a_file(&run, name, |text| {
            assert!(text.contains(from), "{from}");
            text.replacen(from, to, 1)
        });
        resumed(&scene, &checkpoint)
    };
    let refused = |name: &str, from: &str, to: &str| {
        changed(name, from, to).map(|_| ()).unwrap_err().to_string()
    };
    let force = refused("force", "\"contacts\":[{\"t_n\":", "\"contacts\":[{\"t_n\":9");
    assert!(force.contains("no equilibrium"), "{force}");
    let list = refused("list", "\"displacements\":[[[", "\"displacements\":[[[0.0,0.0],[");
    assert!(list.contains("displacements of block \"wall/1/1\""), "{list}");
    let energy = refused("energy", "],\"strain_energy\":", "],\"strain_energy\":-");
    assert!(energy.contains("solve from the first step"), "{energy}");
    let status = refused("status", "\"status\":\"Solved\"", "\"status\":\"Stalled\"");
    assert!(status.contains("no equilibrium"), "{status}");
    let mut run = changed("basis", "\"basis\":\"", "\"basis\":\"t").unwrap();
    assert!(run.advance(&mut |_| ControlFlow::Continue(())).unwrap());
}
