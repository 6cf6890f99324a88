//! Converts EDS and DCF files (CiA 306-1) to IR.
//!
//! [`read`] reads the sections of a file in one pass. The values in header sections are stored in the device directly.
//! Object sections may have any order in the file, so they are sorted by index first.
//!
//! | file | subject |
//! |---|---|
//! | `file` | the sections of a file, sorted by subject |
//! | `sections` | kinds of sections by name |
//! | `reader` | reads single entries |
//! | `header` | `[FileInfo]`, `[DeviceInfo]`, `[DummyUsage]`, `[Comments]`, `[DeviceComissioning]`, `[DynamicChannels]` |
//! | `lists` | the object lists, and their comparison with the described objects |
//! | `keywords` | the keywords of an object, and the assignment of entries to keywords |
//! | `object` | an object and its sub-indices |
//! | `compact` | CompactSubObj, and the names, values and denotations of its sub-indices |
//! | `modules` | modular devices |

mod compact;
mod file;
mod header;
mod keywords;
mod lists;
mod modules;
mod object;
mod reader;
mod sections;

pub use file::read;
