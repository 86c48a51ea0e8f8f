//! Results in files: what is written is read back as it was.

use lcp::faer::mat;
use lcp::lemke::{Parametric, ParametricPath};
use lcp::pgs::{Constraint, RowsSolution};
use lcp::qp::SoftConstraints;
use lcp::refine::{ContactStatus, Margin, Refinement};
use lcp::{
    Auto, AutoSettings, Basis, BoxedLcp, Choice, Contact2d, ContactForces, ContactPoint,
    ContactState, Covering, ErrorBound, EvolutionSettings, Friction2d, HorizontalLcp,
    InteriorPointSettings, Lcp, Lemke, LemkeSettings, Method, MixedLcp,
    ProjectedGaussSeidelSettings, Qp, QuadraticProgram, QuadraticProgramSettings, Residuals,
    SemismoothNewtonSettings, Side, Solution, Solver, Status, WarmStart,
};
use lcp_problems::families;
use lcp_problems::io::{read, to_json};
use serde_json::{from_str, to_string};

/// As text and back; the text of what came back is the same.
macro_rules! assert_comes_back {
    ($type:ty, $value:expr) => {{
        let value: $type = $value;
        let text = to_string(&value).unwrap();
        let again: $type = from_str(&text).unwrap_or_else(|error| panic!("{text}: {error}"));
        assert_eq!(again, value, "{text}");
        assert_eq!(to_string(&again).unwrap(), text);
        text
    }};
}

fn contact() -> Contact2d {
    let mut builder = Contact2d::builder(mat![[3.0, 0.0], [0.0, 0.0]], vec![0.4, -2.0]);
    builder.add_point(ContactPoint {
        normal: &[(1, 1.0)],
        tangent: &[(0, 1.0)],
        mu: 0.5,
        ..Default::default()
    });
    builder.build().unwrap()
}

