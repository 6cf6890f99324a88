//! Structs of parameter records.

mod bytes;
mod check;

use super::docs;
use super::field::{Field, Use};
use super::image::{self, FieldModel};
use super::values::Values;
use crate::backend::rust::code::Doc;
use crate::backend::rust::{literal, RustOptions};
use crate::ir::{Access, Binding, Group, GroupKind, Item, Record, Value};
use crate::limits::MAX_RECORD_BYTES;
use crate::names::{self, Case, NameRequest};
use crate::number::hex16;
use crate::text::count_of;
use bytes::{default_bytes, has_bytes, value_of};
use check::{check, ranges};

/// Maximum length of a record's name, without a suffix that makes the name unique. The limit keeps the generated lines
/// that contain the record's type short.
const MAX_NAME: usize = 32;

/// Maximum length of a field's name, without a suffix that makes the name unique.
const MAX_FIELD_NAME: usize = 30;

/// Names that fields must not have.
const RESERVED_FIELDS: [&str; 3] = ["self", "super", "crate"];

/// Names that the constants for fields of a record must not have: keywords, and the names of constants that all records
/// have.
const RESERVED_CONSTANTS: [&str; 8] =
    ["self", "super", "crate", "index", "len", "transfer_sequence", "default", "default_bytes"];

/// A record, ready to be printed.
pub(in crate::backend::rust) struct RecordModel {
    pub name: String,
    /// Name of the record in the description, as a literal.
    pub title: String,
    pub docs: Vec<String>,
    pub derives: Vec<String>,
    pub index: u16,
    pub length: u32,
    pub transfer_sequence: u16,
    pub default_bytes: String,
    /// Changeable fields.
    pub fields: Vec<FieldModel>,
    /// Default values of the changeable fields.
    pub defaults: Vec<Doc>,
    /// Fields that cannot be changed and therefore become constants.
    pub constants: Vec<ConstantModel>,
    /// Statements that check the values of the fields.
    pub checks: Vec<Doc>,
    /// True if a literal may be close to a mathematical constant. Clippy reports such literals.
    pub has_real: bool,
}

/// A field that cannot be changed and therefore becomes a constant.
pub(in crate::backend::rust) struct ConstantModel {
    pub name: String,
    pub docs: Vec<String>,
    pub ty: String,
    /// True if the type is an enumeration.
    pub is_enumeration: bool,
    pub value: Doc,
}

/// An item and its field in the record.
struct Parameter<'i> {
    /// Position of the item in the group.
    position: u32,
    item: &'i Item,
    field: Field<'i>,
}

/// A record for which a struct is generated.
struct Named<'a> {
    /// Position of the group in the submodule.
    position: u32,
    group: &'a Group,
    record: &'a Record,
    /// Name of the struct without the ending `Record`.
    name: String,
}

/// The generated struct of a record, for documentation.
pub(super) struct RecordStruct<'a> {
    /// Position of the record in the submodule.
    pub position: u32,
    pub name: String,
    /// Default bytes of the record; empty if they are not completely known.
    pub default_bytes: Vec<u8>,
    /// For each changeable field: the position of its item, the item, and the name of the field.
    pub fields: Vec<(u32, &'a Item, String)>,
}

/// Returns the records of a submodule in the order of the description. Records without a valid length are left out.
pub(super) fn models<'a>(groups: &'a [Group], values: &'a Values<'a>, options: &RustOptions) -> Vec<RecordModel> {
    let model = |record| model(record, values, options);
    named_records(groups).into_iter().map(model).collect()
}

/// Returns the structs that are generated for a submodule's records.
pub(super) fn structs<'a>(groups: &'a [Group], values: &'a Values<'a>) -> Vec<RecordStruct<'a>> {
    let found = |Named { position, group, record, name }| {
        let parameters = parameters(group, record, values);
        let is_known = parameters.len() == group.items.len() && parameters.iter().all(has_bytes);
        let default_bytes = if is_known { default_bytes(record, &parameters) } else { Vec::new() };
        let free: Vec<_> = parameters.into_iter().filter(|parameter| !parameter.is_constant()).collect();
        let fields = named(&free, &RESERVED_FIELDS).into_iter();
        let fields = fields.map(|(parameter, name)| (parameter.position, parameter.item, names::escaped(&name)));
        RecordStruct { position, name: struct_name(&name), default_bytes, fields: fields.collect() }
    };
    named_records(groups).into_iter().map(found).collect()
}

fn named_records(groups: &[Group]) -> Vec<Named<'_>> {
    let records = (0..).zip(groups).filter_map(|(position, group)| match &group.kind {
        GroupKind::Record(record) if (1..=MAX_RECORD_BYTES).contains(&record.length) => {
            Some((position, group, &**record))
        }
        _ => None,
    });
    let records: Vec<(u32, &Group, &Record)> = records.collect();
    let name_requests = records
        .iter()
        .map(|(_, group, record)| NameRequest::new(&group.name, "parameter", format!("{:04X}", record.index)));
    let names = names::unique_up_to(name_requests, &[], Case::Pascal, MAX_NAME);
    let all = records.into_iter().zip(names);
    all.map(|((position, group, record), name)| Named { position, group, record, name }).collect()
}

fn struct_name(name: &str) -> String {
    format!("{name}Record")
}

