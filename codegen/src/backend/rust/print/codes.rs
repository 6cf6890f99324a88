//! Tables of codes.

use super::section;
use crate::backend::rust::code::{line, open, Code};
use crate::backend::rust::code_table::CodeTableModel;
use crate::backend::rust::code_type::CodeTypeModel;
use crate::backend::rust::model::Model;
use crate::backend::rust::reexport::Section;

pub(super) fn write(code: &mut Code, model: &Model) {
    let tables = &model.code_tables;
    let heading = "Tables of codes. `rt::codes::find` looks a code up.";
    section::write(code, model, Section::Codes, heading, (!tables.is_empty()).then_some(true), |code| {
        tables.iter().for_each(|own| table(code, own));
    });
}

pub(in crate::backend::rust) fn table(code: &mut Code, table: &CodeTableModel) {
    code.docs(&table.docs);
    if table.has_real {
        line!(code, "#[allow(clippy::approx_constant)]");
    }
    open!(code, "pub static ", table.name, ": &[rt::codes::Code] = &[");
    for row in &table.rows {
        line!(code, row, ",");
    }
    code.close("];");
    if let Some(own) = &table.ty {
        self::ty(code, table, own);
    }
}

fn ty(code: &mut Code, table: &CodeTableModel, own: &CodeTypeModel) {
    code.doc(&format!("A code of {}.", table.link));
    code.docs(&own.table);
    code.lines(&own.derives);
    open!(code, "pub enum ", own.name, " {");
    for variant in &own.variants {
        code.doc(&variant.docs);
        match variant.code {
            Some(_) => line!(code, variant.name, ","),
            None => line!(code, variant.name, "(", own.native, "),"),
        }
    }
    code.doc("Any other number.");
    line!(code, "Unknown(", own.native, "),");
    code.close("}");
    conversions(code, table, own);
}

fn conversions(code: &mut Code, table: &CodeTableModel, own: &CodeTypeModel) {
    open!(code, "impl rt::codes::CodeTable for ", own.name, " {");
    line!(code, "type Raw = ", own.native, ";");
    open!(code, "fn codes() -> &'static [rt::codes::Code] {");
    line!(code, table.name);
    code.close("}");
    open!(code, "fn from_raw(code: ", own.native, ") -> Self {");
    open!(code, "match code {");
    for (pattern, variant) in &own.arms {
        line!(code, pattern, " => Self::", variant, ",");
    }
    if !own.complete {
        line!(code, "_ => Self::Unknown(code),");
    }
    code.close("}");
    code.close("}");
    open!(code, "fn raw(self) -> ", own.native, " {");
    open!(code, "match self {");
    for variant in &own.variants {
        match &variant.code {
            Some(number) => line!(code, "Self::", variant.name, " => ", number, ","),
            None => line!(code, "Self::", variant.name, "(code) => code,"),
        }
    }
    line!(code, "Self::Unknown(code) => code,");
    code.close("}");
    code.close("}");
    code.close("}");
}
