//! Bounds on what a description may make the compiler do.
//!
//! Reading takes time and memory in proportion to the input. Where a short line stands for many elements, these limits
//! keep it so. They lie far above anything a real device has.

pub use crate::source::{MAX_INPUT_BYTES, MAX_REFERENCES};

/// Diagnostics of one code in one file that are kept; more are counted.
pub const MAX_SAME_DIAGNOSTICS: usize = 10_000;

/// Items that one row of a register table may stand for.
pub const MAX_REPEAT: u32 = 0x1_0000;

/// Items that a file may declare without a line for each, in total: through CompactSubObj of an EDS, through arrays and shared
/// dictionaries of an ESI, through `count` of a register table; and copies of named values that types of GSDML need.
pub const MAX_DERIVED_ITEMS: usize = 200_000;

/// Implicit PDOs that a file may declare through CompactPDO, per direction (CiA 301 knows 512).
pub const MAX_IMPLICIT_PDOS: u16 = 512;

/// How many unknown keys of a section a further one is compared with to find a repeated one.
pub const MAX_COMPARED_EXTENSIONS: usize = 64;

/// Messages of a register table: each is compared with all others.
pub const MAX_MESSAGES: usize = 4_096;

/// Unknown keys of one piece of a register table, such as a row or a list of codes, that are passed over.
pub const MAX_UNKNOWN_KEYS: usize = 100;

/// States, commands, transitions, rows and notes of all state machines of a device: what leaves any state is written for each.
pub const MAX_MACHINE_ROWS: usize = 2_048;

/// Bytes of a row of a register table, and of what it inherits, that may be copied at no cost.
pub const MAX_FREE_ROW_BYTES: usize = 4096;

/// Bytes beyond them that count as one of [`MAX_DERIVED_ITEMS`] for every copy.
pub const ROW_BYTES_PER_ITEM: usize = 1024;

/// Bytes of data types, flags, vendors and shared files (ESI), parameters (XDD), texts of CompactSubObj and names of sections (EDS) that may be copied, for each
/// byte of the file. One object a type is the rule.
pub const MAX_COPIES_PER_BYTE: usize = 64;

/// Depth to which XML elements may be nested.
pub const MAX_XML_DEPTH: usize = 128;

/// Modules that all slots of a description may take together.
pub const MAX_MODULE_USES: usize = 200_000;

/// Pages of a documentation of one kind that are all linked on each page.
pub const MAX_LINKED_PAGES: usize = 200;

/// Of more, so many before and behind a page are.
pub const NEAR_LINKED_PAGES: usize = 20;

/// Bytes of text that a GSDML file may copy by referring to its text list, for each byte of the file.
pub const MAX_TEXT_COPIES_PER_BYTE: usize = 8;

/// Bytes of text that any GSDML file may copy so.
pub const MIN_TEXT_COPIES: usize = 1 << 20;

/// Values that a range of a register table stands for where single values are meant.
pub const MAX_LISTED_VALUES: i128 = 1024;

/// Depth to which folders are searched for descriptions.
pub const MAX_FOLDER_DEPTH: usize = 32;

/// Names of a register table that texts are searched for.
pub const MAX_SEARCHED_NAMES: usize = 5_000;

/// Words of texts that they are looked for in.
pub const MAX_SEARCHED_WORDS: usize = 50_000;

/// Bits of an entry of a PDO that becomes a field.
pub const MAX_FIELD_BITS: u32 = u16::MAX as u32;

/// Bytes of a PROFINET record, or of what a diagnosis adds, that becomes a struct.
pub const MAX_RECORD_BYTES: u32 = u16::MAX as u32;

/// Letters of an identifier that a name gives.
pub const MAX_IDENTIFIER: usize = 48;