/// Returns the items of a record that have a field.
fn parameters<'a>(group: &'a Group, record: &Record, values: &'a Values<'a>) -> Vec<Parameter<'a>> {
    let found = |(position, item): (u32, &'a Item)| {
        let (_, offset, bits) = record_address(item)?;
        let field = Field::new(values, item.ty, (offset, bits), record.length, Use::Record)?;
        Some(Parameter { position, item, field })
    };
    (0..).zip(&group.items).filter_map(found).collect()
}

impl Parameter<'_> {
    /// Returns whether the field cannot be changed.
    fn is_constant(&self) -> bool {
        self.item.access == Access::Constant
    }
}

fn model<'a>(record: Named<'a>, values: &'a Values<'a>, options: &RustOptions) -> RecordModel {
    let Named { group, record, name, .. } = record;
    let parameters = parameters(group, record, values);
    let left_out = group.items.len() - parameters.len();
    let bytes = default_bytes(record, &parameters);
    let (fixed, free): (Vec<_>, Vec<_>) = parameters.into_iter().partition(Parameter::is_constant);
    let constants = constants(&fixed, &bytes, values);
    let fields = named(&free, &RESERVED_FIELDS);
    let model = |(parameter, name): &(&Parameter<'_>, String)| {
        let field = &parameter.field;
        FieldModel::new(field, name, facts(parameter, values), options)
    };
    let models: Vec<FieldModel> = fields.iter().map(model).collect();
    let default = |at: usize| {
        let value = fields.get(at).and_then(|(parameter, _)| parameter.item.default.as_ref());
        value.map(docs::value).unwrap_or_default()
    };
    let mut docs = record_docs(group, record, left_out);
    docs.extend(image::table(&models, &["check", "encode", "decode"], default));
    RecordModel {
        name: struct_name(&name),
        title: literal::string(&group.name),
        docs,
        derives: options.derives(true),
        index: record.index,
        length: record.length,
        transfer_sequence: record.transfer_sequence,
        default_bytes: literal::bytes(&bytes),
        defaults: free.iter().map(|parameter| value_of(&parameter.field, &bytes)).collect(),
        checks: fields.iter().filter_map(|(parameter, name)| check(parameter, &names::escaped(name))).collect(),
        has_real: free.iter().chain(&fixed).any(|parameter| parameter.field.is_real()),
        fields: models,
        constants,
    }
}

/// Returns the record index, bit offset and number of bits of an item.
fn record_address(item: &Item) -> Option<(u16, u32, u32)> {
    item.bindings.iter().find_map(|binding| match binding {
        Binding::Record { index, bit_offset, bits } => Some((*index, *bit_offset, *bits)),
        _ => None,
    })
}

fn named<'p, 'i>(parameters: &'p [Parameter<'i>], reserved: &[&str]) -> Vec<(&'p Parameter<'i>, String)> {
    let name_requests = parameters.iter().map(|parameter| image::name_request(&parameter.item.name, &parameter.field));
    let names = names::unique_up_to(name_requests, reserved, Case::Snake, MAX_FIELD_NAME);
    parameters.iter().zip(names).collect()
}

fn constants(fixed: &[Parameter<'_>], bytes: &[u8], values: &Values<'_>) -> Vec<ConstantModel> {
    let named = named(fixed, &RESERVED_CONSTANTS);
    let constant = |(parameter, name): (&Parameter<'_>, String)| {
        let mut docs = facts(parameter, values);
        docs.extend([String::new(), "The device requires this value.".to_owned()]);
        ConstantModel {
            name: name.to_ascii_uppercase(),
            docs,
            ty: parameter.field.rust_type(),
            is_enumeration: parameter.field.enumeration.is_some(),
            value: value_of(&parameter.field, bytes),
        }
    };
    named.into_iter().map(constant).collect()
}

fn record_docs(group: &Group, record: &Record, left_out: usize) -> Vec<String> {
    let facts = format!("parameter record {} of {}", hex16(record.index), count_of(record.length, "byte"));
    let title = docs::titled(&group.name, &facts);
    let mut lines = docs::documented(title, &group.name, group.documentation.as_deref());
    if let Some(bump) = record.changeable_with_bump {
        let not = if bump { "may disturb" } else { "does not disturb" };
        lines.extend([String::new(), format!("Writing the record {not} the running device.")]);
    }
    if left_out > 0 {
        let text = format!("{left_out} parameters are left out because they are not within the bytes of the record.");
        lines.extend([String::new(), text]);
    }
    lines
}

fn facts(parameter: &Parameter<'_>, values: &Values<'_>) -> Vec<String> {
    let Parameter { item, field, .. } = parameter;
    let mut facts = field.facts(values.types, item.ty);
    if let Some(default) = &item.default {
        facts += &format!(", default {}", docs::value(default));
    }
    let ranges: Vec<String> = ranges(&item.limits)
        .iter()
        .map(|(first, last)| match (first, last) {
            (Some(first), Some(last)) if first == last => docs::value(first),
            (first, last) => format!("{} to {}", bound(first), bound(last)),
        })
        .collect();
    if !ranges.is_empty() {
        /// Maximum number of ranges that documentation lists.
        const SHOWN: usize = 16;
        let more = if ranges.len() > SHOWN { ", …" } else { "" };
        facts += &format!(", allowed {}{more}", ranges[..ranges.len().min(SHOWN)].join(", "));
    }
    docs::documented(docs::titled(&item.name, &facts), &item.name, item.documentation.as_deref())
}

fn bound(value: &Option<Value>) -> String {
    value.as_ref().map_or_else(|| "any".to_owned(), docs::value)
}
