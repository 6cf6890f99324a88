//! XDD, XDC and XPD files (CiA 311, versions 1.0 and 1.1) to IR.
//!
//! A file has two profiles: one of the device (identity, application process), one of the communication network (object
//! list, bit rates, network management). An object may carry all of its facts, or refer to a parameter of the
//! application process, which may follow it. So [`read`] goes through the file once, where it reads everything but
//! the objects and notes the positions of those, and then reads the objects in the order of their indices.
//!
//! The IR is that of the same device described by an EDS. A version 1.0 differs from 1.1 in its namespace and in what an
//! object may leave to a parameter, neither of which needs a case of its own here.
//!
//! | file | subject |
//! |---|---|
//! | `document` | a file with its profiles |
//! | `reader`, `number` | the state of reading; labels and numbers |
//! | `identity` | file, vendor, product |
//! | `network` | bit rates, network management, dummy entries, dynamic channels, commissioning |
//! | `modules` | slots of modular devices |
//! | `process`, `parameter`, `data_type_list`, `data_type` | reading the application process |
//! | `application` | its parameters, templates and data types by their identifiers |
//! | `types` | its data types to types |
//! | `object_list`, `objects` | objects and their sub-objects |
//! | `item` | from an object and the parameter it refers to, to an item |

mod application;
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
