//! Numbers in the CSV, JSON, VTU and text reports are those of the outcome.

use crate::synthetic;

use masonry::analysis::outcome::PointStatus;
use masonry::model::Body;
use masonry::units::{ForceUnit, LengthUnit, Units};
use masonry_report::{csv, joints, json, summary, table, vtu};
use roxmltree::Document;
use serde_json::Value;
use synthetic::Wall;

/// The checks of a state in `result.json`.
const BALANCE: [&str; 9] = [
    "force",
    "moment",
    "uncarried_load",
    "nodal",
    "cone_violation",
    "penetration",
    "complementarity",
    "energy",
    "deformation",
];

/// Fields of CSV text, quotes undone.
fn records(text: &str) -> Vec<Vec<String>> {
    let mut records = Vec::new();
    let (mut record, mut field, mut quoted) = (Vec::new(), String::new(), false);
    let mut characters = text.chars().peekable();
    while let Some(character) = characters.next() {
        match character {
            '"' if quoted && characters.peek() == Some(&'"') => {
                field.push('"');
                characters.next();
            }
            '"' => quoted = !quoted,
            ',' if !quoted => record.push(std::mem::take(&mut field)),
            '\r' if !quoted && characters.peek() == Some(&'\n') => {
                characters.next();
                record.push(std::mem::take(&mut field));
                records.push(std::mem::take(&mut record));
            }
            other => field.push(other),
        }
    }
    assert!(field.is_empty() && record.is_empty() && !quoted, "the last line is not ended");
    records
}

#[test]
fn contacts_read_back_exactly() {
    let outcome = synthetic::solved(Wall::PANEL);
    let (model, state) = (&outcome.model, outcome.state.as_ref().unwrap());
    let records = records(&csv::contacts(model, state));
    let heads = [
        "index",
        "joint",
        "class",
        "a",
        "b",
        "x_m",
        "y_m",
        "area_m2",
        "t_n_kN",
        "t_t_kN",
        "traction_n_kN/m2",
        "traction_t_kN/m2",
        "gap_m",
        "slip_m",
        "mu",
        "status",
    ];
    assert_eq!(records[0], heads);
    assert_eq!(records.len(), model.contacts.len() + 1);
    for ((record, contact), force) in records[1..].iter().zip(&model.contacts).zip(&state.contacts)
    {
        assert_eq!(record.len(), heads.len());
        let joint = &model.joints[contact.joint.index()];
        let a = match joint.a {
            Body::Block(id) => &model.blocks[id.index()].name,
            Body::Support(id) => &model.supports[id.index()].name,
        };
        assert_eq!(&record[2], &model.joint_classes[joint.class].name);
        assert_eq!(&record[3], a);
        assert_eq!(&record[4], &model.blocks[joint.b.index()].name);
        let numbers: Vec<f64> = record[5..15].iter().map(|field| field.parse().unwrap()).collect();
        let expected = [
            contact.position.x,
            contact.position.y,
            contact.weight,
            force.t_n / 1e3,
            force.t_t / 1e3,
            force.t_n / contact.weight / 1e3,
            force.t_t / contact.weight / 1e3,
            force.y_n,
            force.y_t,
            contact.law.mu,
        ];
        for (number, expected) in numbers.iter().zip(expected) {
            assert_eq!(number.to_bits(), (expected + 0.0).to_bits(), "{number} {expected}");
        }
        let status = match force.status {
            PointStatus::Open => "open",
            PointStatus::Stick => "stick",
            PointStatus::Slip => "slip",
        };
        assert_eq!(record[15], status);
    }
    assert!(records.iter().any(|record| record[3] == "floor \"right\""));
}

#[test]
fn the_json_of_a_solution_has_every_key() {
    let outcome = synthetic::solved(Wall::PANEL);
    let files = ["scene.svg".to_owned()];
    let value: Value = serde_json::from_str(&json::result(&outcome, &files).unwrap()).unwrap();
    let keys = [
        "status",
        "title",
        "units",
        "plan",
        "form",
        "order",
        "attempts",
        "pivots",
        "residuals",
        "balance",
        "reactions",
        "contacts",
        "strain_energy",
        "max_displacement",
        "time_s",
        "files",
    ];
    for key in keys {
        assert!(!value[key].is_null(), "{key} is missing");
    }
    assert!(value.get("reason").is_none());
    for key in ["equation", "feasibility", "complementarity", "natural"] {
        assert!(value["residuals"][key].is_number(), "{key}");
    }
    for key in BALANCE {
        assert!(value["balance"][key].is_number(), "{key}");
    }
    let wall = &value["reactions"]["left <wall>"];
    assert_eq!(wall, &serde_json::json!({"fx": 1.2, "fy": 1.0, "m": -0.5}));
    assert_eq!(value["time_s"]["solve"], 1.75);
    assert_eq!(value["units"]["reactions"]["m"], "kNm");
    assert_eq!(value["contacts"]["slip"], outcome.checks.unwrap().slip);
    assert_eq!(value["files"][0], "scene.svg");
    assert_eq!(value["plan"]["contact_points"], outcome.model.contacts.len());
}

