//! `masonry import` from a file to a scene, a report and a picture.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use masonry::{Model, Scene};
use masonry_drawing::{Drawing, DrawingFormat};
use serde_json::Value;

/// A drawing in a directory of its own.
fn written(name: &str, text: &str) -> PathBuf {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join("import").join(name);
    let _ = fs::remove_dir_all(&directory);
    fs::create_dir_all(&directory).unwrap();
    let path = directory.join("wall.dxf");
    fs::write(&path, text).unwrap();
    path
}

fn masonry(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_masonry")).args(arguments).output().unwrap()
}

/// Three courses of bricks, turned by five degrees, with corners rounded to millimetres.
const DRAWING: &str = include_str!("import_command/wall.dxf");

#[test]
fn a_drawing_becomes_a_scene_that_is_solved() {
    let path = written("good", DRAWING);
    let [scene, picture] = ["scene.toml", "picture.svg"].map(|name| path.with_file_name(name));
    let [drawing, scene, picture] = [&path, &scene, &picture].map(|it| it.to_str().unwrap());
    let output =
        masonry(&["import", drawing, "--out", scene, "--picture", picture, "--thickness", "0.5"]);
    let report = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(
        report.starts_with("10 blocks, 1 support; unit of the drawing: m; tolerance: 0.00"),
        "{report}"
    );
    assert!(
        report.contains("10 x corners were moved so that blocks meet exactly, by up to 0.000"),
        "{report}"
    );
    assert!(report.ends_with(&format!("wrote {scene}\nwrote {picture}\n")), "{report}");

    let text = fs::read_to_string(scene).unwrap();
    assert!(text.contains("[[blocks]]  # LWPOLYLINE 1 (line 22)\nname = \"brick/1\"\n"), "{text}");
    assert_eq!(Scene::from_toml(&text).unwrap().thickness, Some(0.5));
    let solved = masonry(&["solve", scene]);
    assert!(String::from_utf8(solved.stdout).unwrap().starts_with("The wall stands"));
    let picture = fs::read_to_string(picture).unwrap();
    let document = roxmltree::Document::parse(&picture).unwrap();
    let groups =
        document.descendants().filter(|it| it.has_tag_name(("http://www.w3.org/2000/svg", "g")));
    let counts: Vec<_> = groups
        .map(|it| {
            (
                it.attribute("class").unwrap(),
                it.children().filter(roxmltree::Node::is_element).count(),
            )
        })
        .collect();
    assert_eq!(counts, [("drawing", 10), ("blocks", 10), ("supports", 1)]);
}

#[test]
fn a_scene_without_a_file_is_printed() {
    let path = written("printed", DRAWING);
    let output = masonry(&["import", path.to_str().unwrap()]);
    let scene = Scene::from_toml(&String::from_utf8(output.stdout).unwrap()).unwrap();
    assert_eq!((scene.title.as_str(), scene.blocks.len()), ("wall", 10));
}

#[test]
fn what_cannot_be_imported_ends_with_code_2() {
    let path = written("refused", DRAWING);
    let drawing = path.to_str().unwrap();
    let refused = |arguments: &[&str]| {
        let output = masonry(arguments);
        assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0));
        String::from_utf8(output.stderr).unwrap()
    };
    let error = refused(&["import", drawing, "--out", drawing]);
    assert_eq!(error, format!("error: {drawing} is the drawing: choose another --out\n"));
    assert!(fs::read_to_string(&path).unwrap().starts_with("0\nSECTION"));
    let error = refused(&["import", drawing, "--tolerance", "0.05"]);
    assert!(error.contains("is shorter than four times the tolerance of 0.05 m"), "{error}");
    let scene = path.with_extension("dwg");
    let scene = scene.to_str().unwrap();
    let error = refused(&["import", scene]);
    assert_eq!(
        error,
        format!(
            "error: {scene}: a drawing must be a .dxf, .svg, .obj or .json file: save it as one of these\n"
        )
    );
    let error = refused(&["import", &drawing.replace("wall.dxf", "none.dxf")]);
    assert!(error.contains("none.dxf: No such file"), "{error}");
}

