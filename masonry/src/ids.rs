//! Typed indices, so that a block is never confused with a support or a contact point.

use serde::Serialize;

macro_rules! id {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
        #[serde(transparent)]
        pub struct $name(pub u32);

        impl $name {
            /// Returns the position of the item in the list that owns it.
            pub fn index(self) -> usize {
                self.0 as usize
            }

            /// Returns the id of the item at `index` of its list.
            ///
            /// # Panics
            /// If `index` exceeds `u32::MAX`; no scene has so many items.
            pub fn new(index: usize) -> Self {
                Self(u32::try_from(index).expect("fewer than 2^32 items"))
            }
        }
    };
}

id!(
    /// The index of a block in [`Model::blocks`](crate::model::Model::blocks).
    BlockId
);
id!(
    /// The index of a rigid support in [`Model::supports`](crate::model::Model::supports).
    SupportId
);
id!(
    /// The index of a load in [`Scene::loads`](crate::scene::Scene::loads).
    LoadId
);
id!(
    /// The index of a joint in [`Model::joints`](crate::model::Model::joints).
    JointId
);
id!(
    /// The index of a mortar film; the films of a model are counted in the order of its joints.
    FilmId
);
id!(
    /// The index of a contact point in [`Model::contacts`](crate::model::Model::contacts).
    ContactId
);
