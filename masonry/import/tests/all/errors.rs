//! Mistakes in drawings: the message names the place and the remedy, and no file makes the reader panic.

use std::fmt::Write as _;

use masonry_drawing::{Drawing, DrawingFormat, LARGEST_FILE};
use masonry_import::{ImportOptions, import};
use proptest::prelude::*;

use crate::common::{Dxf, Polygon, wall};

#[track_caller]
fn assert_refused(text: &str, format: DrawingFormat, expected: &str) {
    let error = Drawing::read(text.as_bytes(), format).unwrap_err();
    assert_eq!(error.to_string(), expected);
}

fn square(x: f64, y: f64) -> Polygon {
    vec![[x, y], [x + 1.0, y], [x + 1.0, y + 1.0], [x, y + 1.0]]
}

#[track_caller]
fn assert_not_imported(dxf: &Dxf, options: &ImportOptions, expected: &str) {
    let error = import(&dxf.read(), options).unwrap_err();
    assert_eq!(error.to_string(), expected);
}

#[test]
fn files_that_are_no_drawings_say_why() {
    let binary = b"AutoCAD Binary DXF\r\n\x1a\0";
    let error = Drawing::read(binary, DrawingFormat::Dxf).unwrap_err();
    assert_eq!(error.to_string(), "the file is binary: save it as text (DXF: \"ASCII\")");
    let error = Drawing::read(&vec![b' '; LARGEST_FILE + 1], DrawingFormat::Dxf).unwrap_err();
    assert_eq!(
        error.to_string(),
        "the file is larger than 32 MB: save only the layers with the blocks"
    );
    let empty = Dxf::new(6).entity("TEXT", "0", "1\nA\n").text();
    assert_refused(
        &empty,
        DrawingFormat::Dxf,
        "nothing in the file bounds a block (TEXT 1 (line 22): TEXT was left out: only polylines, lines and arcs \
         bound blocks): draw blocks as closed polylines",
    );
}

#[test]
fn mistakes_of_dxf_have_their_line() {
    let text = Dxf::new(6).polygons("brick", &[square(0.0, 0.0)]).text();
    let cut = text.rfind("0\nENDSEC").unwrap();
    assert_refused(
        &text[..cut],
        DrawingFormat::Dxf,
        "DXF (line 22): the file ends in the middle: save it again",
    );
    assert_refused(
        &text.replace("90\n4", "ninety\n4"),
        DrawingFormat::Dxf,
        "LWPOLYLINE 1 (line 22): line 27 has \"ninety\" in place of a group code: save it again as DXF",
    );
    assert_refused(
        &text.replace("10\n0\n20", "10\nO\n20"),
        DrawingFormat::Dxf,
        "LWPOLYLINE 1 (line 32): \"O\" is not a number",
    );
    assert_refused(
        &text.replace("10\n0\n20", "10\n1e99\n20"),
        DrawingFormat::Dxf,
        "LWPOLYLINE 1 (line 22): a coordinate is not a finite number below 1e60: correct it or delete the entity",
    );
}

#[test]
fn a_coordinate_that_is_no_number_is_refused() {
    let text = Dxf::new(6).polygons("brick", &[square(0.0, 0.0)]).text();
    assert_refused(
        &text.replace("10\n0\n20", "10\nNaN\n20"),
        DrawingFormat::Dxf,
        "LWPOLYLINE 1 (line 22): a coordinate is not a finite number below 1e60: correct it or delete the entity",
    );
}

