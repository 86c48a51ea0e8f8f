//! COMPAS JSON, SVG, OBJ and lists become the scenes that they draw.

#![allow(clippy::float_cmp, reason = "import rounds away what is no digit of the drawing")]

use std::collections::BTreeMap;
use std::f64::consts::PI;

use masonry::{Model, Verdict, solve};
use masonry_drawing::{Drawing, DrawingFormat, Unit};
use masonry_import::{ImportOptions, Imported, import};
use serde_json::{Value, json};

use crate::common::{BRICK, Dxf, Polygon, changes, mapped, turned, wall};

#[track_caller]
fn imported(text: &str, format: DrawingFormat) -> Imported {
    let drawing = Drawing::read(text.as_bytes(), format).unwrap_or_else(|error| panic!("{error}"));
    import(&drawing, &ImportOptions::default()).unwrap_or_else(|error| panic!("{error}"))
}

/// A plane of space: where a point of the drawing comes to, at a depth.
type Plane = fn([f64; 2], f64) -> [f64; 3];

fn in_xz([x, y]: [f64; 2], depth: f64) -> [f64; 3] {
    [x, depth, y]
}

/// A prism as the mesh of COMPAS has it, with its ends in triangles or not.
fn mesh(polygon: &Polygon, depth: f64, plane: Plane, has_triangles: bool) -> Value {
    let n = polygon.len();
    let mut vertices = BTreeMap::new();
    for (k, corner) in polygon.iter().enumerate() {
        for (end, at) in [(0, 0.0), (n, depth)] {
            let [x, y, z] = plane(*corner, at);
            vertices.insert((k + end).to_string(), json!({ "x": x, "y": y, "z": z }));
        }
    }
    let mut faces: Vec<Vec<usize>> =
        (0..n).map(|k| vec![k, (k + 1) % n, n + (k + 1) % n, n + k]).collect();
    let ends = |order: Vec<usize>| {
        if has_triangles {
            (1..n - 1).map(|k| vec![order[0], order[k], order[k + 1]]).collect()
        } else {
            vec![order]
        }
    };
    faces.extend(ends((0..n).rev().collect()));
    faces.extend(ends((n..2 * n).collect()));
    let faces: BTreeMap<String, Vec<usize>> =
        faces.into_iter().enumerate().map(|(k, face)| (k.to_string(), face)).collect();
    json!({ "attributes": { "name": "Block" }, "vertex": vertices, "face": faces })
}

/// An assembly as COMPAS writes it: nodes of a graph hold the blocks.
fn assembly(blocks: &[(Value, bool)]) -> String {
    let node = |(k, (mesh, is_support)): (usize, &(Value, bool))| {
        let block = json!({ "dtype": "compas_assembly.datastructures/Block", "data": mesh });
        (k.to_string(), json!({ "block": block, "is_support": is_support }))
    };
    let nodes: BTreeMap<String, Value> = blocks.iter().enumerate().map(node).collect();
    let graph = json!({ "node": nodes, "edge": {}, "attributes": { "name": "Graph" } });
    json!({
        "dtype": "compas_assembly.datastructures/Assembly",
        "data": { "attributes": { "name": "Assembly" }, "graph": { "data": graph } }
    })
    .to_string()
}

fn prisms(polygons: &[Polygon], depth: f64, plane: Plane) -> Vec<(Value, bool)> {
    let prism = |(k, it): (usize, &Polygon)| (mesh(it, depth, plane, k % 2 == 0), false);
    polygons.iter().enumerate().map(prism).collect()
}

#[test]
fn a_wall_of_compas_stands() {
    let mut blocks = prisms(&wall(4, 4, 0.0), 0.2, in_xz);
    let ground = vec![[-0.1, -0.3], [1.1, -0.3], [1.1, 0.0], [-0.1, 0.0]];
    blocks.push((mesh(&ground, 0.2, in_xz, true), true));
    let found = imported(&assembly(&blocks), DrawingFormat::Json);
    assert_eq!(found.scene.thickness, Some(0.2));
    assert_eq!(found.scene.blocks[0].corners[1], [BRICK[0], 0.0]);
    assert_eq!((found.scene.blocks.len(), found.scene.supports.len()), (18, 1));
    assert_eq!(changes(&found, "touch no block"), 3);
    let outcome = solve(&found.scene).unwrap();
    assert_eq!(outcome.judgement.verdict, Verdict::Stands);
    let weight = 0.2 * 0.5 * 2000.0 * 9.81;
    assert!((outcome.reactions[0].fy / weight - 1.0).abs() < 1e-9);
}

