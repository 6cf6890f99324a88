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
mod image;
mod program;
mod record;
mod scope;
mod types;
mod usage;
mod values;

use super::code::{Code, Doc};
use super::RustOptions;
use super::{literal, print};
use crate::ir::Catalog;
pub(super) use descriptor::{DapModel, ModuleModel, SubmoduleModel};
pub(super) use diagnosis::UnitModel;
pub(super) use f_record::FRecordModel;
pub(super) use image::{FieldModel, ImageModel};
pub use program::{profinet_program, ProfinetData, ProfinetProgram};
pub(super) use record::RecordModel;
use scope::Scope;
pub(super) use usage::usage_of_records;
pub(super) use values::Enumeration;

/// All device access points of a file, ready to be printed.
pub(super) struct FileModel<'a> {
    pub access_points: Vec<DapModel<'a>>,
    /// True if the file has a single device access point. The code of a single device access point is at the top level
    /// of the output.
    pub is_single: bool,
    pub modules: Vec<ModuleModel<'a>>,
    pub submodules: Vec<SubmoduleModel<'a>>,
    pub values: Vec<&'a Enumeration>,
    /// Channel errors as elements of a table.
    pub errors: Vec<Doc>,
    /// User-defined diagnosis structures.
    pub units: Vec<UnitModel>,
}

/// Adds all device access points of `catalog` to `code`. Returns false if there are none.
pub(super) fn emit(catalog: &Catalog, options: &RustOptions, mut code: Code<'_>) -> bool {
    let scope = Scope::new(catalog, options);
    if scope.access_points.is_empty() {
        return false;
    }
    print::start(&mut code);
    print::profinet::write(&mut code, &FileModel::new(&scope));
    code.finish();
    true
}

impl<'a> FileModel<'a> {
    fn new(scope: &'a Scope<'_>) -> Self {
        let modules = scope.modules.values();
        let submodules = scope.submodules.values();
        FileModel {
            access_points: scope.access_points.iter().map(|point| descriptor::access_point(scope, point)).collect(),
            is_single: scope.is_single(),
            modules: modules.map(|(module, name)| descriptor::module(scope, module, name)).collect(),
            submodules: submodules.map(|(submodule, name)| descriptor::submodule(scope, submodule, name)).collect(),
            values: scope.values.iter().collect(),
            errors: diagnosis::channel_errors(scope.catalog),
            units: diagnosis::units(scope.catalog, &scope.values, scope.options),
        }
    }
}
