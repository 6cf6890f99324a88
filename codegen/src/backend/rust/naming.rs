//! The first stage: what elements of a description are called in Rust.

mod composites;
pub(super) mod handles;
pub(super) mod machines;
#[cfg(feature = "messages")]
pub(super) mod messages;
pub(super) mod pdos;
pub(super) mod types;

use super::located::Located;
use handles::HandleNames;
#[cfg(feature = "messages")]
use messages::NamedMessages;
use types::TypeNames;

/// The names of a device's or a module's elements.
pub(super) struct Names<'a> {
    pub handles: HandleNames,
    /// By the positions of the PDOs.
    pub pdos: Vec<String>,
    pub types: TypeNames,
    /// By the positions of the numbers that are split over several items.
    pub composites: Vec<String>,
    #[cfg(feature = "messages")]
    pub messages: NamedMessages<'a>,
    /// What messages borrow.
    #[cfg(not(feature = "messages"))]
    pub messages: std::marker::PhantomData<&'a ()>,
}

impl<'a> Names<'a> {
    pub fn of(located: &Located<'a>) -> Self {
        Names {
            handles: handles::names(located),
            pdos: pdos::names(located),
            types: TypeNames::of(located),
            composites: located.device.map(composites::names).unwrap_or_default(),
            #[cfg(feature = "messages")]
            messages: located.device.map(NamedMessages::of).unwrap_or_default(),
            #[cfg(not(feature = "messages"))]
            messages: std::marker::PhantomData,
        }
    }
}
