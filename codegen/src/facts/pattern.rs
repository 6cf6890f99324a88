//! Bit patterns of states and commands.

use crate::ir::Pattern;

/// Returns the number of bits with which patterns are printed: the width of their item. Without an item, returns the smallest of
/// 8, 16 and 32 bits that fits all patterns.
pub fn width(of_item: Option<u32>, patterns: &[Pattern]) -> u32 {
    of_item.unwrap_or_else(|| {
        let used = patterns.iter().fold(0, |used, pattern| used | pattern.mask);
        match used {
            0..=0xFF => 8,
            0x100..=0xFFFF => 16,
            _ => 32,
        }
    })
}

/// Formats the bits of `value` that are in `mask`, and other bits as `x`: `xxxx xxxx x1xx 0000`. `bits` is the width of the item.
pub fn text(mask: u32, value: u32, bits: u32) -> String {
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
    fn patterns_without_an_item_have_the_minimum_width() {
        let of = |mask| Pattern { mask, ..Pattern::default() };
        assert_eq!(width(None, &[of(0x0F), of(0x80)]), 8);
        assert_eq!(width(None, &[of(0x0F), of(0x100)]), 16);
        assert_eq!(width(None, &[of(0x1_0000)]), 32);
        assert_eq!(width(Some(16), &[of(0x0F)]), 16);
    }

    #[test]
    fn other_bits_are_x() {
        assert_eq!(text(0x4F, 0x40, 16), "xxxx xxxx x1xx 0000");
        assert_eq!(text(0x4F, 0x40, 8), "x1xx 0000");
        assert_eq!(text(0x14F, 0x40, 0), "0 x1xx 0000", "the type is unknown");
        assert_eq!(text(u32::MAX, 0, 32), "0000 0000 0000 0000 0000 0000 0000 0000");
    }
}
