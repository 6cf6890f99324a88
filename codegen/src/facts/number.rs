//! Numbers in hexadecimal notation.

/// `0x1F`: a byte of a frame.
pub fn hex8(number: u8) -> String {
    format!("0x{number:02X}")
}

/// `0x6040`: an index, an address or an API number.
pub fn hex16(number: impl Into<u32>) -> String {
    format!("0x{:04X}", number.into())
}

/// `0x00000539`: a vendor-ID, a product code, a revision number or an ident number.
pub fn hex32(number: u32) -> String {
    format!("0x{number:08X}")
}

/// `02 1B FF`: the bytes of a frame or a value.
pub fn bytes(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02X}")).collect::<Vec<_>>().join(" ")
}
