//! A heavy beam on a rigid floor, lifted at one end: the length that leaves the floor and the rise of the end
//! against beam theory, on finer and finer meshes of four-node elements.
//!
//! These elements lock in shear: long ones are far too stiff in bending, by a factor that is known, and that
//! tends to one as the square of their length. What is left then is what a beam of this height differs from
//! beam theory by.

#[path = "support/beam.rs"]
mod beam;

use std::time::Instant;

use beam::{Beam, Uplift};
use masonry::analysis::solve::solve;
use masonry::scene::Route;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("l: length of the lifted part, h: height, a: length of an element; lengths and rises");
    println!("relative to beam theory, which has l = 2 P / q and the rise 2 P^4 / (3 q^3 E I)\n");
    println!(
        "l / h  a / h  rows  elements  length    rise  rise by locking  route     steps  time [s]"
    );
    for slenderness in [10, 20, 40] {
        for (elements_per_height, rows) in [(1, 1), (2, 1), (4, 1), (4, 2), (8, 1), (16, 1)] {
            for route in [Route::Qp, Route::Interior] {
                row(Beam { slenderness, elements_per_height, rows }, route)?;
            }
        }
        println!();
    }
    Ok(())
}

fn row(beam: Beam, route: Route) -> Result<(), Box<dyn std::error::Error>> {
    let began = Instant::now();
    let outcome = solve(&beam.scene(route))?;
    let Some(Uplift { length, lift }) = beam.uplift(&outcome) else {
        return Err(format!("no answer: {:?}", outcome.solve.attempts).into());
    };
    println!(
        "{:>5} {:>6.3} {:>5} {:>9} {length:>7.4} {lift:>7.4} {:>16.4}  {:<8} {:>6} {:>9.3}",
        beam.slenderness,
        beam.aspect(),
        beam.rows,
        beam.elements() * beam.rows,
        beam.locking(),
        outcome.solve.route.name(),
        outcome.solve.factorisations,
        began.elapsed().as_secs_f64(),
    );
    Ok(())
}
