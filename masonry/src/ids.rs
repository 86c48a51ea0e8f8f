//! Typed indices: a block is never confused with a support or a contact point.

use serde::Serialize;

macro_rules! id {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
        #[serde(transparent)]
        pub struct $name(pub u32);

        impl $name {
            /// The position in the list that owns the item.
            pub fn index(self) -> usize {
                self.0 as usize
            }

            /// The id of the item at `index` of its list.
            ///
            /// # Panics
            /// If `index` exceeds `u32::MAX`: no scene has four thousand million items.
            pub fn new(index: usize) -> Self {
                Self(u32::try_from(index).expect("fewer than 2^32 items"))
            }
        }
    };
}

id!(
    /// A block of [`Model::blocks`](crate::model::Model::blocks).
    BlockId
);
id!(
    /// A rigid support of [`Model::supports`](crate::model::Model::supports).
    SupportId
);
id!(
    /// A load of [`Scene::loads`](crate::scene::Scene::loads).
    LoadId
);
id!(
    /// A joint of [`Model::joints`](crate::model::Model::joints).
    JointId
);
id!(
    /// A mortar film: the films of a model are counted in the order of its joints.
    FilmId
);
id!(
    /// A contact point of [`Model::contacts`](crate::model::Model::contacts).
    ContactId
);
