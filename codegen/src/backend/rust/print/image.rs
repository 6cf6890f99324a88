//! Prints the default process image.

use super::section;
use crate::backend::rust::code::{call, generic, line, open, seq, Code, Doc, Stop};
use crate::backend::rust::ethercat::{ImageField, ImageModel};
use crate::backend::rust::model::Model;
use crate::backend::rust::reexport::Section;

const ERROR: &str = "Returns an error if `data` has fewer bytes than the image.";

pub(super) fn write(code: &mut Code, model: &Model) {
    let images = &model.images;
    let heading = "Process image of the default PDO assignment, with one struct for each sync manager.";
    section::write(code, model, Section::Image, heading, (!images.is_empty()).then_some(true), |code| {
        images.iter().for_each(|image| self::image(code, image));
    });
}

pub(in crate::backend::rust) fn image(code: &mut Code, image: &ImageModel) {
    structure(code, image);
    view(code, image);
}

fn structure(code: &mut Code, image: &ImageModel) {
    code.doc(&image.title);
    code.lines(&image.derives);
    open!(code, "pub struct ", image.name, " {");
    for field in &image.fields {
        code.doc(&field.docs);
        line!(code, "pub ", field.name, ": super::pdo::", field.pdo, ",");
    }
    code.close("}");
    open!(code, "impl ", image.name, " {");
    code.doc("Number of the sync manager.");
    line!(code, "pub const SYNC_MANAGER: u8 = ", image.sync_manager, ";");
    code.doc("Length in bytes.");
    line!(code, "pub const LEN: usize = ", image.length, ";");
    code.doc("Returns the bytes of the process image. Unmapped bits are 0.");
    line!(code, "#[inline]");
    open!(code, "pub fn pack(&self) -> [u8; ", image.length, "] {");
    line!(code, "let mut data = [0; ", image.length, "];");
    for field in &image.fields {
        let packed = seq!["&self.", field.name, ".pack()"];
        line!(code, call!("rt::bits::set_bytes", "&mut data", field.bit, packed), ";");
    }
    line!(code, "data");
    code.close("}");
    unpack(code, image);
    code.close("}");
}

fn unpack(code: &mut Code, image: &ImageModel) {
    code.docs_with_error("Decodes the PDOs of a process image. Bytes after the image are ignored.", ERROR);
    line!(code, "#[inline]");
    open!(code, "pub fn unpack(data: &[u8]) -> Result<Self, rt::LengthError> {");
    line!(code, "rt::bits::check_length(data, ", image.bits, ")?;");
    open!(code, "let image = Self {");
    for (left, field) in (0..image.fields.len()).rev().zip(&image.fields) {
        let bytes = call!(seq!["&rt::bits::get_bytes::<", field.length, ">"], "data", field.bit);
        let value = call!(seq!["super::pdo::", field.pdo, "::unpack"], bytes);
        // In the last line of the struct literal, the comma may exceed the maximum line width.
        let end = (left == 0).then_some(Stop);
        line!(code, field.name, ": ", value, "?", end, ",");
    }
    code.close("};");
    line!(code, "Ok(image)");
    code.close("}");
}

fn view(code: &mut Code, image: &ImageModel) {
    code.doc(&format!("{} This view reads and writes the bytes in place.", image.title));
    code.block(seq!["pub struct ", image.view_name(), "<B>"], "data: B,");
    code.lines(image.view_allow());
    open!(code, "impl<B: AsRef<[u8]>> ", image.view_name(), "<B> {");
    code.docs_with_error("Creates a view of the process image at the start of `data`.", ERROR);
    line!(code, "#[inline]");
    open!(code, "pub fn new(data: B) -> Result<Self, rt::LengthError> {");
    line!(code, "rt::bits::check_length(data.as_ref(), ", image.bits, ")?;");
    line!(code, "Ok(Self { data })");
    code.close("}");
    for field in &image.fields {
        let method = call!(seq!["pub fn ", field.name], "&self");
        pdo(code, field, method, "&[u8]", "as_ref");
    }
    code.close("}");
    code.lines(image.view_mut_allow());
    open!(code, "impl<B: AsMut<[u8]>> ", image.view_name(), "<B> {");
    for field in &image.fields {
        let method = call!(seq!["pub fn ", field.name_mut], "&mut self");
        pdo(code, field, method, "&mut [u8]", "as_mut");
    }
    code.close("}");
}

/// Writes the method that returns the view of a PDO. `bytes` is the type of the image's bytes, and `borrow` is the
/// method that borrows them.
fn pdo(code: &mut Code, field: &ImageField, method: Doc, bytes: &str, borrow: &str) {
    code.doc(&field.docs);
    line!(code, "#[inline]");
    open!(code, method, " -> ", generic!(seq!["super::view::", field.pdo], bytes), " {");
    open!(code, "super::view::", field.pdo, " {");
    line!(code, "data: self.data.", borrow, "(),");
    line!(code, "bit: ", field.bit, ",");
    code.close("}");
    code.close("}");
}
