//! PDOs and their entries.

use compact_str::format_compact;

use super::reader::{note, Given, Names, Read, Reader};
use super::templates::{self, Reference};
use crate::diagnostics::codes;
use crate::ir::{Direction, Extensions, Oversampling, Pdo, PdoEntry, PdoEntryKind, ProcessData, Type};
use crate::syntax::xml::Tag;

/// The PDOs of a device or module. What the types of their entries are is known only once the dictionary was read.
#[derive(Default)]
pub(super) struct Pdos<'a> {
    pub list: Vec<Pdo>,
    /// The type that each entry names, entry by entry and PDO by PDO.
    pub types: Vec<Given<'a>>,
}

/// Reads a RxPdo or TxPdo.
pub(super) fn read<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, pdos: &mut Pdos<'a>) -> Read<()> {
    let direction = if parent.name == "RxPdo" { Direction::Receive } else { Direction::Transmit };
    let mut pdo = Pdo { origin: reader.cursor.origin(parent), ..Pdo::new(direction, 0) };
    let reference = attributes(reader, parent, &mut pdo)?;
    let channel = reference.as_ref().map_or(0, |reference| reference.channel);
    let mut content = content(reader, parent, &mut pdo, channel)?;
    let has_template = match &reference {
        Some(reference) => templates::complete(reader, reference, &mut pdo, &mut content)?,
        None => true,
    };
    let Content { index, names, types } = content;
    let (name, others) = (names.name(), names.others());
    let own = Pdo::new(direction, index.unwrap_or(0));
    pdo = Pdo { mapping_index: own.mapping_index, number: own.number, name, names: others, ..pdo };
    // A missing template is reported already.
    if has_template {
        check(reader, parent, &pdo, index.is_some());
    }
    pdos.types.extend(types);
    pdos.list.push(pdo);
    Ok(())
}

/// What the elements of a PDO give, besides the fields of [`Pdo`].
#[derive(Default)]
pub(super) struct Content<'a> {
    pub index: Option<u16>,
    pub names: Names<'a>,
    /// The type that each entry names.
    pub types: Vec<Given<'a>>,
}

/// Reads the elements of a PDO, or of the template of a channel.
pub(super) fn content<'a>(
    reader: &mut Reader<'a, '_>,
    parent: &Tag<'a>,
    pdo: &mut Pdo,
    channel: u16,
) -> Read<Content<'a>> {
    let mut content = Content::default();
    while let Some(tag) = reader.cursor.child(parent)? {
        match tag.name {
            "Index" => content.index = pdo_index(reader, &tag, pdo, channel)?,
            "Name" => reader.name(&tag, &mut content.names, &mut pdo.extensions)?,
            "Exclude" => {
                let excluded = plain_index(reader, &tag, &mut pdo.extensions)?;
                pdo.excludes.extend(excluded);
            }
            "ExcludedSm" => {
                let excluded: Option<u8> = reader.number(&tag, "number of a sync manager", &mut pdo.extensions)?;
                pdo.excluded_sync_managers.extend(excluded);
            }
            "Entry" => {
                let (entry, ty) = entry(reader, &tag, &mut pdo.extensions, channel)?;
                pdo.entries.push(entry);
                content.types.push(ty);
            }
            _ => reader.unknown(&tag, &mut pdo.extensions)?,
        }
    }
    Ok(content)
}

/// Reads the attributes of a PDO or a template. Returns the template that a PDO names.
pub(super) fn attributes<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>, pdo: &mut Pdo) -> Read<Option<Reference<'a>>> {
    const NAMES: [&str; 13] = [
        "Fixed",
        "Mandatory",
        "Virtual",
        "Sm",
        "Su",
        "OSFac",
        "OSMin",
        "OSMax",
        "OSIndexInc",
        "OverwrittenByModule",
        "Ref",
        "Chn",
        "RefName",
    ];
    let fields = reader.fields(tag, &NAMES, &mut pdo.extensions)?;
    let [fixed, mandatory, is_virtual, sm, su, factor, min, max, increment, overwritten, name, channel, _] = &fields;
    pdo.fixed = reader.flag(fixed);
    pdo.mandatory = reader.flag(mandatory);
    pdo.is_virtual = reader.flag(is_virtual);
    pdo.sync_manager = reader.int(sm, "number of a sync manager");
    pdo.sync_unit = reader.int(su, "number of a sync unit");
    pdo.overwritten_by_module = reader.flag(overwritten);
    let oversampling = Oversampling {
        factor: reader.int(factor, "oversampling factor"),
        min: reader.int(min, "oversampling factor"),
        max: reader.int(max, "oversampling factor"),
        index_increment: reader.int(increment, "increment of an index"),
    };
    if oversampling != Oversampling::default() {
        pdo.oversampling = Some(Box::new(oversampling));
    }
    let channel_number = reader.int(channel, "number of a channel").unwrap_or(0);
    let reference = || Reference { name: name.clone(), channel: channel_number, channel_given: channel.clone() };
    Ok((!name.is_empty()).then(reference))
}

fn pdo_index<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>, pdo: &mut Pdo, channel: u16) -> Read<Option<u16>> {
    let index = slot_index(reader, tag, &mut pdo.extensions)?;
    (pdo.depends_on_slot, pdo.depends_on_slot_group) = (index.slot, index.group);
    Ok(index.of_channel(reader, channel))
}