#[test]
fn the_json_without_a_solution_says_why() {
    let outcome = synthetic::unsolved(Wall::PANEL);
    let value: Value = serde_json::from_str(&json::result(&outcome, &[]).unwrap()).unwrap();
    assert_eq!(value["status"], "RayTermination");
    assert!(value["reason"].as_str().unwrap().contains("not a proof"));
    for key in ["balance", "reactions", "contacts", "strain_energy", "max_displacement"] {
        assert_eq!(value.get(key), Some(&Value::Null), "{key}");
    }
}

#[test]
fn results_are_in_the_units_of_the_scene() {
    let mut outcome = synthetic::solved(Wall::PANEL);
    outcome.model.units = Units { length: LengthUnit::Mm, force: ForceUnit::N };
    let value: Value = serde_json::from_str(&json::result(&outcome, &[]).unwrap()).unwrap();
    let state = outcome.state.as_ref().unwrap();
    let largest = summary::largest_displacement(&outcome.model, state).unwrap();
    let close = |value: &Value, expected: f64| {
        (value.as_f64().unwrap() - expected).abs() <= 1e-14 * expected.abs()
    };
    assert!(close(&value["max_displacement"]["value"], largest.value * 1e3));
    assert!(close(&value["reactions"]["right wall"]["fx"], -1200.0));
    assert!(close(&value["reactions"]["right wall"]["m"], 1.5e6));
    assert!(close(&value["strain_energy"], state.strain_energy * 1e3));
    assert_eq!(value["units"]["stress"], "N/mm2");
    let text = csv::contacts(&outcome.model, state);
    assert!(
        text.starts_with("index,joint,class,a,b,x_mm,y_mm,area_mm2,t_n_N,t_t_N,traction_n_N/mm2")
    );
}

#[test]
fn the_applied_load_is_that_of_the_edges_and_of_the_weight() {
    let mut outcome = synthetic::solved(Wall::PANEL);
    let load = summary::applied_load(&outcome.model);
    assert!((load.force.y + 10e3).abs() < 1e-8 && load.force.x.abs() < 1e-12, "{load:?}");
    assert!((load.moment + 5e3).abs() < 1e-8, "{load:?}");
    for block in &mut outcome.model.blocks {
        block.density = Some(1800.0);
    }
    let weight = 1800.0 * 9.81 * 1.0 * 0.8;
    let load = summary::applied_load(&outcome.model);
    assert!((load.force.y + 10e3 + weight).abs() < 1e-7, "{load:?}");
    assert!((load.moment + 0.5 * (10e3 + weight)).abs() < 1e-7, "{load:?}");
}

#[test]
fn extremes_have_their_sign_and_place() {
    let mut outcome = synthetic::solved(Wall::PANEL);
    let state = outcome.state.as_mut().unwrap();
    state.displacements[3][5].x = -0.5;
    state.stresses[7].principal.sigma_2 = -1e9;
    state.stresses[9].principal.sigma_1 = 1e9;
    let largest = summary::largest_displacement(&outcome.model, state).unwrap();
    assert_eq!((largest.component, largest.block.index()), ('x', 3));
    assert_eq!(largest.value.to_bits(), (-0.5_f64).to_bits());
    assert_eq!(largest.position, outcome.model.blocks[3].mesh.as_ref().unwrap().nodes[5]);
    let (compression, tension) = summary::extreme_stresses(state);
    assert_eq!(compression.unwrap().position, state.stresses[7].centre);
    assert_eq!(tension.unwrap().position, state.stresses[9].centre);
}

/// The XML of a VTU file without its raw data, and the raw data.
fn split(bytes: &[u8]) -> (String, &[u8]) {
    let marker = b"<AppendedData encoding=\"raw\">\n_";
    let start =
        bytes.windows(marker.len()).position(|it| it == marker).expect("a VTU file") + marker.len();
    let tail = b"\n</AppendedData>\n</VTKFile>\n";
    assert!(bytes.ends_with(tail));
    let xml = [&bytes[..start], tail].concat();
    (String::from_utf8(xml).expect("a VTU file"), &bytes[start..bytes.len() - tail.len()])
}

/// The bytes of a named array, checked against the length written before them.
fn array<'a>(document: &Document<'_>, data: &'a [u8], name: &str) -> &'a [u8] {
    let tag = document
        .descendants()
        .find(|node| node.attribute("Name") == Some(name))
        .unwrap_or_else(|| panic!("no array {name}"));
    let offset: usize = tag.attribute("offset").expect("a VTU file").parse().expect("a VTU file");
    let length = u64::from_le_bytes(data[offset..offset + 8].try_into().expect("a VTU file"));
    &data[offset + 8..][..usize::try_from(length).expect("a VTU file")]
}

fn floats(bytes: &[u8]) -> Vec<f64> {
    bytes.chunks_exact(8).map(|it| f64::from_le_bytes(it.try_into().expect("a VTU file"))).collect()
}

