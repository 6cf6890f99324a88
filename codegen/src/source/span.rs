//! Positions in a source file.

use std::ops::Range;

/// Which file of a compilation: an index into its list of sources.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FileId(pub u32);

/// A range of bytes of a decoded source. The empty span at 0 stands for "nowhere in particular".
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Span {
    /// The file.
    pub file: FileId,
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
}

impl Span {
    /// The span `start..end` of `file`.
    pub const fn new(file: FileId, start: u32, end: u32) -> Self {
        Span { file, start, end }
    }

    /// The bytes as a range to index with.
    pub fn range(self) -> Range<usize> {
        self.start as usize..self.end as usize
    }

    /// Whether this span points nowhere.
    pub fn is_empty(self) -> bool {
        self.start >= self.end
    }

    /// This span where it points somewhere, else `other`.
    pub fn or(self, other: Span) -> Span {
        if self.is_empty() {
            other
        } else {
            self
        }
    }
}

/// Where an element of the IR stands in its file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Origin {
    /// The section header, element or row that declares the element.
    pub span: Span,
    /// Its line, counted from 1; 0 where the element was derived and stands nowhere.
    pub line: u32,
}

impl Origin {
    /// Whether the compiler derived the element from others, so that it stands nowhere.
    pub fn is_derived(&self) -> bool {
        self.line == 0
    }
}

/// Line and column, both counted from 1; the column counts characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Position {
    /// Line.
    pub line: u32,
    /// Column.
    pub column: u32,
}