/// An index, and what it grows with.
#[derive(Default)]
pub(super) struct SlotIndex<'a> {
    pub given: Given<'a>,
    /// The slot.
    pub slot: bool,
    /// The slot group.
    pub group: bool,
    /// The channel of a template, by so much.
    factor: Given<'a>,
}

impl SlotIndex<'_> {
    /// The index for a channel of a template.
    fn of_channel(&self, reader: &mut Reader<'_, '_>, channel: u16) -> Option<u16> {
        let base = reader.int(&self.given, "index");
        templates::of_channel(reader, base, &self.factor, channel, self.given.span)
    }
}

/// Reads an index.
pub(super) fn slot_index<'a>(
    reader: &mut Reader<'a, '_>,
    tag: &Tag<'a>,
    extensions: &mut Extensions,
) -> Read<SlotIndex<'a>> {
    let [slot, group, factor] = reader.fields(tag, &["DependOnSlot", "DependOnSlotGroup", "ChnFac"], extensions)?;
    let (slot, group) = (reader.flag(&slot), reader.flag(&group));
    Ok(SlotIndex { given: reader.content(extensions)?, slot, group, factor })
}

/// An index of which nothing matters but the number.
fn plain_index<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>, extensions: &mut Extensions) -> Read<Option<u16>> {
    reader.number(tag, "index", extensions)
}

fn entry<'a>(
    reader: &mut Reader<'a, '_>,
    parent: &Tag<'a>,
    extensions: &mut Extensions,
    channel: u16,
) -> Read<(PdoEntry, Given<'a>)> {
    let mut entry = PdoEntry { origin: reader.cursor.origin(parent), ..PdoEntry::new(0, 0, 0) };
    let [fixed] = reader.fields(parent, &["Fixed"], extensions)?;
    entry.fixed = reader.flag(&fixed);
    let (mut names, mut ty) = (Names::default(), Given::default());
    let (mut index, mut sub_index, mut sub_factor) = (SlotIndex::default(), Given::default(), Given::default());
    while let Some(tag) = reader.cursor.child(parent)? {
        match tag.name {
            "Index" => {
                index = slot_index(reader, &tag, extensions)?;
                (entry.depends_on_slot, entry.depends_on_slot_group) = (index.slot, index.group);
            }
            "SubIndex" => {
                [sub_factor] = reader.fields(&tag, &["ChnFac"], extensions)?;
                sub_index = reader.content(extensions)?;
            }
            "BitLen" => entry.bits = reader.number(&tag, "length in bits", extensions)?.unwrap_or(0),
            "Name" => reader.name(&tag, &mut names, extensions)?,
            "DataType" => ty = data_type(reader, &tag, extensions)?,
            "Comment" => {
                let given = reader.leaf(&tag, extensions)?;
                note("Entry/Comment", &given, extensions);
            }
            _ => reader.unknown(&tag, extensions)?,
        }
    }
    (entry.name, entry.names) = (names.name(), names.others());
    let known = index.of_channel(reader, channel);
    entry.index = known.unwrap_or(0);
    let sub_base = reader.int::<u8>(&sub_index, "sub-index").map(u16::from);
    let sub_of_channel: Option<u8> = templates::of_channel(reader, sub_base, &sub_factor, channel, sub_index.span);
    entry.sub_index = sub_of_channel.unwrap_or(0);
    if known.is_none() && !entry.name.is_empty() && !ty.is_empty() {
        entry.kind = PdoEntryKind::Unnumbered;
    } else if entry.index == 0 {
        entry.kind = PdoEntryKind::Padding;
    }
    if index.given.is_empty() {
        let read_as = if entry.kind == PdoEntryKind::Unnumbered { "kept without an object" } else { "read as padding" };
        reader.report(&codes::ESI_MISSING_INDEX, parent.span, "this entry has no index", read_as);
    }
    Ok((entry, ty))
}

/// The name of a type, with its scale and the order of its bytes, which have no place in the IR.
fn data_type<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>, extensions: &mut Extensions) -> Read<Given<'a>> {
    let [scale, swap] = reader.fields(tag, &["DScale", "SwapData"], extensions)?;
    note("DataType@DScale", &scale, extensions);
    note("DataType@SwapData", &swap, extensions);
    reader.content(extensions)
}

fn check(reader: &mut Reader<'_, '_>, tag: &Tag<'_>, pdo: &Pdo, has_index: bool) {
    if !has_index {
        let message = format!("this {} has no index", tag.name);
        reader.report(&codes::PDO_WITHOUT_INDEX, tag.span, message, "it can't be assigned to a sync manager");
    }
    if pdo.name.is_empty() {
        let message = format_compact!("this {} has no name", tag.name);
        reader.report(&codes::UNNAMED_PDO, tag.span, message.as_str(), "it goes by its index");
    }
}

impl<'a> Pdos<'a> {
    /// Puts the PDOs into `data`, RxPdos first, each with the types that `resolve` gives.
    pub fn finish(self, data: &mut ProcessData, mut resolve: impl FnMut(&Given<'a>, &PdoEntry) -> Type) {
        let mut list = self.list;
        let entries = list.iter_mut().flat_map(|pdo| &mut pdo.entries);
        for (entry, ty) in entries.zip(&self.types) {
            entry.ty = resolve(ty, entry);
        }
        let (receive, transmit): (Vec<Pdo>, Vec<Pdo>) =
            list.into_iter().partition(|pdo| pdo.direction == Direction::Receive);
        data.pdos = receive;
        data.pdos.extend(transmit);
    }
}
