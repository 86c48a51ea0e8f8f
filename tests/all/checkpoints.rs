//! Load histories that are broken off and taken up again.

use crate::common;

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
fn through_a_file(
    run: &Run,
    name: &str,
    change: impl Fn(String) -> String,
) -> Result<Checkpoint, CheckpointError> {
    let file = format!("masonry-{}-{name}.json", std::process::id());
    let path = std::env::temp_dir().join(file);
    run.checkpoint().unwrap().write(&path).unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::write(&path, change(text)).unwrap();
    let checkpoint = Checkpoint::read(&path);
    std::fs::remove_file(&path).unwrap();
    checkpoint
}

/// The same text with the checksum that belongs to it.
fn sealed(text: &str) -> String {
    let (data, _) = text.rsplit_once(",\"checksum\":").unwrap();
    let mut hash = 14_695_981_039_346_656_037_u64;
    for byte in data.bytes() {
        hash = (hash ^ u64::from(byte)).wrapping_mul(1_099_511_628_211);
    }
    format!("{data},\"checksum\":\"{hash:016x}\"}}")
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
        let checkpoint = through_a_file(&first, route.name(), |text| text).unwrap();
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
            sealed(&text.replacen(from, to, 1))
        });
        resumed(&scene, &checkpoint.unwrap())
    };
    let refused = |name: &str, from: &str, to: &str| {
        changed(name, from, to).map(|_| ()).unwrap_err().to_string()
    };
    let force = refused("force", "\"contacts\":[{\"t_n\":", "\"contacts\":[{\"t_n\":9");
    assert!(force.contains("not an equilibrium"), "{force}");
    let list = refused("list", "\"displacements\":[[[", "\"displacements\":[[[0.0,0.0],[");
    assert!(list.contains("displacements of block \"wall/1/1\""), "{list}");
    let energy = refused("energy", "],\"strain_energy\":", "],\"strain_energy\":-");
    assert!(energy.contains("solve from the first step"), "{energy}");
    let status = refused("status", "\"status\":\"Solved\"", "\"status\":\"Stalled\"");
    assert!(status.contains("not an equilibrium"), "{status}");
    let mut run = changed("basis", "\"basis\":\"", "\"basis\":\"t").unwrap();
    assert!(run.advance(&mut |_| ControlFlow::Continue(())).unwrap());
}

/// A file in which a single bit has changed is never taken for another state.
#[test]
fn checkpoints_with_flipped_bits_are_refused() {
    let run = begun(&pushed(2).route(Route::Lemke));
    for k in 0..200 {
        let flipped = |text: String| {
            let mut bytes = text.into_bytes();
            let place = k * (bytes.len() - 1) / 199;
            // The lowest bits turn a digit into another one.
            bytes[place] ^= 1 << (k % 3);
            String::from_utf8(bytes).unwrap()
        };
        let error = through_a_file(&run, &format!("bit-{k}"), flipped).unwrap_err();
        assert!(error.to_string().contains("solve from the first step"), "{k}: {error}");
    }
}
