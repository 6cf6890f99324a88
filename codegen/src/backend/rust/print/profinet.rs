//! Prints the code for PROFINET devices.

mod diagnosis;
mod image;
mod record;
mod values;

use super::device::identity;
use crate::backend::rust::code::{line, list, open, Code, Data, Doc};
use crate::backend::rust::profinet::{DapModel, FieldModel, FileModel, ModuleModel, SubmoduleModel};
use crate::number::{hex16, hex32};

/// Writes the code of a file: device access points, modules, submodules, enumerations and diagnosis.
pub(in crate::backend::rust) fn write(code: &mut Code, file: &FileModel<'_>) {
    for point in &file.access_points {
        if file.is_single {
            access_point(code, point);
            continue;
        }
        code.module(&point.heading, point.name, |code| {
            code.use_runtime();
            access_point(code, point);
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

fn access_point(code: &mut Code, access_point: &DapModel<'_>) {
    code.docs(&access_point.docs);
    open!(code, "pub static DAP: rt::profinet::Dap = rt::profinet::Dap {");
    line!(code, "vendor_id: ", hex16(access_point.vendor_id), ",");
    line!(code, "device_id: ", hex16(access_point.device_id), ",");
    line!(code, "slot: ", access_point.slot, ",");
    open!(code, "module: rt::profinet::Module {");
    line!(code, "ident: ", hex32(access_point.ident), ",");
    line!(code, "name: ", access_point.identity.product_name, ",");
    line!(code, "submodules: ", list("&[", &access_point.submodules, "]"), ",");
    line!(code, "subslots: &[],");
    code.close("},");
    line!(code, "slots: ", list("&[", &access_point.slots, "]"), ",");
    line!(code, "modules: ", list("&[", &access_point.modules, "]"), ",");
    open!(code, "max_lengths: rt::profinet::IoLengths {");
    let [input, output, data] = &access_point.max_lengths;
    line!(code, "input: ", input, ",");
    line!(code, "output: ", output, ",");
    line!(code, "data: ", data, ",");
    code.close("},");
    line!(code, "max_record_size: ", access_point.max_record_size, ",");
    code.close("};");
    let documentation = "Identity of the device. The product code is the PROFINET device ID.";
    identity(code, &access_point.identity, documentation);
}

fn pluggable(code: &mut Code, module: &ModuleModel<'_>) {
    code.docs(&module.docs);
    open!(code, "pub mod ", module.name, " {");
    code.use_runtime();
    code.doc("Description of the module. A slot plan uses this constant.");
    open!(code, "pub static MODULE: rt::profinet::Module = rt::profinet::Module {");
    line!(code, "ident: ", hex32(module.ident), ",");
    line!(code, "name: ", module.title, ",");
    line!(code, "submodules: ", list("&[", &module.submodules, "]"), ",");
    line!(code, "subslots: ", list("&[", &module.subslots, "]"), ",");
    code.close("};");
    code.close("}");
}

fn submodule(code: &mut Code, submodule: &SubmoduleModel<'_>) {
    code.docs(&submodule.docs);
    open!(code, "pub mod ", submodule.name, " {");
    code.use_runtime();
    if submodule.uses_values {
        line!(code, "use super::super::values;");
    }
    code.doc("Description of the submodule. Modules and slot plans use this constant.");
    open!(code, "pub static SUBMODULE: rt::profinet::Submodule = rt::profinet::Submodule {");
    line!(code, "ident: ", hex32(submodule.ident), ",");
    line!(code, "api: ", hex16(submodule.api), ",");
    line!(code, "name: ", submodule.title, ",");
    line!(code, "input_len: ", submodule.input_len, ",");
    line!(code, "output_len: ", submodule.output_len, ",");
    line!(code, "provider_len: ", submodule.provider_len, ",");
    line!(code, "consumer_len: ", submodule.consumer_len, ",");
    line!(code, "records: ", list("&[", &submodule.record_list, "]"), ",");
    code.close("};");
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
