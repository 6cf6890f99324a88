//! What generated documentation says of the manual that a description was taken from.

use super::docs::WORDS;
use crate::backend::words;
use crate::ir::{Availability, Device, Documentation, Doubt, LocalText};

/// What is known of the manual.
#[derive(Clone, Debug, Default)]
pub(super) struct Manual(words::Manual);

impl Manual {
    pub(super) fn of(device: &Device) -> Self {
        Manual(words::Manual::of(device))
    }

    /// The place in the manual and its own words for an element: `Manual, line 12: Posizione.`
    pub(super) fn place(&self, documentation: Option<&Documentation>, names: &[LocalText]) -> Option<String> {
        WORDS.place(&self.0, documentation, names)
    }
}

/// `Note: … Chosen: … (why).`
pub(super) fn doubt(doubt: &Doubt) -> String {
    WORDS.doubt(doubt)
}

/// Models, firmware, buses and options that have an element; empty where all do.
pub(super) fn availability(availability: &Availability) -> String {
    WORDS.availability(availability)
}
