//! What is not built takes no memory: allocations are counted.

use allocation_counter::{AllocationInfo, measure};

use super::common::routes::ROUTES;
use super::scenes::{boxed, elastic, long_wall, stack};
use super::{built, effect};
use masonry::analysis::outcome::ElementStress;
use masonry::analysis::solve::solve;
use masonry::forms::Sparse;
use masonry::forms::reduction::Reduction;
use masonry::model::Model;
use masonry::scene::{Joint, Material, Movement, Route, Scene, Stage};
use masonry::system::System;

/// Bytes of a dense matrix of this order.
fn square(order: usize) -> u64 {
    (order * order * size_of::<f64>()) as u64
}

fn solving(scene: &Scene) -> AllocationInfo {
    measure(|| {
        solve(scene).unwrap();
    })
}

/// `A` alone, let alone the matrices that pivots work on, would not fit into what sparse routes take.
#[test]
fn sparse_routes_form_no_dense_matrix() {
    let scene = long_wall(400);
    let (plan, _, system) = built(&scene, Route::Interior);
    let order_of_a = system.rows.len() - plan.rigid_modes;
    for route in [Route::Interior, Route::Qp] {
        let taken = solving(&scene.clone().route(route));
        assert!(taken.bytes_max < square(order_of_a), "{route:?}: {taken:?}");
    }
    let taken = measure(|| {
        let system = System::without_factors(&Model::from_scene(&scene).unwrap()).unwrap();
        Sparse::new(&system).unwrap();
    });
    assert!(20 * taken.bytes_max < square(order_of_a), "{taken:?}");
}

/// The reduction of rigid blocks in dry joints holds `R`, not `A`.
#[test]
fn rigid_blocks_have_no_compliance_matrix() {
    let reducing = |material| {
        let (plan, _, system) = built(&boxed(material, Joint::mu(0.6)), Route::Lemke);
        let reduce = || drop(Reduction::new(&system, None).unwrap());
        // What products of matrices keep for the thread is no part of it.
        reduce();
        (measure(reduce), square(system.rows.len() - plan.rigid_modes))
    };
    let ((rigid, a), (elastic, _)) = (reducing(Material::rigid()), reducing(elastic()));
    assert!(elastic.bytes_max > rigid.bytes_max + 3 * a, "{a}: {rigid:?} {elastic:?}");
}

/// What is recovered is one record for every element, and nothing where no output shows it.
#[test]
fn stresses_take_their_list() {
    for route in ROUTES {
        let scene = stack(elastic(), Joint::mu(0.6)).route(route);
        let with = solving(&scene).bytes_total;
        let without = solving(&scene.clone().stresses(false)).bytes_total;
        let (_, model, _) = built(&scene, route);
        let meshes = model.blocks.iter().filter_map(|block| block.mesh.as_ref());
        let elements: usize = meshes.map(|mesh| mesh.elements.len()).sum();
        let list = (elements * size_of::<ElementStress>()) as u64;
        assert!(with >= without + list, "{route:?}: {with} and {without}");
    }
}

/// A stage of one step, and a support that moves in it, are numbers in what is there anyway. Where the way
/// matters, a second step takes a solve more.
#[test]
fn one_step_remembers_nothing() {
    for route in ROUTES {
        let scene = boxed(elastic(), Joint::mu(0.6)).route(route);
        let staged = |moves: f64| {
            let stage = Stage::new("all").load("top", 1.0);
            scene.clone().stage(stage.moves("floor", Movement::by(0.0, moves)))
        };
        solving(&scene);
        let two = staged(0.0).stage(Stage::new("wait"));
        assert!(effect(&built(&two, route).0, "load history").on);
        let [plain, one, moved, two] = [&scene, &staged(0.0), &staged(1e-6), &two].map(solving);
        let more = |taken: AllocationInfo| taken.bytes_max as f64 / plain.bytes_max as f64;
        assert!(more(one) < 1.02 && more(moved) < 1.02, "{route:?}: {plain:?} {one:?} {moved:?}");
        assert!(two.count_total > one.count_total, "{route:?}");
    }
}
