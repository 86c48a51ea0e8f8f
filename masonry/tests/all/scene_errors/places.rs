//! Blocks, supports, loads and contact points in wrong places.

use masonry::scene::SceneErrorKind;

use super::{CORNERS, GOOD, assert_error, error_of};

#[test]
fn blocks_of_a_wrong_shape() {
    let clockwise = "[[0.0, 0.3], [0.0, 0.5], [1.0, 0.5], [1.0, 0.3]]";
    assert_error(
        CORNERS,
        clockwise,
        "[[",
        "blocks[0].corners",
        &["block \"lintel\" run clockwise (area -0.2 m2)", "list them counter-clockwise"],
    );
    let spike = "[[0.0, 0.3], [1.0, 0.3], [1.0, 0.5], [1.0, 0.4], [0.0, 0.5]]";
    assert_error(
        CORNERS,
        spike,
        "[1.0, 0.5",
        "blocks[0].corners[2]",
        &["no width at corner 3", "leave the corner out"],
    );
    let line = "[[0.0, 0.3], [1.0, 0.3]]";
    assert_error(CORNERS, line, "[[", "blocks[0].corners", &["2 corners: give at least three"]);
    let star = "[[0.5, 0.3], [0.8, 1.2], [0.0, 0.7], [1.0, 0.7], [0.2, 1.2]]";
    assert_error(
        CORNERS,
        star,
        "[[",
        "blocks[0].corners",
        &["the edges of block \"lintel\" cross or touch", "in which they follow each other"],
    );
}

/// A mesh of patches has one number, and no mesh fits a block with an edge that cannot be seen from its centroid.
#[test]
fn elastic_blocks_have_a_mesh_that_fits() {
    let lintel = format!("material = \"stone\"\ncorners = {CORNERS}");
    let brick = |corners: &str, mesh: &str| {
        format!("material = \"brick\"\ncorners = {corners}\nmesh = {mesh}")
    };
    let house = "[[0.0, 0.3], [1.0, 0.3], [1.0, 0.5], [0.5, 0.6], [0.0, 0.5]]";
    assert_error(
        &lintel,
        &brick(house, "[1, 2]"),
        "[1, 2]",
        "blocks[0].mesh",
        &["only a convex block with four corners can have", "give one, such as mesh = 1"],
    );
    let hollow = "[[0.0, 0.3], [1.0, 0.3], [1.0, 1.3], [0.9, 1.3], [0.9, 0.4], [0.1, 0.4], [0.1, 1.3], [0.0, 1.3]]";
    assert_error(
        &lintel,
        &brick(hollow, "1"),
        "[0.9, 1.3]",
        "blocks[0].corners[3]",
        &["block \"lintel\" has no mesh", "its edge 3", "give it a rigid material"],
    );
    assert_error(&lintel, &brick(house, "-1"), "-1", "", &["at least 1"]);
    let wanted = "expected a number of elements, or a list of exactly 2 items";
    assert_error(&lintel, &brick(house, "1.5"), "1.5", "", &[wanted]);
    assert_error(&lintel, &brick(house, "600"), "600", "blocks[0].mesh", &["elements of a block"]);
}

#[test]
fn blocks_in_a_wrong_place() {
    assert_error(
        "[[0.0, 0.3], [1.0, 0.3]",
        "[[0.0, 0.29], [1.0, 0.3]",
        "[[0.0",
        "blocks[0].corners",
        &["blocks \"wall/3/1\" and \"lintel\" overlap by an area of 0.0018", "m2"],
    );
    let far = "[[0.0, 10.3], [1.0, 10.3], [1.0, 10.5], [0.0, 10.5]]";
    assert_error(
        CORNERS,
        far,
        "[[0.0",
        "blocks[0].corners",
        &["\"lintel\" touches no other block and no support", "move in every direction"],
    );
}

#[test]
fn supports_and_loads_in_a_wrong_place() {
    let idle = "[[loads]]\nname = \"idle\"\nfrom = [5, 0]\nto = [6, 0]\npressure = 1\n[[loads]]";
    let error = error_of("[[loads]]", idle);
    let line = GOOD.lines().position(|line| line == "[[loads]]").unwrap() + 1;
    assert_eq!((error.line(), error.key()), (Some(line), "loads[0]".to_owned()), "{error}");
    assert!(error.to_string().contains("load \"idle\" acts on nothing"), "{error}");

    let within = idle.replace("[5, 0]", "[0, 0.1]").replace("[6, 0]", "[1, 0.1]");
    assert!(matches!(error_of("[[loads]]", &within).kind(), SceneErrorKind::IdleLoad { .. }));

    let hook =
        "[[supports]]\nname = \"hook\"\nfrom = [7, 1]\nto = [8, 1]\njoint = \"bed\"\n[[supports]]";
    let error = error_of("[[supports]]", hook);
    assert!(error.to_string().contains("no block touches support \"hook\""), "{error}");
    assert_eq!(error.key(), "supports[0]");

    let through = hook.replace("[7, 1]", "[0.5, 0.4]").replace("[8, 1]", "[8, 0.4]");
    let error = error_of("[[supports]]", &through);
    let words = "runs through the inside of block \"lintel\" for a length of 0.5";
    assert!(error.to_string().contains(words), "{error}");

    let twice =
        hook.replace("hook", "again").replace("[7, 1]", "[3, 0]").replace("[8, 1]", "[0.5, 0]");
    let error = error_of("[[supports]]", &twice);
    let words = "\"again\" and \"floor\" lie on each other along block \"wall/1/";
    assert!(error.to_string().contains(words), "{error}");
    assert!(error.to_string().contains("remove one of them"), "{error}");
    assert_eq!(error.key(), "supports[1]");
    // Supports that share an end, or hold the faces of two blocks from the same line, are two.
    let beside = twice.replace("[0.5, 0]", "[8, 0]");
    let beside = GOOD
        .replacen("[[supports]]", &beside, 1)
        .replace("from = [-1.0, 0.0]\nto = [3.0, 0.0]", "from = [-1.0, 0.0]\nto = [2.2, 0.0]")
        .replace("[3, 0]", "[2.2, 0]");
    super::Model::from_scene(&super::Scene::from_toml(&beside).unwrap()).unwrap();

    assert_error(
        "to = [3.0, 0.0]",
        "to = [-1.0, 0.0]",
        "[-1.0",
        "supports[0].to",
        &["no length", "[-1, 0]"],
    );
    // Too short for its direction to be computed.
    let error = error_of("to = [3.0, 0.0]", "to = [-1.0, 1e-300]");
    assert!(matches!(error.kind(), SceneErrorKind::NoLength { .. }), "{error}");
}

#[test]
fn a_joint_class_that_blocks_need() {
    let error = error_of("[joints.head]\nphi_deg = 30.0", "");
    assert!(error.to_string().contains("add [joints.head]"), "{error}");
    assert!(error.to_string().contains("\"wall/1/1\" and \"wall/1/2\""), "{error}");
}

#[test]
fn contact_points_at_nodes_that_do_not_match() {
    let error = error_of("gap_limit = 0.0", "points = \"nodal_pairs\"");
    assert!(matches!(error.kind(), SceneErrorKind::Contact(_)), "{error}");
    assert_eq!(error.key(), "contact.points");
    assert!(error.line().is_some());
}
