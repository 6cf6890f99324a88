//! Parameter records: constants, parameters and menus.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::fmt::Write as _;

use super::types;
use super::Context;
use crate::note::{NoteKind, Place};
use crate::xml::Xml;
use lexibus_codegen::ir::{
    Access, Binding, CompactString, Extension, FParameter, FParameters, Group, GroupKind, Item, Menu, Record,
    Submodule, Value,
};

/// Writes RecordDataList, if there is anything in it.
pub(super) fn list(xml: &mut Xml, context: &mut Context<'_>, submodule: &Submodule) {
    if submodule.records.is_empty() && submodule.f_parameters.is_none() {
        return;
    }
    xml.open("RecordDataList");
    let mut menus = Menus::new(&submodule.menus);
    for group in &submodule.records {
        let GroupKind::Record(record) = &group.kind else { continue };
        xml.open("ParameterRecordDataItem");
        xml.attribute("Index", record.index);
        xml.attribute("Length", record.length);
        if record.transfer_sequence != 0 {
            xml.attribute("TransferSequence", record.transfer_sequence);
        }
        xml.optional("ChangeableWithBump", record.changeable_with_bump);
        xml.open("Name");
        xml.attribute("TextId", context.texts.id(&group.name, &group.names));
        xml.close();
        body(xml, context, record, group, &menus.take(group));
        xml.close();
    }
    context.notes.add_many(NoteKind::OtherPart, menus.others(), Place::Named(&submodule.name));
    if let Some(parameters) = &submodule.f_parameters {
        f_record(xml, submodule, parameters);
    }
    xml.close();
}

/// The menus of a submodule, each taken by the first record that it belongs to.
struct Menus<'m> {
    /// Those that no record took so far.
    left: Vec<Option<&'m Menu>>,
    /// By their names and by those that they show.
    by_name: HashMap<&'m str, Vec<usize>>,
}

impl<'m> Menus<'m> {
    fn new(menus: &'m [Menu]) -> Self {
        let mut by_name: HashMap<&str, Vec<usize>> = HashMap::new();
        for (at, menu) in menus.iter().enumerate() {
            for name in menu.targets.iter().chain([&menu.id]) {
                by_name.entry(name).or_default().push(at);
            }
        }
        Menus { left: menus.iter().map(Some).collect(), by_name }
    }

    /// The menus with parameters of a record and those that are connected with them, in their order.
    fn take(&mut self, group: &'m Group) -> Vec<&'m Menu> {
        let mut own = BTreeMap::new();
        let mut names: Vec<&str> = group.items.iter().filter_map(id).map(CompactString::as_str).collect();
        while let Some(name) = names.pop() {
            // Each name leads to its menus once.
            for at in self.by_name.remove(name).into_iter().flatten() {
                if let Some(menu) = self.left.get_mut(at).and_then(Option::take) {
                    names.extend(menu.targets.iter().chain([&menu.id]).map(CompactString::as_str));
                    own.insert(at, menu);
                }
            }
        }
        own.into_values().collect()
    }

    /// How many no record took.
    fn others(&self) -> usize {
        self.left.iter().flatten().count()
    }
}

fn id(item: &Item) -> Option<&CompactString> {
    item.extensions.iter().find(|extension| extension.key == "ID").map(|extension| &extension.value)
}

/// Constants, parameters and menus.
pub(super) fn body(xml: &mut Xml, context: &mut Context<'_>, record: &Record, group: &Group, menus: &[&Menu]) {
    for (offset, data) in &record.constants {
        xml.open("Const");
        if *offset != 0 {
            xml.attribute("ByteOffset", offset);
        }
        xml.attribute("Data", octets(data));
        xml.close();
    }
    group.items.iter().for_each(|item| parameter(xml, context, item));
    if !menus.is_empty() {
        xml.open("MenuList");
        let names: HashSet<&str> = menus.iter().map(|own| own.id.as_str()).collect();
        menus.iter().for_each(|own| menu(xml, context, own, &names));
        xml.close();
    }
    context.notes.add_many(NoteKind::Extension, group.extensions.len(), Place::Named(&group.name));
}

fn octets(data: &[u8]) -> String {
    let mut text = String::with_capacity(5 * data.len());
    for byte in data {
        let comma = if text.is_empty() { "" } else { "," };
        let _ = write!(text, "{comma}0x{byte:02X}");
    }
    text
}

fn parameter(xml: &mut Xml, context: &mut Context<'_>, item: &Item) {
    let place = Place::Named(&item.name);
    let Some(Binding::Record { bit_offset, bits, .. }) = item.bindings.first() else {
        return context.notes.add(NoteKind::Binding, place);
    };
    let (offset, bits, types) = (*bit_offset, *bits, context.types);
    let values = types::enumeration(item.ty, types);
    let ty = values.map_or(item.ty, |(_, base)| base);
    xml.open("Ref");
    xml.optional("ID", id(item));
    xml.optional("ValueItemTarget", values.map(|(def, _)| &def.name).or_else(|| kept(item, "ValueItemTarget")));
    types::place(xml, context, ty, (offset, bits), &item.name);
    if let Some(default) = item.default.as_ref().and_then(value) {
        xml.attribute("DefaultValue", default);
    }
    if item.limits.are_swapped(ty) && item.limits.allowed.is_empty() {
        context.notes.add(NoteKind::SwappedLimits, place);
    }
    xml.optional("AllowedValues", allowed(item));
    if !matches!(item.access, Access::ReadWrite) {
        xml.attribute("Changeable", "false");
    }
    if item.behaviour.as_ref().is_some_and(|behaviour| behaviour.hidden) {
        xml.attribute("Visible", "false");
    }
    xml.attribute("TextId", context.texts.id(&item.name, &item.names));
    xml.close();
    let is_told = |extension: &&Extension| matches!(extension.key.as_str(), "ID" | "ValueItemTarget" | "AllowedValues");
    let lost = item.extensions.iter().filter(|extension| !is_told(extension)).count();
    context.notes.add_many(NoteKind::Extension, lost, place);
}

fn kept<'i>(item: &'i Item, key: &str) -> Option<&'i CompactString> {
    item.extensions.iter().find(|extension| extension.key == key).map(|extension| &extension.value)
}

