//! Exports a device with objects as an EDS or DCF file (CiA 306). Reading the file gives the same objects again, except
//! for the facts in [`Export::notes`].
//!
//! If the source is an EDS, the export contains the repaired facts. The notation of values follows the standard. Sections
//! without extension attributes have the order of the standard. Extension attributes and comments stay in their sections. If the
//! source has another format, the export has the facts that CiA 306 can express. [`Export::notes`] lists the facts that were
//! left out or changed.
//!
//! | file | subject |
//! |---|---|
//! | `context`, `file` | options; the file: the order of its sections |
//! | `writer` | sections, entries, comments; texts without line breaks |
//! | `extras` | sections of extension attributes |
//! | `header` | `[FileInfo]`, `[DeviceInfo]` and the other sections about the file and the device |
//! | `file_info` | conversion of the header of another format |
//! | `object`, `compact` | objects; CompactSubObj |
//! | `data_type`, `value` | types as numbers, values as texts |
//! | `modules` | modular devices |
//! | `mapping` | mapping objects that the dictionary does not have |
//! | `losses` | facts that CiA 306 cannot hold |

mod compact;
mod context;
mod data_type;
mod extras;
mod file;
mod file_info;
mod header;
mod losses;
mod mapping;
mod modules;
mod object;
mod section;
mod value;
mod writer;

pub use super::note::{Export, Note, NoteKind};
use super::{note, registers};
use context::{is_coe_only, Context};
pub use context::{Flavor, Options, Reals};
pub use file::export;
