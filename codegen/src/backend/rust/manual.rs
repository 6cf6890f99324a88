//! What generated documentation says of the manual that a description was taken from.

use super::docs;
use crate::ir::{Availability, Device, Documentation, Doubt, LocalText};

/// What is known of the manual.
#[derive(Clone, Debug, Default)]
pub(super) struct Manual {
    /// Its language, where it isn't the one of the description.
    language: String,
    /// What places in it are: `line` or `page`.
    cites: String,
}

impl Manual {
    pub(super) fn of(device: &Device) -> Self {
        let fact = |key: &str| {
            let own = device.extensions.iter().find(|extension| extension.key == key);
            own.map(|own| own.value.to_string()).unwrap_or_default()
        };
        Manual { language: fact("manual/language"), cites: fact("manual/cites") }
    }

    /// The place in the manual and its own words for an element: `Manual, line 12: Posizione.`
    pub(super) fn place(&self, documentation: Option<&Documentation>, names: &[LocalText]) -> Option<String> {
        let cite = documentation.and_then(|documentation| documentation.cite.as_deref());
        let is_original = |text: &&LocalText| !self.language.is_empty() && text.language == self.language;
        let original = names.iter().find(is_original).map(|text| docs::escape(&text.text));
        let place = cite.map(|cite| match self.cites.as_str() {
            "" => format!("Manual, {}", docs::escape(cite)),
            kind => format!("Manual, {} {}", docs::escape(kind), docs::escape(cite)),
        });
        match (place, original) {
            (None, None) => None,
            (Some(place), None) => Some(format!("{place}.")),
            (place, Some(original)) => {
                let place = place.unwrap_or_else(|| "Manual".to_owned());
                Some(format!("{place}: {}", docs::sentence(&original)))
            }
        }
    }
}

/// `Note: the manual says …, taken as … (why).`
pub(super) fn doubt(doubt: &Doubt) -> String {
    let part = |text: &str| docs::escape(text.trim_end_matches('.'));
    let why = if doubt.why.is_empty() { String::new() } else { format!(" ({})", part(&doubt.why)) };
    format!("Note: {}. Chosen: {}{why}.", part(&doubt.says), part(&doubt.chosen))
}

/// A bus as people write it.
fn bus_name(key: &str) -> &str {
    match key {
        "canopen" => "CANopen",
        "ethercat" => "EtherCAT",
        "modbus" => "Modbus",
        "profinet" => "PROFINET",
        "serial" => "a serial line",
        other => other,
    }
}

/// Models, firmware, buses and options that have an element; empty where all do.
pub(super) fn availability(availability: &Availability) -> String {
    let list =
        |names: &[crate::ir::CompactString]| names.iter().map(|name| docs::escape(name)).collect::<Vec<_>>().join(", ");
    let mut sentences = Vec::new();
    if !availability.models.is_empty() {
        sentences.push(format!("Only of {}.", list(&availability.models)));
    }
    match (&availability.since, &availability.until) {
        (Some(since), Some(until)) => {
            sentences.push(format!("From firmware {} to before {}.", docs::escape(since), docs::escape(until)));
        }
        (Some(since), None) => sentences.push(format!("From firmware {} on.", docs::escape(since))),
        (None, Some(until)) => sentences.push(format!("Before firmware {}.", docs::escape(until))),
        (None, None) => {}
    }
    if let Some(other) = &availability.replaced_by {
        sentences.push(format!("Replaced by {}.", docs::escape(other)));
    }
    if !availability.buses.is_empty() {
        let buses: Vec<crate::ir::CompactString> = availability.buses.iter().map(|bus| bus_name(bus).into()).collect();
        sentences.push(format!("Only on {}.", list(&buses)));
    }
    if !availability.options.is_empty() {
        sentences.push(format!("Needs {}.", list(&availability.options)));
    }
    sentences.join(" ")
}
