//! List of the attributes that an element has.

use thin_vec::ThinVec;

use crate::frontend::xml::Given;

/// Declares keys for the attributes of an element, with the names of the attributes. Further keys are those of child
/// elements that contain one value.
macro_rules! keys {
    ($(#[$doc:meta])* $keys:ident { $($key:ident = $name:literal,)+ $(; $($child:ident,)+)? }) => {
        $(#[$doc])*
        #[derive(Clone, Copy)]
        pub(super) enum $keys { $($key,)+ $($($child,)+)? }

        impl $keys {
            /// Names of the attributes in the order of the keys.
            pub const NAMES: [&'static str; [$($name),+].len()] = [$($name),+];
        }
    };
}
pub(super) use keys;

/// Attributes of an element, each with its position in the array of all attributes. Missing attributes need no memory.
/// Most elements have only a few of the attributes that the standard defines.
#[derive(Default)]
pub(super) struct Attributes<'a>(ThinVec<(u8, Given<'a>)>);

impl<'a> Attributes<'a> {
    /// Takes the attributes that are not missing from `all`.
    pub fn take(all: &mut [Given<'a>]) -> Self {
        let mut present = ThinVec::with_capacity(all.iter().filter(|given| !given.is_missing()).count());
        for (position, given) in (0..).zip(all) {
            if !given.is_missing() {
                present.push((position, std::mem::take(given)));
            }
        }
        Attributes(present)
    }

    /// Returns the attribute at `position`, or `None` if it is missing.
    pub fn get(&self, position: u8) -> Option<&Given<'a>> {
        self.0.iter().find(|(other, _)| *other == position).map(|(_, given)| given)
    }
}
