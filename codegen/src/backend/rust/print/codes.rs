//! Prints code tables.

use super::section;
use super::types;
use crate::backend::rust::code::{line, open, Code};
use crate::backend::rust::code_table::CodeTableModel;
use crate::backend::rust::code_type::CodeTypeModel;
use crate::backend::rust::model::Model;
use crate::backend::rust::reexport::Section;

pub(in crate::backend::rust) fn write(code: &mut Code, model: &Model) {
    let tables = &model.code_tables;
    let heading = "Code tables. The function `codes::find` of the runtime returns the row for a code.";
    section::write(code, model, Section::Codes, heading, (!tables.is_empty()).then_some(true), |code| {
        tables.iter().for_each(|table| self::table(code, table));
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
    if let Some(ty) = &table.ty {
        self::ty(code, table, ty);
    }
}

fn ty(code: &mut Code, table: &CodeTableModel, ty: &CodeTypeModel) {
    code.doc(&format!("Code of the table {}.", table.link));
    code.docs(&ty.table);
    code.lines(&ty.derives);
    open!(code, "pub enum ", ty.name, " {");
    for variant in &ty.variants {
        code.doc(&variant.docs);
        match variant.code {
            Some(_) => line!(code, variant.name, ","),
            None => line!(code, variant.name, "(", ty.native, "),"),
        }
    }
    code.doc("A code that is not in the table.");
    line!(code, "Unknown(", ty.native, "),");
    code.close("}");
    conversions(code, table, ty);
    if let Some(gate) = &ty.equality {
        let raw = |value: &str| format!("rt::codes::CodeTable::raw({value})");
        types::equality(code, &ty.name, gate, [&raw("*self"), &raw("*other")]);
    }
}

fn conversions(code: &mut Code, table: &CodeTableModel, ty: &CodeTypeModel) {
    open!(code, "impl rt::codes::CodeTable for ", ty.name, " {");
    line!(code, "type Raw = ", ty.native, ";");
    open!(code, "fn codes() -> &'static [rt::codes::Code] {");
    line!(code, table.name);
    code.close("}");
    open!(code, "fn from_raw(code: ", ty.native, ") -> Self {");
    open!(code, "match code {");
    for (pattern, variant) in &ty.arms {
        line!(code, pattern, " => Self::", variant, ",");
    }
    if !ty.complete {
        line!(code, "_ => Self::Unknown(code),");
    }
    code.close("}");
    code.close("}");
    open!(code, "fn raw(self) -> ", ty.native, " {");
    open!(code, "match self {");
    for variant in &ty.variants {
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
