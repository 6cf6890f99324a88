//! Reads fixed process images: the positions of items and of additional fields in the cyclic data.

use std::collections::BTreeMap;

use super::at::At;
use super::format::{field_row, ImageField, ImageTable, Row};
use super::rows::{Named, Rows};
use super::tree::Reader;
use super::{process, types};
use crate::collections::HashMap;
use crate::diagnostics::codes;
use crate::ir::{
    Access, Binding, CompactString, Device, Direction, Group, GroupKind, ImageBinding, Item, ObjectCode, PdoEntry,
    PdoEntryKind, ProcessImage, Type,
};
use crate::text::brief;

/// Bit offset and length of a field in its image, and the type that the field declares.
struct FieldPosition {
    bit_offset: u32,
    bits: u32,
    /// Type that the field declares, if any.
    ty: Option<Type>,
}

/// New items of the images that were read so far, and the positions of all items.
pub(super) struct Images {
    /// Items that exist only in images, in one group per image.
    groups: Vec<Group>,
    /// Positions of the items of the device and of earlier images, by name. The first item counts if a name is
    /// repeated.
    positions: HashMap<CompactString, ItemPosition>,
}

/// Group and item number of an item in the device or in the images.
#[derive(Clone, Copy)]
enum ItemPosition {
    Device(usize, usize),
    Image(usize, usize),
}

impl Images {
    pub fn new(device: &Device) -> Self {
        let mut images = Images { groups: Vec::new(), positions: HashMap::default() };
        for (at, group) in device.groups.iter().enumerate() {
            images.know(group, |item| ItemPosition::Device(at, item));
        }
        images
    }

    fn know(&mut self, group: &Group, position: impl Fn(usize) -> ItemPosition) {
        for (at, item) in group.items.iter().enumerate() {
            self.positions.entry(item.name.clone()).or_insert_with(|| position(at));
        }
    }

    fn item<'d>(&'d mut self, device: &'d mut Device, name: &str) -> Option<&'d mut Item> {
        match *self.positions.get(name)? {
            ItemPosition::Device(group, item) => device.groups.get_mut(group)?.items.get_mut(item),
            ItemPosition::Image(group, item) => self.groups.get_mut(group)?.items.get_mut(item),
        }
    }

    fn add(&mut self, group: Group) {
        let at = self.groups.len();
        self.know(&group, |item| ItemPosition::Image(at, item));
        self.groups.push(group);
    }

    /// Inserts the groups of the images before the groups of the device, the last image first.
    pub fn finish(self, device: &mut Device) {
        device.groups.splice(..0, self.groups.into_iter().rev());
    }
}

/// Reads a process image. A field with the name of an item of the device or of an earlier image refers to this item.
/// Any other field becomes a new item.
pub(super) fn image(
    reader: &mut Reader<'_, '_>,
    rows: &mut Rows,
    table: &At<ImageTable>,
    images: &mut Images,
    device: &mut Device,
) {
    let given = &table.value;
    let name: CompactString = given.name.as_deref().unwrap_or("image").into();
    let Some((direction, length)) = process::direction(reader, given.direction.as_ref()).zip(given.bytes) else {
        reader.report(&codes::TABLE_VALUE, reader.span(table), "an image needs a `direction` and a number of `bytes`");
        return;
    };
    let origin = reader.origin(table);
    let doubts = reader.doubts_of(given, origin);
    let order =
        given.order.as_ref().and_then(|word| reader.word(word, "byte order", &[("big", true), ("little", false)]));
    let mut group = Group::object(0, ObjectCode::Record);
    group.kind = GroupKind::Image { length };
    group.name = name.clone();
    group.origin = origin;
    group.documentation = reader.documentation_of(given);
    let mut fields = Fields::default();
    for (key, field) in given.fields.iter() {
        let positioned = match images.item(device, &key.value) {
            Some(item) => of_item(reader, rows, key, &field.value, item).map(|position| {
                item.bindings.push(binding(&name, &position));
                (position, entry(item))
            }),
            None => new_item(reader, rows, key, field, direction).map(|(position, mut item)| {
                item.bindings = [binding(&name, &position)].into_iter().collect();
                let entry = entry(&item);
                group.items.push(item);
                (position, entry)
            }),
        };
        let Some((FieldPosition { bit_offset, bits, .. }, entry)) = positioned else { continue };
        let entry = PdoEntry { bit_offset, bits, origin: reader.origin(key), ..entry };
        if fields.is_free(reader, key, &entry, length) {
            fields.add(entry);
        }
    }
    let fields = fields.0.into_values().collect();
    let big_endian = order.unwrap_or(true);
    device.process_data.images.push(ProcessImage { name, direction, length, overhead: 0, big_endian, fields, doubts });
    if !group.items.is_empty() {
        images.add(group);
    }
}

