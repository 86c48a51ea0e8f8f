//! Many points, thin bricks, thin films, tiny gaps.

use masonry::model::joints::PointRule;
use masonry::scene::{Films, Joint, Load, Material, Scene, Support};

use super::case::Case;
use super::common::{GRAVITY, rectangle, state};
use super::scenes::{YOUNG, elastic, pressed, reactions_off, rigid, scene, sinking_off};
use super::sweep::{Sweep, decades};

pub const TITLE: &str = "Contacts and shapes";

pub fn cases() -> Vec<Case> {
    vec![
        many_supports(50.0),
        flat(1e3),
        slender(1e3),
        thin_film(1e-6),
        beside_nodes(1e-6, Films::Compliance),
        beside_nodes(1e-6, Films::Strips),
        uneven_supports("rigid", rigid(), 1e-12),
        uneven_supports("elastic", elastic(), 1e-12),
        small_gap(1e-8),
    ]
}

pub fn sweeps() -> Vec<Sweep> {
    let uneven = |kind: &'static str, material: Material| {
        Sweep::new(
            &format!("uneven supports, {kind} block"),
            "depth of the supports / length of the block [-]",
            decades(-4, -16, 1),
            move |depth| uneven_supports(kind, material, depth),
        )
    };
    let beside = |kind: &str, films| {
        Sweep::new(
            &format!("film that ends beside a node, films as {kind}"),
            "distance from the node / length of the brick [-]",
            decades(-1, -14, 1),
            move |distance| beside_nodes(distance, films),
        )
    };
    vec![
        Sweep::new(
            "supports under one rigid block",
            "number of supports",
            [1, 2, 5, 10, 20, 50, 100, 200].map(f64::from),
            many_supports,
        ),
        Sweep::new("flat bricks", "length / height [-]", decades(0, 6, 1), flat),
        Sweep::new("slender bricks", "height / length [-]", decades(0, 6, 1), slender),
        Sweep::new(
            "thin film between bricks",
            "thickness of the film / height of the brick [-]",
            decades(-1, -13, 1),
            thin_film,
        ),
        beside("compliances", Films::Compliance),
        beside("strips", Films::Strips),
        uneven("rigid", rigid()),
        uneven("elastic", elastic()),
        Sweep::new("gap of a pier", "gap / height of the pier [-]", decades(-5, -15, 1), small_gap),
    ]
}

fn many_supports(count: f64) -> Case {
    let base = scene("Many supports", 0.6).gravity([0.3 * GRAVITY, -GRAVITY]);
    let block = rectangle("block", "stone", [0.0, 1.0], [0.0, 0.5]);
    let supported = (0..1000).map(f64::from).take_while(|k| *k < count).fold(
        base.material("stone", rigid()).block(block),
        |scene, k| {
            let [from, to] = [[k / count, 0.0], [(k + 1.0) / count, 0.0]];
            scene.support(Support::new(&format!("{k}"), from, to, "bed"))
        },
    );
    Case::new(
        "one rigid block on a hundred points",
        "Three equations of equilibrium for 200 contact forces: 197 of these are undetermined.",
        supported,
    )
    .parameters("1 x 0.5 m, 50 supports side by side, mu = 0.6, pushed by 0.3 of its weight")
    .known("the sum of the reactions is the load", reactions_off)
}

fn flat(ratio: f64) -> Case {
    column(
        "bricks a thousand times as long as high",
        "Q4 elements of this shape have stiffnesses that differ by the square of the ratio.",
        [1.0, 1.0 / ratio],
        [4, 1],
    )
}

fn slender(ratio: f64) -> Case {
    column(
        "bricks a thousand times as high as long",
        "The same; the base is a thousandth of the height.",
        [1.0 / ratio, 1.0],
        [1, 4],
    )
    // Rounding errors of the contact forces bend and turn it by the square of the ratio more than the load
    // compresses it.
    .amplified(1e-8 * ratio * ratio)
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
        .parameters(&format!("three bricks {width} x {height} m, {} x {} elements each, pressure E/1000, no weight, nu = 0, mu = 0.5", mesh[0], mesh[1]))
        .known("the top sinks by 3 h p / E", move |outcome| sinking_off(outcome, "2", sinks))
}

/// Of a thickness relative to the height of the brick.
fn thin_film(ratio: f64) -> Case {
    let thin = 0.1 * ratio;
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
    .parameters("two bricks 0.2 x 0.1 m, the lower in 2 x 1 and the upper in 3 x 1 elements, film of t_y = 1e-7 m, E equal, nu = 0, mu = 0.5, pressure E/1000, no weight")
    .known(
        "the top sinks by (2 h + t_y) p / E, and sigma_y = -p in the film",
        move |outcome| {
            let films = state(outcome).films.iter();
            let films = films.map(|film| (film.sigma_y / (-1e3 * pressure) - 1.0).abs());
            films.fold(sinking_off(outcome, "upper", sinks), f64::max)
        },
    )
}

