//! Logs tipped into a box: rigid discs with Coulomb friction in time steps, with the crate `lcp` alone.
//!
//! In a step of length `h` the velocities `u` at its end and the contact forces obey (Stewart and
//! Trinkle 1996)
//!
//! ```text
//! M/h (u - v) = weights + C_n^T t_n + C_t^T t_t,    0 <= t_n  _|_  gap/h + C_n u >= 0,
//! ```
//!
//! with friction against the slip `C_t u`. That is a [`Contact2d`] with `K = M/h`, the loads
//! `M v/h + weights` and `x_0 = gap/h`. Impacts need no rule of their own: they are inelastic. The gap of
//! two discs is a convex function of their motion, so that the linear one of the problem is on the safe
//! side, and nothing penetrates. Forces between rigid bodies are not unique; each solver has its own.
//!
//! Prints the steps and a check, and draws the pile into `target/contact_reuse/`.

#[path = "support/pile_svg.rs"]
mod pile_svg;

use std::error::Error;
use std::f64::consts::PI;
use std::path::Path;

use lcp::{Auto, Contact2d, ContactPoint, ContactState, Matrix, Solution, Solver};
use pile_svg::{Circle, Force, Frame};

const DISCS: usize = 48;
/// Floor `y = 0`, walls `x = 0` and `x = WIDTH` \[m\].
const WIDTH: f64 = 1.7;
/// Density of the wood \[kg/m^3\]; the logs are a metre long.
const DENSITY: f64 = 600.0;
const GRAVITY: f64 = 9.81;
const FRICTION: f64 = 0.4;
/// Step \[s\].
const STEP: f64 = 0.01;
/// What a step may leave of the loads.
const ENOUGH: f64 = 1e-8;

fn main() -> Result<(), Box<dyn Error>> {
    // Any other solver of the library for contact problems may stand here.
    let solver: &dyn Solver<Contact2d> = &Auto::default();
    let mut discs = tipped();
    let mut frames = Vec::new();
    println!("time/s  contacts: open stick slip  residual  kinetic/J  solver");
    for number in 1..=1000 {
        let step = Step::new(&discs, solver)?;
        let change = step.advance(&mut discs);
        let time = STEP * f64::from(number);
        let rests = change < 1e-6 * GRAVITY * STEP && discs.iter().all(|disc| disc.speed() < 0.01);
        if number % 10 == 0 || rests {
            step.print(time, &discs);
        }
        if [50, 80].contains(&number) || rests {
            frames.push(Frame { time, circles: circles(&discs), forces: step.forces(&discs) });
        }
        if rests {
            step.check(&discs);
            return draw(&frames);
        }
    }
    Err("the pile does not come to rest".into())
}

struct Disc {
    radius: f64,
    center: [f64; 2],
    angle: f64,
    /// Of the center and of the rotation \[m/s, rad/s\].
    velocity: [f64; 3],
}

impl Disc {
    /// The diagonal of the mass matrix.
    fn masses(&self) -> [f64; 3] {
        let mass = DENSITY * PI * self.radius.powi(2);
        [mass, mass, 0.5 * mass * self.radius.powi(2)]
    }

    fn weight(&self) -> f64 {
        self.masses()[0] * GRAVITY
    }

    fn speed(&self) -> f64 {
        self.velocity[0].hypot(self.velocity[1])
    }

    fn kinetic_energy(&self) -> f64 {
        self.masses().iter().zip(self.velocity).map(|(m, v)| 0.5 * m * v * v).sum()
    }
}

/// Discs of many sizes in four columns above the left part of the floor.
fn tipped() -> Vec<Disc> {
    let scattered = |k: usize| (k as f64 * 0.618_033_988_749_895).fract();
    let disc = |k: usize| {
        let (row, column) = ((k / 4) as f64, (k % 4) as f64);
        let center = [0.13 + 0.24 * column + 0.02 * scattered(7 * k), 0.3 + 0.24 * row];
        Disc { radius: 0.05 + 0.06 * scattered(k), center, angle: 0.0, velocity: [0.0; 3] }
    };
    (0..DISCS).map(disc).collect()
}

