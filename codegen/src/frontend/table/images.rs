//! Fixed process images: where the items of a device, or fields of its own, are in cyclic data.

use std::collections::{BTreeMap, HashMap};

use super::at::At;
use super::format::{field_row, ImageField, ImageTable, Row};
use super::rows::{Named, Rows};
use super::tree::Reader;
use super::{process, types};
use crate::diagnostics::{codes, Diagnostic};
use crate::ir::{
    Access, Binding, CompactString, Device, Direction, Group, GroupKind, ImageBinding, Item, ObjectCode, PdoEntry,
    PdoEntryKind, ProcessImage, SubjectKind, Type, TypeDef,
};
use crate::text::brief;

/// A field at its place.
struct Placed {
    bit_offset: u32,
    bits: u32,
    /// The field's own type, where it has one.
    ty: Option<Type>,
}

/// What images have read so far.
pub(super) struct Images {
    /// The items that only images have, those of each in a group.
    groups: Vec<Group>,
    /// Where the items of the device and of earlier images are, by name: the first of each.
    places: HashMap<CompactString, Place>,
}

/// A group and an item of it: of the device, or of the images.
#[derive(Clone, Copy)]
enum Place {
    Device(usize, usize),
    Image(usize, usize),
}

impl Images {
    pub fn new(device: &Device) -> Self {
        let mut images = Images { groups: Vec::new(), places: HashMap::new() };
        for (at, group) in device.groups.iter().enumerate() {
            images.know(group, |item| Place::Device(at, item));
        }
        images
    }

    fn know(&mut self, group: &Group, place: impl Fn(usize) -> Place) {
        for (at, item) in group.items.iter().enumerate() {
            self.places.entry(item.name.clone()).or_insert_with(|| place(at));
        }
    }

    fn item<'d>(&'d mut self, device: &'d mut Device, name: &str) -> Option<&'d mut Item> {
        match *self.places.get(name)? {
            Place::Device(group, item) => device.groups.get_mut(group)?.items.get_mut(item),
            Place::Image(group, item) => self.groups.get_mut(group)?.items.get_mut(item),
        }
    }

    fn add(&mut self, group: Group) {
        let at = self.groups.len();
        self.know(&group, |item| Place::Image(at, item));
        self.groups.push(group);
    }

    /// Puts the groups of the images in front of all others, the last one first.
    pub fn finish(self, device: &mut Device) {
        device.groups.splice(..0, self.groups.into_iter().rev());
    }
}

/// Reads a process image. A field that is called as an item of the device is that item; any other is an item that is found
/// nowhere else.
pub(super) fn image(
    reader: &mut Reader<'_, '_>,
    rows: &mut Rows,
    table: &At<ImageTable>,
    images: &mut Images,
    device: &mut Device,
) {
    let own = &table.value;
    let name: CompactString = own.name.as_deref().unwrap_or("image").into();
    let Some((direction, length)) = process::direction(reader, own.direction.as_ref()).zip(own.bytes) else {
        reader.report(&codes::TABLE_VALUE, reader.span(table), "an image has a `direction` and a number of `bytes`");
        return;
    };
    let origin = reader.origin(table);
    device.doubts.extend(reader.doubts_about(own, origin, SubjectKind::Image, &name, ""));
    let order = own.order.as_ref().and_then(|word| reader.word(word, "order", &[("big", true), ("little", false)]));
    let mut group = Group::object(0, ObjectCode::Record);
    group.kind = GroupKind::Image { length };
    group.name = name.clone();
    group.origin = origin;
    group.documentation = reader.documentation_of(own);
    let mut fields = Fields::default();
    for (key, field) in own.fields.iter() {
        let placed = match images.item(device, &key.value) {
            Some(item) => of_item(reader, rows, key, &field.value, item).map(|placed| {
                item.bindings.push(binding(&name, &placed));
                (placed, entry(item))
            }),
            None => new_item(reader, rows, key, field, direction).map(|(placed, mut item)| {
                item.bindings = [binding(&name, &placed)].into_iter().collect();
                let entry = entry(&item);
                group.items.push(item);
                (placed, entry)
            }),
        };
        let Some((Placed { bit_offset, bits, .. }, entry)) = placed else { continue };
        let entry = PdoEntry { bit_offset, bits, origin: reader.origin(key), ..entry };
        if fields.is_free(reader, key, &entry, length) {
            fields.add(entry);
        }
    }
    let fields = fields.0.into_values().collect();
    let big_endian = order.unwrap_or(true);
    device.process_data.images.push(ProcessImage { name, direction, length, overhead: 0, big_endian, fields });
    if !group.items.is_empty() {
        images.add(group);
    }
}