fn binding(image: &CompactString, position: &FieldPosition) -> Binding {
    Binding::Image(Box::new(ImageBinding {
        image: image.clone().into(),
        bit_offset: position.bit_offset,
        bits: position.bits,
        ty: position.ty,
    }))
}

fn entry(item: &Item) -> PdoEntry {
    let (index, sub_index) = item.object().unwrap_or_default();
    let entry = PdoEntry::new(index, sub_index, 0);
    PdoEntry { kind: PdoEntryKind::Item, name: item.name.clone(), ty: item.ty, names: item.names.clone(), ..entry }
}

/// Returns the position of a field in the image. The field refers to `item`, and has the length of this item unless the
/// field declares a type.
fn of_item(
    reader: &mut Reader<'_, '_>,
    rows: &Rows,
    key: &At<String>,
    field: &ImageField,
    item: &Item,
) -> Option<FieldPosition> {
    let more = [field.bits.is_some(), field.values.is_some(), field.unit.is_some(), field.scale.is_some()];
    if more.contains(&true) || field.min.is_some() || field.max.is_some() || field.na.is_some() {
        let message = format!("`{}` is an item of the table, so its row describes the value", brief(&key.value));
        let help = "move the facts about the value to the row of the item";
        reader.report_with_help(&codes::TABLE_VALUE, reader.span(key), message, help);
    }
    let ty = field.ty.as_ref().map_or(Some(item.ty), |given| types::single(&given.value));
    position(reader, rows, key, field, ty)
}

/// Reads a field that defines a new item. The field is read as a row that has the same keys.
fn new_item(
    reader: &mut Reader<'_, '_>,
    rows: &mut Rows,
    key: &At<String>,
    field: &At<ImageField>,
    direction: Direction,
) -> Option<(FieldPosition, Item)> {
    let given = &field.value;
    let row = field_row!(given);
    let named = Named { name: &key.value, key, number: 0, end: field.end };
    let ty = rows.ty(reader, named, &row)?;
    let position = position(reader, rows, key, given, Some(ty))?;
    let mut item = Item::new(Binding::Ascii(CompactString::default()));
    item.access = match direction {
        Direction::Receive => Access::ReadWrite,
        Direction::Transmit => Access::ReadOnly,
    };
    rows.fill(reader, &mut item, named, &row, Some(ty));
    Some((position, item))
}

fn position(
    reader: &mut Reader<'_, '_>,
    rows: &Rows,
    key: &At<String>,
    field: &ImageField,
    ty: Option<Type>,
) -> Option<FieldPosition> {
    let Some((at, bits)) = field.at.zip(ty.and_then(|ty| rows.definitions.bits_of(ty))) else {
        let message = format!("the field `{}` needs an `at`, and a `type` with a fixed length", brief(&key.value));
        reader.report(&codes::TABLE_VALUE, reader.span(key), message);
        return None;
    };
    let bit_offset = at.saturating_mul(8).saturating_add(field.bit.unwrap_or(0).into());
    Some(FieldPosition { bit_offset, bits, ty: ty.filter(|_| field.ty.is_some()) })
}

/// Returns the bit offset after the end of a field.
fn end(field: &PdoEntry) -> u64 {
    u64::from(field.bit_offset) + u64::from(field.bits)
}

/// Fields of an image, by first bit, bit after the last bit, and number. The fields do not overlap.
#[derive(Default)]
struct Fields(BTreeMap<(u64, u64, usize), PdoEntry>);

impl Fields {
    fn add(&mut self, field: PdoEntry) {
        self.0.insert((field.bit_offset.into(), end(&field), self.0.len()), field);
    }

    /// Returns whether a field is within its image and does not overlap another field. Otherwise, reports an error.
    fn is_free(&self, reader: &mut Reader<'_, '_>, key: &At<String>, entry: &PdoEntry, length: u32) -> bool {
        if end(entry) > u64::from(length) * 8 {
            let message = format!("`{}` ends after the {length} bytes of its image", brief(&key.value));
            reader.report(&codes::TABLE_PLACE, reader.span(key), message);
            return false;
        }
        // Earlier fields do not overlap each other, so only the last field that begins before the end of `entry` can overlap
        // `entry`.
        let before = self.0.range(..(end(entry), 0, 0)).next_back();
        let Some((_, other)) = before.filter(|(range, _)| u64::from(entry.bit_offset) < range.1) else { return true };
        let message = format!("`{}` overlaps `{}`", brief(&key.value), brief(&other.name));
        let found = codes::TABLE_PLACE.at(reader.span(key), message);
        reader.diagnostics.push(found.note_at(other.origin.span, "the other field"));
        false
    }
}
