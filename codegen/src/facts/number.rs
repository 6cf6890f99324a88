//! Numbers in hexadecimal notation, and ranges of numbers.

use crate::ir::Numbers;

/// Maximum number of allowed values that a sentence lists.
pub const ALLOWED_SHOWN: usize = 16;

/// Formats a byte or a sub-index: `0x0F`.
pub fn hex8(number: impl Into<i128>) -> String {
    format!("0x{:02X}", number.into())
}

/// Formats an index, an address or an API number: `0x6040`.
pub fn hex16(number: impl Into<i128>) -> String {
    format!("0x{:04X}", number.into())
}

/// Formats a vendor ID, a product code, a revision number or an ident number: `0x00000539`.
pub fn hex32(number: impl Into<i128>) -> String {
    format!("0x{:08X}", number.into())
}

/// Formats a mask or another number without leading zeros: `0xF`.
pub fn hex(number: impl Into<i128>) -> String {
    format!("0x{:X}", number.into())
}

/// Formats the bytes of a frame or a value: `02 1B FF`.
pub fn bytes(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02X}")).collect::<Vec<_>>().join(" ")
}

/// Formats ranges of numbers: `1, 4 to 7`. `shown` formats one number. A list of more than [`ALLOWED_SHOWN`] ranges is shortened.
pub fn ranges(numbers: &Numbers, shown: impl Fn(u16) -> String) -> String {
    let range = |&(first, last): &(u16, u16)| match first == last {
        true => shown(first),
        false => format!("{} to {}", shown(first), shown(last)),
    };
    let mut list: Vec<String> = numbers.0.iter().take(ALLOWED_SHOWN).map(range).collect();
    if numbers.0.len() > ALLOWED_SHOWN {
        list.push("…".to_owned());
    }
    list.join(", ")
}
