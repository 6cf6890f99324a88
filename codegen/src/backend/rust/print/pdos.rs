//! Prints PDO structs.

use super::section;
use crate::backend::rust::code::{line, open, seq, Code};
use crate::backend::rust::model::Model;
use crate::backend::rust::pdo::PdoModel;
use crate::backend::rust::reexport::Section;
use crate::number::hex16;

pub(super) fn write(code: &mut Code, model: &Model) {
    let heading = "PDOs with their default mapping.";
    section::write(code, model, Section::Pdo, heading, (!model.pdos.is_empty()).then_some(true), |code| {
        model.pdos.iter().for_each(|pdo| self::pdo(code, pdo));
    });
}

pub(in crate::backend::rust) fn pdo(code: &mut Code, pdo: &PdoModel) {
    code.docs(&pdo.docs);
    code.lines(&pdo.derives);
    open!(code, "pub struct ", pdo.name, " {");
    for field in &pdo.fields {
        code.field(&field.docs, field.attribute.as_ref(), &field.name, &field.ty);
    }
    code.close("}");
    open!(code, "impl ", pdo.name, " {");
    code.doc("Length in bits.");
    line!(code, "pub const BITS: u32 = ", pdo.bits, ";");
    code.doc("Length in bytes.");
    line!(code, "pub const LEN: usize = ", pdo.length, ";");
    if let Some(cob_id) = &pdo.cob_id {
        code.doc("Default COB-ID (CiA 301 7.5.2.35).");
        line!(code, "pub const COB_ID: rt::CobId = ", cob_id, ";");
    }
    pack(code, pdo);
    unpack(code, pdo);
    if !pdo.configuration.is_empty() {
        configuration(code, pdo);
    }
    code.close("}");
    open!(code, "impl rt::Pdo for ", pdo.name, " {");
    line!(code, "const INDEX: u16 = ", hex16(pdo.mapping_index), ";");
    line!(code, "const LEN: usize = Self::LEN;");
    open!(code, "const MAPPING: &'static [rt::MappedEntry] = &[");
    for entry in &pdo.mapping {
        line!(code, entry, ",");
    }
    code.close("];");
    code.close("}");
    if pdo.is_on_ethercat {
        line!(code, "rt::ethercrab_wire!(", pdo.name, ", ", pdo.length, ");");
    }
    if pdo.word && !pdo.constant.is_empty() {
        proof(code, pdo);
    }
}

fn pack(code: &mut Code, pdo: &PdoModel) {
    code.doc("Returns the bytes of the PDO. Unmapped bits are 0.");
    line!(code, "#[inline]");
    open!(code, "pub ", pdo.constant, "fn pack(&self) -> [u8; ", pdo.length, "] {");
    if pdo.word {
        line!(code, "let mut word = 0;");
        for field in &pdo.fields {
            code.lines(field.packed());
            match field.offset {
                0 => line!(code, "word |= bits;"),
                offset => line!(code, "word |= bits << ", offset, ";"),
            }
        }
        line!(code, "rt::pdo::to_bytes(word)");
    } else {
        code.lines(pdo.pack_long());
    }
    code.close("}");
}

fn unpack(code: &mut Code, pdo: &PdoModel) {
    let about = "Decodes the fields of the PDO. Bytes after the mapped objects are ignored.";
    code.docs_with_error(about, "Returns an error if `data` has fewer bytes than the PDO.");
    line!(code, "#[inline]");
    open!(code, "pub ", pdo.constant, "fn unpack(data: &[u8]) -> Result<Self, rt::LengthError> {");
    open!(code, "let Some(data) = data.first_chunk::<", pdo.length, ">() else {");
    line!(code, "return Err(rt::LengthError::new(Self::LEN, data.len()));");
    code.close("};");
    if pdo.word {
        line!(code, "let word = rt::pdo::from_bytes(data);");
    }
    line!(code, "let pdo = ", pdo.unpacked(), ";");
    line!(code, "Ok(pdo)");
    code.close("}");
}

fn configuration(code: &mut Code, pdo: &PdoModel) {
    let count = pdo.configuration.len();
    if pdo.has_identifier {
        code.doc("Returns the writes that configure the PDO with its default COB-ID and enable it.");
        let function = seq!["pub const fn configuration(node_id: rt::NodeId) -> [rt::SdoWrite; ", count, "]"];
        code.block(function, "Self::configuration_as(Self::COB_ID.resolve(node_id))");
    }
    code.doc(
        "Returns the writes that configure the PDO with `cob_id`. In order, they disable the PDO, clear the mapping,",
    );
    code.doc("write the entries and their number, set the timing, and enable the PDO.");
    code.doc("Read-only communication parameters are left out.");
    open!(code, "pub const fn configuration_as(cob_id: u32) -> [rt::SdoWrite; ", count, "] {");
    open!(code, "[");
    for write in &pdo.configuration {
        line!(code, write, ",");
    }
    code.close("]");
    code.close("}");
}

/// Writes a constant that causes a compile error if unpacking and packing a PDO changes any of its covered bits.
fn proof(code: &mut Code, pdo: &PdoModel) {
    open!(code, "const _: () = {");
    line!(code, "let word = ", pdo.covered, ";");
    line!(code, "let data: [u8; ", pdo.length, "] = rt::pdo::to_bytes(word);");
    open!(code, "let packed = match ", pdo.name, "::unpack(&data) {");
    line!(code, "Ok(pdo) => pdo.pack(),");
    line!(code, "Err(_) => panic!(),");
    code.close("};");
    line!(code, "let packed = rt::pdo::from_bytes(&packed);");
    line!(code, "assert!(packed == word);");
    code.close("};");
}
