//! Writes parameter records: constants, parameters and menus.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::fmt::Write as _;

use super::values::range;
use super::{elements, types, Context};
use crate::note::{NoteKind, Subject};
use crate::xml::Xml;
use lexibus_codegen::ir::{
    Access, Binding, CompactString, FParameter, FParameters, Group, GroupKind, Item, Menu, Record, RelatedItems,
    Submodule, Value,
};

/// Writes the RecordDataList element unless it is empty.
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
        xml.unless("TransferSequence", record.transfer_sequence, 0);
        xml.optional("ChangeableWithBump", record.changeable_with_bump);
        context.texts.text(xml, "Name", &group.name, &group.names);
        body(xml, context, record, group, &menus.take(group));
        xml.close();
    }
    xml.notes.add_many(NoteKind::OtherPart, menus.others(), Subject::Named(&submodule.name));
    if let Some(parameters) = &submodule.f_parameters {
        f_record(xml, submodule, parameters);
    }
    xml.close();
}

/// The menus of a submodule. Each menu is written with the first record that uses it.
struct Menus<'m> {
    /// Menus that no record has used so far.
    left: Vec<Option<&'m Menu>>,
    /// Positions of menus, keyed by the identifier of the menu and by the identifiers of the parameters and menus in
    /// it.
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

    /// Removes and returns the menus that contain parameters of a record, and the menus that are connected with these
    /// menus by references. Keeps the order of the description file.
    fn take(&mut self, group: &'m Group) -> Vec<&'m Menu> {
        let mut menus = BTreeMap::new();
        let mut names: Vec<&str> = group.items.iter().filter_map(id).map(CompactString::as_str).collect();
        while let Some(name) = names.pop() {
            // Remove each name from the map, because its menus have to be collected only once.
            for at in self.by_name.remove(name).into_iter().flatten() {
                if let Some(menu) = self.left.get_mut(at).and_then(Option::take) {
                    names.extend(menu.targets.iter().chain([&menu.id]).map(CompactString::as_str));
                    menus.insert(at, menu);
                }
            }
        }
        menus.into_values().collect()
    }

    /// Returns the number of menus that no record has used.
    fn others(&self) -> usize {
        self.left.iter().flatten().count()
    }
}

fn id(item: &Item) -> Option<&CompactString> {
    reference(item, |related| &related.id)
}

/// Writes the constants, parameters and menus of a record.
pub(super) fn body(xml: &mut Xml, context: &mut Context<'_>, record: &Record, group: &Group, menus: &[&Menu]) {
    for (offset, data) in &record.constants {
        xml.open("Const");
        xml.unless("ByteOffset", *offset, 0);
        xml.attribute("Data", octets(data));
        xml.close();
    }
    group.items.iter().for_each(|item| parameter(xml, context, item));
    let names: HashSet<&str> = menus.iter().map(|menu| menu.id.as_str()).collect();
    xml.list("MenuList", menus, |xml, each| menu(xml, context, each, &names));
    xml.notes.add_many(NoteKind::Extension, group.extensions.len(), Subject::Named(&group.name));
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
    let subject = Subject::Named(&item.name);
    let Some(Binding::Record { bit_offset, bits, .. }) = item.bindings.first() else {
        return xml.notes.add(NoteKind::Binding, subject);
    };
    let (offset, bits, types) = (*bit_offset, *bits, context.types);
    let values = types::enumeration(item.ty, types);
    let ty = values.map_or(item.ty, |(_, base)| base);
    xml.open("Ref");
    xml.optional("ID", id(item));
    xml.optional(
        "ValueItemTarget",
        values.map(|(def, _)| &def.name).or_else(|| reference(item, |related| &related.unsuitable_values)),
    );
    types::position(xml, context, ty, offset, bits, &item.name);
    xml.optional("DefaultValue", item.default.as_ref().and_then(value));
    if item.limits.are_swapped(ty) && item.limits.allowed.is_empty() {
        xml.notes.add(NoteKind::SwappedLimits, subject);
    }
    xml.optional("AllowedValues", allowed(item));
    xml.flag("Changeable", item.access != Access::ReadWrite, "false");
    xml.flag("Visible", item.behavior.as_ref().is_some_and(|behavior| behavior.hidden), "false");
    xml.attribute("TextId", context.texts.id(&item.name, &item.names));
    xml.close();
    xml.notes.add_many(NoteKind::Extension, item.extensions.len(), subject);
}

/// Returns an identifier in the relations of an item, if there is one.
fn reference(item: &Item, text: impl Fn(&RelatedItems) -> &CompactString) -> Option<&CompactString> {
    item.related.as_deref().map(text).filter(|text| !text.is_empty())
}

fn value(value: &Value) -> Option<String> {
    Some(match value {
        Value::Bool(value) => u8::from(*value).to_string(),
        Value::Int(value) => value.to_string(),
        // Rust's debug notation has a decimal point or an exponent, with digits on both sides of the point.
        Value::Real(value) => format!("{value:?}"),
        Value::Text(text) | Value::Raw(text) => text.to_string(),
        Value::Bytes(bytes) => octets(bytes),
        Value::NodeId(_) | Value::Time { .. } => return None,
    })
}

/// Returns the allowed values as ranges. If the IR stores the original text, returns this text.
fn allowed(item: &Item) -> Option<String> {
    let limits = &item.limits;
    if !limits.text.is_empty() {
        return Some(limits.text.to_string());
    }
    let one = limits.low.clone().zip(limits.high.clone()).filter(|_| !limits.are_swapped(item.ty));
    let ranges = if limits.allowed.is_empty() { one.as_slice() } else { &limits.allowed };
    let texts: Vec<String> =
        ranges.iter().filter_map(|(first, last)| Some(range(value(first)?, value(last)?))).collect();
    (!texts.is_empty()).then(|| texts.join(" "))
}

fn menu(xml: &mut Xml, context: &mut Context<'_>, menu: &Menu, all: &HashSet<&str>) {
    xml.open("MenuItem");
    xml.attribute("ID", &menu.id);
    context.texts.text(xml, "Name", &menu.name, &menu.names);
    for target in &menu.targets {
        let is_menu = all.contains(target.as_str());
        let (element, attribute) =
            if is_menu { ("MenuRef", "MenuTarget") } else { ("ParameterRef", "ParameterTarget") };
        xml.empty(element, &[(attribute, target)]);
    }
    xml.close();
}

fn f_record(xml: &mut Xml, submodule: &Submodule, parameters: &FParameters) {
    xml.open("F_ParameterRecordDataItem");
    xml.attribute("Index", parameters.index);
    xml.unless("TransferSequence", parameters.transfer_sequence, 0);
    xml.optional("F_ParamDescCRC", parameters.description_crc);
    elements::attributes_of(xml, "F_ParameterRecordDataItem", &submodule.attributes);
    parameters.parameters.iter().for_each(|parameter| f_parameter(xml, parameter));
    xml.close();
}

fn f_parameter(xml: &mut Xml, parameter: &FParameter) {
    xml.open(parameter.name.to_string());
    match parameter.label.as_str() {
        "" => xml.attribute("DefaultValue", parameter.default),
        label => xml.attribute("DefaultValue", label),
    }
    let ranges: Vec<String> = parameter.allowed.iter().map(|(first, last)| range(first, last)).collect();
    let allowed =
        if parameter.allowed_labels.is_empty() { &ranges.join(" ") } else { &parameter.allowed_labels.join(" ") };
    xml.text_attribute("AllowedValues", allowed);
    xml.attribute("Changeable", parameter.changeable);
    xml.attribute("Visible", parameter.visible);
    xml.close();
}
