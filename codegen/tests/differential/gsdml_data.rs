//! Returns the data of GSDML submodules as facts.

use lexibus_codegen::ir::{
    Access, Binding, Group, GroupKind, IoData, Item, Limits, Menu, PdoEntryKind, Shape, Submodule, Type, TypeDef,
};

use super::facts::{put, put_flag, put_number, put_some, Elements, Facts};
use super::values::{hex, put_names, type_name, value};

/// Adds the data items of inputs or outputs. A data item that has no entry in `data.items` is a field of the image.
pub fn io_data(elements: &mut Elements, key: &str, data: &IoData, types: &[TypeDef]) {
    let mut facts = Facts::new();
    put(&mut facts, "length", (data.image.length + data.image.overhead).to_string());
    put_number(&mut facts, "trailer", data.image.overhead);
    put_flag(&mut facts, "consistent", data.consistent);
    elements.insert(key.to_owned(), facts);
    let is_within = |at: usize| {
        let at = at as u32;
        data.items.iter().any(|item| (item.first_field..item.first_field + item.fields).contains(&at))
    };
    let mut items: Vec<(u32, Facts, std::ops::Range<usize>)> = Vec::new();
    for (at, field) in data.image.fields.iter().enumerate().filter(|(at, _)| !is_within(*at)) {
        let mut facts = Facts::new();
        put(&mut facts, "offset", field.bit_offset.to_string());
        put(&mut facts, "bits", field.bits.to_string());
        put(&mut facts, "type", type_name(field.ty, types));
        put_names(&mut facts, "name", &field.name, &field.names);
        items.push((field.bit_offset, facts, at..at));
    }
    for item in &data.items {
        let mut facts = Facts::new();
        put(&mut facts, "offset", item.bit_offset.to_string());
        put(&mut facts, "bits", item.bits.to_string());
        put(&mut facts, "spelled", item.data_type.as_str());
        put_flag(&mut facts, "subordinate", item.subordinate);
        put_names(&mut facts, "name", &item.name, &item.names);
        let first = item.first_field as usize;
        items.push((item.bit_offset, facts, first..first + item.fields as usize));
    }
    items.sort_by_key(|(offset, ..)| *offset);
    for (place, (_, facts, fields)) in items.into_iter().enumerate() {
        elements.insert(format!("{key} item {place}"), facts);
        let fields = &data.image.fields[fields];
        for bit in fields.iter().filter(|bit| bit.ty == Type::Boolean && bit.kind != PdoEntryKind::Padding) {
            let mut facts = Facts::new();
            put_names(&mut facts, "name", &bit.name, &bit.names);
            elements.insert(format!("{key} item {place} bit {}", bit.bit_offset), facts);
        }
    }
}

pub fn records(elements: &mut Elements, owner: &str, submodule: &Submodule, types: &[TypeDef]) {
    for (place, group) in submodule.records.iter().enumerate() {
        let key = format!("{owner} record {place}");
        let mut facts = body(elements, &key, group, types);
        if let GroupKind::Record(record) = &group.kind {
            put(&mut facts, "index", record.index.to_string());
            put_number(&mut facts, "sequence", record.transfer_sequence);
            put_flag(&mut facts, "bump", record.changeable_with_bump.unwrap_or(false));
        }
        elements.insert(key, facts);
    }
    let Some(actual) = &submodule.f_parameters else { return };
    let mut facts = Facts::new();
    put(&mut facts, "index", actual.index.to_string());
    put_some(&mut facts, "CRC", actual.description_crc);
    put_number(&mut facts, "sequence", actual.transfer_sequence);
    elements.insert(format!("{owner} F"), facts);
    for parameter in &actual.parameters {
        let mut facts = Facts::new();
        let is_number = parameter.label.is_empty();
        put(&mut facts, "default", if is_number { parameter.default.to_string() } else { parameter.label.to_string() });
        let range = |&(first, last): &(i128, i128)| match first == last {
            true => first.to_string(),
            false => format!("{first}..{last}"),
        };
        let labels = parameter.allowed_labels.iter().map(ToString::to_string);
        let allowed: Vec<String> = parameter.allowed.iter().map(range).chain(labels).collect();
        put(&mut facts, "allowed", allowed.join(" "));
        put_flag(&mut facts, "changeable", parameter.changeable);
        put_flag(&mut facts, "visible", parameter.visible);
        elements.insert(format!("{owner} F {}", parameter.name), facts);
    }
}

/// Adds the parameters of a record or vendor block. Returns the facts of the whole record or block.
pub fn body(elements: &mut Elements, key: &str, group: &Group, types: &[TypeDef]) -> Facts {
    for (place, item) in group.items.iter().enumerate() {
        elements.insert(format!("{key} ref {place}"), parameter(item, types));
    }
    let mut facts = Facts::new();
    put_names(&mut facts, "name", &group.name, &group.names);
    let GroupKind::Record(record) = &group.kind else { return facts };
    put(&mut facts, "length", record.length.to_string());
    let constants = record.constants.iter().map(|(at, octets)| format!("{at}:x'{}'", hex(octets)));
    put(&mut facts, "constants", constants.collect::<Vec<_>>().join(" "));
    facts
}

fn parameter(item: &Item, types: &[TypeDef]) -> Facts {
    let mut facts = Facts::new();
    put(&mut facts, "type", type_name(item.ty, types));
    if let Some(Binding::Record { bit_offset, bits, .. }) = item.bindings.first() {
        put(&mut facts, "offset", bit_offset.to_string());
        put(&mut facts, "bits", bits.to_string());
    }
    put_some(&mut facts, "default", item.default.as_ref().map(value));
    put(&mut facts, "allowed", allowed(&item.limits));
    put_flag(&mut facts, "changeable", item.access == Access::ReadWrite);
    put_flag(&mut facts, "visible", !item.behavior.as_ref().is_some_and(|behavior| behavior.hidden));
    let unsuitable = item.related.as_ref().map(|related| related.unsuitable_values.as_str());
    put_some(&mut facts, "values", values(item.ty, types).or(unsuitable.filter(|values| !values.is_empty())));
    put_names(&mut facts, "name", &item.name, &item.names);
    facts
}

/// Returns the name of the value list of a type, or `None` if the type has no value list.
fn values(ty: Type, types: &[TypeDef]) -> Option<&str> {
    let Type::Named(id) = ty else { return None };
    let types = &types[id.0 as usize];
    matches!(types.shape, Shape::Enumeration { .. }).then_some(types.name.as_str())
}

fn allowed(limits: &Limits) -> String {
    if let (Some(low), Some(high), true) = (&limits.low, &limits.high, limits.allowed.is_empty()) {
        return format!("{}..{}", value(low), value(high));
    }
    let ranges = limits.allowed.iter().map(|(first, last)| format!("{}..{}", value(first), value(last)));
    ranges.collect::<Vec<_>>().join(" ")
}

pub fn menus(elements: &mut Elements, owner: &str, menus: &[Menu]) {
    for (place, menu) in menus.iter().enumerate() {
        let mut facts = Facts::new();
        put(&mut facts, "id", menu.id.as_str());
        put(&mut facts, "targets", menu.targets.join(" "));
        put_names(&mut facts, "name", &menu.name, &menu.names);
        elements.insert(format!("{owner} menu {place}"), facts);
    }
}
