//! Contact points and the displacements on which they depend.

/// All contact points; their displacements are stored in one place, one point after the other.
pub(crate) struct Points {
    /// The first place of the displacements of every point, and the end of those of the last one.
    starts: Vec<usize>,
    columns: Vec<usize>,
    coefficients: Vec<[f64; 2]>,
    pub(crate) x_0: Vec<f64>,
    pub(crate) s_0: Vec<f64>,
    pub(crate) mu: Vec<f64>,
    /// Normal and tangential compliance; the second is zero without friction.
    pub(crate) compliance: Vec<[f64; 2]>,
}

/// A contact point: the displacements on which it depends, with their coefficients in gap and slip.
#[derive(Clone, Copy)]
pub(crate) struct Point<'a> {
    pub(crate) columns: &'a [usize],
    pub(crate) coefficients: &'a [[f64; 2]],
    pub(crate) x_0: f64,
    pub(crate) s_0: f64,
    pub(crate) mu: f64,
    pub(crate) compliance: [f64; 2],
}

impl Points {
    /// Hard points, without displacements until these are [added](Self::close), point by point.
    pub(crate) fn new(x_0: Vec<f64>, s_0: Vec<f64>, mu: Vec<f64>) -> Self {
        let compliance = vec![[0.0; 2]; mu.len()];
        let (columns, coefficients) = (Vec::new(), Vec::new());
        Self { starts: vec![0], columns, coefficients, x_0, s_0, mu, compliance }
    }

    /// Adds a displacement to those of a point, with its coefficients in gap and slip.
    pub(crate) fn push(&mut self, column: usize, coefficients: [f64; 2]) {
        self.columns.push(column);
        self.coefficients.push(coefficients);
    }

    /// Ends the displacements of a point.
    pub(crate) fn close(&mut self) {
        self.starts.push(self.columns.len());
    }

    pub(crate) fn len(&self) -> usize {
        self.mu.len()
    }

    pub(crate) fn get(&self, i: usize) -> Point<'_> {
        let range = self.starts[i]..self.starts[i + 1];
        Point {
            columns: &self.columns[range.clone()],
            coefficients: &self.coefficients[range],
            x_0: self.x_0[i],
            s_0: self.s_0[i],
            mu: self.mu[i],
            compliance: self.compliance[i],
        }
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = Point<'_>> + Clone {
        (0..self.len()).map(|i| self.get(i))
    }
}

impl<'a> Point<'a> {
    /// The edges of the friction cone: the point, and the tangential force for a normal force of one.
    pub(crate) fn edges(self) -> impl Iterator<Item = (Point<'a>, f64)> {
        let count = if self.mu > 0.0 { 2 } else { 1 };
        [(self, self.mu), (self, -self.mu)].into_iter().take(count)
    }

    /// The gap at displacements and a normal force.
    pub(crate) fn gap(&self, u: &[f64], t_n: f64) -> f64 {
        self.x_0 + self.moved(u).0 + self.compliance[0] * t_n
    }

    /// The slip at displacements and a tangential force.
    pub(crate) fn slip(&self, u: &[f64], t_t: f64) -> f64 {
        self.s_0 + self.moved(u).1 + self.compliance[1] * t_t
    }

    /// The stiffnesses of these springs in series with the compliances.
    pub(crate) fn in_series(&self, stiffness: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k| stiffness[k] / (1.0 + self.compliance[k] * stiffness[k]))
    }

    /// The changes of gap and slip by a step of the displacements, which may be far smaller than gap
    /// and slip.
    pub(crate) fn moved(&self, u: &[f64]) -> (f64, f64) {
        let terms = self.columns.iter().zip(self.coefficients);
        terms.fold((0.0, 0.0), |(gap, slip), (&j, [n, t])| (gap + n * u[j], slip + t * u[j]))
    }

    /// Adds the forces of the point to those on the displacements.
    pub(crate) fn add_forces(&self, t_n: f64, t_t: f64, out: &mut [f64]) {
        for (&j, [n, t]) in self.columns.iter().zip(self.coefficients) {
            out[j] += n * t_n + t * t_t;
        }
    }
}
