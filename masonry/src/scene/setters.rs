//! Methods that change one value of their object and return it, so that a scene is built in one expression.

/// Generates such methods: a body changes `self`, which is returned after it.
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