#[test]
fn insertions_without_an_end_are_refused() {
    let myself = Dxf::new(6).insert("a", [0.0, 0.0], "").into_block("a", [0.0, 0.0]);
    let error =
        Drawing::read(myself.insert("a", [0.0, 0.0], "").text().as_bytes(), DrawingFormat::Dxf)
            .unwrap_err();
    assert!(
        error.to_string().ends_with("block references are nested more than 16 deep: explode them"),
        "{error}"
    );
    assert!(error.to_string().starts_with("INSERT 1 in block a of INSERT 1"), "{error}");
    assert_refused(
        &Dxf::new(6).insert("b", [0.0, 0.0], "").text(),
        DrawingFormat::Dxf,
        "INSERT 1 (line 22): it inserts the block \"b\", which the file does not have: bind external references",
    );
    let many = Dxf::new(6).polygons("0", &[square(0.0, 0.0)]).into_block("a", [0.0, 0.0]);
    assert_refused(
        &many.insert("a", [0.0, 0.0], "70\n100000\n71\n100000\n").text(),
        DrawingFormat::Dxf,
        "INSERT 2 (line 60): there are more than 150000 copies of a block: save only the layers with the blocks",
    );
    // Each block inserts the one before ten times.
    let mut bomb = Dxf::new(6).polygons("0", &[square(0.0, 0.0)]).into_block("0", [0.0, 0.0]);
    for k in 1..10 {
        for _ in 0..10 {
            bomb = bomb.insert(&(k - 1).to_string(), [0.0, 0.0], "");
        }
        bomb = bomb.into_block(&k.to_string(), [0.0, 0.0]);
    }
    let error =
        Drawing::read(bomb.insert("9", [0.0, 0.0], "").text().as_bytes(), DrawingFormat::Dxf)
            .unwrap_err();
    assert!(error.to_string().contains("there are more than 150000 "), "{error}");
}

#[test]
fn mistakes_of_other_formats_have_their_place() {
    assert_refused(
        "{\"vertex\": ",
        DrawingFormat::Json,
        "JSON (line 1): the file ends in the middle: save it again",
    );
    assert_refused(
        r#"{"data": {"vertex": {"0": {"x": 1, "y": 2}}, "face": {}}}"#,
        DrawingFormat::Json,
        "data: vertex 0 has no number z: save it again",
    );
    assert_refused(
        r#"{"data": {"vertex": {"0": {"x": 1, "y": 2, "z": 0}}, "face": {"3": [0, 7]}}}"#,
        DrawingFormat::Json,
        "data: there is no corner 7: save the file again",
    );
    assert_refused(
        "v 0 0\n",
        DrawingFormat::Obj,
        "v (line 1): the file ends in the middle: save it again",
    );
    assert_refused("v 0 0 a\n", DrawingFormat::Obj, "v (line 1): \"a\" is not a number");
    assert_refused(
        "v 0 0 0\nf 1 2 3\n",
        DrawingFormat::Obj,
        "f (line 2): there is no corner 2: save the file again",
    );
    let svg = |inside: &str| format!("<svg xmlns=\"http://www.w3.org/2000/svg\">\n{inside}</svg>");
    assert_refused(
        &svg("<rect id=\"r\" width=\"1x\"/>"),
        DrawingFormat::Svg,
        "<rect> id \"r\" (line 2): \"1x\" is not a number",
    );
    let deep = svg(&("<g>".repeat(80) + &"</g>".repeat(80)));
    assert_refused(
        &deep,
        DrawingFormat::Svg,
        "<g> (line 2): block references are nested more than 64 deep: explode them",
    );
}

/// A box with its lower corner at a place; by `skew` the far end is shifted.
fn body(number: u32, [x, y, z]: [f64; 3], skew: f64) -> String {
    let mut text = format!("o body{number}\n");
    for (y, shift) in [(y, 0.0), (y + 0.2, skew)] {
        for (dx, dz) in [(0.0, 0.0), (1.0, 0.0), (1.0, 0.5), (0.0, 0.5)] {
            let _ = writeln!(text, "v {} {y} {}", x + dx + shift, z + dz + shift);
        }
    }
    text + "f -8 -7 -6 -5\nf -1 -2 -3 -4\nf -8 -4 -3 -7\nf -7 -3 -2 -6\nf -6 -2 -1 -5\nf -5 -1 -4 -8\n"
}

#[test]
fn bodies_that_are_not_plane_are_refused() {
    let first = body(1, [0.0; 3], 0.0);
    assert_refused(
        &(first.clone() + &body(2, [1.0, 0.0, 0.0], 0.1)),
        DrawingFormat::Obj,
        "o body2 (line 16): it is not a prism across the plane of the others: the model is plane; cut it with a plane \
         and draw the section",
    );
    assert_refused(
        &(first + &body(2, [0.5, 0.2, 0.5], 0.0)),
        DrawingFormat::Obj,
        "o body2 (line 16): it reaches from -0.4 to -0.2 across the plane and others do not: the model is plane; \
         export one layer of blocks",
    );
}

