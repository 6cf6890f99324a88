//! PROFINET devices: submodules, parameter records, diagnosis, and statics with which a program plans the modules in
//! slots.
//!
//! The device access points of a file share modules and submodules. No code is generated for modules and submodules
//! that fit into none of the device access points.

mod descriptor;
mod diagnosis;
mod docs;
mod f_record;
mod field;
mod file;
mod image;
mod program;
mod record;
mod scope;
mod types;
mod usage;
mod values;

pub(super) use descriptor::{ModuleModel, SubmoduleModel};
pub(super) use diagnosis::UnitModel;
pub(super) use f_record::FRecordModel;
pub(super) use file::{emit, FileModel};
pub(super) use image::{FieldModel, ImageModel};
pub use program::{profinet_program, ProfinetData, ProfinetProgram};
pub(super) use record::RecordModel;
pub(super) use usage::usage_of_records;
pub(super) use values::Enumeration;
