//! The first stage: what elements of a description are called in Rust.

pub(super) mod composites;
pub(super) mod handles;
pub(super) mod machines;
pub(super) mod messages;
pub(super) mod pdos;
pub(super) mod types;

use super::located::Located;
use handles::HandleNames;
use types::TypeNames;

/// The names of a device's or a module's elements.
pub(super) struct Names {
    pub handles: HandleNames,
    /// By the positions of the PDOs.
    pub pdos: Vec<String>,
    pub types: TypeNames,
}

impl Names {
    pub fn of(located: &Located<'_>) -> Self {
        Names { handles: handles::names(located), pdos: pdos::names(located), types: TypeNames::of(located) }
    }
}
