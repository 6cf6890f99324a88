//! Limits for the time and memory that a description can use.
//!
//! A short line can declare many elements. The limits therefore keep time and memory proportional to the length of the input.
//! Descriptions of real devices stay far below the limits.

pub use crate::source::{MAX_INPUT_BYTES, MAX_REFERENCES};

/// Maximum number of diagnostics with the same code in one file. Further diagnostics are only counted.
pub const MAX_SAME_DIAGNOSTICS: usize = 10_000;

/// Maximum number of items that one row of a register table can describe.
pub const MAX_REPEAT: u32 = 0x1_0000;

/// Maximum number of derived items in a file. A derived item has no separate line in the file.
///
/// Derived items come from CompactSubObj of an EDS, arrays and shared dictionaries of an ESI, and `count` of a register table. For
/// GSDML, the limit applies to the values that are copied if a value list is used with several types. In addition, the limit
/// applies to the items that `import` creates.
pub const MAX_DERIVED_ITEMS: usize = 200_000;

/// Maximum number of implicit PDOs (CompactPDO) in each direction. CiA 301 defines 512 PDOs in each direction.
pub const MAX_IMPLICIT_PDOS: u16 = 512;

/// Maximum number of unknown keys in an EDS section, or attributes in an XML tag, that are compared with each other to
/// find repeated names.
pub const MAX_COMPARED_EXTENSIONS: usize = 64;

/// Maximum number of messages of a register table. The number is limited because each message is compared with all others.
pub const MAX_MESSAGES: usize = 4_096;

/// Maximum number of unknown keys that the compiler reports in one part of a register table, such as a row or a list of codes. A
/// part with more unknown keys is left out.
pub const MAX_UNKNOWN_KEYS: usize = 100;

/// Maximum number of states, commands, transitions, rows and notes of all state machines of a device. The number must be limited
/// because a transition from any state is generated for each state.
pub const MAX_MACHINE_ROWS: usize = 2_048;

/// Length in bytes up to which copies of a row, unit or `defaults` table of a register table do not count as additional
/// items.
pub const MAX_FREE_ROW_BYTES: usize = 4096;

/// Number of copied bytes that count as one additional item toward [`MAX_DERIVED_ITEMS`], not counting the first
/// [`MAX_FREE_ROW_BYTES`] bytes. In state machines, this number of copied bytes counts as one additional row toward
/// [`MAX_MACHINE_ROWS`].
pub const ROW_BYTES_PER_ITEM: usize = 1024;

/// Maximum number of copied bytes for each byte of the file. In most files, only one object uses each type, so little is copied.
///
/// The copied elements are data types, flags, vendors and shared files (ESI), parameters (XDD), texts of CompactSubObj and
/// section names (EDS).
pub const MAX_COPIES_PER_BYTE: usize = 64;

/// Maximum depth of nested XML elements.
pub const MAX_XML_DEPTH: usize = 128;

/// Maximum number of modules that all slots of a description accept, in total.
pub const MAX_MODULE_USES: usize = 200_000;

/// Maximum number of pages of one kind to which each page of a documentation site links.
pub const MAX_LINKED_PAGES: usize = 200;

/// Number of preceding pages, and number of following pages, to which a page links if there are more than [`MAX_LINKED_PAGES`]
/// pages.
pub const NEAR_LINKED_PAGES: usize = 20;

/// Maximum number of bytes that are copied for references to the text list of a GSDML file, for each byte of the file.
pub const MAX_TEXT_COPIES_PER_BYTE: usize = 8;

/// Number of bytes that may be copied for references to the text list of a GSDML file, even if the file is small.
pub const MIN_TEXT_COPIES: usize = 1 << 20;

/// Maximum number of single values in a list of values and ranges, for keys of a register table that need single values.
pub const MAX_LISTED_VALUES: i128 = 1024;

/// Maximum depth of folders in the search for descriptions.
pub const MAX_FOLDER_DEPTH: usize = 32;

/// Maximum number of item names and group names in a register table that the lint for misspelled names compares with words in
/// texts.
pub const MAX_SEARCHED_NAMES: usize = 5_000;

/// Maximum number of different words in texts that the lint for misspelled names compares with names.
pub const MAX_SEARCHED_WORDS: usize = 50_000;

/// Maximum length in bits of a PDO entry that becomes a field of a struct.
pub const MAX_FIELD_BITS: u32 = u16::MAX as u32;

/// Maximum length in bytes of a PROFINET record or diagnosis structure that becomes a struct.
pub const MAX_RECORD_BYTES: u32 = u16::MAX as u32;

/// Maximum number of characters of an identifier that is derived from a name.
pub const MAX_IDENTIFIER: usize = 48;