#[test]
fn walls_in_other_upright_planes_are_the_wall() {
    fn in_yz([x, y]: [f64; 2], depth: f64) -> [f64; 3] {
        [7.0 - depth, x, y]
    }
    fn askew([x, y]: [f64; 2], depth: f64) -> [f64; 3] {
        let [u, v] = turned(30.0)([x, depth]);
        [u, v, y]
    }
    for plane in [in_xz as Plane, in_yz, askew] {
        let found = imported(&assembly(&prisms(&wall(3, 3, 0.0), 0.2, plane)), DrawingFormat::Json);
        let model = Model::from_scene(&found.scene).unwrap();
        let flat = imported(&list(&wall(3, 3, 0.0)), DrawingFormat::List);
        assert_eq!(model.joints.len(), Model::from_scene(&flat.scene).unwrap().joints.len());
        assert!((found.scene.thickness.unwrap() - 0.2).abs() < 1e-12);
    }
}

#[test]
fn an_arch_of_compas_stands() {
    const COUNT: usize = 12;
    let at = |radius: f64, k: usize| {
        let angle = PI * k as f64 / COUNT as f64;
        [radius * angle.cos(), radius * angle.sin()]
    };
    let voussoir = |k: usize| vec![at(1.0, k), at(1.2, k), at(1.2, k + 1), at(1.0, k + 1)];
    let polygons: Vec<Polygon> = (0..COUNT).map(voussoir).collect();
    let found = imported(&assembly(&prisms(&polygons, 0.4, in_xz)), DrawingFormat::Json);
    assert_eq!(solve(&found.scene).unwrap().judgement.verdict, Verdict::Stands);
    assert_eq!(Model::from_scene(&found.scene).unwrap().joints.len(), COUNT + 1);
}

/// The bars between two fixed posts that are known as `H` and `A`: both supports are found, on the sides of the bar.
#[test]
fn bars_between_posts_of_compas_lie_on_both() {
    let h = |x: f64| vec![[x, -1.0], [x + 0.6, -1.0], [x + 0.6, 1.4], [x, 1.4]];
    let bar = |a: f64, b: f64| vec![[-a, -0.2], [a, -0.2], [b, 0.6], [-b, 0.6]];
    let leaning = |side: f64| {
        vec![[side * 1.1547, -0.2], [side * 2.0, -0.2], [side * 1.9, 0.6], [side * 1.1407, 0.6]]
    };
    let cases =
        [(bar(0.9, 0.9), [h(-1.5), h(0.9)]), (bar(1.1547, 1.1407), [leaning(-1.0), leaning(1.0)])];
    for (bar, posts) in cases {
        let mut blocks = vec![(mesh(&bar, 0.2, in_xz, true), false)];
        blocks.extend(posts.iter().map(|post| (mesh(post, 0.2, in_xz, false), true)));
        let found = imported(&assembly(&blocks), DrawingFormat::Json);
        let model = Model::from_scene(&found.scene).unwrap();
        assert_eq!([model.blocks.len(), model.supports.len(), model.joints.len()], [1, 2, 2]);
        assert!(model.joints.iter().all(|joint| joint.normal.x.abs() > 0.99));
    }
}

#[test]
fn a_flat_mesh_has_a_block_for_each_face() {
    let vertices = json!({
        "0": { "x": 0.0, "y": 0.0, "z": 0.0 }, "1": { "x": 1.0, "y": 0.0, "z": 0.0 },
        "2": { "x": 1.0, "y": 1.0, "z": 0.0 }, "3": { "x": 0.0, "y": 1.0, "z": 0.0 },
        "4": { "x": 0.5, "y": 1.5, "z": 0.0 }
    });
    let mesh = json!({ "vertex": vertices, "face": { "0": [0, 1, 2, 3], "1": ["3", "2", "4"] } });
    let found = imported(
        &json!({ "dtype": "compas.datastructures/Mesh", "data": mesh }).to_string(),
        DrawingFormat::Json,
    );
    assert_eq!(found.scene.blocks[1].corners, [[0.0, 1.0], [1.0, 1.0], [0.5, 1.5]]);
}

