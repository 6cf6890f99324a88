//! Spans and positions in a source file.

use std::ops::Range;

/// Number of a file in a compilation: an index into its list of sources.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FileId(pub u32);

/// A range of bytes of a decoded source. The empty span at 0 means "no position".
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Span {
    /// File that contains the range.
    pub file: FileId,
    /// Offset of the first byte.
    pub start: u32,
    /// Offset after the last byte.
    pub end: u32,
}

impl Span {
    /// Span of a missing element.
    pub const MISSING: Span = Span::new(FileId(0), 0, 0);

    /// Creates the span `start..end` of `file`.
    pub const fn new(file: FileId, start: u32, end: u32) -> Self {
        Span { file, start, end }
    }

    /// Returns the byte offsets as a range for indexing.
    pub fn range(self) -> Range<usize> {
        self.start as usize..self.end as usize
    }

    /// Returns whether the span is empty.
    pub fn is_empty(self) -> bool {
        self.start >= self.end
    }

    /// Returns this span if it is not empty, and otherwise `other`.
    pub fn or(self, other: Span) -> Span {
        if self.is_empty() {
            other
        } else {
            self
        }
    }
}

/// Position in a file at which an element of the IR is declared.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Origin {
    /// Span of the section header, XML element or row that declares the element.
    pub span: Span,
    /// Line of the declaration, counted from 1; 0 if the element was derived.
    pub line: u32,
}

impl Origin {
    /// Returns whether the compiler derived the element from other elements. For a derived element, `line` is 0.
    pub fn is_derived(&self) -> bool {
        self.line == 0
    }
}

/// Line and column, both counted from 1. The column counts characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Position {
    /// Line number.
    pub line: u32,
    /// Column number.
    pub column: u32,
}
