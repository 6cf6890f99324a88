//! Concise DCF (CiA 302-3, 0x1F22): the number of entries, then index, sub-index, length and bytes of each value.

/// A value in a concise DCF: index and sub-index, and the bytes of the value.
pub type ConciseEntry<'b> = ((u16, u8), &'b [u8]);

/// Returns a concise DCF. All numbers are little-endian.
pub fn concise<'b>(entries: impl ExactSizeIterator<Item = ConciseEntry<'b>>) -> Vec<u8> {
    let mut bytes = (entries.len() as u32).to_le_bytes().to_vec();
    for ((index, sub_index), value) in entries {
        bytes.extend(index.to_le_bytes());
        bytes.push(sub_index);
        bytes.extend((value.len() as u32).to_le_bytes());
        bytes.extend(value);
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_follow_their_number() {
        let entries: [ConciseEntry; 2] = [((0x1017, 0), &[0xE8, 0x03]), ((0x6060, 1), &[7])];
        let expected = [2, 0, 0, 0, 0x17, 0x10, 0, 2, 0, 0, 0, 0xE8, 0x03, 0x60, 0x60, 1, 1, 0, 0, 0, 7];
        assert_eq!(concise(entries.into_iter()), expected);
    }
}