/// Files are written again, as long as their mark says that nobody else has written them.
#[test]
fn only_files_with_the_mark_are_overwritten() {
    let path = written("marked", DRAWING);
    let others = ["scene.toml", "picture.svg", "drawn.dxf", "drawn.svg"];
    let others = others.map(|name| path.with_file_name(name));
    let drawing = path.to_str().unwrap();
    let [scene, picture, dxf, svg] = others.each_ref().map(|it| it.to_str().unwrap());
    let import = ["import", drawing, "--out", scene, "--picture", picture];
    let draw = ["draw", scene, "--dxf", dxf, "--out", svg];
    for arguments in [&import, &draw, &import, &draw] {
        let output = masonry(arguments);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }
    Scene::read(&others[0]).unwrap();
    Drawing::read(&fs::read(dxf).unwrap(), DrawingFormat::Dxf).unwrap();
    roxmltree::Document::parse(&fs::read_to_string(svg).unwrap()).unwrap();
    let last = [&draw, &draw, &import, &import];
    let options = ["--out", "--dxf", "--picture", "--out"];
    for ((file, arguments), option) in [svg, dxf, picture, scene].into_iter().zip(last).zip(options)
    {
        let marked = fs::read_to_string(file).unwrap();
        let text = marked.replace("written by masonry", "");
        fs::write(file, &text).unwrap();
        let output = masonry(arguments);
        assert_eq!(output.status.code(), Some(2));
        let error = String::from_utf8(output.stderr).unwrap();
        let expected = format!(
            "error: {file} would be overwritten, and masonry has not written it: move it away, or choose another {option}\n"
        );
        assert_eq!(error, expected);
        assert_eq!(fs::read_to_string(file).unwrap(), text);
        fs::write(file, marked).unwrap();
    }
}

/// What `draw --dxf` writes is read back with the same coordinates, and its scene has the verdict of the first.
#[test]
fn a_drawing_of_a_scene_is_the_scene() {
    let stack = |left: f64| {
        let [from, to] = [left, left + 1.2];
        format!(
            "title = \"Stack\"\nthickness = 1.0\ngravity = [0.0, -9.81]\nunits = {{ length = \"m\", force = \"kN\" }}\n\
             materials.stone.density = 2000.0\njoints.bed.mu = 0.6\n\
             [[supports]]\nname = \"the floor\"\nfrom = [-1.0, 0.0]\nto = [4.0, 0.0]\njoint = \"bed\"\n\
             [[blocks]]\nname = \"lower\"\nmaterial = \"stone\"\ncorners = [[0.0, 0.0], [1.0, 0.0], [1.0, 0.7], [0.0, 0.7]]\n\
             [[blocks]]\nname = \"upper\"\nmaterial = \"stone\"\n\
             corners = [[{from}, 0.7], [{to}, 0.7], [{to}, 1.1], [{from}, 1.1]]\n"
        )
    };
    let arch = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/arch_semicircular.toml");
    // Without the push to the side it stands.
    let standing = fs::read_to_string(arch).unwrap().replace("9.81, 0.0]", "0.0, 0.0]");
    let scenes = [
        ("stands", stack(0.1), [true, false]),
        ("falls", stack(0.7), [false, true]),
        ("arch", standing, [true, false]),
    ];
    for (name, text, has) in scenes {
        let path = written(&format!("drawn_{name}"), "");
        let [scene, again] = ["scene.toml", "again.toml"].map(|it| path.with_file_name(it));
        fs::write(&scene, text).unwrap();
        let [drawing, scene, again] = [&path, &scene, &again].map(|it| it.to_str().unwrap());
        let output = masonry(&["draw", scene, "--dxf", drawing]);
        assert_eq!(String::from_utf8(output.stdout).unwrap(), format!("{drawing}\n"));
        let read = Drawing::read(&fs::read(drawing).unwrap(), DrawingFormat::Dxf).unwrap();
        let model = Model::from_scene(&Scene::read(Path::new(scene)).unwrap()).unwrap();
        let metre = model.units.length_to_si();
        let outlines =
            |layer: &str| read.outlines.iter().filter(|it| it.layer == layer).collect::<Vec<_>>();
        assert_eq!(outlines("blocks").len(), model.blocks.len());
        for (outline, block) in outlines("blocks").iter().zip(&model.blocks) {
            assert!(outline.corners.iter().copied().eq(block.corners.iter().map(|it| it / metre)));
        }
        let lines =
            |begin: &str| read.lines.iter().filter(|it| it.layer.starts_with(begin)).count();
        assert_eq!(lines("support_"), model.supports.len());
        assert_eq!(lines("joint_"), model.joints.len());
        assert_eq!([lines("result_forces") > 0, !outlines("result_mechanism").is_empty()], has);
        if name == "arch" {
            // From each joint to the middle of both forces of every voussoir.
            assert_eq!(lines("result_thrust"), 2 * model.blocks.len());
        }

        let output = masonry(&["import", drawing, "--out", again]);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let verdict = |scene: &str| {
            let output = masonry(&["solve", scene, "--json"]);
            let result: Value = serde_json::from_slice(&output.stdout).unwrap();
            (result["verdict"].clone(), result["plan"]["joints"].clone())
        };
        assert_eq!(verdict(again), verdict(scene));
    }
}
