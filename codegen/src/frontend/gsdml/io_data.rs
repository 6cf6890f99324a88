//! Reads the cyclic data of a submodule: data items, bits and channels.

use compact_str::{format_compact, CompactString};

use super::data_type::DataType;
use super::reader::Reader;
use crate::diagnostics::codes;
use crate::frontend::xml::{Given, Read};
use crate::ir::{Direction, Doubts, IoChannel, IoData, IoItem, PdoEntry, PdoEntryKind, ProcessImage, Submodule, Type};
use crate::source::Origin;
use crate::syntax::xml::Tag;

impl<'a> Reader<'a, '_> {
    /// Reads an `IOData` element.
    pub fn io_data(&mut self, parent: &Tag<'a>, submodule: &mut Submodule) -> Read<()> {
        let names = ["IOPS_Length", "IOCS_Length", "F_IO_StructureDescVersion", "F_IO_StructureDescCRC"];
        let [provider, consumer, version, crc] = self.attributes(parent, names)?;
        let mut length = |given: &Given<'a>| {
            self.unsigned(given, u8::MAX.into(), "length in bytes").and_then(|length| u8::try_from(length).ok())
        };
        submodule.status_lengths = (length(&provider).unwrap_or(1), length(&consumer).unwrap_or(1));
        submodule.attributes.extend(version.attribute("IOData@F_IO_StructureDescVersion"));
        submodule.attributes.extend(crc.attribute("IOData@F_IO_StructureDescCRC"));
        while let Some(tag) = self.child(parent)? {
            let direction = match tag.name {
                "Input" => Direction::Transmit,
                "Output" => Direction::Receive,
                _ => {
                    self.unknown(&tag)?;
                    continue;
                }
            };
            let data = self.direction(&tag, direction)?;
            let target = if direction == Direction::Transmit { &mut submodule.input } else { &mut submodule.output };
            if target.replace(Box::new(data)).is_some() {
                let message = format!("the element <{}> occurs twice", tag.name);
                self.report(&codes::DUPLICATE_ID, tag.span, message, "replaces the previous element");
            }
        }
        Ok(())
    }

    fn direction(&mut self, parent: &Tag<'a>, direction: Direction) -> Read<IoData> {
        let [consistency] = self.attributes(parent, ["Consistency"])?;
        let consistent = consistency.text == "All items consistency";
        if !consistent && !consistency.is_missing() && consistency.text != "Item consistency" {
            self.bad(&consistency, "value of Consistency", "read as `Item consistency`");
        }
        let mut layout = Layout::default();
        let mut channels = Vec::new();
        while let Some(tag) = self.child(parent)? {
            match tag.name {
                "DataItem" => self.data_item(&tag, &mut layout)?,
                "Channel" => channels.push(self.channel(&tag)?),
                _ => self.unknown(&tag)?,
            }
        }
        let Layout { fields, items, at, overhead, .. } = layout;
        let length = (at / 8).saturating_sub(overhead);
        let (name, doubts) = (parent.name.into(), Doubts::new());
        let image = ProcessImage { name, direction, length, overhead, big_endian: true, fields, doubts };
        Ok(IoData { image, consistent, items, channels })
    }

    fn data_item(&mut self, tag: &Tag<'a>, layout: &mut Layout) -> Read<()> {
        let origin = self.origin(tag);
        let names = ["DataType", "TextId", "Length", "UseAsBits", "Subordinate"];
        let [given, text, length, use_as_bits, subordinate] = self.attributes(tag, names)?;
        let mut item = DataItem {
            name: self.name(tag, text),
            subordinate: self.flag_or(&subordinate, false),
            found: self.data_type(tag, &given),
            data_type: given.compact(),
            length: None,
            bits: Vec::new(),
            origin,
        };
        item.length = self.item_length(tag, &item, &length);
        let use_as_bits = self.flag_or(&use_as_bits, false);
        self.bit_data_items(tag, &mut item)?;
        if !item.bits.is_empty() && !use_as_bits {
            let message = "the bits of this data item have names, but UseAsBits is not true";
            self.report(&codes::BIT_DATA_ITEM, tag.name_span(), message, "read as bits");
        }
        layout.add(item, self);
        Ok(())
    }

    /// Returns the declared length of a data item in bytes, or `None` if it is missing or invalid. Reports a length that
    /// contradicts the data type, and a missing length if the data type does not define a length.
    fn item_length(&mut self, tag: &Tag<'a>, item: &DataItem, given: &Given<'a>) -> Option<u32> {
        let length = self.unsigned(given, u16::MAX.into(), "length in bytes");
        let fixed = item.found.and_then(DataType::bytes);
        match (fixed, length) {
            (Some(fixed), Some(length)) if fixed != length => {
                let message = format!("{} has {fixed} bytes, but Length is {length}", item.data_type);
                self.report(&codes::GSDML_VALUE, given.span, message, format!("read as {fixed}"));
            }
            (None, None) if given.is_missing() => {
                self.missing(tag, "Length", "read as 0 bytes; later items may have wrong offsets");
            }
            _ => {}
        }
        length
    }

    fn bit_data_items(&mut self, parent: &Tag<'a>, item: &mut DataItem) -> Read<()> {
        self.each(parent, "BitDataItem", |reader, tag| {
            let origin = reader.origin(tag);
            let [offset, text] = reader.attributes(tag, ["BitOffset", "TextId"])?;
            let name = reader.name(tag, text);
            reader.require(tag, &offset, "BitOffset", "left out");
            if let Some(offset) = reader.unsigned(&offset, u16::MAX.into(), "bit offset") {
                item.bits.push(Bit { offset, name, origin });
            }
            reader.no_children(tag)
        })
    }

    fn channel(&mut self, parent: &Tag<'a>) -> Read<IoChannel> {
        let mut channel = IoChannel::default();
        let [number] = self.attributes_and_others(parent, ["Number"], &mut channel.attributes)?;
        channel.number = self.unsigned16(&number, "channel number").unwrap_or(0);
        while let Some(tag) = self.child(parent)? {
            if !matches!(tag.name, "Data" | "Quality") {
                self.unknown(&tag)?;
                continue;
            }
            let names = ["BitOffset", "BitLength", "Format"];
            let [offset, bits, format] = self.attributes_and_others(&tag, names, &mut channel.attributes)?;
            let offset = self.unsigned(&offset, u16::MAX.into(), "bit offset");
            let bits = self.unsigned(&bits, u16::MAX.into(), "number of bits");
            if tag.name == "Data" {
                channel.data = offset.map(|offset| (offset, bits.unwrap_or(1)));
            } else {
                channel.quality_format = format.compact();
                let bits = bits.unwrap_or_else(|| quality_bits(&channel.quality_format));
                channel.quality = offset.map(|offset| (offset, bits));
            }
            self.no_children(&tag)?;
        }
        Ok(channel)
    }
}