#[test]
fn bodies_with_steps_across_the_plane_are_refused() {
    let section = [[0.0, 0.0], [1.0, 0.0], [1.0, 0.1], [0.5, 0.1], [0.5, 0.2], [0.0, 0.2]];
    let mut text = "o step\n".to_owned();
    for z in [0.0, 0.5] {
        for [x, y] in section {
            let _ = writeln!(text, "v {x} {y} {z}");
        }
    }
    text += "f 6 5 4 3 2 1\nf 7 8 9 10 11 12\n";
    for k in 0..6 {
        let next = (k + 1) % 6;
        let _ = writeln!(text, "f {} {} {} {}", k + 1, next + 1, next + 7, k + 7);
    }
    assert_refused(
        &text,
        DrawingFormat::Obj,
        "o step (line 1): it is not a prism across the plane of the others: the model is plane; cut it with a plane \
         and draw the section",
    );
}

#[test]
fn bodies_and_lines_of_obj_are_limited() {
    assert_refused(
        &"o a\n".repeat(150_001),
        DrawingFormat::Obj,
        "o a (line 150001): there are more than 150000 bodies or lines: save only the layers with the blocks",
    );
    assert_refused(
        &("v 0 0 0\n".to_owned() + &"l 1 1\n".repeat(150_001)),
        DrawingFormat::Obj,
        "l (line 150002): there are more than 150000 bodies or lines: save only the layers with the blocks",
    );
}

#[test]
fn names_cannot_command_the_terminal() {
    assert_refused(
        &Dxf::new(6).insert("\u{1b}[31m", [0.0, 0.0], "").text(),
        DrawingFormat::Dxf,
        "INSERT 1 (line 22): it inserts the block \"\u{fffd}[31m\", which the file does not have: bind external \
         references",
    );
    let list = r#"[{ "name": "a\nb", "material": "stone", "corners": [[0, 0], [1, 0], [1, 1]] }]"#;
    let drawing = Drawing::read(list.as_bytes(), DrawingFormat::List).unwrap();
    assert_eq!(drawing.outlines[0].name.as_deref(), Some("a\u{fffd}b"));
    let ray = Dxf::new(6).entity("RAY\u{7}", "0", "").polygons("0", &[square(0.0, 0.0)]).read();
    assert!(ray.changes[0].what.starts_with("RAY\u{fffd} was left out"), "{:?}", ray.changes);
}

#[test]
fn a_unit_that_is_not_known_must_be_given() {
    let wall = Dxf::new(14).polygons("brick", &wall(4, 4, 0.0));
    assert_not_imported(
        &wall,
        &ImportOptions::default(),
        "the unit 14 of $INSUNITS is not known: give --unit, or --unit m and the metres in one unit as --scale",
    );
    let unit = Some(masonry_drawing::Unit::Metre);
    assert!(import(&wall.read(), &ImportOptions { unit, ..ImportOptions::default() }).is_ok());
}

#[test]
fn a_unit_that_cannot_be_is_noticed() {
    let scaled: Vec<Polygon> = wall(4, 4, 0.0)
        .into_iter()
        .map(|polygon| polygon.into_iter().map(|point| point.map(|it| 1e3 * it)).collect())
        .collect();
    assert_not_imported(
        &Dxf::new(0).polygons("brick", &scaled),
        &ImportOptions::default(),
        "half of all blocks are larger than 280 m, with m as the unit (which the file does not say): give --unit mm or \
         --unit cm or --unit in, or --unit m if that is right",
    );
    assert_not_imported(
        &Dxf::new(4).polygons("brick", &wall(4, 4, 0.0)),
        &ImportOptions::default(),
        "half of all blocks are smaller than 0.00028 m, with mm as the unit (as the file says): give --unit in or \
         --unit ft or --unit m, or --unit mm if that is right",
    );
    let options =
        ImportOptions { unit: Some(masonry_drawing::Unit::Metre), ..ImportOptions::default() };
    assert!(import(&Dxf::new(0).polygons("brick", &scaled).read(), &options).is_ok());
}

