//! The Rust back end: generates one module for each device.
//!
//! [`emit`] lowers a device to plain data (`model`), which `print` writes as code. `code` breaks long lines as
//! `prettyplease` does.

mod axes;
mod bit_field;
mod bus_facts;
mod calls;
mod catalog;
mod cia402;
mod code;
mod code_table;
mod code_type;
mod composite;
mod configuration;
mod constants;
mod constructor;
mod context;
mod definitions;
mod device_models;
mod device_names;
mod doc_table;
mod docs;
mod emit;
mod enumeration;
mod ethercat;
mod example;
mod field_type;
mod given;
mod handle;
mod identity;
mod item;
mod item_addresses;
mod item_type;
mod links;
mod literal;
mod located;
mod locations;
mod machine;
#[cfg(feature = "messages")]
mod messages;
mod method_names;
mod model;
mod named;
mod naming;
mod objects;
mod options;
mod pdo;
mod print;
mod procedure;
mod profiles;
#[cfg(feature = "gsdml")]
mod profinet;
mod program;
mod quantity;
mod reachable;
mod reexport;
mod remap;
mod route;
mod scope;
mod shareable;
mod simulation;
mod slot_dependency;
mod table;
mod target;
mod value_type;
mod variant;
mod walk;
mod window;
mod window_model;
mod words;

pub use calls::{Calls, RecordUsage, Usage};
pub use device_names::{module_name, stem_name as file_name};
pub use emit::{device_name, emit, emit_catalog, usage, usage_of_modules, usage_of_records, write_catalog};
pub use options::{Presence, RustOptions};
pub use print::INTERFACE_VERSION;
#[cfg(feature = "gsdml")]
pub use profinet::{profinet_program, ProfinetData, ProfinetProgram};
pub use program::{program, Program, ProgramCia402, ProgramItem, ProgramMachine};
pub use simulation::Simulation;
pub use target::NoTarget;
