//! Exports devices from any input format as EDS or DCF (CiA 306), ESI (ETG.2000), EEPROM content of EtherCAT slaves
//! (SII) or GSDML. Also writes the IR as JSON, and diagnostics as JSON lines, SARIF or annotations of GitHub.
//!
//! Facts that the output format cannot express are left out or changed. [`Export::notes`] lists these facts.
//!
//! ```
//! use lexibus_codegen::compile::{check, Options};
//! use lexibus_codegen::source::Source;
//! use lexibus_export::eds;
//!
//! let table = "lexibus = 1\n[device]\nname = \"Pump\"\nbuses = [\"canopen\"]\n[[chapters]]\n[chapters.objects]\n\
//!              0x2000 = { name = \"Speed\", type = \"u16\", access = \"rw\" }\n";
//! let catalog = check(Source::new("pump.toml", table.into()), &Options::default()).catalog.expect("a device");
//! let file = eds::export(&catalog, &catalog.devices[0], eds::Flavor::Eds).expect("a device with objects");
//! assert!(file.text.contains("[2000]\r\nParameterName=Speed\r\n"));
//! ```

#![forbid(unsafe_code)]

pub mod diagnostics;
pub mod eds;
pub mod esi;
pub mod gsdml;
pub mod json;
mod note;
mod options;
mod registers;
pub mod sii;
mod types;
mod xml;

pub use note::{Export, Note, NoteKind};
pub use options::{MissingFact, Refusal};
