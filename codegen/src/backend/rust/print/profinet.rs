//! PROFINET devices.

mod diagnosis;
mod image;
mod record;
mod values;

use super::device::identity;
use crate::backend::rust::code::{line, list, open, Code, Data, Doc};
use crate::backend::rust::profinet::{DapModel, FieldModel, FileModel, ModuleModel, SubmoduleModel};

/// All device access points of a file, and what can be plugged into them.
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
            file.modules.iter().for_each(|own| self::pluggable(code, own));
        });
    }
    if !file.submodules.is_empty() {
        code.module("Submodules: their data and parameter records.", "submodules", |code| {
            file.submodules.iter().for_each(|own| submodule(code, own));
        });
    }
    if !file.values.is_empty() {
        code.module("Enumerations: named values of fields.", "values", |code| {
            file.values.iter().for_each(|own| values::write(code, own));
        });
    }
    if !file.errors.is_empty() || !file.units.is_empty() {
        code.module("Diagnosis: what error types and user structures mean.", "diagnosis", |code| {
            diagnosis::write(code, file);
        });
    }
}

fn hexadecimal(number: impl Into<u32>, digits: usize) -> String {
    format!("0x{:0digits$X}", number.into())
}

fn access_point(code: &mut Code, own: &DapModel<'_>) {
    code.docs(&own.docs);
    open!(code, "pub static DAP: rt::profinet::Dap = rt::profinet::Dap {");
    line!(code, "vendor_id: ", hexadecimal(own.vendor_id, 4), ",");
    line!(code, "device_id: ", hexadecimal(own.device_id, 4), ",");
    line!(code, "slot: ", own.slot, ",");
    open!(code, "module: rt::profinet::Module {");
    line!(code, "ident: ", hexadecimal(own.ident, 8), ",");
    line!(code, "name: ", own.identity.product_name, ",");
    line!(code, "submodules: ", list("&[", &own.submodules, "]"), ",");
    line!(code, "subslots: &[],");
    code.close("},");
    line!(code, "slots: ", list("&[", &own.slots, "]"), ",");
    line!(code, "modules: ", list("&[", &own.modules, "]"), ",");
    open!(code, "max_lengths: rt::profinet::IoLengths {");
    let [input, output, data] = &own.max_lengths;
    line!(code, "input: ", input, ",");
    line!(code, "output: ", output, ",");
    line!(code, "data: ", data, ",");
    code.close("},");
    line!(code, "max_record_size: ", own.max_record_size, ",");
    code.close("};");
    let about =
        "Who made the device, and which one it is: the product code is the number that PROFINET calls DeviceID.";
    identity(code, &own.identity, about);
}

fn pluggable(code: &mut Code, own: &ModuleModel<'_>) {
    code.docs(&own.docs);
    open!(code, "pub mod ", own.name, " {");
    code.use_runtime();
    code.doc("The module, as a plan names it.");
    open!(code, "pub static MODULE: rt::profinet::Module = rt::profinet::Module {");
    line!(code, "ident: ", hexadecimal(own.ident, 8), ",");
    line!(code, "name: ", own.title, ",");
    line!(code, "submodules: ", list("&[", &own.submodules, "]"), ",");
    line!(code, "subslots: ", list("&[", &own.subslots, "]"), ",");
    code.close("};");
    code.close("}");
}

fn submodule(code: &mut Code, own: &SubmoduleModel<'_>) {
    code.docs(&own.docs);
    open!(code, "pub mod ", own.name, " {");
    code.use_runtime();
    if own.uses_values {
        line!(code, "use super::super::values;");
    }
    code.doc("The submodule, as modules and plans name it.");
    open!(code, "pub static SUBMODULE: rt::profinet::Submodule = rt::profinet::Submodule {");
    line!(code, "ident: ", hexadecimal(own.ident, 8), ",");
    line!(code, "api: ", hexadecimal(own.api, 4), ",");
    line!(code, "name: ", own.title, ",");
    line!(code, "input_len: ", own.input_len, ",");
    line!(code, "output_len: ", own.output_len, ",");
    line!(code, "provider_len: ", own.provider_len, ",");
    line!(code, "consumer_len: ", own.consumer_len, ",");
    line!(code, "records: ", list("&[", &own.record_list, "]"), ",");
    code.close("};");
    own.images.iter().for_each(|image| image::write(code, image));
    own.records.iter().for_each(|record| record::write(code, record));
    if let Some(record) = &own.f_record {
        record::f_parameters(code, record);
    }
    code.close("}");
}

/// The fields of a struct.
fn fields(code: &mut Code, fields: &[FieldModel]) {
    for field in fields {
        code.field(&field.docs, field.attribute.as_ref(), &field.name, &field.ty);
    }
}

/// The literal of a struct with these fields.
fn literal(fields: Vec<(&str, Doc)>) -> Doc {
    if fields.is_empty() {
        return Doc::from("Self {}");
    }
    Data::fields("Self", fields)
}
