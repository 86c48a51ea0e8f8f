//! How problems are put together, and how answers are read.

use faer::mat;
use faer::sparse::{SparseColMat, Triplet};
use lcp::{
    Auto, AutoSettings, BoxedLcp, Contact2d, ContactPoint, Error, Friction2d, InteriorPoint, Lcp,
    Lemke, Matrix, MixedLcp, QuadraticProgram, Solver, Vector,
};
use lcp_problems::families;

fn entries(matrix: &Matrix) -> Vec<Vec<f64>> {
    (0..matrix.nrows()).map(|i| (0..matrix.ncols()).map(|j| matrix[(i, j)]).collect()).collect()
}

/// Two bodies, each with a place along and a height above a floor.
fn two_points() -> Contact2d {
    let mut builder = Contact2d::builder(mat![[3.0, 0.0], [0.0, 0.0]], vec![0.4, -2.0]);
    let first = builder.add_point(ContactPoint {
        normal: &[(1, 0.25), (1, 0.75)],
        tangent: &[(0, 1.0)],
        gap: 0.1,
        slip: -0.2,
        mu: 0.5,
        ..Default::default()
    });
    let second =
        builder.add_point(ContactPoint { normal: &[(0, -1.0)], gap: 5.0, ..Default::default() });
    assert_eq!((first, second), (0, 1));
    builder.build().unwrap()
}

#[test]
fn a_builder_gives_the_matrices() {
    let built = two_points();
    assert_eq!(built.normal().to_dense(), mat![[0.0, 1.0], [-1.0, 0.0]]);
    assert_eq!(built.tangent().to_dense(), mat![[1.0, 0.0], [0.0, 0.0]]);
    assert_eq!((built.initial_gaps(), built.initial_slips()), (&[0.1, 5.0][..], &[-0.2, 0.0][..]));
    assert_eq!((built.mu(), built.loads()), (&[0.5, 0.0][..], &[0.4, -2.0][..]));
    assert_eq!(built.compliance(), [[0.0; 2]; 2]);
    let none = Contact2d::builder([[1.0]], vec![2.0]).build().unwrap();
    assert_eq!((none.displacements(), none.points()), (1, 0));
}

#[test]
fn a_builder_names_the_point_and_the_entry() {
    let good = ContactPoint { normal: &[(0, 1.0)], ..Default::default() };
    let error = |point: ContactPoint<'_>| {
        let mut builder = Contact2d::builder([[1.0]], vec![0.0]);
        builder.add_point(good);
        builder.add_point(point);
        builder.build().unwrap_err()
    };
    let outside = error(ContactPoint { tangent: &[(0, 1.0), (1, 2.0)], ..good });
    let expected =
        Error::PointEntry { point: 1, row: "tangent", index: 1, value: 2.0, displacements: 1 };
    assert_eq!(outside, expected);
    assert_eq!(
        outside.to_string(),
        "contact point 1 has the entry (1, 2) in its tangent row: the index must be below 1, the number of \
         displacements, and the value finite"
    );
    let infinite = error(ContactPoint { normal: &[(0, f64::INFINITY)], ..good });
    assert!(matches!(infinite, Error::PointEntry { point: 1, row: "normal", index: 0, .. }));
    for (point, name) in [
        (ContactPoint { gap: f64::NAN, ..good }, "gap"),
        (ContactPoint { slip: f64::INFINITY, ..good }, "slip"),
        (ContactPoint { mu: -0.1, ..good }, "mu"),
        (ContactPoint { mu: f64::NAN, ..good }, "mu"),
        (ContactPoint { compliance: [-0.1, 0.0], ..good }, "normal compliance"),
        (ContactPoint { compliance: [0.0, f64::INFINITY], ..good }, "tangential compliance"),
    ] {
        let error = error(point);
        assert!(
            matches!(error, Error::PointValue { point: 1, name: of, .. } if of == name),
            "{error}"
        );
    }
    let shape = Contact2d::builder([[1.0, 0.0]], vec![0.0]).build().unwrap_err();
    assert!(matches!(shape, Error::Shape { what: "K", rows: 1, cols: 2, .. }), "{shape}");
}

