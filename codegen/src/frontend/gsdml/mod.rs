//! Converts PROFINET device descriptions (GSDML V1.0 to V2.45) to IR.
//!
//! A file describes a family of devices. Each device access point becomes a [`Device`](crate::ir::Device). Modules,
//! submodules and the types of their data belong to the catalog, because several devices can use them. A file is read
//! once, from top to bottom, directly into the IR. Many references come before their targets, and the texts are at the
//! end of the file. References are therefore collected, and resolved at the end.
//!
//! GSDML versions differ only in the elements and attributes that they define. This front end reads all versions of
//! GSDML in the same way. The front end also reads files of later versions, because unknown elements and attributes
//! become extensions.
//!
//! | file | subject |
//! |---|---|
//! | `document`, `lists` | a file, and its lists of graphics and categories |
//! | `reader` | reader state; identifiers, references to texts, required attributes |
//! | `number` | numbers, Boolean values and lists |
//! | `text_list`, `resolve` | the text list, and the resolution of references to texts |
//! | `links` | identifiers of elements, and references to them |
//! | `header` | name and version of the file, vendor, family |
//! | `device` | device access points |
//! | `module`, `module_info` | modules, and ModuleInfo of modules, submodules and device access points |
//! | `submodule` | submodules, interfaces and ports |
//! | `io_data` | cyclic data |
//! | `record`, `parameter` | parameter records |
//! | `location`, `value` | locations and types of values; defaults and allowed values |
//! | `safety` | parameters of PROFIsafe |
//! | `data_type`, `types`, `value_list` | data types, types of the catalog, named values |
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
mod types;
mod value;
mod value_list;

pub use document::read;
