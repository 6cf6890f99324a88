//! Formats numbers for people and for generated Rust in hexadecimal notation: addresses, identifiers, masks and bytes. Also formats
//! ranges of numbers. Exported files have their own formats.

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

/// Formats a COB-ID, a mask or another number without leading zeros: `0xF`.
pub fn hex(number: impl Into<i128>) -> String {
    format!("0x{:X}", number.into())
}

/// Formats index and sub-index for lists and tables: `0x6040:00`.
pub fn object(index: u16, sub_index: u8) -> String {
    format!("{}:{sub_index:02X}", hex16(index))
}

/// Formats index and sub-index for sentences: `0x6040 sub-index 0x00`.
pub fn sub_entry(index: u16, sub_index: u8) -> String {
    format!("{} sub-index {}", hex16(index), hex8(sub_index))
}

/// Formats index and sub-index as in register tables and network descriptions: `0x6040:0`.
pub fn written_object(index: u16, sub_index: u8) -> String {
    format!("{}:{sub_index}", hex16(index))
}

/// Formats the bytes of a frame or a value: `02 1B FF`.
pub fn bytes(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02X}")).collect::<Vec<_>>().join(" ")
}

/// Formats a range of numbers: `4 to 7`, or `4` if the range has only one number. `shown` formats one number.
pub fn range<N: PartialEq>(first: N, last: N, shown: impl Fn(N) -> String) -> String {
    match first == last {
        true => shown(first),
        false => format!("{} to {}", shown(first), shown(last)),
    }
}

/// Formats ranges of numbers: `1, 4 to 7`. `shown` formats one number. A list of more than [`ALLOWED_SHOWN`] ranges is shortened.
pub fn ranges(numbers: &[(u16, u16)], shown: impl Fn(u16) -> String) -> String {
    let first_ones = numbers.iter().take(ALLOWED_SHOWN);
    let mut list: Vec<String> = first_ones.map(|&(first, last)| range(first, last, &shown)).collect();
    if numbers.len() > ALLOWED_SHOWN {
        list.push("…".to_owned());
    }
    list.join(", ")
}
