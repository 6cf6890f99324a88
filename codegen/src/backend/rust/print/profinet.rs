//! Prints the code for PROFINET devices.

mod diagnosis;
mod image;
mod record;
mod values;

use crate::backend::rust::code::{line, open, Code, Data, Doc};
use crate::backend::rust::profinet::{FieldModel, FileModel, ModuleModel, SubmoduleModel};

/// Writes the code of a file: device access points, modules, submodules, enumerations and diagnosis.
pub(in crate::backend::rust) fn write(code: &mut Code, file: &FileModel<'_>) {
    for point in &file.access_points {
        if file.is_single {
            code.declare(&point.constants);
            continue;
        }
        code.module(&point.heading, point.name, |code| {
            code.use_runtime();
            code.declare(&point.constants);
        });
    }
    if !file.modules.is_empty() {
        code.module("Modules that can be plugged into the device.", "modules", |code| {
            file.modules.iter().for_each(|module| self::pluggable(code, module));
        });
    }
    if !file.submodules.is_empty() {
        code.module("Submodules with their cyclic data and parameter records.", "submodules", |code| {
            file.submodules.iter().for_each(|submodule| self::submodule(code, submodule));
        });
    }
    if !file.values.is_empty() {
        code.module("Enumerations: named values of fields.", "values", |code| {
            file.values.iter().for_each(|enumeration| values::write(code, enumeration));
        });
    }
    if !file.errors.is_empty() || !file.units.is_empty() {
        code.module("Diagnosis: channel errors and user structures.", "diagnosis", |code| {
            diagnosis::write(code, file);
        });
    }
}

fn pluggable(code: &mut Code, module: &ModuleModel<'_>) {
    code.docs(&module.docs);
    open!(code, "pub mod ", module.name, " {");
    code.use_runtime();
    code.declare([&module.constant]);
    code.close("}");
}

fn submodule(code: &mut Code, submodule: &SubmoduleModel<'_>) {
    code.docs(&submodule.docs);
    open!(code, "pub mod ", submodule.name, " {");
    code.use_runtime();
    if submodule.uses_values {
        line!(code, "use super::super::values;");
    }
    code.declare([&submodule.constant]);
    submodule.images.iter().for_each(|image| image::write(code, image));
    submodule.records.iter().for_each(|record| record::write(code, record));
    if let Some(record) = &submodule.f_record {
        record::f_parameters(code, record);
    }
    code.close("}");
}

/// Writes the fields of a struct.
fn fields(code: &mut Code, fields: &[FieldModel]) {
    for field in fields {
        code.field(&field.docs, field.attribute.as_ref(), &field.name, &field.ty);
    }
}

/// Returns a struct literal with these fields.
fn literal(fields: Vec<(&str, Doc)>) -> Doc {
    if fields.is_empty() {
        return Doc::from("Self {}");
    }
    Data::fields("Self", fields)
}
