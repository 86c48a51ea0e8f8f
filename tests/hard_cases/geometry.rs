//! Many points, thin bricks, thin films, tiny gaps.

use masonry::scene::{Joint, Load, Material, Scene, Support};

use super::case::Case;
use super::common::{GRAVITY, rectangle, state};
use super::scenes::{YOUNG, elastic, pressed, reactions_off, rigid, scene, sinking_off};

pub const TITLE: &str = "Contacts and shapes";

pub fn cases() -> Vec<Case> {
    vec![
        many_supports(),
        column(
            "bricks a thousand times as long as high",
            "Q4 elements of this shape have stiffnesses that differ by the square of the ratio.",
            [1.0, 1e-3],
            [4, 1],
        ),
        column(
            "bricks a thousand times as high as long",
            "The same, and the base is a thousandth of the height.",
            [1e-3, 1.0],
            [1, 4],
        ),
        thin_film(),
        uneven_supports("rigid", rigid()),
        uneven_supports("elastic", elastic()),
        small_gap(),
    ]
}

fn many_supports() -> Case {
    let base = scene("Many supports", 0.6).gravity([0.3 * GRAVITY, -GRAVITY]);
    let block = rectangle("block", "stone", [0.0, 1.0], [0.0, 0.5]);
    let supported =
        (0..50).map(f64::from).fold(base.material("stone", rigid()).block(block), |scene, k| {
            let [from, to] = [[k / 50.0, 0.0], [(k + 1.0) / 50.0, 0.0]];
            scene.support(Support::new(&format!("{k}"), from, to, "bed"))
        });
    Case::new(
        "one rigid block on a hundred points",
        "Three equations of equilibrium for 200 contact forces: 197 of these are free.",
        supported,
    )
    .parameters("1 x 0.5 m, 50 supports side by side, mu = 0.6, pushed by 0.3 of its weight")
    .known("the sum of the reactions is the load", reactions_off)
}

/// Three bricks on top of each other without weight and Poisson's ratio, pressed by a thousandth of their
/// modulus.
fn column(name: &str, why: &'static str, [width, height]: [f64; 2], mesh: [u32; 2]) -> Case {
    let base = scene("Column", 0.5).material("stone", Material::elastic(YOUNG, 0.0));
    let floor = Support::new("floor", [0.0, 0.0], [width, 0.0], "bed");
    let bricks = (0..3).map(f64::from).fold(base.support(floor), |scene, k| {
        let y = [height * k, height * (k + 1.0)];
        scene.block(rectangle(&format!("{k}"), "stone", [0.0, width], y).mesh(mesh))
    });
    let sinks = 3.0 * height * 1e-3;
    Case::new(name, why, pressed(bricks, width, 3.0 * height, 1e-3 * YOUNG))
        .parameters(&format!("three bricks {width} x {height} m, pressure E/1000, nu = 0"))
        .known("the top sinks by 3 h p / E", move |outcome| sinking_off(outcome, "2", sinks))
}

fn thin_film() -> Case {
    let thin = 1e-7;
    let pressure = 1e-3 * YOUNG;
    let bricks = scene("Thin film", 0.5)
        .material("brick", Material::elastic(YOUNG, 0.0))
        .joint("bed", Joint::mu(0.5).mortar(thin, "brick"))
        .joint("floor", Joint::mu(0.5))
        .block(rectangle("lower", "brick", [0.0, 0.2], [0.0, 0.1]).mesh([2, 1]))
        .block(rectangle("upper", "brick", [0.0, 0.2], [0.1 + thin, 0.2 + thin]).mesh([3, 1]))
        .support(Support::new("floor", [0.0, 0.0], [0.2, 0.0], "floor"));
    let sinks = (0.2 + thin) * 1e-3;
    Case::new(
        "a film of a millionth of the brick",
        "The film is a million times as stiff as the bricks that it joins.",
        pressed(bricks, 0.2, 0.2 + thin, pressure),
    )
    .parameters("two bricks 0.2 x 0.1 m, meshes that do not match, t_y = 1e-7 m, E equal, nu = 0")
    .known(
        "the top sinks by (2 h + t_y) p / E, and sigma_y = -p in the film",
        move |outcome| {
            let films = state(outcome).films.iter();
            let films = films.map(|film| (film.sigma_y / (-1e3 * pressure) - 1.0).abs());
            films.fold(sinking_off(outcome, "upper", sinks), f64::max)
        },
    )
}

/// Supports that are lower than the block by up to 1e-12 of it.
fn uneven_supports(kind: &str, material: Material) -> Case {
    let base = scene("Uneven supports", 0.6).material("stone", material);
    let block = rectangle("block", "stone", [0.0, 1.0], [0.0, 0.5]).mesh([10, 2]);
    let depths = [0.0, 2e-12, 1e-12, 0.0, 3e-12, 1e-12, 0.0, 1e-12, 2e-12, 0.0];
    let uneven = depths.iter().zip(0_u32..).fold(base.block(block), |scene, (depth, k)| {
        let x = f64::from(k) / 10.0;
        scene.support(Support::new(&format!("{k}"), [x, -depth], [x + 0.1, -depth], "bed"))
    });
    Case::new(
        &format!("gaps of 1e-12 under a block, {kind}"),
        "The gaps are near the rounding errors of the coordinates; of a rigid block they are the only length but its \
         own.",
        uneven,
    )
    .parameters("1 x 0.5 m, ten supports 0 to 3e-12 m below it, own weight")
    .known("the sum of the reactions is the weight", reactions_off)
}

/// Three piers under a rigid beam, the one in the middle shorter.
fn small_gap() -> Case {
    let (gap, load) = (1e-8, 30.0);
    let piers = [("left", 0.0, 1.0), ("middle", 0.4, 1.0 - gap), ("right", 0.8, 1.0)];
    let base = scene("Piers", 0.5)
        .gap_limit(1e-6)
        .material("pier", Material::elastic(YOUNG, 0.0))
        .material("beam", Material::rigid())
        .support(Support::new("floor", [0.0, 0.0], [1.0, 0.0], "bed"))
        .block(rectangle("beam", "beam", [0.0, 1.0], [1.0, 1.2]))
        .load(Load::pressure("top", [0.0, 1.2], [1.0, 1.2], load));
    let on_piers = piers.iter().fold(base, |scene: Scene, (name, x, top)| {
        scene.block(rectangle(name, "pier", [*x, x + 0.2], [0.0, *top]).mesh([2, 2]))
    });
    Case::new("a gap of 1e-8 of a pier", "The gap closes at a thousandth of the load.", on_piers)
        .parameters("three piers 0.2 x 1 m, the middle one 1e-8 m shorter, rigid beam, 30 kN, E = 1e6 kN/m2, mu = 0.5")
        .known("piers carry k (delta - gap) with 3 k delta = P + k gap", move |outcome| {
            let stiffness = 0.2 * YOUNG / (1.0 - gap);
            let outer = 0.2 * YOUNG;
            let sinks = (load + stiffness * gap) / (2.0 * outer + stiffness);
            let off = |name: &str, force: f64| {
                let pier = super::common::block_named(&outcome.model, name);
                let floor = masonry::model::Body::Support(masonry::ids::SupportId(0));
                let found = super::common::joint_resultant(outcome, floor, pier).y;
                (found / (1e3 * force) - 1.0).abs()
            };
            let outer = off("left", outer * sinks).max(off("right", outer * sinks));
            outer.max(off("middle", stiffness * (sinks - gap)))
        })
}
