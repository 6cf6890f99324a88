//! Channel diagnosis and user-defined diagnosis structures.

use crate::number::hex16;
use std::collections::BTreeMap;

use super::docs;
use super::field::{Field, Use};
use super::image::{self, FieldModel};
use super::values::Values;
use crate::backend::rust::code::{call, slice, Doc};
use crate::backend::rust::{literal, RustOptions};
use crate::ir::{Catalog, CodeRow, Documentation, Type, UnitDiagnosis};
use crate::names::{self, Case, NameRequest};
use crate::text::count_of;

/// Name of the table of channel errors in the IR.
const ERRORS: &str = "channel_diagnosis";

/// Name of the table of extended channel errors in the IR. The first cell of a row is the error type that the row
/// extends.
const EXTENDED: &str = "extended_channel_diagnosis";

/// Key of a channel error: the application process identifier (API) of the profile that defines it, and the error type.
type Key = (u32, u16);

/// Returns the channel errors in the description as elements of a table. The list contains each channel error only
/// once.
pub(super) fn channel_errors(catalog: &Catalog) -> Vec<Doc> {
    let rows = |name: &'static str| {
        catalog.code_tables.iter().filter(move |table| table.name == name).flat_map(|table| &table.rows)
    };
    let mut errors: BTreeMap<Key, (Option<&CodeRow>, BTreeMap<u16, &CodeRow>)> = BTreeMap::new();
    for row in rows(ERRORS) {
        if let (Some(api), Ok(code)) = (number(row, 1), u16::try_from(row.code)) {
            errors.entry((api, code)).or_default().0.get_or_insert(row);
        }
    }
    for row in rows(EXTENDED) {
        let parent = number(row, 0).and_then(|parent| u16::try_from(parent).ok());
        if let (Some(parent), Some(api), Ok(code)) = (parent, number(row, 2), u16::try_from(row.code)) {
            errors.entry((api, parent)).or_default().1.entry(code).or_insert(row);
        }
    }
    // Extended errors of a profile can extend a channel error that only the standard API (API 0) defines.
    let of_all = |code: u16| errors.get(&(0, code)).and_then(|(row, _)| *row);
    errors.iter().map(|(key, (row, extended))| error(*key, row.or(of_all(key.1)), extended)).collect()
}

fn number(row: &CodeRow, cell: usize) -> Option<u32> {
    u32::try_from(row.cells.get(cell)?.as_int()?).ok()
}

fn error(key: Key, row: Option<&CodeRow>, extended: &BTreeMap<u16, &CodeRow>) -> Doc {
    let (api, code) = key;
    let (name, help) = row.map_or(("\"\"".to_owned(), "\"\"".to_owned()), texts);
    let extended = slice(extended.iter().map(|(code, row)| {
        let (name, help) = texts(row);
        call!("rt::profinet::ExtendedError::new", hex16(*code), name, help)
    }));
    let code = hex16(code);
    match api {
        0 => call!("rt::profinet::ChannelError::new", code, name, help, extended),
        _ => {
            let api = hex16(api);
            call!("rt::profinet::ChannelError::of_profile", api, code, name, help, extended)
        }
    }
}

fn texts(row: &CodeRow) -> (String, String) {
    let help = Documentation::text_of(row.documentation.as_deref());
    (literal::string(&row.name), literal::string(help))
}

/// A user-defined diagnosis structure, ready to be printed.
pub(in crate::backend::rust) struct UnitModel {
    pub name: String,
    pub docs: Vec<String>,
    pub derives: Vec<String>,
    pub api: u32,
    pub identifier: u16,
    pub length: u32,
    pub fields: Vec<FieldModel>,
}

/// Returns the user-defined diagnosis structures that have fields and are not too long.
pub(super) fn units(catalog: &Catalog, values: &Values<'_>, options: &RustOptions) -> Vec<UnitModel> {
    let units: Vec<&UnitDiagnosis> = catalog.unit_diagnoses.iter().filter(|unit| length(unit).is_some()).collect();
    let name_requests =
        units.iter().map(|unit| NameRequest::new(&unit.name, "structure", format!("{:04X}", unit.identifier)));
    let names = names::unique_up_to(name_requests, &[], Case::Pascal, 40);
    let models = units.iter().zip(names).map(|(unit, name)| unit_model(unit, name, values, options));
    models.filter(|model| !model.fields.is_empty()).collect()
}

/// Returns the number of bytes up to the end of the last field. Returns `None` if there are no fields or too many
/// bytes.
fn length(unit: &UnitDiagnosis) -> Option<u32> {
    let ends = unit.fields.iter().map(|field| u64::from(field.bit_offset) + u64::from(field.bits));
    let length = u32::try_from(ends.max()?.div_ceil(8)).ok()?;
    (1..=crate::limits::MAX_RECORD_BYTES).contains(&length).then_some(length)
}

fn unit_model(unit: &UnitDiagnosis, name: String, values: &Values<'_>, options: &RustOptions) -> UnitModel {
    let length = length(unit).unwrap_or(0);
    let found = unit.fields.iter().filter_map(|entry| {
        let ty = entry.values.map_or(entry.ty, Type::Named);
        let field = Field::new(values, ty, (entry.bit_offset, entry.bits), length, Use::Record)?;
        Some((entry.name.as_str(), entry.ty, field))
    });
    let fields = image::models(&found.collect::<Vec<_>>(), &["self", "super", "crate"], values, options);
    let facts = format!("user structure {} of {}", hex16(unit.identifier), count_of(length, "byte"));
    let title = docs::titled(&unit.name, &facts);
    let mut lines = docs::documented(title, &unit.name, unit.documentation.as_deref());
    lines.extend(image::table(&fields, &["decode"], |_| String::new()));
    UnitModel {
        name: format!("{name}Diagnosis"),
        docs: lines,
        derives: options.derives(true),
        api: unit.api,
        identifier: unit.identifier,
        length,
        fields,
    }
}
