//! Prints the structs for cyclic data, and the views that access the data as bytes.

use super::{fields, literal};
use crate::backend::rust::code::{call, line, open, seq, Break, Code, Doc};
use crate::backend::rust::profinet::ImageModel;

const ERROR: &str = "Returns an error if `data` has fewer bytes than the user data.";

pub(super) fn write(code: &mut Code, image: &ImageModel) {
    let name = image.name;
    code.docs(&image.docs);
    code.lines(&image.derives);
    open!(code, "pub struct ", name, " {");
    fields(code, &image.fields);
    code.close("}");
    open!(code, "impl ", name, " {");
    code.doc("Length of the user data in bytes.");
    line!(code, "pub const LEN: usize = ", image.length, ";");
    pack(code, image);
    code.docs_with_error("Decodes the fields of the user data. Bytes after the user data are ignored.", ERROR);
    line!(code, "#[inline]");
    open!(code, "pub fn unpack(data: &[u8]) -> Result<Self, rt::LengthError> {");
    line!(code, "let view = ", name, "View::new(data)?;");
    let values = image.fields.iter().map(|field| (field.name.as_str(), seq!["view", Break, ".", field.name, "()"]));
    line!(code, "Ok(", literal(values.collect()), ")");
    code.close("}");
    code.close("}");
    io_data(code, image);
    view(code, image);
    if image.is_output {
        view_mut(code, image);
    }
}

fn pack(code: &mut Code, image: &ImageModel) {
    code.doc("Returns the bytes of the user data. Bits without a field are 0.");
    line!(code, "#[inline]");
    open!(code, "pub fn pack(&self) -> [u8; ", image.length, "] {");
    line!(code, "let mut data = [0; ", image.length, "];");
    if image.is_output {
        line!(code, "let mut view = ", image.name, "Mut(&mut data);");
        for field in &image.fields {
            line!(code, call!(seq!["view.", field.setter()], seq!["self.", field.name]), ";");
        }
    } else {
        code.lines(image.fields.iter().map(|field| &field.pack));
    }
    line!(code, "data");
    code.close("}");
}

fn io_data(code: &mut Code, image: &ImageModel) {
    open!(code, "impl rt::profinet::IoData for ", image.name, " {");
    line!(code, "const LEN: usize = Self::LEN;");
    line!(code, "const TRAILER_LEN: usize = ", image.trailer, ";");
    line!(code, "const STATUS_LEN: usize = ", image.status, ";");
    code.block("fn unpack(data: &[u8]) -> Result<Self, rt::LengthError>", "Self::unpack(data)");
    open!(code, "fn pack_into(&self, data: &mut [u8]) -> Result<(), rt::LengthError> {");
    line!(code, "rt::profinet::be::write(data, &self.pack())?;");
    line!(code, "Ok(())");
    code.close("}");
    code.close("}");
}

fn view(code: &mut Code, image: &ImageModel) {
    let name = image.name;
    code.doc(&format!("View of {name} that reads fields without copying the bytes."));
    line!(code, "#[derive(Clone, Copy)]");
    line!(code, "pub struct ", name, "View<'a>(&'a [u8; ", image.length, "]);");
    code.lines(image.allow);
    open!(code, "impl<'a> ", name, "View<'a> {");
    code.docs_with_error("Creates a view of the user data at the start of `data`.", ERROR);
    line!(code, "#[inline]");
    open!(code, "pub const fn new(data: &'a [u8]) -> Result<Self, rt::LengthError> {");
    open!(code, "match rt::profinet::be::chunk(data) {");
    line!(code, "Ok(data) => Ok(Self(data)),");
    line!(code, "Err(error) => Err(error),");
    code.close("}");
    code.close("}");
    for field in &image.fields {
        let function = call!(seq!["pub ", field.constant, "fn ", field.name], "&self");
        method(code, &field.heading, seq![function, " -> ", field.ty], &field.get);
    }
    code.close("}");
}

fn view_mut(code: &mut Code, image: &ImageModel) {
    let name = image.name;
    code.doc(&format!("View of {name} that writes fields without copying the bytes."));
    line!(code, "pub struct ", name, "Mut<'a>(&'a mut [u8; ", image.length, "]);");
    open!(code, "impl<'a> ", name, "Mut<'a> {");
    code.docs_with_error("Creates a view of the user data at the start of `data`.", ERROR);
    line!(code, "#[inline]");
    let function = "pub fn new(data: &'a mut [u8]) -> Result<Self, rt::LengthError>";
    code.block(function, "Ok(Self(rt::profinet::be::chunk_mut(data)?))");
    let function = seq!["pub fn view(&self) -> ", name, "View<'_>"];
    method(code, "Returns a view that reads the fields.", function, &seq![name, "View(self.0)"]);
    for field in &image.fields {
        let function = call!(seq!["pub fn ", field.setter()], "&mut self", seq!["value: ", field.ty]);
        method(code, &field.heading, function, &field.set);
    }
    code.close("}");
}

/// Writes a method whose body is a single line.
fn method(code: &mut Code, docs: &str, function: Doc, body: &Doc) {
    code.doc(docs);
    line!(code, "#[inline]");
    code.block(function, body);
}
