//! CAN-IDs that no configurable COB-ID can have.

use std::ops::RangeInclusive;

use lexibus_codegen::diagnostics::{codes, Diagnostic};
use lexibus_codegen::number::{self, hex};
use lexibus_codegen::source::Span;

use crate::model::EXTENDED;

/// Restricted CAN-IDs with 11 bits, each range with its use (CiA 301 7.3.5).
const RESTRICTED: [(RangeInclusive<u32>, &str); 8] = [
    (0x000..=0x000, "NMT"),
    (0x001..=0x07F, "other uses"),
    (0x101..=0x180, "other uses"),
    (0x581..=0x5FF, "SDO"),
    (0x601..=0x67F, "SDO"),
    (0x6E0..=0x6FF, "other uses"),
    (0x701..=0x77F, "heartbeat and node guarding"),
    (0x780..=0x7FF, "LSS and other uses"),
];

/// Returns a diagnostic if the CAN-ID of a COB-ID is restricted, or has more than 11 bits although bit 29 is 0. `name` is the name
/// of the messages.
pub(super) fn fault(cob_id: u32, name: &str, span: Span) -> Option<Diagnostic> {
    if cob_id & EXTENDED != 0 {
        return None;
    }
    let can_id = cob_id & 0x1FFF_FFFF;
    let found = |help| {
        let message = format!("{name} cannot use the CAN-ID {}", hex(can_id));
        Diagnostic::new(&codes::RESTRICTED_CAN_ID, span, message).help(help)
    };
    if can_id > 0x7FF {
        let found = found("use a CAN-ID of 11 bits, or set bit 29 of the COB-ID (0x20000000) for a CAN-ID of 29 bits");
        return Some(found.label("a CAN-ID has 11 bits if bit 29 of the COB-ID is 0"));
    }
    let (range, owner) = RESTRICTED.iter().find(|(range, _)| range.contains(&can_id))?;
    let ids = number::range(*range.start(), *range.end(), hex);
    Some(found("choose another COB-ID").label(format!("CiA 301 reserves {ids} for {owner}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_can_ids_of_pdos_and_services_are_allowed() {
        let is_allowed = |cob_id: u32| fault(cob_id, "TPDO 1", Span::MISSING).is_none();
        for allowed in
            [0x080, 0x100, 0x181, 0x57F, 0x580, 0x600, 0x680, 0x6DF, 0x700, 0xC000_0181, EXTENDED, EXTENDED | 0x801]
        {
            assert!(is_allowed(allowed), "{allowed:#X}");
        }
        for restricted in [
            0,
            1,
            0x7F,
            0x101,
            0x180,
            0x581,
            0x5FF,
            0x601,
            0x67F,
            0x6E0,
            0x6FF,
            0x701,
            0x77F,
            0x780,
            0x7FF,
            0x801,
            0x4000_0101,
        ] {
            assert!(!is_allowed(restricted), "{restricted:#X}");
        }
    }
}
