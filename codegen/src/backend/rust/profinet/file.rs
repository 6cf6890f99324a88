//! All device access points of a file, as one module.

use super::descriptor::{self, DapModel, ModuleModel, SubmoduleModel};
use super::diagnosis::{self, UnitModel};
use super::scope::Scope;
use super::values::Enumeration;
use crate::backend::rust::code::{Code, Doc};
use crate::backend::rust::{print, RustOptions};
use crate::ir::Catalog;

/// All device access points of a file, ready to be printed.
pub struct FileModel<'a> {
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
pub fn emit(catalog: &Catalog, options: &RustOptions, mut code: Code<'_>) -> bool {
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
