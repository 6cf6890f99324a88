//! Reports objects that texts of a table mention but the table does not contain.

use std::ops::RangeInclusive;

use crate::check::context::Context;
use crate::check::mapped_object::indices;
use crate::diagnostics::{codes, Diagnostics};
use crate::ir::texts;
use crate::number::hex16;

/// Indices of the first axis of a drive profile. Such an index in a text needs neither a sub-index nor the word `object` to be
/// recognized.
const PROFILE: RangeInclusive<u16> = 0x6000..=0x67FF;

pub(crate) fn check(context: &Context<'_>, diagnostics: &mut Diagnostics) {
    let device = context.device;
    let known = indices(device);
    if known.is_empty() {
        return;
    }
    for text in texts::all(device) {
        for index in mentions(text.words).filter(|index| !known.contains(index)) {
            let message = format!("a text mentions object {}, which the table does not have", hex16(index));
            diagnostics.push(codes::MENTIONED_OBJECT.at(text.span, message));
        }
    }
}

/// Returns the indices that a text mentions: `0x60D0`, `object 0x2010`, `0x1003:1`.
fn mentions(text: &str) -> impl Iterator<Item = u16> + '_ {
    text.match_indices("0x").filter_map(|(at, _)| {
        let rest = text.get(at + 2..)?;
        let digits = rest.find(|c: char| !c.is_ascii_hexdigit()).unwrap_or(rest.len());
        let index = u16::from_str_radix(rest.get(..digits).filter(|digits| digits.len() == 4)?, 16).ok()?;
        let before = text.get(..at).unwrap_or_default();
        let mut after = rest.get(digits..).unwrap_or_default().chars();
        let has_sub = after.next() == Some(':') && after.next().is_some_and(|c| c.is_ascii_digit());
        let is_called = before.ends_with("object ") || before.ends_with("Object ");
        let follows_letter = before.ends_with(|c: char| c.is_alphanumeric());
        (!follows_letter && (PROFILE.contains(&index) || has_sub || is_called)).then_some(index)
    })
}

#[cfg(test)]
mod tests {
    use super::mentions;

    #[test]
    fn objects_are_distinguished_from_other_numbers() {
        let found = |text| mentions(text).collect::<Vec<_>>();
        assert_eq!(found("source in 0x60D0, not 0x60D01"), [0x60D0]);
        assert_eq!(found("object 0x2010 and 0x1003:1"), [0x2010, 0x1003]);
        assert_eq!(found("0x8000 to 0xFFFF; 0x1000, 0x12 and x0x6040"), [0; 0]);
    }
}