#[test]
fn matrices_come_from_many_things() {
    let expected = vec![vec![2.0, 0.0], vec![1.0, 3.0]];
    let triplets = [(1, 1, 3.0), (0, 0, 1.5), (1, 0, 1.0), (0, 0, 0.5)];
    let of_faer = triplets.map(|(i, j, v)| Triplet::new(i, j, v));
    for (matrix, is_sparse) in [
        (Matrix::from([[2.0, 0.0], [1.0, 3.0]]), false),
        (Matrix::from(&[[2.0, 0.0], [1.0, 3.0]]), false),
        (Matrix::from(mat![[2.0, 0.0], [1.0, 3.0]]), false),
        (Matrix::from_rows(&expected).unwrap(), false),
        (Matrix::from_rows(&[[2.0, 0.0], [1.0, 3.0]]).unwrap(), false),
        (Matrix::from_triplets(2, 2, &triplets).unwrap(), true),
        (SparseColMat::try_new_from_triplets(2, 2, &of_faer).unwrap().into(), true),
        #[cfg(feature = "nalgebra")]
        (nalgebra::DMatrix::from_row_slice(2, 2, &[2.0, 0.0, 1.0, 3.0]).into(), false),
        #[cfg(feature = "nalgebra")]
        ((&nalgebra::DMatrix::from_row_slice(2, 2, &[2.0, 0.0, 1.0, 3.0])).into(), false),
        #[cfg(feature = "nalgebra")]
        (nalgebra::Matrix2::new(2.0, 0.0, 1.0, 3.0).into(), false),
    ] {
        assert_eq!((entries(&matrix), matrix.is_sparse()), (expected.clone(), is_sparse));
    }
    let wide = Matrix::from([[1.0, 2.0, 3.0]]);
    assert_eq!((wide.nrows(), wide.ncols(), wide[(0, 2)]), (1, 3, 3.0));
    let none = Matrix::from_rows(&[] as &[Vec<f64>]).unwrap();
    assert_eq!((none.nrows(), none.ncols()), (0, 0));
}

#[test]
fn lists_that_make_no_matrix_say_where() {
    for (row, col) in [(2, 0), (0, 3), (usize::MAX, usize::MAX)] {
        let error = Matrix::from_triplets(2, 3, &[(0, 0, 1.0), (row, col, 1.0)]).unwrap_err();
        assert_eq!(error, Error::Outside { row, col, rows: 2, cols: 3 });
    }
    let error = Matrix::from_rows(&[vec![1.0, 2.0], vec![3.0, 4.0], vec![5.0]]).unwrap_err();
    assert_eq!(
        error.to_string(),
        "row 2 has 1 entries, but row 0 has 2: all rows must be equally long"
    );
    // What is not finite is refused with its place where the problem is made.
    let m = Matrix::from_triplets(1, 1, &[(0, 0, f64::MAX), (0, 0, f64::MAX)]).unwrap();
    let error = Lcp::new(m, vec![1.0]).unwrap_err();
    assert_eq!(error, Error::NotFinite { what: "M", row: 0, col: 0, value: f64::INFINITY });
}

