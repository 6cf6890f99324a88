//! Process data that the table itself describes.

use super::at::At;
use super::format::{ImageTable, NumberOrText, PdoTable};
use super::place;
use super::tree::{cited, Reader};
use super::types;
use crate::diagnostics::codes;
use crate::ir::{Binding, Device, Direction, Group, GroupKind, Item, Pdo, PdoEntry, PdoEntryKind, Type};
use crate::text::brief;

/// A direction, seen from the device.
pub(super) fn direction(reader: &mut Reader<'_, '_>, given: Option<&At<String>>) -> Option<Direction> {
    reader.word(given?, "direction", &[("rx", Direction::Receive), ("tx", Direction::Transmit)])
}

/// Adds a PDO.
pub(super) fn pdo(reader: &mut Reader<'_, '_>, table: &At<PdoTable>, device: &mut Device) {
    let own = &table.value;
    let direction = direction(reader, own.direction.as_ref());
    let (Some(index), Some(direction)) = (&own.index, direction) else {
        reader.report(&codes::TABLE_VALUE, reader.span(table), "a PDO has an `index` and a `direction`");
        return;
    };
    let mut pdo = Pdo::new(direction, index.value);
    pdo.origin = reader.origin(table);
    pdo.name = own.name.as_deref().unwrap_or_default().into();
    (pdo.fixed, pdo.mandatory) = (own.fixed, own.mandatory);
    pdo.sync_manager = own.sm.filter(|_| own.default);
    for excluded in &own.excludes {
        let found = match excluded {
            NumberOrText::Number(index) => u16::try_from(*index).ok().map(|index| (index, index)),
            NumberOrText::Text(text) => place::objects(text).map(|own| own.indices),
        };
        match found {
            Some((first, last)) => pdo.excludes.extend((first..=last).filter(|&other| other != index.value)),
            None => reader.report(&codes::TABLE_PLACE, reader.span(table), "`excludes` has indices of PDOs"),
        }
    }
    let cite = own.cite.as_ref().map(cited);
    device.doubts.extend(reader.doubts([own.doubt.as_ref(), own.doubts.as_ref()], pdo.origin, cite.as_deref()));
    for text in &own.entries {
        if let Some(entry) = entry(reader, text, device) {
            let bit_offset = pdo.bits();
            pdo.entries.push(PdoEntry { bit_offset, ..entry });
        }
    }
    device.process_data.pdos.push(pdo);
}

/// `0x6040:0/16`, `item`, `item/16`, `pad/8`.
fn entry(reader: &mut Reader<'_, '_>, text: &At<String>, device: &Device) -> Option<PdoEntry> {
    let (what, bits) = match text.value.rsplit_once('/') {
        Some((what, bits)) => (what.trim(), place::integer(bits).and_then(|bits| u32::try_from(bits).ok())),
        None => (text.value.trim(), None),
    };
    let origin = reader.origin(text);
    if what == "pad" {
        let bits = bits.filter(|&bits| bits > 0);
        if bits.is_none() {
            reader.report(&codes::TABLE_PLACE, reader.span(text), "padding has a length: write `pad/8`");
        }
        return Some(PdoEntry { origin, kind: PdoEntryKind::Padding, ..PdoEntry::new(0, 0, bits?) });
    }
    let by_name = || {
        let mut items = device.groups.iter().flat_map(|group| &group.items);
        items.find(|item| item.name == what).and_then(Item::object)
    };
    let by_place = || {
        let found = place::objects(what).filter(|own| own.indices.0 == own.indices.1)?;
        Some((found.indices.0, found.subs.map_or(0, |(first, _)| first)))
    };
    let Some((index, sub_index)) = by_place().or_else(by_name) else {
        let names = device.groups.iter().flat_map(|group| &group.items).map(|item| item.name.as_str());
        reader.unresolved("object", what, reader.span(text), names);
        return None;
    };
    let item = device.entry(index, sub_index);
    let known = item.and_then(|item| match item.ty {
        Type::Named(id) => device.types.get(id.0 as usize).and_then(|def| def.bits),
        ty => ty.bits(),
    });
    let Some(bits) = bits.or(known).filter(|&bits| bits > 0) else {
        let message = format!("nothing tells the length of `{}`: write `{}/16`", brief(what), brief(what));
        reader.report(&codes::TABLE_PLACE, reader.span(text), message);
        return None;
    };
    let mut entry = PdoEntry { origin, ..PdoEntry::new(index, sub_index, bits) };
    if let Some(item) = item {
        entry.name = item.name.clone();
        entry.ty = item.ty;
        entry.kind = PdoEntryKind::Item;
    }
    Some(entry)
}

/// Adds a process image: a group of items that have a place in it.
pub(super) fn image(reader: &mut Reader<'_, '_>, table: &At<ImageTable>, device: &mut Device) {
    let own = &table.value;
    let name = own.name.as_deref().unwrap_or("image");
    let mut group = Group::object(0, crate::ir::ObjectCode::Record);
    group.kind = GroupKind::Image { length: own.bytes.unwrap_or(0) };
    group.name = name.into();
    group.origin = reader.origin(table);
    group.documentation = reader.documentation(own.doc.as_deref(), own.cite.as_ref().map(cited));
    for (key, field) in own.fields.iter() {
        let ty = field.value.ty.as_ref().and_then(|ty| types::named(&ty.value)).map(|named| named.ty);
        let Some(bits) = ty.and_then(Type::bits) else {
            reader.report(&codes::TABLE_VALUE, reader.span(key), "a field of an image has a `type` of a fixed length");
            continue;
        };
        let at = field.value.at.saturating_mul(8);
        let mut item = Item::new(Binding::Image { image: name.into(), bit_offset: at, bits });
        (item.name, item.at.name, item.origin) = (key.value.as_str().into(), reader.span(key), reader.origin(key));
        item.ty = ty.unwrap_or(Type::Opaque(None));
        item.access = match direction(reader, own.direction.as_ref()) {
            Some(Direction::Receive) => crate::ir::Access::ReadWrite,
            _ => crate::ir::Access::ReadOnly,
        };
        group.items.push(item);
    }
    device.groups.insert(0, group);
}
