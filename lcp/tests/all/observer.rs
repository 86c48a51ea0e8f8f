//! What all methods have in common: names, settings, and an observer of their iterations.

use std::ops::ControlFlow;

use faer::mat;
#[cfg(feature = "clarabel")]
use lcp::qp::SoftConstraints;
use lcp::{
    Auto, BoxedLcp, Contact2d, Error, Friction2d, HorizontalLcp, InteriorPoint, Iteration, Lcp,
    Lemke, Method, MixedLcp, ProjectedGaussSeidel, SemismoothNewton, Solver, Status, Step,
    StepKind,
};
use lcp::{QuadraticProgram, QuadraticProgramSettings};
use lcp_problems::families;

/// Symmetric positive definite, so that all methods treat it, and none of them needs no iteration.
fn standard() -> Lcp {
    families::obstacle(6).problem
}

/// A body of weight 2 on a plane, pushed by 1.4 against a spring.
fn contact() -> Contact2d {
    Contact2d::new(
        mat![[3.0, 0.0], [0.0, 4.0]],
        vec![-2.0, 1.4],
        mat![[1.0, 0.0]],
        mat![[0.0, 1.0]],
        vec![0.0],
        vec![0.0],
        vec![0.5],
    )
    .unwrap()
}

fn mixed() -> MixedLcp {
    let m = mat![[2.0, -1.0, -1.0], [1.0, 1.0, 0.0], [1.0, 0.0, 1.0]];
    MixedLcp::new(m, vec![-2.0, -3.0, 3.0], vec![true, false, false]).unwrap()
}

fn boxed() -> BoxedLcp {
    let m = mat![[2.0, 1.0], [1.0, 2.0]];
    BoxedLcp::new(m, vec![-9.0, 2.0], vec![-1.0, -1.0], vec![3.0, f64::INFINITY]).unwrap()
}

fn friction() -> Friction2d {
    Friction2d::new(mat![[2.0, 0.0], [0.0, 1.0]], vec![-2.0, -0.25], vec![0.5]).unwrap()
}

/// The observer sees the iterations one by one, changes nothing, and may end the solve at the first.
fn check<P>(solver: &dyn Solver<P>, problem: &P) {
    let name = solver.method();
    let plain = solver.solve(problem).unwrap();
    let mut seen: Vec<Iteration> = Vec::new();
    let observed = solver.solve_observed(problem, &mut |at| {
        seen.push(*at);
        ControlFlow::Continue(())
    });
    let observed = observed.unwrap();
    assert!(plain.is_solved() && observed.is_solved(), "{name}: {}", plain.status);
    assert_eq!((&plain.t, &plain.y), (&observed.t, &observed.y), "{name}");
    assert_eq!(seen.first().map(|at| at.iteration), Some(0), "{name}");
    assert!(seen.iter().all(|at| at.residual.is_finite()), "{name}: {seen:?}");
    assert!(
        seen.windows(2).all(|two| two[1].iteration == two[0].iteration + 1),
        "{name}: {seen:?}"
    );
    let mut calls = 0;
    let stopped = solver.solve_observed(problem, &mut |_| {
        calls += 1;
        ControlFlow::Break(())
    });
    let stopped = stopped.unwrap();
    assert_eq!((stopped.status, calls), (Status::Cancelled, 1), "{name}");
    let source = observed.info.runs.last().map_or(name, |run| run.method);
    assert_eq!(observed.info.method, source);
    assert!(seen.iter().any(|at| at.method == source), "{name}: {seen:?}");
    for pair in seen.windows(2).filter(|pair| pair[1].method == Method::Interior) {
        if let Some(step) = pair[1].step {
            assert!(step.length > 0.0 && step.length <= 1.0, "{name}: {step:?}");
            let before = pair[0].step.map_or(f64::INFINITY, |step| step.mean_product);
            assert!(step.kind == StepKind::Turn || step.mean_product < before, "{name}: {seen:?}");
        }
    }
}

fn check_all<P>(solvers: &[&dyn Solver<P>], problem: &P) {
    for solver in solvers {
        check(*solver, problem);
    }
}

#[test]
fn every_method_lets_itself_be_watched_on_all_that_it_treats() {
    let lcp = standard();
    let general: HorizontalLcp = lcp.clone().into();
    let (lemke, pgs) = (Lemke::default(), ProjectedGaussSeidel::default());
    let (newton, interior) = (SemismoothNewton::default(), InteriorPoint::default());
    let auto = Auto::default();
    check_all::<Lcp>(&[&lemke, &pgs, &newton, &interior, &auto], &lcp);
    check_all::<HorizontalLcp>(&[&lemke, &pgs, &newton, &interior, &auto], &general);
    check_all::<Contact2d>(&[&lemke, &pgs, &interior, &auto], &contact());
    check_all::<Friction2d>(&[&lemke, &pgs, &interior, &auto], &friction());
    check_all::<MixedLcp>(&[&interior, &auto], &mixed());
    check_all::<BoxedLcp>(&[&pgs, &auto], &boxed());
}