/// One method on every kind of problem, and its answer in the terms of each.
#[test]
fn answers_are_read_in_the_terms_of_their_problem() {
    let lemke = Lemke::default();
    let near = |found: &[f64], expected: &[f64]| {
        assert_eq!(found.len(), expected.len());
        assert!(found.iter().zip(expected).all(|(x, y)| (x - y).abs() < 1e-13), "{found:?}");
    };
    let lcp = Lcp::new([[2.0, 1.0], [1.0, 2.0]], vec![-5.0, 6.0]).unwrap();
    let (z, w) = lcp.variables(&lemke.solve(&lcp).unwrap());
    near(&z, &[2.5, 0.0]);
    near(&w, &[0.0, 8.5]);
    // u - 1 = 0 with u free, w = u + v: v is zero
    let mixed =
        MixedLcp::new([[1.0, 0.0], [1.0, 1.0]], vec![-1.0, 0.0], vec![true, false]).unwrap();
    let (z, w) = mixed.variables(&lemke.solve(&mixed).unwrap());
    near(&z, &[1.0, 0.0]);
    near(&w, &[0.0, 1.0]);
    // z - 3 < 0 at the upper bound
    let boxed = BoxedLcp::new([[1.0]], vec![-3.0], vec![-1.0], vec![2.0]).unwrap();
    let (z, w) = boxed.variables(&lemke.solve(&boxed).unwrap());
    near(&z, &[2.0]);
    near(&w, &[-1.0]);
    // A point of mass 1 hits a floor with 2, and slides along it with 3.
    let friction = Friction2d::new([[1.0, 0.0], [0.0, 1.0]], vec![-2.0, -3.0], vec![0.5]).unwrap();
    let forces = friction.variables(&lemke.solve(&friction).unwrap());
    near(&forces.normal, &[2.0]);
    near(&forces.tangential, &[1.0]);
    // The body sinks by its gap, and the floor carries its weight; it does not reach the wall.
    let contact = two_points();
    let state = contact.variables(&lemke.solve(&contact).unwrap());
    near(&state.t_n, &[2.0, 0.0]);
    near(&[state.u[1], state.gap[0]], &[-0.1, 0.0]);
    // The slip of -0.2 is taken back until the spring and friction balance: 3 u = 0.4 + t_t, |t_t| <= 1
    near(&[state.u[0], state.slip[0], state.t_t[0]], &[0.2, 0.0, 0.2]);
}

#[test]
fn vectors_are_made_from_what_callers_have() {
    let entries = vec![-1.0, 2.0];
    let vectors: Vec<Vector> = vec![
        [-1.0, 2.0].into(),
        (&[-1.0, 2.0]).into(),
        entries[..].into(),
        (&entries).into(),
        faer::col![-1.0, 2.0].into(),
        #[cfg(feature = "nalgebra")]
        nalgebra::Vector2::new(-1.0, 2.0).into(),
        #[cfg(feature = "nalgebra")]
        nalgebra::DVector::from_column_slice(&entries).into(),
    ];
    for vector in vectors {
        assert_eq!(Lcp::new(Matrix::identity(2), vector).unwrap().q(), entries);
    }
}

#[test]
fn many_problems_come_back_in_their_order() {
    let problems: Vec<Lcp> = (0..40).map(|seed| families::p_matrix(9, seed).problem).collect();
    let all = Auto::default().solve_all(&problems);
    assert_eq!(all.len(), problems.len());
    for (problem, answer) in problems.iter().zip(all) {
        let alone = Auto::default().solve(problem).unwrap();
        let answer = answer.unwrap();
        assert_eq!((answer.t, answer.status), (alone.t, alone.status));
    }
    let wrong = Auto::new(AutoSettings { tolerance: 2.0, ..Default::default() });
    assert!(wrong.solve_all(&problems).into_iter().all(|answer| answer.is_err()));
}

#[test]
fn no_point_has_a_nan_if_coefficients_have_no_inverse() {
    let smallest = f64::from_bits(1);
    for n in 1..=3 {
        let matrix = faer::Mat::from_fn(n, n, |_, _| smallest);
        let problem = Lcp::new(matrix, vec![-1.0; n]).unwrap();
        let solvers: [&dyn Solver<Lcp>; 4] = [
            &InteriorPoint::default(),
            &QuadraticProgram::default(),
            &Lemke::default(),
            &Auto::default(),
        ];
        for solver in solvers {
            let solution = solver.solve(&problem).unwrap();
            assert!(solution.t.iter().chain(&solution.y).all(|it| it.is_finite()), "{solution:?}");
        }
    }
}