/// Bricks in mortar whose meshes match but for an offset, relative to the length of the brick: parts of the
/// film as long as that are between a node of one brick and one of the other.
fn beside_nodes(offset: f64, films: Films) -> Case {
    let film = 0.01;
    let aside = 0.2 * offset;
    let kind = match films {
        Films::Compliance => "compliances",
        Films::Strips => "strips",
    };
    let bricks = scene("Nodes beside nodes", 0.5)
        .material("brick", Material::elastic(YOUNG, 0.15))
        .material("mortar", Material::elastic(0.1 * YOUNG, 0.2))
        .joint("bed", Joint::mu(0.5).mortar(film, "mortar"))
        .joint("floor", Joint::mu(0.5))
        .contact_points(PointRule::Gauss)
        .films(films)
        .block(rectangle("lower", "brick", [0.0, 0.2], [0.0, 0.1]).mesh([4, 2]))
        .block(
            rectangle("upper", "brick", [aside, 0.2 + aside], [0.1 + film, 0.2 + film])
                .mesh([4, 2]),
        )
        .support(Support::new("floor", [0.0, 0.0], [0.2, 0.0], "floor"));
    let top = 0.2 + film;
    let load = Load::traction("top", [aside, top], [0.2 + aside, top], [10.0, -100.0]);
    Case::new(
        &format!("a film that ends 1e-6 beside a node, {kind}"),
        "Parts of the film, from a node of one brick to the nearest node of the other, are as short as the offset.",
        bricks.load(load),
    )
    .parameters("two bricks 0.2 x 0.1 m in 4 x 2 elements, the upper one 2e-7 m to the right, film of 0.01 m, E_m = E / 10, nu_m = 0.2, contact points of Gauss, mu = 0.5, no weight, 100 kN/m2 inclined by 0.1")
    .known("the sum of the reactions is the load", reactions_off)
}

/// Supports that are lower than the block by up to three times this depth.
fn uneven_supports(kind: &str, material: Material, depth: f64) -> Case {
    let base = scene("Uneven supports", 0.6).gap_limit(1e-3).material("stone", material);
    let block = rectangle("block", "stone", [0.0, 1.0], [0.0, 0.5]).mesh([10, 2]);
    let depths = [0, 2, 1, 0, 3, 1, 0, 1, 2, 0].map(|times| f64::from(times) * depth);
    let uneven = depths.iter().zip(0_u32..).fold(base.block(block), |scene, (depth, k)| {
        let x = f64::from(k) / 10.0;
        scene.support(Support::new(&format!("{k}"), [x, -depth], [x + 0.1, -depth], "bed"))
    });
    Case::new(
        &format!("gaps of 1e-12 under a block, {kind}"),
        "The gaps are near the rounding errors of the coordinates; for a rigid block they are the only length besides its size.",
        uneven,
    )
    .parameters("1 x 0.5 m, in 10 x 2 elements if elastic, ten supports 0 to 3e-12 m below it, mu = 0.6, own weight")
    .known("the sum of the reactions is the weight", reactions_off)
}

/// Three piers under a rigid beam, the one in the middle shorter.
fn small_gap(gap: f64) -> Case {
    let load = 30.0;
    let piers = [("left", 0.0, 1.0), ("middle", 0.4, 1.0 - gap), ("right", 0.8, 1.0)];
    let base = scene("Piers", 0.5)
        .gap_limit(1e-4)
        .material("pier", Material::elastic(YOUNG, 0.0))
        .material("beam", Material::rigid())
        .support(Support::new("floor", [0.0, 0.0], [1.0, 0.0], "bed"))
        .block(rectangle("beam", "beam", [0.0, 1.0], [1.0, 1.2]))
        .load(Load::pressure("top", [0.0, 1.2], [1.0, 1.2], load));
    let on_piers = piers.iter().fold(base, |scene: Scene, (name, x, top)| {
        scene.block(rectangle(name, "pier", [*x, x + 0.2], [0.0, *top]).mesh([2, 2]))
    });
    Case::new("a gap of 1e-8 of a pier", "The gap closes at a thousandth of the load.", on_piers)
        .parameters("three piers 0.2 x 1 m, the middle one 1e-8 m shorter, rigid beam 1 x 0.2 m, 30 kN, nu = 0, mu = 0.5, no weight")
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
