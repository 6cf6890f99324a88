//! The naming stage of the back end determines the Rust names of a description's elements.

pub(super) mod composites;
pub(super) mod handles;
pub(super) mod machines;
#[cfg(feature = "messages")]
pub(super) mod messages;
pub(super) mod pdos;
pub(super) mod types;

use super::located::Located;
use composites::NamedComposite;
use handles::HandleNames;
#[cfg(feature = "messages")]
use messages::NamedMessages;
use pdos::NamedPdo;
use types::TypeNames;

/// The Rust names of the elements of a device or module.
pub(super) struct Names<'a> {
    pub handles: HandleNames<'a>,
    pub pdos: Vec<NamedPdo<'a>>,
    pub types: TypeNames<'a>,
    /// Composite numbers, which consist of several items.
    pub composites: Vec<NamedComposite<'a>>,
    #[cfg(feature = "messages")]
    pub messages: NamedMessages<'a>,
}

impl<'a> Names<'a> {
    pub fn of(located: &Located<'a>) -> Self {
        let handles = HandleNames::of(located);
        Names {
            pdos: pdos::names(located, &handles),
            types: TypeNames::of(located, &handles),
            composites: located.device.map(composites::names).unwrap_or_default(),
            #[cfg(feature = "messages")]
            messages: located.device.map(NamedMessages::of).unwrap_or_default(),
            handles,
        }
    }
}