#[test]
fn arrays_of_the_vtu_fill_the_data_without_gaps() {
    let outcome = synthetic::solved(Wall::PANEL);
    let bytes = vtu::vtu(&outcome.model, outcome.state.as_ref());
    let (xml, data) = split(&bytes);
    let document = Document::parse(&xml).unwrap();
    let mut next = 0;
    for tag in document.descendants().filter(|node| node.has_tag_name("DataArray")) {
        let offset: usize = tag.attribute("offset").unwrap().parse().unwrap();
        assert!(offset < data.len());
        let name = tag.attribute("Name").unwrap();
        next += 8 + array(&document, data, name).len();
    }
    assert_eq!(next, data.len());
}

#[test]
fn the_vtu_holds_the_fields_in_the_units_of_the_scene() {
    let outcome = synthetic::solved(Wall::PANEL);
    let (model, state) = (&outcome.model, outcome.state.as_ref().unwrap());
    let bytes = vtu::vtu(model, Some(state));
    let (xml, data) = split(&bytes);
    let document = Document::parse(&xml).unwrap();
    let moves = floats(array(&document, data, "displacement_m"));
    let expected: Vec<f64> =
        state.displacements.iter().flatten().flat_map(|u| [u.x, u.y, 0.0]).collect();
    assert_eq!(moves, expected);
    let least = floats(array(&document, data, "sigma_2_kN/m2"));
    let expected: Vec<f64> = state.stresses.iter().map(|it| it.principal.sigma_2 / 1e3).collect();
    assert_eq!(least, expected);
    let piece = document.descendants().find(|node| node.has_tag_name("Piece")).unwrap();
    let cells: usize = piece.attribute("NumberOfCells").unwrap().parse().unwrap();
    assert_eq!(cells, state.stresses.len());
    assert_eq!(array(&document, data, "connectivity").len(), 4 * 8 * cells);
    assert!(array(&document, data, "types").iter().all(|kind| *kind == 9));
}

#[test]
fn rigid_blocks_are_one_cell_each_and_no_state_leaves_the_geometry() {
    let outcome = synthetic::solved(Wall { rigid: true, ..Wall::PANEL });
    let bytes = vtu::vtu(&outcome.model, None);
    let (xml, data) = split(&bytes);
    let document = Document::parse(&xml).unwrap();
    assert_eq!(array(&document, data, "deformable"), vec![0; outcome.model.blocks.len()]);
    assert_eq!(array(&document, data, "position_m").len(), outcome.model.blocks.len() * 4 * 24);
    assert!(!xml.contains("displacement") && !xml.contains("sigma"));
}

#[test]
fn the_text_is_narrow_and_complete() {
    let outcome = synthetic::solved(Wall::PANEL);
    let text = table::report(&outcome);
    for part in [
        "floor \"right\"",
        "sum of reactions",
        "applied load",
        "17 open",
        "u_y = ",
        "kNm",
        "largest compression",
        "2.3e-15",
    ] {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
    assert!(!text.contains("No equilibrium"));
    let text = format!("{text}{}", table::report(&synthetic::unsolved(Wall::PANEL)));
    assert!(text.contains("No equilibrium found") && text.contains("left after 412 steps"));
    for line in text.lines() {
        assert!(line.chars().count() <= 100, "{line}");
    }
}

/// A name that begins like a formula is text in every spreadsheet.
#[test]
fn names_are_no_formulas() {
    let mut outcome = synthetic::solved(Wall::PANEL);
    for (name, cell) in
        [("=1+1", "'=1+1"), ("@wall", "'@wall"), ("-a, b", "'-a, b"), ("a=b", "a=b")]
    {
        outcome.model.blocks[0].name = name.to_owned();
        let records = records(&csv::contacts(&outcome.model, outcome.state.as_ref().unwrap()));
        let sides = || records.iter().skip(1).flat_map(|record| &record[3..5]);
        assert!(sides().any(|side| side == cell), "{name}");
        assert!(sides().all(|side| !side.starts_with(['=', '@', '-'])), "{name}");
    }
}

/// Sides of a joint that are apart have moved against each other, not slid.
#[test]
fn points_that_are_open_do_not_slide() {
    let outcome = synthetic::solved(Wall::PANEL);
    let mut contacts = outcome.state.as_ref().unwrap().contacts.clone();
    let joint = outcome.model.contacts[0].joint;
    let of_joint = |k: &usize| outcome.model.contacts[*k].joint == joint;
    let points: Vec<usize> = (0..contacts.len()).filter(of_joint).collect();
    let slip = |contacts: &[_]| {
        let openings = joints::openings(&outcome.model, contacts);
        openings.iter().find(|it| it.joint == joint).map(|it| it.slip)
    };
    for &k in &points {
        (contacts[k].y_n, contacts[k].y_t) = (0.01, 0.02);
    }
    assert_eq!(slip(&contacts), Some(0.0));
    (contacts[points[0]].y_n, contacts[points[0]].y_t) = (0.0, -0.005);
    assert_eq!(slip(&contacts), Some(0.005));
}
