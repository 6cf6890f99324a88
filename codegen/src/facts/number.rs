//! Numbers in hexadecimal notation.

/// Formats a byte of a frame: `0x1F`.
pub fn hex8(number: u8) -> String {
    format!("0x{number:02X}")
}

/// Formats an index, an address or an API number: `0x6040`.
pub fn hex16(number: impl Into<u32>) -> String {
    format!("0x{:04X}", number.into())
}

/// Formats a vendor ID, a product code, a revision number or an ident number: `0x00000539`.
pub fn hex32(number: u32) -> String {
    format!("0x{number:08X}")
}

/// Formats the bytes of a frame or a value: `02 1B FF`.
pub fn bytes(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02X}")).collect::<Vec<_>>().join(" ")
}
