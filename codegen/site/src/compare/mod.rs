//! Compares two versions of a description. Each change states whether it breaks Rust code, the communication or the
//! behavior.
//!
//! ```
//! use lexibus_codegen::compile::{check, Options};
//! use lexibus_codegen::source::Source;
//! use lexibus_site::compare::{compare, Effect};
//!
//! let eds = |access: &str| {
//!     let text = format!("[DeviceInfo]\n[ManufacturerObjects]\nSupportedObjects=1\n1=0x2000\n\
//!                         [2000]\nParameterName=Gain\nDataType=6\nAccessType={access}\n");
//!     check(Source::new("d.eds", text.into()), &Options::default()).catalog.expect("a device")
//! };
//! let changes = compare(&eds("rw"), &eds("ro"));
//! assert_eq!((changes.len(), changes[0].judgment.api), (1, Effect::Breaking));
//! assert_eq!(changes[0].to_string(), "breaks api: 0x2000:00 Gain: access rw, now ro");
//! ```
//!
//! The comparison covers all fields of the intermediate representation. Each call of the macro `compare_fields` or
//! `rules` gives the reasons for its ignored fields.

mod bindings;
mod catalog;
mod change;
mod codes;
mod comparison;
mod conditions;
mod devices;
mod ethercat;
mod groups;
mod identity;
mod item;
mod machines;
mod messages;
mod modules;
mod names;
mod pairing;
mod pdos;
mod profinet;
mod show;
mod slots;
mod texts;
mod types;

pub use catalog::{compare, compare_devices};
pub use change::{Change, Class, Effect, Judgment, Summary};
