//! Modular devices: objects and sub-indices that modules add to the dictionary (CiA 306, "modular devices").

use std::collections::BTreeMap;

use super::header;
use super::keywords::{Key, Raw, OF_MANY_VALUES};
use super::lists;
use super::object::{in_order_of_file, ObjectSections};
use super::reader::{Fixed, Reader};
use super::sections::ModulePart;
use crate::diagnostics::codes;
use crate::frontend::canopen::number;
use crate::ir::{Binding, Device, Group, Item, Module, SubExtension};
use crate::number::hex16;
use crate::source::Span;
use crate::syntax::ini::{Entry, Section};
use crate::text::count_of;

/// Sections of a module, grouped by [`ModulePart`].
#[derive(Default)]
struct Parts {
    info: Vec<Section>,
    comments: Vec<Section>,
    fixed_list: Vec<Section>,
    fixed: BTreeMap<u16, ObjectSections>,
    extends_list: Vec<Section>,
    extensions: BTreeMap<u16, Vec<Section>>,
}

/// Reads the modules of a device. `sections` is sorted by module number.
pub(super) fn read(
    reader: &mut Reader<'_, '_>,
    sections: Vec<(u32, ModulePart, Section)>,
    device: &Device,
) -> Vec<Module> {
    let mut by_module: BTreeMap<u32, Parts> = BTreeMap::new();
    for (number, part, section) in sections {
        let parts = by_module.entry(number).or_default();
        match part {
            ModulePart::Info => parts.info.push(section),
            ModulePart::Comments => parts.comments.push(section),
            ModulePart::FixedObjects => parts.fixed_list.push(section),
            ModulePart::FixedObject(index) => parts.fixed.entry(index).or_default().object.push(section),
            ModulePart::FixedSub(index, sub) => parts.fixed.entry(index).or_default().subs.push((sub, section)),
            ModulePart::SubExtends => parts.extends_list.push(section),
            ModulePart::SubExtension(index) => parts.extensions.entry(index).or_default().push(section),
        }
    }
    check_announced(reader, &by_module);
    by_module.into_iter().map(|(number, parts)| module(reader, number, parts, device)).collect()
}

fn check_announced(reader: &mut Reader<'_, '_>, by_module: &BTreeMap<u32, Parts>) {
    let described = by_module.len();
    let Some((announced, span)) = reader.announced_modules else {
        if described > 0 {
            reader.missing_section("SupportedModules");
        }
        return;
    };
    if announced as usize != described {
        let message = format!("the file declares {}, but describes {described}", count_of(announced, "module"));
        reader.diagnostics.push(codes::UNRESOLVED_MODULE.at(span, message));
    }
}

fn module(reader: &mut Reader<'_, '_>, number: u32, mut parts: Parts, device: &Device) -> Module {
    let mut module = Module { number, ..Module::default() };
    info(reader, &parts.info, &mut module);
    reader.duplicate_sections(&parts.comments);
    header::comments(reader, &parts.comments, &mut module.comments, &mut module.extensions);
    let fixed = announced(reader, &parts.fixed_list, &mut module);
    missing(reader, &fixed, |index| parts.fixed.contains_key(&index), |index| format!("[M{number}Fixed{index:04X}]"));
    for (&index, sections) in &mut parts.fixed {
        sections.subs.sort_by_key(|&(sub, _)| sub);
        if let Some(group) = reader.object(index, sections) {
            clash(reader, &group, device);
            if !fixed.contains_key(&index) {
                let message = format!("object {} is not listed in [M{number}FixedObjects]", hex16(index));
                reader.diagnostics.push(codes::NOT_LISTED.at(group.origin.span, message));
            }
            module.fixed_objects.push(group);
        }
    }
    let extends = announced(reader, &parts.extends_list, &mut module);
    let section_name = |index| format!("[M{number}SubExt{index:04X}]");
    missing(reader, &extends, |index| parts.extensions.contains_key(&index), section_name);
    for (&index, sections) in &parts.extensions {
        let extension = sub_extension(reader, index, sections);
        let origin = extension.template.origin.span;
        if !extends.contains_key(&index) {
            let message = format!("object {} is not listed in [M{number}SubExtends]", hex16(index));
            reader.diagnostics.push(codes::SUB_EXTEND.at(origin, message));
        }
        extended_object(reader, index, origin, device);
        module.sub_extensions.push(extension);
    }
    module
}

fn info(reader: &mut Reader<'_, '_>, sections: &[Section], module: &mut Module) {
    const KEYS: [&str; 4] = ["ProductName", "ProductVersion", "ProductRevision", "OrderCode"];
    reader.duplicate_sections(sections);
    let mut seen = [None; KEYS.len()];
    for section in sections {
        module.origin = reader.origin(section);
        for ref entry in reader.doc.entries(section) {
            let key = reader.doc.key(entry);
            let Some(which) = KEYS.iter().position(|known| known.eq_ignore_ascii_case(key)) else {
                reader.extension(entry, &mut module.extensions);
                continue;
            };
            reader.once(&mut seen[which], entry);
            let text = match which {
                0 => &mut module.name,
                1 => &mut module.version,
                2 => &mut module.revision,
                _ => &mut module.identity.order_code,
            };
            let mut at = Span::default();
            reader.name(Some(entry), text, &mut at);
        }
    }
}