fn list(polygons: &[Polygon]) -> String {
    let block = |it: &Polygon| json!({ "material": "brick", "corners": it });
    Value::from(polygons.iter().map(block).collect::<Vec<_>>()).to_string()
}

#[test]
fn a_list_is_healed_as_a_drawing_is() {
    let polygons = mapped(&wall(3, 3, 0.0), |[x, y]| [x, if y > 0.3 { y + 1e-3 } else { y }]);
    let found = imported(&list(&polygons), DrawingFormat::Json);
    assert_eq!(found.scene.blocks[0].material, "brick");
    assert_eq!(solve(&found.scene).unwrap().judgement.verdict, Verdict::Stands);
}

#[test]
fn svg_has_transforms_units_and_layers() {
    let svg = r#"<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"
        width="400mm" height="300mm" viewBox="0 0 200 150">
      <defs><rect width="3" height="3"/></defs>
      <g inkscape:label="brick" transform="translate(10, 20)">
        <rect x="0" y="60" width="50" height="20"/>
        <polygon points="50,60 100,60 100,80 50,80"/>
        <g transform="matrix(1 0 0 -1 0 60)"><path d="m 25 0 h 50 v 20 h -50 z"/></g>
        <rect style="display: none" x="0" y="0" width="5" height="5"/>
      </g>
      <g inkscape:label="old" style="fill:none; display : none"><g transform="broken"><rect width="9" height="9"/></g></g>
      <g inkscape:label="brick" visibility="hidden">
        <circle r="4"/>
        <g visibility="visible" transform="translate(10, 20)">
          <rect x="0" y="40" width="25" height="20"/><rect x="0" y="40" width="25" height="20" style="visibility:collapse"/>
        </g>
      </g>
      <g id="support"><line x1="0" y1="100" x2="150" y2="100"/></g>
      <text>A wall</text>
    </svg>"#;
    let found = imported(svg, DrawingFormat::Svg);
    assert_eq!(found.unit, Unit::Millimetre);
    // Lengths are twice the coordinates in millimetres, and y points up.
    let near = |found: [f64; 2], expected: [f64; 2]| {
        (found[0] - expected[0]).abs() + (found[1] - expected[1]).abs() < 1e-12
    };
    let lowest = |k: usize| {
        let corners: &[[f64; 2]] = &found.scene.blocks[k].corners;
        *corners.iter().min_by(|a, b| (a[0] + a[1]).total_cmp(&(b[0] + b[1]))).unwrap()
    };
    assert_eq!(found.scene.blocks.len(), 4);
    let hidden =
        |layer| changes(&found, &format!("hidden objects of layer \"{layer}\" were left out"));
    assert_eq!([hidden("brick"), hidden("old")], [3, 1], "{}", found.report());
    assert!(near(lowest(0), [0.02, -0.2]), "{:?}", lowest(0));
    assert!(near(lowest(1), [0.12, -0.2]) && near(lowest(2), [0.07, -0.16]), "{:?}", lowest(2));
    assert!(found.scene.blocks.iter().all(|it| it.material == "brick"));
    assert_eq!(changes(&found, "<text> was left out"), 1);
    assert_eq!(solve(&found.scene).unwrap().judgement.verdict, Verdict::Stands);
}

#[test]
fn curves_of_svg_become_chords() {
    let svg = r#"<svg xmlns="http://www.w3.org/2000/svg"><path d="M 0 0 L 1 0 A 0.5 0.5 0 0 0 0 0 Z"/></svg>"#;
    let found = imported(svg, DrawingFormat::Svg);
    let corners = &found.scene.blocks[0].corners;
    assert!(corners.len() > 5, "{corners:?}");
    assert!(corners.iter().all(|[x, y]| ((x - 0.5).hypot(*y) - 0.5).abs() < 1e-3), "{corners:?}");
}

