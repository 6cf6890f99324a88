//! The Lexibus compiler. It reads and checks the description of a fieldbus device, and generates typed Rust code.
//!
//! Use it in a build script:
//!
//! ```no_run
//! // build.rs
//! fn main() -> Result<(), lexibus_codegen::BuildError> {
//!     lexibus_codegen::Builder::new().compile("drive.eds")
//! }
//! ```
//!
//! The pipeline:
//!
//! ```text
//! source -> syntax -> frontend/{eds, xdd, esi, gsdml, table} -> ir -> resolve -> check -> facts -> backend/rust
//! ```
//!
//! | subject | module |
//! |---|---|
//! | build scripts | [`Builder`] |
//! | programs that read descriptions | [`compile`], [`selection`], and the result, [`ir`] |
//! | errors and warnings | [`diagnostics`], and the list of codes, [`diagnostics::codes`] |
//! | facts in documentation | [`facts`] |
//! | generated Rust | [`backend::rust`] |
//! | texts in messages | [`text`], and numbers, [`number`] |
//! | writing output files | [`output`] |
//!
//! Other crates use the same [`ir`]: `lexibus-site` generates documentation and compares versions, and `lexibus-export` writes
//! EDS, DCF, ESI, GSDML and JSON. `lexibus-import` converts lists of registers (CSV) to register tables, `lexibus-device`
//! accesses devices on a bus, and `lexibus-cli` is the command `lexibus`.
//! [The book](https://github.com/lexibus/lexibus/blob/main/docs/src/SUMMARY.md)
//! has a chapter for each format, and a chapter about writing a front end.
//!
//! # Features
//!
//! Each format has a feature: `eds` (EDS and DCF), `xdd` (XDD and XDC), `esi`, `gsdml` (with code generation for PROFINET) and
//! `table` (register tables and overlays). The feature `messages` is for command protocols in register tables. All features
//! mentioned so far are on by default. Profiles do not need a feature. A build script compiles faster with only the features that
//! it needs:
//!
//! ```toml
//! [build-dependencies]
//! lexibus-codegen = { version = "0.1", default-features = false, features = ["eds"] }
//! ```
//!
//! With the feature `serde`, the types of [`ir`] implement the traits of the crate `serde`. This feature is off by default.
//!
//! Programs can use each stage separately:
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
//! for diagnostic in compilation.diagnostics.list() {
//!     println!("{}: {}", diagnostic.code.id, diagnostic.message);
//! }
//! ```
#![forbid(unsafe_code)]

pub mod backend;
pub mod builder;
pub mod check;
pub mod collections;
pub mod compile;
pub mod diagnostics;
pub mod etg;
pub mod facts;
pub mod frontend;
pub mod ir;
pub mod limits;
pub mod names;
pub mod number;
pub mod output;
pub mod resolve;
pub mod selection;
pub mod source;
pub mod syntax;
pub mod text;
pub mod unique;

pub use backend::rust::{Presence, RustOptions};
pub use builder::{BuildError, Builder};
pub use diagnostics::Level;
