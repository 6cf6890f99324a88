//! A cell of a drawing. If the cell is wide enough, its label is the name of the field.

/// Approximate width of a letter in pixels.
const LETTER: u32 = 7;

/// A field in a drawing. A field that spans several rows has a cell in each row.
#[derive(Debug)]
pub(super) struct Cell {
    pub left: u32,
    pub width: u32,
    pub middle: u32,
    pub label: String,
}

impl Cell {
    pub fn new(left: u32, width: u32, name: &str) -> Self {
        let does_fit = name.chars().count() as u32 * LETTER + LETTER <= width;
        let label = if does_fit { name.to_owned() } else { String::new() };
        Cell { left, width, middle: left + width / 2, label }
    }
}
