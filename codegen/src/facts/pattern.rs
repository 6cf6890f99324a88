//! Bits that have to be 0 or 1.

/// `xxxx xxxx x1xx 0000`: the bits of `mask` as `value` has them, all others as `x`. `bits` is the width of the item.
pub(crate) fn text(mask: u32, value: u32, bits: u32) -> String {
    let used = 32 - mask.leading_zeros();
    let bits = bits.min(32).max(used);
    let mut text = String::new();
    for bit in (0..bits).rev() {
        text.push(match (mask >> bit & 1, value >> bit & 1) {
            (0, _) => 'x',
            (_, 0) => '0',
            _ => '1',
        });
        if bit > 0 && bit % 4 == 0 {
            text.push(' ');
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_bits_are_x() {
        assert_eq!(text(0x4F, 0x40, 16), "xxxx xxxx x1xx 0000");
        assert_eq!(text(0x4F, 0x40, 8), "x1xx 0000");
        assert_eq!(text(0x14F, 0x40, 0), "0 x1xx 0000", "the type is unknown");
        assert_eq!(text(u32::MAX, 0, 32), "0000 0000 0000 0000 0000 0000 0000 0000");
    }
}