/// Returns a placeholder for the text of `placeholder` followed by `suffix`.
fn with_suffix(placeholder: &str, suffix: &str) -> CompactString {
    // A placeholder is the number of a reference. Without the space, digits at the start of the suffix would be read as
    // a part of this number.
    format_compact!("{placeholder} {suffix}")
}

/// Returns the number of quality bits of a format: 1 for a qualifier, 8 for a status, 0 for an unknown format.
fn quality_bits(format: &str) -> u32 {
    match format {
        "Qualifier" => 1,
        "Status" => 8,
        _ => 0,
    }
}

/// Contents of a `DataItem` element.
struct DataItem {
    name: CompactString,
    data_type: CompactString,
    found: Option<DataType>,
    length: Option<u32>,
    subordinate: bool,
    bits: Vec<Bit>,
    origin: Origin,
}

/// Named bit of a data item.
struct Bit {
    offset: u32,
    name: CompactString,
    origin: Origin,
}

/// Layout of consecutive data items.
#[derive(Default)]
struct Layout {
    fields: Vec<PdoEntry>,
    items: Vec<IoItem>,
    /// Length in bits of the data items that were added so far.
    at: u32,
    /// Number of bytes of PROFIsafe trailers at the end of the data, which are not user data.
    overhead: u32,
    /// Positions and origins of the PROFIsafe trailers in `items`.
    trailers: Vec<(usize, Origin)>,
}