/// A disc close to another one, or to the floor or a wall.
struct Contact {
    disc: usize,
    other: Option<usize>,
    /// Unit vector towards the disc.
    normal: [f64; 2],
    gap: f64,
}

impl Contact {
    fn tangent(&self) -> [f64; 2] {
        [-self.normal[1], self.normal[0]]
    }
}

/// All contacts that may close within a step.
fn contacts(discs: &[Disc]) -> Vec<Contact> {
    let fastest = discs.iter().map(Disc::speed).fold(0.0, f64::max);
    let reach = 2.0 * STEP * (fastest + STEP * GRAVITY);
    let mut contacts = Vec::new();
    for (i, disc) in discs.iter().enumerate() {
        let [x, y] = disc.center;
        let sides = [([0.0, 1.0], y), ([1.0, 0.0], x), ([-1.0, 0.0], WIDTH - x)];
        for (normal, distance) in sides {
            contacts.push(Contact { disc: i, other: None, normal, gap: distance - disc.radius });
        }
        for (j, other) in discs.iter().enumerate().take(i) {
            let [dx, dy] = [x - other.center[0], y - other.center[1]];
            let distance = dx.hypot(dy);
            let normal = [dx / distance, dy / distance];
            let gap = distance - disc.radius - other.radius;
            contacts.push(Contact { disc: i, other: Some(j), normal, gap });
        }
    }
    contacts.retain(|contact| contact.gap <= reach);
    contacts
}

/// The problem of one step.
fn velocity_problem(discs: &[Disc], contacts: &[Contact]) -> Result<Contact2d, lcp::Error> {
    let (mut masses, mut loads) = (Vec::new(), Vec::new());
    for disc in discs {
        let weight = [0.0, -disc.weight(), 0.0];
        for ((mass, v), weight) in disc.masses().into_iter().zip(disc.velocity).zip(weight) {
            masses.push((loads.len(), loads.len(), mass / STEP));
            loads.push(mass * v / STEP + weight);
        }
    }
    let k = Matrix::from_triplets(loads.len(), loads.len(), &masses)?;
    let mut builder = Contact2d::builder(k, loads);
    for contact in contacts {
        let ([n_x, n_y], [t_x, t_y]) = (contact.normal, contact.tangent());
        let (mut normal, mut tangent) = (Vec::new(), Vec::new());
        let sides = [(Some(contact.disc), 1.0), (contact.other, -1.0)];
        for (disc, sign) in sides.into_iter().filter_map(|(disc, sign)| Some((disc?, sign))) {
            let [x, y, rotation] = [0, 1, 2].map(|part| 3 * disc + part);
            normal.extend([(x, sign * n_x), (y, sign * n_y)]);
            tangent.extend([(x, sign * t_x), (y, sign * t_y), (rotation, -discs[disc].radius)]);
        }
        let gap = contact.gap.max(0.0) / STEP;
        builder.add_point(ContactPoint {
            normal: &normal,
            tangent: &tangent,
            gap,
            mu: FRICTION,
            ..Default::default()
        });
    }
    builder.build()
}

/// A solved step.
struct Step {
    contacts: Vec<Contact>,
    solution: Solution<Contact2d>,
    state: ContactState,
}

impl Step {
    fn new(discs: &[Disc], solver: &dyn Solver<Contact2d>) -> Result<Self, Box<dyn Error>> {
        let contacts = contacts(discs);
        let problem = velocity_problem(discs, &contacts)?;
        let solution = solver.solve(&problem)?;
        // Of logs that come to rest nothing is left but rounding errors, in which no contact can be told to the last
        // digit. What is left of the loads decides.
        if solution.residuals.loads > ENOUGH {
            return Err(format!("{}: {}", solver.method(), solution.status).into());
        }
        let state = problem.variables(&solution);
        Ok(Self { contacts, solution, state })
    }

