//! Reads PDOs and their entries.

use super::reader::{Names, Reader};
use super::slot_index::SlotIndex;
use crate::diagnostics::codes;
use crate::frontend::xml::{Given, Read};
use crate::ir::{Oversampling, Pdo, PdoEntry, PdoEntryKind};
use crate::syntax::xml::Tag;

/// Contents of a PDO that are added to [`Pdo`] after the template of the PDO is read.
#[derive(Default)]
pub(super) struct Content<'a> {
    pub index: Option<u16>,
    pub names: Names<'a>,
    /// Type name of each PDO entry.
    pub types: Vec<Given<'a>>,
}

/// Reference of a PDO to a template, and the channel of the PDO.
pub(super) struct Reference<'a> {
    pub name: Given<'a>,
    pub channel: u16,
    pub channel_given: Given<'a>,
}

/// Reads the child elements of a PDO, or of a template for one channel.
pub(super) fn content<'a>(
    reader: &mut Reader<'a, '_>,
    parent: &Tag<'a>,
    pdo: &mut Pdo,
    channel: u16,
) -> Read<Content<'a>> {
    let mut content = Content::default();
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "Index" => {
                let index = SlotIndex::read(reader, &tag)?;
                (pdo.depends_on_slot, pdo.depends_on_slot_group) = (index.slot, index.group);
                content.index = index.of_channel(reader, channel, "index");
            }
            "Name" => reader.name(&tag, &mut content.names)?,
            "Exclude" => pdo.excludes.extend(reader.number::<u16>(&tag, "index")?),
            "ExcludedSm" => pdo.excluded_sync_managers.extend(reader.number::<u8>(&tag, "sync manager number")?),
            "Entry" => {
                let (entry, ty) = entry(reader, &tag, channel)?;
                pdo.entries.push(entry);
                content.types.push(ty);
            }
            _ => reader.unknown(&tag)?,
        }
    }
    Ok(content)
}

/// Reads the attributes of a PDO or template. Returns the PDO's reference to a template, if it has one.
pub(super) fn attributes<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>, pdo: &mut Pdo) -> Read<Option<Reference<'a>>> {
    const NAMES: [&str; 15] = [
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
        "PdoOrder",
        "SRA_Parameter",
        "RefName",
    ];
    let fields = reader.attributes(tag, NAMES)?;
    let [fixed, mandatory, is_virtual, sm, su, factor, min, max, increment, overwritten, name, channel, order, sra, _] =
        &fields;
    pdo.fixed = reader.flag(fixed);
    pdo.mandatory = reader.flag(mandatory);
    pdo.is_virtual = reader.flag(is_virtual);
    pdo.sync_manager = reader.int(sm, "sync manager number");
    pdo.sync_unit = reader.int(su, "sync unit number");
    pdo.overwritten_by_module = reader.flag(overwritten);
    pdo.order = reader.int(order, "order number");
    pdo.sra_parameter = reader.optional_flag(sra);
    let oversampling = Oversampling {
        factor: reader.int(factor, "oversampling factor"),
        min: reader.int(min, "oversampling factor"),
        max: reader.int(max, "oversampling factor"),
        index_increment: reader.int(increment, "index increment"),
    };
    if oversampling != Oversampling::default() {
        pdo.oversampling = Some(Box::new(oversampling));
    }
    let channel_number = reader.int(channel, "channel number").unwrap_or(0);
    let reference = || Reference { name: name.clone(), channel: channel_number, channel_given: channel.clone() };
    Ok((!name.is_empty()).then(reference))
}

fn entry<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, channel: u16) -> Read<(PdoEntry, Given<'a>)> {
    let origin = reader.origin(parent);
    let [fixed] = reader.attributes(parent, ["Fixed"])?;
    let fixed = reader.flag(&fixed);
    let (mut names, mut ty, mut bits) = (Names::default(), Given::default(), 0);
    let (mut index, mut sub_index) = (SlotIndex::default(), SlotIndex::default());
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "Index" => index = SlotIndex::read(reader, &tag)?,
            "SubIndex" => {
                [sub_index.factor] = reader.attributes(&tag, ["ChnFac"])?;
                sub_index.given = reader.content()?;
            }
            "BitLen" => bits = reader.number(&tag, "length in bits")?.unwrap_or(0),
            "Name" => reader.name(&tag, &mut names)?,
            "DataType" => ty = data_type(reader, &tag)?,
            "Comment" => {
                let given = reader.text(&tag)?;
                reader.note("Entry/Comment", &given);
            }
            _ => reader.unknown(&tag)?,
        }
    }
    let known = index.of_channel(reader, channel, "index");
    let sub_index = sub_index.of_channel(reader, channel, "sub-index").unwrap_or(0);
    let mut entry = PdoEntry::new(known.unwrap_or(0), sub_index, bits);
    (entry.depends_on_slot, entry.depends_on_slot_group) = (index.slot, index.group);
    (entry.fixed, entry.origin) = (fixed, origin);
    (entry.name, entry.names) = (names.name(), names.others());
    if known.is_none() && !entry.name.is_empty() && !ty.is_empty() {
        entry.kind = PdoEntryKind::Unnumbered;
    }
    if index.given.is_empty() {
        let read_as = if entry.kind == PdoEntryKind::Unnumbered { "kept without an object" } else { "read as padding" };
        reader.report(&codes::ESI_MISSING_INDEX, parent.span, "this PDO entry has no index", read_as);
    }
    Ok((entry, ty))
}

/// Reads the type name of a PDO entry. The scale and byte order become extensions because the IR has no fields for
/// them.
fn data_type<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>) -> Read<Given<'a>> {
    let [scale, swap] = reader.attributes(tag, ["DScale", "SwapData"])?;
    reader.note("DataType@DScale", &scale);
    reader.note("DataType@SwapData", &swap);
    reader.content()
}
