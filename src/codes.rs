//! Tables of codes, such as alarms, emergency codes and abort codes.

/// A row of a code table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Code {
    /// The code, or the first code of a range.
    pub first: i64,
    /// The last code of a range; equal to `first` for a single code.
    pub last: i64,
    /// Name of the code.
    pub name: &'static str,
    /// Cause of the code and remedy; empty if the device description has none.
    pub text: &'static str,
    /// Cells of the additional columns, in column order.
    pub cells: &'static [Cell],
}

impl Code {
    /// Creates a row of a code table.
    #[must_use]
    pub const fn new(first: i64, last: i64, name: &'static str, text: &'static str, cells: &'static [Cell]) -> Self {
        Self { first, last, name, text, cells }
    }
}

/// A cell of an additional column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cell {
    /// An empty cell.
    Empty,
    /// An integer.
    Number(i64),
    /// A number with a fraction.
    Real(f64),
    /// A text.
    Text(&'static str),
}

/// Enumeration of the codes of a table. The compiler generates one enumeration per table, which implements this trait.
///
/// ```
/// use lexibus::codes::{Code, CodeTable};
///
/// // The compiler generates this for a table of two codes:
/// static ALARMS: &[Code] = &[Code::new(7, 7, "motor blocked", "Let it move.", &[]), Code::new(0x80, 0x8F, "option", "", &[])];
///
/// #[derive(Clone, Copy, Debug, PartialEq)]
/// enum Alarms {
///     MotorBlocked,
///     Option(u16),
///     Unknown(u16),
/// }
///
/// impl CodeTable for Alarms {
///     type Raw = u16;
///
///     fn codes() -> &'static [Code] {
///         ALARMS
///     }
///
///     fn from_raw(code: u16) -> Self {
///         match code {
///             7 => Self::MotorBlocked,
///             0x80..=0x8F => Self::Option(code),
///             _ => Self::Unknown(code),
///         }
///     }
///
///     fn raw(self) -> u16 {
///         match self {
///             Self::MotorBlocked => 7,
///             Self::Option(code) | Self::Unknown(code) => code,
///         }
///     }
/// }
///
/// assert_eq!(Alarms::from_raw(7), Alarms::MotorBlocked);
/// assert_eq!(Alarms::MotorBlocked.row().map(|row| row.text), Some("Let it move."));
/// assert_eq!(Alarms::from_raw(8).row(), None);
/// ```
pub trait CodeTable: Copy {
    /// Integer type of the codes.
    type Raw: Copy + Into<i64>;

    /// Returns the rows of the table.
    fn codes() -> &'static [Code];

    /// Returns the variant for a code.
    fn from_raw(code: Self::Raw) -> Self;

    /// Returns the code as an integer.
    fn raw(self) -> Self::Raw;

    /// Returns the row of the code, or `None` if the table has no such row.
    fn row(self) -> Option<&'static Code> {
        find(Self::codes(), self.raw().into())
    }
}

/// Returns the row that contains a code, or `None` if no row contains the code. If several ranges contain the code, the
/// narrowest range applies.
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