    /// Moves the discs; the largest change of a velocity.
    fn advance(&self, discs: &mut [Disc]) -> f64 {
        let mut change = 0.0_f64;
        for (disc, u) in discs.iter_mut().zip(self.state.u.chunks_exact(3)) {
            change = change.max((u[0] - disc.velocity[0]).hypot(u[1] - disc.velocity[1]));
            disc.velocity.copy_from_slice(u);
            disc.center[0] += STEP * u[0];
            disc.center[1] += STEP * u[1];
            disc.angle += STEP * u[2];
        }
        change
    }

    /// The forces that are not negligible beside the weight of a disc.
    fn forces(&self, discs: &[Disc]) -> Vec<Force> {
        let lightest = discs.iter().map(Disc::weight).fold(f64::INFINITY, f64::min);
        let all = self.contacts.iter().zip(&self.state.t_n).zip(&self.state.slip);
        let forces = all.filter(|((_, normal), _)| **normal > 1e-6 * lightest);
        forces
            .map(|((contact, &normal), slip)| {
                let (from, [n_x, n_y]) = (&discs[contact.disc], contact.normal);
                let at_surface = [0, 1].map(|k| from.center[k] - from.radius * [n_x, n_y][k]);
                let to = contact.other.map_or(at_surface, |other| discs[other].center);
                let (from, is_slipping) = (from.center, slip.abs() > 1e-6);
                Force { from, to, point: at_surface, normal, is_slipping }
            })
            .collect()
    }

    fn print(&self, time: f64, discs: &[Disc]) {
        let forces = self.forces(discs);
        let slipping = forces.iter().filter(|force| force.is_slipping).count();
        let (open, sticking) = (self.contacts.len() - forces.len(), forces.len() - slipping);
        let energy: f64 = discs.iter().map(Disc::kinetic_energy).sum();
        let (worst, solver) = (self.solution.residuals.worst(), self.solution.info.method);
        print!("{time:6.2} {open:15} {sticking:5} {slipping:4}");
        println!(" {worst:9.1e} {energy:10.2e}   {solver}");
    }

    /// What a user wants to be sure of.
    fn check(&self, discs: &[Disc]) {
        let penetration = contacts(discs).iter().map(|contact| -contact.gap).fold(0.0, f64::max);
        let (mut floor, mut walls, mut outside) = (0.0, 0.0, 0.0_f64);
        for (i, contact) in self.contacts.iter().enumerate() {
            let (t_n, t_t) = (self.state.t_n[i], self.state.t_t[i]);
            outside = outside.max((t_t.abs() - FRICTION * t_n) / discs[contact.disc].weight());
            let upward = contact.normal[1] * t_n + contact.tangent()[1] * t_t;
            match contact.other {
                None if contact.normal[1] > 0.0 => floor += upward,
                None => walls += upward,
                Some(_) => {}
            }
        }
        let weight: f64 = discs.iter().map(Disc::weight).sum();
        println!("largest penetration {penetration:.1e} m");
        println!("floor {floor:.3} N + friction of the walls {walls:.3} N, weight {weight:.3} N");
        println!("beyond the friction cone {outside:.1e} of the weight of a disc");
    }
}

fn circles(discs: &[Disc]) -> Vec<Circle> {
    let circle =
        |disc: &Disc| Circle { center: disc.center, radius: disc.radius, angle: disc.angle };
    discs.iter().map(circle).collect()
}

fn draw(frames: &[Frame]) -> Result<(), Box<dyn Error>> {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
    std::fs::create_dir_all(root.join("target/contact_reuse"))?;
    for (name, frames) in [("pile", &frames[frames.len() - 1..]), ("frames", frames)] {
        let file = Path::new("target/contact_reuse").join(name).with_extension("svg");
        std::fs::write(root.join(&file), pile_svg::picture(frames, WIDTH))?;
        println!("wrote {}", file.display());
    }
    Ok(())
}
