//! Prints parameter records.

use super::{fields, literal};
use crate::backend::rust::code::{call, line, open, Code};
use crate::backend::rust::profinet::{FRecordModel, RecordModel};
use crate::number::hex16;

pub(super) fn write(code: &mut Code, record: &RecordModel) {
    let name = &record.name;
    code.docs(&record.docs);
    code.lines(&record.derives);
    if record.fields.is_empty() {
        line!(code, "pub struct ", name, " {}");
    } else {
        open!(code, "pub struct ", name, " {");
        fields(code, &record.fields);
        code.close("}");
    }
    open!(code, "impl ", name, " {");
    constants(code, record);
    check(code, record);
    encode(code, record);
    decode(code, record);
    code.close("}");
    code.implementation("Default", name, "fn default() -> Self", "Self::DEFAULT");
    record_data(code, name);
}

/// Writes the attribute that suppresses the clippy lint about numbers close to a mathematical constant. Writes nothing
/// if the record has no real numbers.
fn allow_real(code: &mut Code, record: &RecordModel) {
    if record.has_real {
        line!(code, "#[allow(clippy::approx_constant)]");
    }
}

fn constants(code: &mut Code, record: &RecordModel) {
    code.doc("Index of the record.");
    line!(code, "pub const INDEX: u16 = ", hex16(record.index), ";");
    code.doc("Length in bytes.");
    line!(code, "pub const LEN: usize = ", record.length, ";");
    code.doc("Position of the record among the start-up records of the submodule; 0 means any position.");
    line!(code, "pub const TRANSFER_SEQUENCE: u16 = ", record.transfer_sequence, ";");
    code.doc("Default content of the record.");
    line!(code, "pub const DEFAULT_BYTES: [u8; ", record.length, "] = *", record.default_bytes, ";");
    code.doc("Default values of the fields.");
    allow_real(code, record);
    let values = record.fields.iter().zip(&record.defaults).map(|(field, value)| (field.name.as_str(), value.clone()));
    line!(code, "pub const DEFAULT: Self = ", literal(values.collect()), ";");
    for constant in &record.constants {
        code.docs(&constant.docs);
        allow_real(code, record);
        line!(code, "pub const ", constant.name, ": ", constant.ty, " = ", constant.value, ";");
    }
}

fn check(code: &mut Code, record: &RecordModel) {
    let first = "Checks that the device allows the values of all fields.";
    code.docs_with_error(first, "Returns an error if a field has a value that the device does not allow.");
    allow_real(code, record);
    open!(code, "pub fn check(&self) -> Result<(), rt::profinet::NotAllowed> {");
    code.lines(&record.checks);
    line!(code, "Ok(())");
    code.close("}");
}

fn encode(code: &mut Code, record: &RecordModel) {
    let first = "Returns the bytes of the record, which consist of constants and fields. All other bits are 0.";
    code.docs_with_error(first, "Returns an error if a field has a value that the device does not allow.");
    let function = call!("pub fn encode", "&self");
    open!(code, function, " -> Result<[u8; ", record.length, "], rt::profinet::NotAllowed> {");
    line!(code, "self.check()?;");
    if record.fields.is_empty() {
        line!(code, "Ok(Self::DEFAULT_BYTES)");
    } else {
        line!(code, "let mut data = Self::DEFAULT_BYTES;");
        code.lines(record.fields.iter().map(|field| &field.pack));
        line!(code, "Ok(data)");
    }
    code.close("}");
}

fn decode(code: &mut Code, record: &RecordModel) {
    let first = "Decodes the fields of a record. Bytes after the record are ignored.";
    code.docs_with_error(first, "Returns an error if `data` has fewer bytes than the record.");
    open!(code, "pub fn decode(data: &[u8]) -> Result<Self, rt::LengthError> {");
    let data = if record.fields.is_empty() { "" } else { "let data = " };
    line!(code, data, "rt::profinet::be::chunk::<", record.length, ">(data)?;");
    let values = record.fields.iter().map(|field| (field.name.as_str(), field.read.clone()));
    line!(code, "Ok(", literal(values.collect()), ")");
    code.close("}");
}

fn record_data(code: &mut Code, name: &str) {
    open!(code, "impl rt::profinet::RecordData for ", name, " {");
    line!(code, "const INDEX: u16 = Self::INDEX;");
    line!(code, "const LEN: usize = Self::LEN;");
    line!(code, "const TRANSFER_SEQUENCE: u16 = Self::TRANSFER_SEQUENCE;");
    code.block("fn decode(data: &[u8]) -> Result<Self, rt::LengthError>", "Self::decode(data)");
    open!(code, "fn encode_into<'b>(");
    line!(code, "&self,");
    line!(code, "data: &'b mut [u8],");
    code.reopen(") -> Result<&'b [u8], rt::profinet::RecordError> {");
    line!(code, "let record = self.encode()?;");
    line!(code, "Ok(rt::profinet::be::write(data, &record)?)");
    code.close("}");
    code.close("}");
}

/// Writes the constant `F_PARAMETERS`, and a static with the default bytes of the record.
pub(super) fn f_parameters(code: &mut Code, record: &FRecordModel) {
    code.declare([&record.constant]);
    line!(code, "static F_PARAMETERS_DEFAULT: [u8; ", record.length, "] = F_PARAMETERS.default_bytes();");
}
