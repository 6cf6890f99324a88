//! The network compiler of Lexibus: checks the configuration of a CANopen network, and writes DCF, concise DCF, DBC and typed Rust.
//! Writes the configuration of an EtherCAT segment as JSON and Rust.
//!
//! ```
//! use lexibus_codegen::diagnostics::Levels;
//! use lexibus_codegen::source::Source;
//! use lexibus_network::check::bus_load;
//! use lexibus_network::compile::compile;
//! use lexibus_network::output::files;
//!
//! // The descriptions of the nodes are in the folder of the network file.
//! let example = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/network/network.toml");
//! let compilation = compile(Source::read(example.as_ref())?, Levels::lenient());
//! let network = compilation.usable().expect("a network without errors");
//! assert!(bus_load(network).ratio() < 0.5);
//! let names: Vec<String> = files(network).into_iter().map(|file| file.name).collect();
//! assert!(names.contains(&"axis1.bin".to_owned()) && names.contains(&"master.dcf".to_owned()));
//! # Ok::<(), std::io::Error>(())
//! ```
//!
//! | stage | module |
//! |---|---|
//! | trees of TOML and YAML with spans | [`syntax`] |
//! | network files in each format | [`frontend`] |
//! | the values that a file declares | [`declared`] |
//! | device descriptions of the nodes | [`description`] |
//! | look-up of objects and PDOs, values as bytes | [`resolve`] |
//! | the resolved network | [`model`] |
//! | values of objects after the configuration | [`values`] |
//! | faults that would occur on the bus | [`check`] |
//! | EtherCAT segments | [`ethercat`] |
//! | output files | [`output`] |
//!
//! [`compile`](compile::compile) runs the stages before the output.

#![forbid(unsafe_code)]

pub mod check;
pub mod compile;
pub mod declared;
pub mod description;
pub mod ethercat;
pub mod frontend;
pub mod model;
pub mod output;
pub mod resolve;
pub mod syntax;
pub mod values;
