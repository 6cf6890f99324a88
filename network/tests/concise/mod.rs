//! Reads concise DCF.

/// Returns the entries of a concise DCF: index, sub-index and bytes.
pub fn entries(mut bytes: &[u8]) -> Vec<(u16, u8, Vec<u8>)> {
    let mut take = |length: usize| {
        let (taken, rest) = bytes.split_at(length);
        bytes = rest;
        taken.to_vec()
    };
    let number = |bytes: &[u8]| bytes.iter().rev().fold(0usize, |number, byte| number << 8 | usize::from(*byte));
    let count = number(&take(4));
    let mut entry = || {
        let (index, sub_index, length) = (number(&take(2)) as u16, take(1)[0], number(&take(4)));
        (index, sub_index, take(length))
    };
    let list = (0..count).map(|_| entry()).collect();
    assert!(bytes.is_empty());
    list
}
