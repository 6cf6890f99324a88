//! Prints channel errors and user-defined diagnosis structures.

use super::{fields, literal};
use crate::backend::rust::code::{call, line, list, open, seq, Code};
use crate::backend::rust::profinet::{FileModel, UnitModel};
use crate::number::hex16;

pub(super) fn write(code: &mut Code, file: &FileModel<'_>) {
    code.use_runtime();
    if !file.units.is_empty() && !file.values.is_empty() {
        line!(code, "#[allow(unused_imports)]");
        line!(code, "use super::values;");
    }
    if !file.errors.is_empty() {
        code.doc(
            "Channel errors in the device description, sorted by application process identifier (API) and error type.",
        );
        let (count, errors) = (file.errors.len(), list("[", &file.errors, "]"));
        line!(code, "pub static CHANNEL_ERRORS: [rt::profinet::ChannelError; ", count, "] = ", errors, ";");
        code.doc(
            "Returns the description of an error type in a submodule with this application process identifier (API).",
        );
        code.doc(
            "Returns `None` if the device description does not contain the error type, for example if the standard defines the error type.",
        );
        let function = call!("pub fn channel_error", "api: u32", "error_type: u16");
        let function = seq![function, " -> Option<&'static rt::profinet::ChannelError>"];
        code.block(function, "rt::profinet::ChannelError::find(&CHANNEL_ERRORS, api, error_type)");
    }
    file.units.iter().for_each(|unit| self::unit(code, unit));
}

fn unit(code: &mut Code, unit: &UnitModel) {
    code.docs(&unit.docs);
    code.lines(&unit.derives);
    open!(code, "pub struct ", unit.name, " {");
    fields(code, &unit.fields);
    code.close("}");
    open!(code, "impl ", unit.name, " {");
    code.doc("Application process identifier (API) of the structure.");
    line!(code, "pub const API: u32 = ", hex16(unit.api), ";");
    code.doc("Identifier of the structure, which precedes its bytes (UserStructureIdentifier).");
    line!(code, "pub const IDENTIFIER: u16 = ", hex16(unit.identifier), ";");
    code.doc("Length in bytes up to the end of the last field.");
    line!(code, "pub const LEN: usize = ", unit.length, ";");
    let first = "Decodes the fields of a structure. Bytes after the last field are ignored.";
    code.docs_with_error(first, "Returns an error if `data` has fewer bytes than the structure.");
    open!(code, "pub fn decode(data: &[u8]) -> Result<Self, rt::LengthError> {");
    line!(code, "let data = rt::profinet::be::chunk::<", unit.length, ">(data)?;");
    let values = unit.fields.iter().map(|field| (field.name.as_str(), field.read.clone()));
    line!(code, "Ok(", literal(values.collect()), ")");
    code.close("}");
    code.close("}");
}