#[test]
fn faces_and_bodies_of_obj_are_blocks() {
    let flat = "# two stones\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nv 2 2 0\nv 0 2 0\nusemtl tuff\nf 1/1 2/2 3/3 4/4\nf -3//1 -4//1 -2//1 -1//1\n";
    // The second face has its corners in a circle of its own.
    let flat = flat.replace("f -3//1 -4//1 -2//1 -1//1", "f 4 3 -2 -1");
    let found = imported(&flat, DrawingFormat::Obj);
    assert_eq!(found.scene.blocks[1].corners, [[0.0, 1.0], [2.0, 1.0], [2.0, 2.0], [0.0, 2.0]]);
    assert_eq!(found.scene.blocks[0].material, "tuff");

    let body = |x: f64| {
        let corners = [[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 0.5], [x, 0.5]];
        let corner = |y: f64| corners.map(|[x, z]| format!("v {x} {y} {z}\n")).concat();
        let faces = "f -8 -7 -6 -5\nf -1 -2 -3 -4\nf -8 -4 -3 -7\nf -7 -3 -2 -6\nf -6 -2 -1 -5\nf -5 -1 -4 -8\n";
        format!("o stone{x}\n{}{}{faces}", corner(0.0), corner(0.3))
    };
    let found = imported(&(body(0.0) + &body(1.0)), DrawingFormat::Obj);
    assert_eq!(found.scene.thickness, Some(0.3));
    assert_eq!(found.scene.blocks[1].name, "stone1");
    assert_eq!(Model::from_scene(&found.scene).unwrap().joints.len(), 3);
}

#[test]
fn lines_of_dxf_are_in_world_coordinates_whatever_their_direction() {
    let seen_from_behind = "230\n-1\n";
    let line = format!("10\n0\n20\n0\n11\n3\n21\n1\n{seen_from_behind}");
    let drawing = Dxf::new(6)
        .entity("LINE", "support", &line)
        .entity("POLYLINE", "support", &format!("70\n8\n{seen_from_behind}"))
        .entity("VERTEX", "support", "10\n0\n20\n0\n")
        .entity("VERTEX", "support", "10\n3\n20\n1\n")
        .entity("POLYLINE", "support", &format!("70\n0\n{seen_from_behind}"))
        .entity("VERTEX", "support", "10\n0\n20\n0\n")
        .entity("VERTEX", "support", "10\n3\n20\n1\n")
        .read();
    let ends: Vec<f64> = drawing.lines.iter().map(|line| line.points[1].x).collect();
    assert_eq!(ends, [3.0, 3.0, -3.0]);
}

#[test]
fn an_arc_of_360_degrees_is_a_circle() {
    let circle = "10\n1\n20\n2\n40\n0.5\n";
    let drawing = Dxf::new(6)
        .entity("CIRCLE", "0", circle)
        .entity("ARC", "0", &format!("{circle}50\n0\n51\n360\n"))
        .read();
    assert_eq!(drawing.outlines[0].corners, drawing.outlines[1].corners);
}

#[test]
fn invisible_entities_are_left_out() {
    let line = "10\n0\n20\n0\n11\n1\n21\n0\n";
    let drawing = Dxf::new(6)
        .entity("LINE", "support", line)
        .entity("LINE", "support", &format!("60\n1\n{line}"))
        .read();
    assert_eq!((drawing.lines.len(), drawing.changes.len()), (1, 1));
    assert_eq!(drawing.changes[0].what, "invisible entities were left out");
}

