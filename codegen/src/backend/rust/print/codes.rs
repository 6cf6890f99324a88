//! Prints code tables.

use super::section;
use super::types;
use crate::backend::rust::code::{line, open, seq, Code, Doc};
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
    let variants = ty.variants.iter().map(|variant| {
        let range = variant.code.is_none().then(|| seq!["(", ty.native, ")"]);
        (&variant.docs, seq![variant.name, range])
    });
    types::variants(code, &ty.name, variants, Some(("A code that is not in the table.", ty.native)));
    conversions(code, table, ty);
    if let Some(gate) = &ty.equality {
        let raw = |value: &str| format!("rt::codes::CodeTable::raw({value})");
        types::equality(code, &ty.name, gate, [&raw("*self"), &raw("*other")]);
    }
}

fn conversions(code: &mut Code, table: &CodeTableModel, ty: &CodeTypeModel) {
    open!(code, "impl rt::codes::CodeTable for ", ty.name, " {");
    line!(code, "type Raw = ", ty.native, ";");
    code.block("fn codes() -> &'static [rt::codes::Code]", &table.name);
    let arms = ty.arms.iter().map(|(pattern, variant)| (pattern.as_str(), seq!["Self::", variant]));
    let unknown = (!ty.complete).then(|| ("_", Doc::from("Self::Unknown(code)")));
    types::matching(code, seq!["fn from_raw(code: ", ty.native, ") -> Self"], "code", arms.chain(unknown));
    let numbers = ty.variants.iter().map(|variant| match &variant.code {
        Some(number) => (seq!["Self::", variant.name], number.as_str()),
        None => (seq!["Self::", variant.name, "(code)"], "code"),
    });
    let unknown = (Doc::from("Self::Unknown(code)"), "code");
    types::matching(code, seq!["fn raw(self) -> ", ty.native], "self", numbers.chain([unknown]));
    code.close("}");
}
