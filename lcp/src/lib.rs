//! Linear complementarity problems `A t + B y = c`, `t >= 0`, `y >= 0`, `t.y = 0`.

mod solution;

pub use solution::{Residuals, Status};