#[test]
fn what_cannot_be_mended_has_its_place_and_remedy() {
    let pair = |by: f64| Dxf::new(6).polygons("brick", &[square(0.0, 0.0), square(0.0, 1.0 - by)]);
    let fine = ImportOptions { tolerance: Some(1e-3), ..ImportOptions::default() };
    assert_not_imported(
        &pair(0.01),
        &fine,
        "LWPOLYLINE 1 (line 22) and LWPOLYLINE 2 (line 48): the blocks overlap by 0.01 m, which is more than the \
         tolerance of 0.001 m: --tolerance 0.012 would do",
    );
    assert_not_imported(
        &pair(-0.1),
        &ImportOptions::default(),
        "LWPOLYLINE 1 (line 22) and LWPOLYLINE 2 (line 48): 1 joints are open, the first by 0.1 m: give --joints close \
         if they are thin, --joints mortar if they are filled, or --joints open if they are gaps",
    );
    assert_not_imported(
        &pair(-0.5),
        &ImportOptions::default(),
        "LWPOLYLINE 2 (line 48): blocks[1].corners: block \"brick/2\" touches no other block and no support, so that it \
         can move in every direction: move it, or raise contact.gap_limit",
    );
    let bow = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.5], [0.5, 2.0]];
    assert_not_imported(
        &Dxf::new(6).polygons("brick", &[bow]),
        &ImportOptions::default(),
        "LWPOLYLINE 1 (line 22): its edges cross or touch each other: draw it with the corners in the order in which they \
         follow each other",
    );
    // Both halves of this one have the same area, which cancel each other.
    let even = vec![[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
    assert_not_imported(
        &Dxf::new(6).polygons("brick", &[square(2.0, 0.0), even]),
        &ImportOptions::default(),
        "LWPOLYLINE 2 (line 48): its edges cross or touch each other: draw it with the corners in the order in which they \
         follow each other",
    );
    // A tolerance that takes the stone inside for a sliver mends nothing.
    let around = vec![[-1.0, -1.0], [2.0, -1.0], [2.0, 2.0], [-1.0, 2.0]];
    assert_not_imported(
        &Dxf::new(6).polygons("brick", &[around, square(0.0, 0.0)]),
        &ImportOptions::default(),
        "LWPOLYLINE 1 (line 22) and LWPOLYLINE 2 (line 48): the blocks overlap by 2 m, which is more than the tolerance of \
         0.05 m: no tolerance mends that: correct the drawing there",
    );
    assert_not_imported(
        &Dxf::new(6).polygons("brick", &[square(0.0, 0.0)]),
        &ImportOptions { tolerance: Some(0.3), ..ImportOptions::default() },
        "LWPOLYLINE 1 (line 22): its edge of 1 m is shorter than four times the tolerance of 0.3 m: give --tolerance 0.25 \
         or less",
    );
    assert_not_imported(
        &Dxf::new(6).line("support", [0.0, 0.0], [1.0, 0.0]),
        &ImportOptions::default(),
        "no outline bounds a block: draw blocks as closed polylines, on other layers than \"support\" and \"joint\"",
    );
    assert_not_imported(
        &Dxf::new(6).polygons("brick", &[square(0.0, 0.0)]),
        &ImportOptions { tolerance: Some(0.6), ..ImportOptions::default() },
        "no outline bounds a block (LWPOLYLINE 1 (line 22): slivers were dropped): draw blocks as closed polylines, on \
         other layers than \"support\" and \"joint\"",
    );
    let diamond = vec![[0.0, 0.0], [1.0, 1.1], [0.0, 2.2], [-1.0, 1.1]];
    assert_not_imported(
        &Dxf::new(6).polygons("brick", &[diamond]),
        &ImportOptions::default(),
        "no support is drawn, and no block rests with an edge on a line below all others: draw supports on a layer \
         \"support\"",
    );
    let same: Vec<Polygon> =
        (0..200).map(|k| square(0.2 * f64::from(k % 3), 1e-3 * f64::from(k))).collect();
    let error = import(&Dxf::new(6).polygons("brick", &same).read(), &ImportOptions::default())
        .unwrap_err();
    assert!(error.to_string().contains("dozens of outlines lie over each other here"), "{error}");
    let options = ImportOptions { scale: -1.0, ..ImportOptions::default() };
    assert_not_imported(&pair(0.0), &options, "--scale is -1: give a positive number");
}

#[test]
fn a_joint_that_no_mortar_fits_is_named() {
    let polygons = [square(0.0, 0.0), square(0.0, 1.1), square(0.0, 2.35)];
    let options =
        ImportOptions { joints: Some(masonry_import::Joints::Mortar), ..ImportOptions::default() };
    assert_not_imported(
        &Dxf::new(6).polygons("brick", &polygons),
        &ImportOptions { tolerance: Some(0.01), ..options },
        "LWPOLYLINE 1 (line 22) and LWPOLYLINE 2 (line 48): the joint is 0.1 m wide and others are 0.25 m: correct the \
         drawing, or give --joints close",
    );
}

/// Valid files of each format.
fn files() -> Vec<(String, DrawingFormat)> {
    let dxf = Dxf::new(6).polygons("0", &wall(2, 2, 0.0)).into_block("wall", [0.0, 0.0]);
    let quoin = [[0.0, 0.0], [1.0, 0.0], [1.0, 0.5], [0.5, 0.5], [0.5, 1.0], [0.0, 1.0]];
    let dxf = dxf.polygons("quoin", &[quoin.to_vec()]);
    let dxf = dxf.insert("wall", [1.0, 0.0], "50\n30\n").line("support", [0.0, 0.0], [9.0, 0.0]);
    let dxf = dxf.entity("ARC", "a", "10\n0\n20\n0\n40\n1\n50\n0\n51\n90\n");
    let svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"40mm\" viewBox=\"0 0 40 40\"><g id=\"a\">\
               <path d=\"M0 0h9v9a2 3 0 0 1-9 0z\" transform=\"rotate(30)\"/><rect width=\"9\" height=\"3\"/></g></svg>";
    let mesh = r#"{"data": {"vertex": {"0": {"x": 0, "y": 0, "z": 0}, "1": {"x": 1, "y": 0, "z": 0},
                   "2": {"x": 0, "y": 1, "z": 0}}, "face": {"0": [0, 1, 2]}}}"#;
    let list = r#"[{"name": "a", "material": "stone", "corners": [[0, 0], [1, 0], [1, 1]]}]"#;
    let obj = body(1, [0.0; 3], 0.0) + &body(2, [1.0, 0.0, 0.0], 0.0);
    vec![
        (dxf.text(), DrawingFormat::Dxf),
        (svg.to_owned(), DrawingFormat::Svg),
        (mesh.to_owned(), DrawingFormat::Json),
        (list.to_owned(), DrawingFormat::Json),
        (obj, DrawingFormat::Obj),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    /// Files that were cut off and changed are read or refused, and so is what is read of them.
    #[test]
    fn damaged_files_do_not_panic(
        file in 0..5_usize,
        end in 0..1200_usize,
        changes in prop::collection::vec((0..1000_usize, any::<u8>()), 0..6),
        cuts in prop::collection::vec((0..1000_usize, 1..40_usize), 0..3),
    ) {
        let (text, format) = files().swap_remove(file);
        let mut bytes = text.into_bytes();
        // Places are in thousandths of the length.
        let place = |part: usize, length: usize| part * length / 1000;
        bytes.truncate(place(end, bytes.len()));
        for (at, byte) in changes {
            let at = place(at, bytes.len());
            if let Some(old) = bytes.get_mut(at) {
                *old = byte;
            }
        }
        for (at, length) in cuts {
            let at = place(at, bytes.len());
            bytes.drain(at..(at + length).min(bytes.len()));
        }
        let drawing = Drawing::read(&bytes, format);
        let imported = drawing.map(|it| import(&it, &ImportOptions::default()));
        if let Ok(Ok(imported)) = imported {
            prop_assert!(imported.to_toml().is_ok());
            prop_assert!(!imported.picture().contains("NaN"));
        }
    }
}