impl Layout {
    fn add(&mut self, item: DataItem, reader: &mut Reader<'_, '_>) {
        if !matches!(item.found, Some(DataType::Trailer(_))) {
            self.trailers_to_data(reader);
        }
        let (first, start) = (self.fields.len(), self.at);
        let bytes = item.found.and_then(DataType::bytes).or(item.length).unwrap_or(0);
        let bits = bytes.saturating_mul(8);
        match item.found {
            Some(DataType::Trailer(bytes)) => self.overhead = self.overhead.saturating_add(bytes),
            _ if !item.bits.is_empty() => self.bits(&item, bits, reader),
            Some(DataType::Pair(pair)) => {
                self.field(&item, item.name.clone(), pair.first, 0, pair.first_bits());
                self.field(&item, with_suffix(&item.name, pair.suffix), pair.second, pair.first_bits(), 8);
            }
            Some(DataType::OctetsWithStatus) if bytes > 1 => {
                self.field(&item, item.name.clone(), Type::OctetString(Some(bytes - 1)), 0, bits - 8);
                self.field(&item, with_suffix(&item.name, "status"), Type::Unsigned(8), bits - 8, 8);
            }
            Some(found) => {
                let (ty, _) = found.lower(item.length, &mut reader.format.types);
                self.field(&item, item.name.clone(), ty, 0, bits);
            }
            None => self.field(&item, item.name.clone(), Type::Opaque(None), 0, bits),
        }
        self.at = start.saturating_add(bits);
        let count = self.fields.len() - first;
        if count != 1 || item.subordinate || !item.bits.is_empty() {
            let DataItem { name, data_type, subordinate, found, origin, .. } = item;
            if matches!(found, Some(DataType::Trailer(_))) {
                self.trailers.push((self.items.len(), origin));
            }
            self.items.push(IoItem {
                name,
                data_type,
                bit_offset: start,
                bits,
                first_field: u32::try_from(first).unwrap_or(u32::MAX),
                fields: u32::try_from(count).unwrap_or(u32::MAX),
                subordinate,
                ..IoItem::default()
            });
        }
    }

    /// Converts the collected PROFIsafe trailers to data, and reports them. A trailer must be at the end of the data, so a trailer
    /// before another data item is read as data.
    fn trailers_to_data(&mut self, reader: &mut Reader<'_, '_>) {
        for (at, origin) in std::mem::take(&mut self.trailers) {
            let Some(item) = self.items.get_mut(at) else { continue };
            let message = "the trailer of a safety message is not at the end of the data";
            let label = "read as data because other items follow it";
            reader.report(&codes::GSDML_VALUE, origin.span, message, label);
            (item.first_field, item.fields) = (u32::try_from(self.fields.len()).unwrap_or(u32::MAX), 1);
            let (name, ty) = (item.name.clone(), Type::OctetString(Some(item.bits / 8)));
            let entry = PdoEntry::new(0, 0, item.bits);
            self.fields.push(PdoEntry {
                bit_offset: item.bit_offset,
                kind: PdoEntryKind::Item,
                name,
                ty,
                origin,
                ..entry
            });
        }
        self.overhead = 0;
    }

    /// Adds a field of a data item. `offset` is the bit offset of the field in the item.
    fn field(&mut self, item: &DataItem, name: CompactString, ty: Type, offset: u32, bits: u32) {
        let kind = if ty == Type::Opaque(None) { PdoEntryKind::Unknown } else { PdoEntryKind::Item };
        self.push(name, ty, kind, offset, bits, item.origin);
    }

    fn push(&mut self, name: CompactString, ty: Type, kind: PdoEntryKind, offset: u32, bits: u32, origin: Origin) {
        let bit_offset = self.at.saturating_add(offset);
        self.fields.push(PdoEntry { bit_offset, kind, name, ty, origin, ..PdoEntry::new(0, 0, bits) });
    }

    /// Adds the named bits of a data item in ascending order, with padding for the other bits. Reports and leaves out
    /// repeated bits and bits outside the data item.
    fn bits(&mut self, item: &DataItem, length: u32, reader: &mut Reader<'_, '_>) {
        let is_number = matches!(item.found, Some(DataType::Basic(Type::Unsigned(_) | Type::Integer(_))));
        let mut bits: Vec<(u32, &Bit)> =
            item.bits.iter().map(|bit| (position(bit.offset, length, is_number), bit)).collect();
        bits.sort_by_key(|&(at, _)| at);
        let mut next = 0;
        for (at, bit) in bits {
            if bit.offset >= length || at < next {
                let message = match at < next {
                    true => format!("bit {} of this data item already has a name", bit.offset),
                    false => format!(
                        "the data item has only {length} bits, but the offset of the named bit is {}",
                        bit.offset
                    ),
                };
                reader.report(&codes::BIT_DATA_ITEM, bit.origin.span, message, "left out");
                continue;
            }
            self.padding(item, next, at);
            self.push(bit.name.clone(), Type::Boolean, PdoEntryKind::Item, at, 1, bit.origin);
            next = at + 1;
        }
        self.padding(item, next, length);
    }

    fn padding(&mut self, item: &DataItem, from: u32, to: u32) {
        if from < to {
            let name = CompactString::default();
            self.push(name, Type::Opaque(None), PdoEntryKind::Padding, from, to - from, item.origin);
        }
    }
}

/// Returns the bit offset of a bit in its data item. Numbers are big-endian, so their bit 0 is in the last byte.
fn position(bit: u32, length: u32, is_number: bool) -> u32 {
    if !is_number || bit >= length {
        return bit;
    }
    (length / 8 - 1 - bit / 8) * 8 + bit % 8
}
