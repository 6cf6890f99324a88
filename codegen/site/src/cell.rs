//! A box of a drawing, with as much of its name as there is room for.

use super::words;

/// Width of a letter, and the room beside a text.
const LETTER: u32 = 7;

/// What a field is drawn as, or the part of it that stands in a row.
#[derive(Debug)]
pub(super) struct Cell {
    pub left: u32,
    pub width: u32,
    pub middle: u32,
    pub label: String,
    /// Whether nobody uses it.
    pub is_padding: bool,
}

impl Cell {
    pub fn new(left: u32, width: u32, name: &str) -> Self {
        let room = (width.saturating_sub(LETTER) / LETTER) as usize;
        Cell { left, width, middle: left + width / 2, label: words::cut(name, room), is_padding: false }
    }

    /// Room without a name.
    pub fn padding(left: u32, width: u32) -> Self {
        Cell { is_padding: true, ..Cell::new(left, width, "") }
    }
}
