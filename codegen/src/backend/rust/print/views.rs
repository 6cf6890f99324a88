//! Prints the views of PDOs within a process image.

use super::section;
use crate::backend::rust::code::{call, line, open, seq, Code};
use crate::backend::rust::model::Model;
use crate::backend::rust::pdo::PdoModel;
use crate::backend::rust::reexport::Section;

const ERROR: &str = "Returns an error if `data` ends before the end of the PDO.";

pub(super) fn write(code: &mut Code, model: &Model) {
    if !model.has_views {
        return;
    }
    let heading = "Views that read and write the PDOs in a process image in place.";
    section::write(code, model, Section::View, heading, (!model.pdos.is_empty()).then_some(true), |code| {
        model.pdos.iter().for_each(|pdo| view(code, pdo, model.is_one_of_several));
    });
}

/// Writes the view of a PDO. The process images of this device, and those of other devices in the file, create views.
/// The fields of the view must therefore be visible in the modules of the process images.
pub(in crate::backend::rust) fn view(code: &mut Code, pdo: &PdoModel, is_one_of_several: bool) {
    let visibility = if is_one_of_several { "pub(in super::super)" } else { "pub(super)" };
    code.docs(&pdo.view_docs);
    open!(code, "pub struct ", pdo.name, "<B> {");
    line!(code, visibility, " data: B,");
    line!(code, visibility, " bit: usize,");
    code.close("}");
    code.lines(pdo.view_allow());
    open!(code, "impl<B: AsRef<[u8]>> ", pdo.name, "<B> {");
    constructors(code, pdo);
    for field in &pdo.fields {
        code.docs(&field.docs);
        line!(code, "#[inline]");
        code.block(seq![call!(seq!["pub fn ", field.getter], "&self"), " -> ", field.ty], field.get_in_image());
    }
    code.close("}");
    open!(code, "impl<B: AsMut<[u8]>> ", pdo.name, "<B> {");
    for field in &pdo.fields {
        code.docs(&field.docs);
        line!(code, "#[inline]");
        code.block(call!(seq!["pub fn ", field.setter], "&mut self", seq!["value: ", field.ty]), field.set_in_image());
    }
    code.close("}");
}

fn constructors(code: &mut Code, pdo: &PdoModel) {
    code.docs_with_error("Creates a view of the PDO at the start of `data`.", ERROR);
    line!(code, "#[inline]");
    code.block("pub fn new(data: B) -> Result<Self, rt::LengthError>", "Self::at(data, 0)");
    code.docs_with_error("Creates a view of the PDO that starts at bit offset `bit` of `data`.", ERROR);
    line!(code, "#[inline]");
    open!(code, "pub fn at(data: B, bit: usize) -> Result<Self, rt::LengthError> {");
    line!(code, "rt::bits::check_length(data.as_ref(), bit.saturating_add(", pdo.bits, "))?;");
    line!(code, "Ok(Self { data, bit })");
    code.close("}");
}
