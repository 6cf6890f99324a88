//! A cell of a drawing. Its label is the part of the name that fits.

use super::words;

/// Width of a letter, and the margin of a text.
const LETTER: u32 = 7;

/// A field of a drawing, or the part of a field in one row.
#[derive(Debug)]
pub(super) struct Cell {
    pub left: u32,
    pub width: u32,
    pub middle: u32,
    pub label: String,
    /// Whether the bits are unused.
    pub is_padding: bool,
}

impl Cell {
    pub fn new(left: u32, width: u32, name: &str) -> Self {
        let room = (width.saturating_sub(LETTER) / LETTER) as usize;
        Cell { left, width, middle: left + width / 2, label: words::cut(name, room), is_padding: false }
    }

    /// Creates a cell without a name.
    pub fn padding(left: u32, width: u32) -> Self {
        Cell { is_padding: true, ..Cell::new(left, width, "") }
    }
}