/// A log of the path to a contact problem's solution: what every step was, and how far it went.
#[test]
fn interior_points_tell_their_steps() {
    let mut log: Vec<Step> = Vec::new();
    let solution = InteriorPoint::default().solve_observed(&contact(), &mut |at| {
        log.extend(at.step);
        ControlFlow::Continue(())
    });
    let solution = solution.unwrap();
    assert_eq!(log.len(), solution.info.iterations);
    assert!(log.iter().all(|step| step.kind == StepKind::Corrected), "{log:?}");
    let products: Vec<f64> = log.iter().map(|step| step.mean_product).collect();
    assert!(products.is_sorted_by(|a, b| a > b), "{products:?}");
}

#[cfg(feature = "clarabel")]
#[test]
fn programs_let_themselves_be_watched() {
    let program = QuadraticProgram::default();
    check(&program, &standard());
    check(&program, &HorizontalLcp::from(standard()));
    check(&program, &mixed());
    check(&program, &contact());
    let soft = Some(SoftConstraints::default());
    check(
        &QuadraticProgram::new(QuadraticProgramSettings { soft, ..Default::default() }),
        &contact(),
    );
}

/// On the path of Lemke's method the artificial variable stands for the residual.
#[test]
fn pivots_show_the_artificial_variable() {
    let problem: HorizontalLcp = families::positive_definite(30, 1).problem.into();
    let mut seen = Vec::new();
    let solution =
        Solver::<HorizontalLcp>::solve_observed(&Lemke::default(), &problem, &mut |at| {
            seen.push((at.iteration, at.residual));
            ControlFlow::Continue(())
        });
    let pivots = solution.unwrap().info.pivots;
    assert_eq!(seen.len(), pivots);
    assert_eq!(seen[..2], [(0, 1.0), (1, 1.0)]);
    // It falls all the way where the matrix is positive definite.
    assert!(seen[1..].windows(2).all(|two| two[1].1 < two[0].1), "{seen:?}");
}

/// A cancelled method is the last one of the chain, and every method counts from zero.
#[test]
fn auto_hands_the_observer_from_method_to_method() {
    // No solution: one method stalls, the next one has the proof.
    let problem = Lcp::new(mat![[1.0, -1.0], [-1.0, 1.0]], vec![-1.0, -1.0]).unwrap();
    let mut starts = 0;
    let solution = Auto::default().solve_observed(&problem, &mut |at| {
        starts += usize::from(at.iteration == 0);
        ControlFlow::Continue(())
    });
    let solution = solution.unwrap();
    assert_eq!((solution.status, solution.info.runs.len()), (Status::Infeasible, 2));
    assert!(starts >= 2);
    let mut starts = 0;
    let stopped = Auto::default().solve_observed(&problem, &mut |at| {
        starts += usize::from(at.iteration == 0);
        if starts < 2 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    });
    let stopped = stopped.unwrap();
    assert_eq!((stopped.status, stopped.info.runs.len()), (Status::Cancelled, 2));
}

#[test]
fn names_are_short_and_read_well_in_messages() {
    let message = |method| Error::NotTreated { method, reason: "why".to_owned() }.to_string();
    let expected = [
        (Method::Auto, "auto", "the automatic choice"),
        (Method::Lemke, "lemke", "Lemke's method"),
        (Method::Newton, "newton", "semismooth Newton"),
        (Method::Interior, "interior", "the interior-point method"),
        (Method::QuadraticProgram, "qp", "quadratic programming"),
        (Method::GaussSeidel, "pgs", "projected Gauss-Seidel"),
        (Method::Enumeration, "enumeration", "enumeration"),
    ];
    for (method, short, full) in expected {
        assert_eq!((method.to_string().as_str(), short.parse()), (short, Ok(method)));
        assert_eq!(message(method), format!("{full} cannot treat this problem: why"));
    }
    assert_eq!(expected.map(|(method, ..)| method), Method::ALL);
}

#[test]
fn settings_can_be_read_back() {
    let tolerance = 1e-7;
    macro_rules! tolerance_of {
        ($solver:ty) => {{
            let mut settings = <$solver>::default().settings().clone();
            settings.tolerance = tolerance;
            <$solver>::new(settings).settings().tolerance
        }};
    }
    let read = [
        tolerance_of!(Auto),
        tolerance_of!(Lemke),
        tolerance_of!(ProjectedGaussSeidel),
        tolerance_of!(SemismoothNewton),
        tolerance_of!(InteriorPoint),
        #[cfg(feature = "clarabel")]
        tolerance_of!(QuadraticProgram),
    ];
    assert!(read.iter().all(|it| it.total_cmp(&tolerance).is_eq()), "{read:?}");
}