/// What hangs on a layer that is frozen or off is no part of the drawing, nor is a block that is inserted on a frozen one.
#[test]
fn layers_that_are_not_shown_are_left_out() {
    let stone = |x: f64| vec![[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0], [x, 1.0]];
    let dxf = Dxf::new(6)
        .polygons("0", &[stone(0.0)])
        .polygons("stone", &[stone(1.0)])
        .into_block("pair", [0.0, 0.0])
        .polygons("Ice", &[stone(20.0), stone(21.0)])
        .polygons("night", &[stone(30.0)])
        .polygons("day", &[stone(40.0)]);
    let insert = |layer: &str, x: f64| format!("0\nINSERT\n8\n{layer}\n2\npair\n10\n{x}\n20\n0\n");
    let layer = |name: &str, flags: i32, colour: i32| {
        format!("0\nLAYER\n2\n{name}\n70\n{flags}\n62\n{colour}\n6\nCONTINUOUS\n")
    };
    let layers = [layer("ICE", 5, 7), layer("night", 0, -7), layer("day", 4, 7)].concat();
    let tables =
        format!("0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n{layers}0\nENDTAB\n0\nENDSEC\n");
    let text = dxf.text();
    let text =
        text.replace("0\nSECTION\n2\nENTITIES\n", &format!("{tables}0\nSECTION\n2\nENTITIES\n"));
    let inserts = [insert("ice", 0.0), insert("night", 5.0), insert("day", 10.0)].concat();
    let text = text.replace("0\nENDSEC\n0\nEOF", &format!("{inserts}0\nENDSEC\n0\nEOF"));
    let found = imported(&text, DrawingFormat::Dxf);
    let lefts: Vec<f64> = found.scene.blocks.iter().map(|it| it.corners[0][0]).collect();
    assert_eq!(lefts, [40.0, 6.0, 10.0, 11.0]);
    let counts =
        ["\"Ice\", which is frozen", "\"ice\", which is frozen", "\"night\", which is off"];
    assert_eq!(counts.map(|it| changes(&found, it)), [2, 1, 2], "{}", found.report());
}

#[test]
fn an_entity_names_each_insertion_once() {
    let dxf = Dxf::new(6).line("0", [0.0, 0.0], [1.0, 0.0]).into_block("inner", [0.0, 0.0]);
    let dxf = dxf.insert("inner", [0.0, 0.0], "").into_block("middle", [0.0, 0.0]);
    let dxf = dxf.insert("middle", [0.0, 0.0], "").into_block("outer", [0.0, 0.0]);
    let place = dxf.insert("outer", [0.0, 0.0], "").read().lines[0].place.entity.clone();
    let at = |name: &str| place.match_indices(name).map(|(at, _)| at).collect::<Vec<_>>();
    let blocks = ["block inner", "block middle", "block outer"].map(at);
    assert!(blocks.iter().all(|it| it.len() == 1) && blocks.is_sorted(), "{place}");
}

#[test]
fn drawings_in_a_drawing_of_svg_are_left_out_if_they_are_moved() {
    let svg = r#"<svg xmlns="http://www.w3.org/2000/svg">
      <svg x="0"><rect width="1" height="1"/></svg>
      <svg x="5"><rect width="1" height="1"/></svg>
      <svg viewBox="0 0 9 9"><rect width="1" height="1"/></svg>
    </svg>"#;
    let drawing = Drawing::read(svg.as_bytes(), DrawingFormat::Svg).unwrap();
    assert_eq!((drawing.outlines.len(), drawing.changes.len()), (1, 2));
    assert_eq!(drawing.changes[1].place.to_string(), "<svg> (line 4)");
}

#[test]
fn lines_of_obj_are_in_the_plane_of_the_faces() {
    let obj = "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nf 1 2 3 4\nl 2 4\n";
    let drawing = Drawing::read(obj.as_bytes(), DrawingFormat::Obj).unwrap();
    let corners = &drawing.outlines[0].corners;
    assert_eq!(drawing.lines[0].points, [corners[1], corners[3]]);
}

#[test]
fn bodies_without_faces_are_passed_over() {
    let face = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";
    let prism = "o prism\nv 0 0 0\nv 1 0 0\nv 0 0 1\nv 0 2 0\nv 1 2 0\nv 0 2 1\n\
                 f 1 2 3\nf 6 5 4\nf 1 4 5 2\nf 2 5 6 3\nf 3 6 4 1\n";
    for obj in [face, prism] {
        let obj = format!("g root\n{obj}g end\n");
        let drawing = Drawing::read(obj.as_bytes(), DrawingFormat::Obj).unwrap();
        assert_eq!(drawing.outlines.len(), 1);
    }
}