fn binding(image: &CompactString, placed: &Placed) -> Binding {
    let image = image.clone();
    Binding::Image(Box::new(ImageBinding { image, bit_offset: placed.bit_offset, bits: placed.bits, ty: placed.ty }))
}

fn entry(item: &Item) -> PdoEntry {
    let (index, sub_index) = item.object().unwrap_or_default();
    let entry = PdoEntry::new(index, sub_index, 0);
    PdoEntry { kind: PdoEntryKind::Item, name: item.name.clone(), ty: item.ty, names: item.names.clone(), ..entry }
}

/// The place of an item; its own length where the field gives no type.
fn of_item(
    reader: &mut Reader<'_, '_>,
    rows: &Rows,
    key: &At<String>,
    field: &ImageField,
    item: &Item,
) -> Option<Placed> {
    let more = [field.bits.is_some(), field.values.is_some(), field.unit.is_some(), field.scale.is_some()];
    if more.contains(&true) || field.min.is_some() || field.max.is_some() || field.na.is_some() {
        let message = format!("`{}` is an item of the table: what it is stands in its row", brief(&key.value));
        reader.report(&codes::TABLE_VALUE, reader.span(key), message);
    }
    let ty = match &field.ty {
        Some(given) => types::named(&given.value).filter(|named| named.elements.is_none()).map(|named| named.ty),
        None => Some(item.ty),
    };
    placed(reader, &rows.definitions.types, key, field, ty)
}

/// A field that is an item of its own: read as a row is, with what a field has in common with it.
fn new_item(
    reader: &mut Reader<'_, '_>,
    rows: &mut Rows,
    key: &At<String>,
    field: &At<ImageField>,
    direction: Direction,
) -> Option<(Placed, Item)> {
    let own = &field.value;
    let row = field_row!(own);
    let named = Named { name: &key.value, key, number: 0, end: field.end };
    let ty = rows.ty(reader, named, &row)?;
    let placed = placed(reader, &rows.definitions.types, key, own, Some(ty))?;
    let mut item = Item::new(Binding::Ascii(CompactString::default()));
    item.access = match direction {
        Direction::Receive => Access::ReadWrite,
        Direction::Transmit => Access::ReadOnly,
    };
    rows.fill(reader, &mut item, named, &row, Some(ty));
    Some((placed, item))
}

fn placed(
    reader: &mut Reader<'_, '_>,
    types: &[TypeDef],
    key: &At<String>,
    field: &ImageField,
    ty: Option<Type>,
) -> Option<Placed> {
    let bits = match ty {
        Some(Type::Named(id)) => types.get(id.0 as usize).and_then(|own| own.bits),
        Some(Type::VisibleString(Some(bytes)) | Type::OctetString(Some(bytes))) => bytes.checked_mul(8),
        Some(Type::UnicodeString(Some(units))) => units.checked_mul(16),
        other => other.and_then(Type::bits),
    };
    let Some((at, bits)) = field.at.zip(bits) else {
        let message = format!("the field `{}` has an `at`, and a `type` of a fixed length", brief(&key.value));
        reader.report(&codes::TABLE_VALUE, reader.span(key), message);
        return None;
    };
    let bit_offset = at.saturating_mul(8).saturating_add(field.bit.unwrap_or(0).into());
    Some(Placed { bit_offset, bits, ty: ty.filter(|_| field.ty.is_some()) })
}

/// The bit behind a field.
fn end(field: &PdoEntry) -> u64 {
    u64::from(field.bit_offset) + u64::from(field.bits)
}

/// The fields of an image by where they begin and end, and their number: none lies where another is.
#[derive(Default)]
struct Fields(BTreeMap<(u64, u64, usize), PdoEntry>);

impl Fields {
    fn add(&mut self, field: PdoEntry) {
        self.0.insert((field.bit_offset.into(), end(&field), self.0.len()), field);
    }

    /// Whether a field lies in its image, and where no other is; if not, that is reported.
    fn is_free(&self, reader: &mut Reader<'_, '_>, key: &At<String>, entry: &PdoEntry, length: u32) -> bool {
        if end(entry) > u64::from(length) * 8 {
            let message = format!("`{}` ends behind the {length} bytes of its image", brief(&key.value));
            reader.report(&codes::TABLE_PLACE, reader.span(key), message);
            return false;
        }
        // Of those that begin in front of its end, the last one reaches furthest.
        let before = self.0.range(..(end(entry), 0, 0)).next_back();
        let Some((_, other)) = before.filter(|(place, _)| u64::from(entry.bit_offset) < place.1) else { return true };
        let message = format!("`{}` lies where `{}` is", brief(&key.value), brief(&other.name));
        let found = Diagnostic::new(&codes::TABLE_PLACE, reader.span(key), message);
        reader.diagnostics.push(found.note_at(other.origin.span, "the other one"));
        false
    }
}
