//! Converts XDD, XDC and XPD files (CiA 311, versions 1.0 and 1.1) to IR.
//!
//! A file has two profiles. The device profile contains the identity and the application process. The communication
//! network profile contains the object list, bit rates and network management.
//!
//! An object either contains all of its facts, or refers to a parameter of the application process, which may come
//! later in the file. [`read`] therefore reads the file once and records only the positions of the objects. The objects
//! are then read in the order of their indices.
//!
//! The IR is the same as for an EDS file of the device. The CiA 311 versions 1.0 and 1.1 differ only in the namespace,
//! and in the object attributes that a parameter may supply. The front end reads both versions in the same way.
//!
//! | file | subject |
//! |---|---|
//! | `document` | a file with its profiles |
//! | `reader`, `number`, `attributes` | reader state; labels, numbers, and lists of attributes |
//! | `identity` | file, vendor, product |
//! | `network` | bit rates, network management, dummy entries, dynamic channels, commissioning |
//! | `modules` | slots of modular devices |
//! | `process`, `parameter`, `data_type_list`, `data_type` | the application process |
//! | `application` | parameters, templates and data types by their identifiers |
//! | `types` | conversion of data types of the application process to types of the IR |
//! | `object_list`, `objects` | positions of the objects; objects and their sub-objects |
//! | `item` | conversion of an object and its parameter to an item |

mod application;
mod attributes;
mod data_type;
mod data_type_list;
mod document;
mod identity;
mod item;
mod modules;
mod network;
mod number;
mod object_list;
mod objects;
mod parameter;
mod process;
mod reader;
mod types;

pub use document::read;
