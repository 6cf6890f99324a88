//! Checks the network settings that EDS and XDD files have in common.

use crate::diagnostics::{codes, Diagnostics};
use crate::source::Span;

/// Returns the data type code of a dummy entry, such as 7 for `Dummy0007`, ignoring case.
pub fn dummy_code(key: &str) -> Option<u8> {
    let digits = key.get(5..).filter(|_| key[..5].eq_ignore_ascii_case("Dummy"))?;
    let hexadecimal = digits.len() <= 4 && digits.bytes().all(|byte| byte.is_ascii_hexdigit());
    hexadecimal.then(|| u8::from_str_radix(digits, 16).ok()).flatten()
}

/// Reports a PDO mapping granularity of more than 64 bits, the maximum length of a PDO.
pub fn granularity(bits: u8, span: Span, diagnostics: &mut Diagnostics) {
    if bits > 64 {
        let message = format!("a granularity of {bits} bits exceeds the 64 bits of a PDO");
        diagnostics.push(codes::VALUE_NOT_ALLOWED.at(span, message).label("expected 0 to 64"));
    }
}

/// Returns `number` as a node-ID. Returns `None` and reports the number if it is outside of the range 1 to 127.
pub fn node_id(number: u32, span: Span, diagnostics: &mut Diagnostics) -> Option<u8> {
    let node_id = u8::try_from(number).ok().filter(|node_id| (1..=127).contains(node_id));
    if node_id.is_none() {
        let message = format!("{number} is not a valid node-ID");
        diagnostics.push(codes::VALUE_NOT_ALLOWED.at(span, message).label("expected 1 to 127"));
    }
    node_id
}

#[cfg(test)]
mod tests {
    use super::dummy_code;

    #[test]
    fn codes_of_dummy_entries() {
        assert_eq!((dummy_code("dummy0007"), dummy_code("Dummy1B")), (Some(7), Some(0x1B)));
        for key in ["Dummy", "Dummy+7", "Dummy0100", "Dummy00007", "Dumm\u{e9}07"] {
            assert_eq!(dummy_code(key), None, "{key}");
        }
    }
}
