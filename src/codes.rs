//! Tables of codes: alarms, emergency codes, abort codes.

/// A row of a table of codes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Code {
    /// The code; the first of a range.
    pub first: i64,
    /// The last code of a range; else the same.
    pub last: i64,
    /// What it is called.
    pub name: &'static str,
    /// Cause and remedy; empty where the source says nothing.
    pub text: &'static str,
    /// The table's other columns, in its order.
    pub cells: &'static [Cell],
}

impl Code {
    /// A row.
    #[must_use]
    pub const fn new(first: i64, last: i64, name: &'static str, text: &'static str, cells: &'static [Cell]) -> Self {
        Self { first, last, name, text, cells }
    }
}

/// A cell of a further column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cell {
    /// Nothing.
    Empty,
    /// An integer.
    Number(i64),
    /// A number with a fraction.
    Real(f64),
    /// A text.
    Text(&'static str),
}

/// The row of a code: where several ranges have it, that of the narrowest.
///
/// ```
/// use lexibus::codes::{self, Code};
///
/// const EMERGENCY: &[Code] = &[
///     Code::new(0x8100, 0x81FF, "communication", "", &[]),
///     Code::new(0x8110, 0x8110, "CAN overrun", "A message was lost", &[]),
/// ];
/// assert_eq!(codes::find(EMERGENCY, 0x8110).map(|code| code.name), Some("CAN overrun"));
/// assert_eq!(codes::find(EMERGENCY, 0x8111).map(|code| code.name), Some("communication"));
/// assert_eq!(codes::find(EMERGENCY, 0x1000), None);
/// ```
#[must_use]
pub fn find(codes: &[Code], code: i64) -> Option<&Code> {
    let rows = codes.iter().filter(|row| (row.first..=row.last).contains(&code));
    rows.min_by_key(|row| row.last.abs_diff(row.first))
}
