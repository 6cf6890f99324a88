//! PROFINET device descriptions (GSDML V1.0 to V2.45) to IR.
//!
//! A file describes a family of devices. Every device access point becomes a [`Device`](crate::ir::Device); modules and
//! submodules, which several of them take, belong to the catalogue, as do the types of their data. A file is read once,
//! from top to bottom, straight into the IR. What an element refers to often stands behind it, and the texts stand at the
//! very end: references are held with their places, and followed when the end is reached.
//!
//! Versions differ in what elements and attributes they have, not in what these mean. No version is told from another
//! here; what this front end doesn't know is kept, so that files of later versions can be read as well.
//!
//! | file | subject |
//! |---|---|
//! | `document`, `lists` | a file, and its lists of pictures and categories |
//! | `reader` | the state of reading; identifiers, references to texts, required attributes |
//! | `number` | numbers, truth values and lists |
//! | `text_references`, `text_list`, `resolve` | references to texts, the text list, and texts in the place of the references |
//! | `links` | identifiers of elements, and references to them |
//! | `header` | name and version of the file, vendor, family |
//! | `device` | device access points |
//! | `module`, `module_info` | modules, and what submodules and device access points have in common with them |
//! | `submodule` | submodules, interfaces and ports |
//! | `io_data` | cyclic data |
//! | `record`, `parameter` | parameter records |
//! | `location`, `value` | bits and types of values; defaults and allowed values |
//! | `safety` | parameters of PROFIsafe |
//! | `data_type`, `types`, `value_list` | data types, types of the catalogue, named values |
//! | `diagnosis` | diagnosis, alarms and log book |

mod data_type;
mod device;
mod diagnosis;
mod document;
mod header;
mod io_data;
mod links;
mod lists;
mod location;
mod module;
mod module_info;
mod number;
mod parameter;
mod reader;
mod record;
mod resolve;
mod safety;
mod submodule;
mod text_list;
mod text_references;
mod types;
mod value;
mod value_list;

pub use document::read;
