//! Problems: the general (horizontal) form, and the forms that convert into it.

mod bound;
mod boxed;
mod contact;
#[cfg(feature = "serde")]
mod data;
mod friction;
mod horizontal;
mod mixed;
mod mixed_form;
mod quadratic;
mod standard;
mod standard_form;

pub use bound::{ErrorBound, Monotonicity};
pub use boxed::BoxedLcp;
pub use contact::{
    Bedding, Contact2d, Contact2dBuilder, ContactPoint, ContactState, ContactStatus,
};
#[cfg(feature = "clarabel")]
pub(crate) use contact::{check_epsilon, ratio};
pub(crate) use contact::{column_factors, median};

pub(crate) use crate::matrix::{column_of, diagonal};
#[cfg(feature = "serde")]
pub use data::Stored;
pub use friction::{ContactForces, Friction2d};
pub use horizontal::HorizontalLcp;
pub(crate) use mixed::Groups;
pub use mixed::MixedLcp;
pub use quadratic::{Qp, QpPoint};
pub use standard::Lcp;
pub use standard_form::StandardForm;
