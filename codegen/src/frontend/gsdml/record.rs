//! Reads parameter records, including constants and menus.

use super::reader::Reader;
use super::value::octets;
use crate::frontend::xml::{Given, Read};
use crate::ir::{Binding, Group, GroupKind, Item, Menu, ObjectCode, Record, Submodule};
use crate::syntax::xml::Tag;

impl<'a> Reader<'a, '_> {
    /// Reads a `RecordDataList` element.
    pub fn record_data_list(&mut self, list: &Tag<'a>, submodule: &mut Submodule) -> Read<()> {
        while let Some(tag) = self.child(list)? {
            match tag.name {
                "ParameterRecordDataItem" => submodule.records.extend(self.record(&tag, &mut submodule.menus)?),
                "F_ParameterRecordDataItem" => self.f_record(&tag, submodule)?,
                _ => self.unknown(&tag)?,
            }
        }
        // Records with the sequence number 0 may be transferred in any order, so they come last.
        let order = |group: &Group| match &group.kind {
            GroupKind::Record(record) if record.transfer_sequence > 0 => record.transfer_sequence,
            _ => u16::MAX,
        };
        submodule.records.sort_by_key(order);
        Ok(())
    }

    fn record(&mut self, tag: &Tag<'a>, menus: &mut Vec<Menu>) -> Read<Option<Group>> {
        let start = self.extensions.len();
        let mut group = Group::object(0, ObjectCode::Record);
        group.origin = self.origin(tag);
        let names = ["Index", "Length", "TransferSequence", "ChangeableWithBump"];
        let [index, length, sequence, bump] = self.attributes(tag, names)?;
        self.require(tag, &index, "Index", "left out because the record has no address");
        let index = self.unsigned16(&index, "record index");
        let mut record = Record {
            index: index.unwrap_or(0),
            length: self.record_length(tag, &length),
            transfer_sequence: self.unsigned16(&sequence, "transfer sequence").unwrap_or(0),
            changeable_with_bump: (!bump.is_missing()).then(|| self.flag(&bump)),
            constants: Vec::new(),
        };
        self.record_body(tag, &mut record, &mut group, menus)?;
        group.kind = GroupKind::Record(Box::new(record));
        group.extensions = self.extensions_since(start);
        Ok(index.map(|_| group))
    }

    /// Reads the required length of a record. Returns 0 if the length is missing or invalid.
    pub fn record_length(&mut self, tag: &Tag<'a>, given: &Given<'a>) -> u32 {
        self.require(tag, given, "Length", "read as 0");
        self.unsigned(given, u32::MAX, "length").unwrap_or(0)
    }

    /// Reads the children of a record or of a vendor block.
    pub fn record_body(
        &mut self,
        parent: &Tag<'a>,
        record: &mut Record,
        group: &mut Group,
        menus: &mut Vec<Menu>,
    ) -> Read<()> {
        let mut items = std::mem::take(&mut self.format.items);
        while let Some(tag) = self.child(parent)? {
            match tag.name {
                "Ref" => {
                    // The large struct is added to the list first and filled there, which avoids a copy.
                    items.push(Item::new(Binding::Record { index: record.index, bit_offset: 0, bits: 0 }));
                    if let Some(item) = items.last_mut() {
                        self.parameter(&tag, record.index, item)?;
                    }
                }
                "Const" => self.constant(&tag, record)?,
                "Name" => {
                    let given = self.attribute(&tag, "TextId")?;
                    group.name_at = given.span.or(tag.span);
                    group.name = self.name(&tag, given);
                }
                "MenuList" => self.menu_list(&tag, menus)?,
                _ => self.unknown(&tag)?,
            }
        }
        // Items are large, so the group reserves memory only for the exact number of items.
        group.items.reserve_exact(items.len());
        group.items.append(&mut items);
        self.format.items = items;
        Ok(())
    }

    fn constant(&mut self, tag: &Tag<'a>, record: &mut Record) -> Read<()> {
        let [offset, data] = self.attributes(tag, ["ByteOffset", "Data"])?;
        let offset = self.unsigned(&offset, u32::MAX, "byte offset").unwrap_or(0);
        if !self.require(tag, &data, "Data", "left out") {
            return Ok(());
        }
        match octets(&data.text) {
            Some(bytes) => record.constants.push((offset, bytes)),
            None => {
                self.bad(&data, "list of octets, such as `0x00,0x1F`", "left out");
                self.note("Const@Data", &data);
            }
        }
        Ok(())
    }

    fn menu_list(&mut self, list: &Tag<'a>, menus: &mut Vec<Menu>) -> Read<()> {
        self.each(list, "MenuItem", |reader, tag| {
            menus.push(reader.menu(tag)?);
            Ok(())
        })
    }

    fn menu(&mut self, parent: &Tag<'a>) -> Read<Menu> {
        let [id] = self.attributes(parent, ["ID"])?;
        let mut menu = Menu { id: id.compact(), ..Menu::default() };
        while let Some(tag) = self.child(parent)? {
            match tag.name {
                "Name" => menu.name = self.text_reference(&tag)?,
                "ParameterRef" => menu.targets.push(self.single(&tag, "ParameterTarget")?.compact()),
                "MenuRef" => menu.targets.push(self.single(&tag, "MenuTarget")?.compact()),
                _ => self.unknown(&tag)?,
            }
        }
        Ok(menu)
    }
}
