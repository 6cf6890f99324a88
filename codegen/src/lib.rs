//! The Lexibus compiler: reads the description of a fieldbus device, checks it, and generates typed Rust.
//!
//! From a build script, one line does it:
//!
//! ```no_run
//! // build.rs
//! fn main() -> Result<(), lexibus_codegen::BuildError> {
//!     lexibus_codegen::Builder::new().compile("drive.eds")
//! }
//! ```
//!
//! Underneath is a pipeline in which data flows one way:
//!
//! ```text
//! source -> syntax -> frontend/{eds, xdd, esi, gsdml, table} -> ir -> resolve -> check -> facts -> backend/rust
//! ```
//!
//! | for | see |
//! |---|---|
//! | a build script | [`Builder`] |
//! | a program that reads descriptions | [`compile`], [`selection`], and [`ir`] for what it gets |
//! | what is wrong with a description | [`diagnostics`], and the catalogue of codes, [`diagnostics::codes`] |
//! | what an output for people states | [`facts`] |
//! | Rust | [`backend::rust`] |
//! | texts within messages | [`text`] |
//! | files that are complete or untouched | [`output`] |
//!
//! Further crates start from the same [`ir`]: `lexibus-site` makes documentation and compares versions, `lexibus-export` writes EDS, DCF, ESI,
//! GSDML and JSON, `lexibus-import` turns lists of registers (CSV) into register tables, and `lexibus-cli` is the command `lexibus`.
//! [The book](https://github.com/lexibus/lexibus/blob/main/docs/src/SUMMARY.md)
//! has a chapter for each format, and one that writes a front end.
//!
//! # Features
//!
//! A feature for each format, all on by default: `eds` (EDS and DCF), `xdd` (XDD and XDC), `esi`, `gsdml` with the code for PROFINET, and `table`
//! (register tables and overlays); `messages` is for command protocols in register tables. Profiles need none. A build script that reads one
//! format compiles faster with that alone:
//!
//! ```toml
//! [build-dependencies]
//! lexibus-codegen = { version = "0.1", default-features = false, features = ["eds"] }
//! ```
//!
//! `serde` gives [`ir`] the traits of that crate; it is off by default.
//!
//! Each stage can be used by itself:
//!
//! ```
//! use lexibus_codegen::compile::{check, Options};
//! use lexibus_codegen::source::Source;
//!
//! let eds = "[DeviceInfo]\nProductName=Pump\n[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=rw\n";
//! let options = Options::default();
//! let compilation = check(Source::new("pump.eds", eds.into()), &options);
//! let device = &compilation.catalog.as_ref().unwrap().devices[0];
//! assert_eq!(device.entry(0x2000, 0).unwrap().name, "Speed");
//! assert!(compilation.rust(&options.rust).unwrap().contains("pub struct Pump"));
//! for finding in compilation.diagnostics.list() {
//!     // EDS042: 0x2000 is in none of the object lists, and more
//!     println!("{}: {}", finding.code.id, finding.message);
//! }
//! ```
#![forbid(unsafe_code)]

pub mod backend;
pub mod builder;
pub mod check;
pub mod compile;
pub mod diagnostics;
pub mod etg;
pub mod facts;
pub mod frontend;
pub mod ir;
pub mod limits;
pub mod names;
pub mod output;
mod profiles;
pub mod resolve;
pub mod selection;
pub mod source;
pub mod syntax;
pub mod text;
pub mod unique;

pub use backend::rust::{Presence, RustOptions};
pub use builder::{BuildError, Builder};
pub use diagnostics::Level;
