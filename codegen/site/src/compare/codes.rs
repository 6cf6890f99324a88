//! Compares code tables, which become enumerations in Rust.

use super::change::Judgment;
use super::comparison::{compare_fields, fact, list, rules, text, Comparison, Elements, COMPARED, POSITION};
use super::conditions::only_on;
use super::names::identifier;
use lexibus_codegen::ir::{CodeRow, CodeTable};

/// Compares code tables, which are paired by name.
pub(super) fn tables() -> impl Fn(&Vec<CodeTable>, &Vec<CodeTable>, &mut Comparison<'_>) {
    let elements = Elements::titled(|table: &CodeTable| format!("codes {}", table.name));
    list(elements.paired_by(|table| identifier(&table.name)).judged(Judgment::API_COMPATIBLE, Judgment::API), table)
}

rules!(fn table(CodeTable) {
    name,
    columns: fact("columns", Judgment::API),
    rows: list(rows(), row),
    buses: only_on,
    documentation, doubts, stated_by,
}, POSITION => [origin]);

/// Compares the rows of a code table. Added rows are breaking changes, because Rust code can match all codes
/// exhaustively.
fn rows() -> Elements<CodeRow> {
    Elements {
        name: |row: &CodeRow| row.name.to_string(),
        position: |row| row.code.to_string(),
        ..Elements::titled(|row: &CodeRow| format!("code {} {}", row.printed_code(), row.name))
    }
    .judged(Judgment::API, Judgment::API)
}

fn row(old: &CodeRow, new: &CodeRow, comparison: &mut Comparison<'_>) {
    let number = |row: &CodeRow| match row.last {
        Some(last) => format!("{} to {last}", row.code),
        None => row.code.to_string(),
    };
    // A different last code of a range affects only Rust code, as long as the first code stays the same.
    let judgment = if old.code == new.code { Judgment::API } else { Judgment::WIRE };
    comparison.texts("code", number(old), number(new), judgment);
    compare_fields!(CodeRow, old, new, comparison, {
        printed: text("printed code"),
        printed_cells: text("printed cells"),
        name, names, availability, documentation, stated_by,
        cells: fact("further columns", Judgment::BEHAVIOR),
    }, COMPARED => [code, last]);
}