fn value(value: &Value) -> Option<String> {
    Some(match value {
        Value::Bool(value) => u8::from(*value).to_string(),
        Value::Int(value) => value.to_string(),
        Value::Real(value) => real(*value),
        Value::Text(text) | Value::Raw(text) => text.to_string(),
        Value::Bytes(bytes) => octets(bytes),
        Value::NodeId(_) | Value::Time { .. } => return None,
    })
}

/// A number with a point, or an exponent, of which no side is empty.
fn real(value: f64) -> String {
    format!("{value:?}")
}

/// The values that are allowed, as ranges; what was kept as it is stays so.
fn allowed(item: &Item) -> Option<String> {
    if let Some(kept) = kept(item, "AllowedValues") {
        return Some(kept.to_string());
    }
    let limits = &item.limits;
    let one = limits.low.clone().zip(limits.high.clone()).filter(|_| !limits.are_swapped(item.ty));
    let ranges = if limits.allowed.is_empty() { one.as_slice() } else { &limits.allowed };
    let range = |(first, last): &(Value, Value)| match (value(first)?, value(last)?) {
        (first, last) if first == last => Some(first),
        (first, last) => Some(format!("{first}..{last}")),
    };
    let texts: Vec<String> = ranges.iter().filter_map(range).collect();
    (!texts.is_empty()).then(|| texts.join(" "))
}

fn menu(xml: &mut Xml, context: &mut Context<'_>, menu: &Menu, all: &HashSet<&str>) {
    xml.open("MenuItem");
    xml.attribute("ID", &menu.id);
    xml.open("Name");
    xml.attribute("TextId", context.texts.id(&menu.name, &menu.names));
    xml.close();
    for target in &menu.targets {
        let is_menu = all.contains(target.as_str());
        let (element, attribute) =
            if is_menu { ("MenuRef", "MenuTarget") } else { ("ParameterRef", "ParameterTarget") };
        xml.open(element);
        xml.attribute(attribute, target);
        xml.close();
    }
    xml.close();
}

fn f_record(xml: &mut Xml, submodule: &Submodule, parameters: &FParameters) {
    xml.open("F_ParameterRecordDataItem");
    xml.attribute("Index", parameters.index);
    if parameters.transfer_sequence != 0 {
        xml.attribute("TransferSequence", parameters.transfer_sequence);
    }
    xml.optional("F_ParamDescCRC", parameters.description_crc);
    for (key, value) in &submodule.attributes {
        if let Some(("F_ParameterRecordDataItem", name)) = key.split_once('@') {
            xml.attribute(name, value);
        }
    }
    parameters.parameters.iter().for_each(|own| f_parameter(xml, own));
    xml.close();
}

fn f_parameter(xml: &mut Xml, parameter: &FParameter) {
    xml.open(parameter.name.to_string());
    match parameter.label.as_str() {
        "" => xml.attribute("DefaultValue", parameter.default),
        label => xml.attribute("DefaultValue", label),
    }
    let range = |&(first, last): &(i128, i128)| match first == last {
        true => first.to_string(),
        false => format!("{first}..{last}"),
    };
    let ranges: Vec<String> = parameter.allowed.iter().map(range).collect();
    if !parameter.allowed_labels.is_empty() {
        xml.attribute("AllowedValues", parameter.allowed_labels.join(" "));
    } else if !ranges.is_empty() {
        xml.attribute("AllowedValues", ranges.join(" "));
    }
    xml.attribute("Changeable", parameter.changeable);
    xml.attribute("Visible", parameter.visible);
    xml.close();
}
