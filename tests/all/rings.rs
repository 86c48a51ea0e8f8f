//! Arches of several rings.

use masonry::analysis::limit::{Laws, limit_by};
use masonry::model::Model;
use masonry::scene::{Arch, Joint, Load, Material, Scene};

use crate::common::{GRAVITY, M_KN, assert_close};

/// A segmental arch with a force at a quarter of its span; two rings of it if there is friction between rings.
fn arch(between_rings: Option<f64>) -> Scene {
    let ring =
        Arch::segmental("arch", "stone", 4.0, 1.0, 0.4, 15).joint("joint").springing("joint");
    let scene = Scene::new("Rings", M_KN)
        .thickness(1.0)
        .gravity([0.0, -GRAVITY])
        .material("stone", Material::rigid().density(2000.0))
        .joint("joint", Joint::mu(0.7))
        .limit_group("axle");
    let (scene, outer) = match between_rings {
        None => (scene.arch(ring), "arch/4"),
        Some(mu) => {
            let rings = ring.rings(2).ring_joint("rings");
            (scene.joint("rings", Joint::mu(mu)).arch(rings), "arch/2/4")
        }
    };
    let model =
        Model::from_scene(&scene.clone().load(Load::acceleration("axle", [0.0, 0.0]))).unwrap();
    let block = model.blocks.iter().find(|it| it.name == outer).unwrap();
    // In the middle of the extrados of the voussoir.
    let at = nalgebra::center(&block.corners[2], &block.corners[3]);
    scene.load(Load::force("axle", outer, at.into(), [0.0, -1.0]))
}

fn limit(scene: &Scene) -> f64 {
    limit_by(scene, Laws::Associative).unwrap().associative.unwrap().load_factor.unwrap()
}

/// Joints between rings allow more motions than the voussoirs through the whole thickness, and friction forbids some: the limit
/// grows with the friction, up to at most that of one ring. A ring alone of half the thickness carries less than two.
#[test]
fn rings_carry_less_than_one_ring_and_more_with_friction() {
    let whole = limit(&arch(None));
    let factors = [0.0, 0.2, 0.7, 10.0, 1e4].map(|mu| limit(&arch(Some(mu))));
    assert!(factors.windows(2).all(|pair| pair[0] <= pair[1] * (1.0 + 1e-6)), "{factors:?}");
    assert!(factors[0] < 0.8 * whole && factors[4] <= whole * (1.0 + 1e-6), "{factors:?} {whole}");
    assert!(factors[4] > 0.98 * whole, "{factors:?} {whole}");
}

/// The voussoirs of both rings meet those of their own ring in joints, and those of the other in ring joints.
#[test]
fn rings_and_their_joints() {
    let model = Model::from_scene(&arch(Some(0.3))).unwrap();
    let class =
        |joint: &masonry::model::PlacedJoint| model.joint_classes[joint.class].name.as_str();
    let count = |name: &str| model.joints.iter().filter(|joint| class(joint) == name).count();
    assert_eq!((count("rings"), count("joint")), (15, 2 * 14 + 4));
    let area = |scene: &Scene| -> f64 {
        let model = Model::from_scene(scene).unwrap();
        model.blocks.iter().map(|block| masonry::geometry::area(&block.corners)).sum()
    };
    assert_close(area(&arch(Some(0.3))), area(&arch(None)), 1e-12);
}