/// Problems come back with the same answers, as files do, and what is no problem is refused as if it were made by hand.
#[test]
fn problems_of_every_kind() {
    macro_rules! assert_same_answer {
        ($kind:expr, $type:ty, $problem:expr) => {{
            let problem: $type = $problem;
            let text = to_string(&problem).unwrap();
            let file = text.replacen('{', &format!(r#"{{"kind":"{}","#, $kind), 1);
            assert_eq!(to_json(&read(file.as_bytes(), None).unwrap().problem), file);
            let again: $type = from_str(&text).unwrap_or_else(|error| panic!("{text}: {error}"));
            assert_eq!(to_string(&again).unwrap(), text);
            let [first, second] = [&problem, &again].map(|it| Auto::default().solve(it).unwrap());
            assert!(first.is_solved() && (first.t, first.y) == (second.t, second.y), "{text}");
        }};
    }
    let lcp = families::positive_definite(6, 3).problem;
    assert_same_answer!("lcp", Lcp, lcp);
    assert_same_answer!("lcp", Lcp, families::obstacle(4).problem);
    assert_same_answer!("horizontal", HorizontalLcp, families::horizontal_monotone(6, 3).problem);
    assert_same_answer!("mixed", MixedLcp, families::mixed_monotone(6, 3).problem);
    assert_same_answer!("boxed", BoxedLcp, families::control(3, 3).problem);
    assert_same_answer!("contact", Contact2d, contact());
    assert_same_answer!("contact", Contact2d, contact().with_compliance(vec![[0.1, 0.2]]).unwrap());
    let friction = Friction2d::new(mat![[2.0, 0.0], [0.0, 1.0]], vec![-2.0, -0.25], vec![0.5]);
    assert_same_answer!("friction", Friction2d, friction.unwrap());
    let program = Qp::new([[2.0]], [-4.0], [[1.0]], [f64::NEG_INFINITY], [3.0]).unwrap();
    let program = program.with_bounds([0.0], [1.0]).unwrap().with_constant(2.0).unwrap();
    let text = to_string(&program).unwrap();
    assert_eq!(to_string(&from_str::<Qp>(&text).unwrap()).unwrap(), text);
    let wrong = text.replace(r#""p":[[2.0]]"#, r#""p":[[-2.0]]"#);
    let error = from_str::<Qp>(&wrong).unwrap_err().to_string();
    assert!(error.contains("semidefinite"), "{error}");
    let open = r#"{"p":[[2.0]],"a":[],"q":[-4.0],"l":[],"u":[]}"#;
    assert_eq!(from_str::<Qp>(open).unwrap().bounds(), [[f64::NEG_INFINITY], [f64::INFINITY]]);
    // Of a matrix that does not fit nothing is allocated.
    for matrix in [
        r#"{"rows":1,"cols":1000000000000000,"triplets":[]}"#,
        r#"{"rows":1,"cols":1,"triplets":[[0,1,2.0]]}"#,
        "[[1.0,2.0]]",
        "[[1.0],[2.0]]",
    ] {
        let text = format!(r#"{{"m":{matrix},"q":[1.0]}}"#);
        assert!(from_str::<Lcp>(&text).is_err(), "{text}");
    }
}

#[test]
fn answers_of_every_end() {
    let settings = LemkeSettings { trace: true, ..Default::default() };
    let lemke = Lemke::new(settings);
    let solved = lemke.solve(&families::positive_definite(6, 1).problem).unwrap();
    let text = assert_comes_back!(Solution<Lcp>, solved);
    assert!(text.contains(r#""solver":"lemke""#), "{text}");
    let infeasible = lemke.solve(&families::kostreva_2().problem).unwrap();
    assert_eq!(infeasible.status, Status::Infeasible);
    assert_comes_back!(Solution<Lcp>, infeasible);
    assert_comes_back!(Solution<Contact2d>, Auto::default().solve(&contact()).unwrap());
    // Pushed up, with a chain of methods and their evidence.
    let falls = Lcp::new([[1.0, -1.0], [-1.0, 1.0]], vec![-1.0, -1.0]).unwrap();
    let solution = Auto::default().solve(&falls).unwrap();
    assert!(solution.info.runs.len() > 1);
    assert_comes_back!(Solution<Lcp>, solution);
}

#[test]
fn residuals_that_are_infinite() {
    let inf = f64::INFINITY;
    let [equation, feasibility, complementarity, natural, loads] = [inf, 0.0, 1e-300, inf, 1.0];
    assert_comes_back!(
        Residuals,
        Residuals { equation, feasibility, complementarity, natural, loads }
    );
    let mut solution = Lemke::default().solve(&families::fathi(3).problem).unwrap();
    solution.info.history = vec![inf, 1.0];
    assert_comes_back!(Solution<Lcp>, solution);
    assert_comes_back!(Constraint, Constraint::Bounds { lower: -inf, upper: inf });
    assert_comes_back!(Margin, Margin { least: inf, contact: None });
}

#[test]
fn parts_of_answers_and_of_settings() {
    let problem = contact();
    let solution = Lemke::default().solve(&problem).unwrap();
    assert_comes_back!(ContactState, problem.variables(&solution));
    let friction = Friction2d::new([[2.0, 0.0], [0.0, 1.0]], vec![-2.0, -0.25], vec![0.5]).unwrap();
    let solution = Lemke::default().solve(&friction).unwrap();
    assert_comes_back!(ContactForces, friction.variables(&solution));
    let lcp = families::obstacle(4).problem;
    assert_comes_back!(ErrorBound, lcp.error_bound(&[0.0; 16]).unwrap());
    assert_comes_back!(Vec<Choice>, Auto::default().plan(&lcp));
    let general = lcp.into();
    let path = Parametric::default().trace(&general, &[1.0; 16], 0.0, 1.0).unwrap();
    assert_comes_back!(ParametricPath, path);
    assert_comes_back!(Covering, Covering::Random { seed: u64::MAX });
    assert_comes_back!(WarmStart, WarmStart::Basis(Basis::all(Side::T, 2)));
    assert_comes_back!(WarmStart, WarmStart::Point { t: vec![0.1], y: vec![1e-320] });
    assert_comes_back!([ContactStatus; 2], [ContactStatus::Open, ContactStatus::Backwards]);
    assert_comes_back!([Refinement; 2], [Refinement::Plain, Refinement::Extended]);
    assert_comes_back!(SoftConstraints, SoftConstraints::default());
    let soft = QuadraticProgram::default().solve_soft(&problem, 1e-3).unwrap();
    assert_comes_back!(lcp::qp::SoftSolution, soft);
    assert_eq!(
        to_string(&Method::ALL).unwrap(),
        r#"["auto","lemke","newton","interior","qp","pgs","enumeration"]"#
    );
    assert_comes_back!([Method; 7], Method::ALL);
}

#[test]
fn answers_of_sweeps_over_rows() {
    let lcp = families::obstacle(3).problem;
    let mut rows = lcp::pgs::MatrixRows::new(lcp.m());
    let solver = lcp::ProjectedGaussSeidel::default();
    let solution =
        solver.solve_rows(&mut rows, lcp.q(), &vec![Constraint::NONNEGATIVE; 9]).unwrap();
    assert_comes_back!(RowsSolution, solution);
}

#[test]
fn settings_of_all_methods() {
    let time_limit = Some(std::time::Duration::from_millis(2500));
    assert_comes_back!(AutoSettings, AutoSettings { time_limit, ..Default::default() });
    assert_comes_back!(LemkeSettings, LemkeSettings { time_limit, ..Default::default() });
    assert_comes_back!(SemismoothNewtonSettings, SemismoothNewtonSettings::default());
    assert_comes_back!(InteriorPointSettings, InteriorPointSettings::default());
    assert_comes_back!(ProjectedGaussSeidelSettings, ProjectedGaussSeidelSettings::default());
    assert_comes_back!(QuadraticProgramSettings, QuadraticProgramSettings::default());
    assert_comes_back!(EvolutionSettings, EvolutionSettings::default());
    // What is not given is the default, and what does not exist is refused.
    let given: LemkeSettings = from_str(r#"{"tolerance": 1e-8}"#).unwrap();
    assert_eq!(given, LemkeSettings { tolerance: 1e-8, ..Default::default() });
    let error = from_str::<LemkeSettings>(r#"{"tolerence": 1e-8}"#).unwrap_err().to_string();
    assert!(error.contains("unknown field `tolerence`, expected one of `tolerance`"), "{error}");
}