/// Returns the indices in an object list of a module, each with its entry.
fn announced(reader: &mut Reader<'_, '_>, sections: &[Section], module: &mut Module) -> BTreeMap<u16, Entry> {
    reader.duplicate_sections(sections);
    let mut indices = BTreeMap::new();
    for entry in lists::numbered(reader, sections, "NrOfEntries", &mut module.extensions) {
        let Some(index) = reader.index_of(&entry) else { continue };
        if indices.insert(index, entry).is_some() {
            let message = format!("{} is listed twice", hex16(index));
            let span = reader.doc.value_span(&entry);
            reader.diagnostics.push(codes::LISTED_TWICE.at(span, message));
        }
    }
    reader.take_comments(&mut module.extensions);
    indices
}

fn missing(
    reader: &mut Reader<'_, '_>,
    announced: &BTreeMap<u16, Entry>,
    exists: impl Fn(u16) -> bool,
    section_name: impl Fn(u16) -> String,
) {
    for (index, entry) in announced {
        if !exists(*index) {
            let span = reader.doc.value_span(entry);
            let message = format!("the section {} is missing", section_name(*index));
            reader.report(&codes::UNRESOLVED_MODULE, span, message, "this entry declares the section");
        }
    }
}

/// Reports a module that adds sub-indices to an object of the device, if this object cannot have sub-indices.
fn extended_object(reader: &mut Reader<'_, '_>, index: u16, span: Span, device: &Device) {
    let Some(object) = device.object(index) else { return };
    if let Some(code) = object.object_code().filter(|code| !code.has_subs()) {
        let message = format!("object {} of the device is a {}, which has no sub-indices", hex16(index), code.name());
        let found = codes::SUB_EXTEND.at(span, message);
        reader.diagnostics.push(found.note_at(object.origin.span, "description in the device"));
    }
}

fn clash(reader: &mut Reader<'_, '_>, group: &Group, device: &Device) {
    let Some(object) = group.index().and_then(|index| device.object(index)) else { return };
    let found = codes::MODULE_INDEX_CLASH.at(group.origin.span, "the device already has this object");
    reader.diagnostics.push(found.note_at(object.origin.span, "description in the device"));
}

fn sub_extension(reader: &mut Reader<'_, '_>, index: u16, sections: &[Section]) -> SubExtension {
    reader.duplicate_sections(sections);
    let mut raw = Raw::new();
    reader.assign(sections, &["Count", "ObjExtend"], &mut raw);
    let code = reader.sub_code(&raw);
    let mut template = Item::new(Binding::canopen(index, 1));
    reader.describe(&mut template, &raw, code);
    reader.name(raw.get(Key::ParameterName), &mut template.name, &mut template.at.name);
    reader.unused(&raw, &OF_MANY_VALUES, &mut template.extensions);
    template.extensions.append(&mut raw.extensions);
    let (count, per) = sub_count(reader, &raw);
    let extends_object = raw.more[1].is_some_and(|entry| obj_extend(reader, &entry));
    reader.take_comments(&mut template.extensions);
    in_order_of_file(&mut template.extensions);
    SubExtension { index, count, per, extends_object, template }
}

/// Returns the number of sub-indices that a module adds. If this number is 0, the second value is the number of bits
/// that the module adds to a common sub-index. Reports a missing or invalid `Count`, and returns 0 for it.
fn sub_count(reader: &mut Reader<'_, '_>, raw: &Raw) -> (u16, Option<u16>) {
    let mut report = |span, message: String, label| {
        let help = "write the number of sub-indices, or `0;` and the number of bits";
        reader.diagnostics.push(codes::SUB_EXTEND.at(span, message).label(label).help(help));
    };
    let Some(entry) = raw.more[0].filter(|entry| !reader.doc.value(entry).is_empty()) else {
        let message = "the key Count is missing";
        report(raw.origin.span, message.into(), "");
        return (0, None);
    };
    let (text, span) = (reader.doc.value(&entry), reader.doc.value_span(&entry));
    let Some((number, bits)) = count(text) else {
        report(span, format!("`{text}` is not a valid value of Count"), "left out");
        return (0, None);
    };
    match (number, bits) {
        (0, None) => report(span, "Count is 0, so the module adds no sub-index".into(), ""),
        (1.., Some(_)) => report(span, format!("Count `{text}` declares both sub-indices and bits"), ""),
        _ => {}
    }
    (number, bits)
}

fn obj_extend(reader: &mut Reader<'_, '_>, entry: &Entry) -> bool {
    let (text, span) = reader.fixed(entry, Fixed::Number);
    let value = number::parse(text, &[]).int();
    if !text.is_empty() && !matches!(value, Some(0 | 1)) {
        let message = format!("ObjExtend is `{text}`, expected 0 or 1");
        reader.diagnostics.push(codes::SUB_EXTEND.at(span, message).label("read as 0"));
    }
    value == Some(1)
}

/// Reads a count in the form `n` or `n;m`.
fn count(text: &str) -> Option<(u16, Option<u16>)> {
    let number = |text: &str| number::parse(text.trim(), &[]).int().and_then(|value| u16::try_from(value).ok());
    match text.split_once(';') {
        Some((count, bits)) => Some((number(count)?, Some(number(bits)?))),
        None => Some((number(text)?, None)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_of_sub_extensions() {
        assert_eq!(count("3"), Some((3, None)));
        assert_eq!(count("0;2"), Some((0, Some(2))));
        assert_eq!(count("x"), None);
    }
}
