//! Methods that change one value of their object and return it, so that a scene is built in one expression.

/// Generates builder methods: each takes `self` by value, runs its body, which changes `self`, and returns `self`.
macro_rules! setters {
    ($($(#[$about:meta])* pub fn $name:ident(mut $self:ident, $($new:ident: $type:ty),+) $change:block)+) => {
        $(
            $(#[$about])*
            #[must_use]
            pub fn $name(mut $self, $($new: $type),+) -> Self {
                $change
                $self
            }
        )+
    };
}

pub(super) use setters;
