//! Parameter records: constants, parameters and menus.

use compact_str::CompactString;

use super::data_type::DataType;
use super::reader::{shortened, Given, Read, Reader};
use super::value::octets;
use crate::diagnostics::{codes, Diagnostic};
use crate::ir::{
    Access, Behaviour, Binding, Extensions, Group, GroupKind, Item, Menu, ObjectCode, Record, Submodule, Type,
};
use crate::source::Span;
use crate::syntax::xml::Tag;

impl<'a> Reader<'a, '_> {
    /// Reads RecordDataList.
    pub fn record_data_list(&mut self, list: &Tag<'a>, submodule: &mut Submodule) -> Read<()> {
        while let Some(tag) = self.cursor.child(list)? {
            match tag.name {
                "ParameterRecordDataItem" => {
                    if let Some(group) = self.record(&tag, submodule)? {
                        submodule.records.push(group);
                    }
                }
                "F_ParameterRecordDataItem" => self.f_record(&tag, submodule)?,
                _ => self.unknown(&tag, &mut submodule.extensions)?,
            }
        }
        // 0 leaves the order open.
        let order = |group: &Group| match &group.kind {
            GroupKind::Record(record) if record.transfer_sequence > 0 => record.transfer_sequence,
            _ => u16::MAX,
        };
        submodule.records.sort_by_key(order);
        Ok(())
    }

    fn record(&mut self, tag: &Tag<'a>, submodule: &mut Submodule) -> Read<Option<Group>> {
        let mut group = Group::object(0, ObjectCode::Record);
        group.origin = self.cursor.origin(tag);
        let names = ["Index", "Length", "TransferSequence", "ChangeableWithBump"];
        let [index, length, sequence, bump] = self.fields(tag, &names, &mut group.extensions)?;
        if index.is_none() {
            self.missing(tag, "Index", "left out: without an index a record has no address");
        }
        let index = self.unsigned16(index.as_ref(), "record index");
        let mut record = Record {
            index: index.unwrap_or(0),
            length: self.record_length(tag, length.as_ref()),
            transfer_sequence: self.unsigned16(sequence.as_ref(), "order of transfer").unwrap_or(0),
            changeable_with_bump: bump.as_ref().map(|given| self.flag(Some(given), false)),
            constants: Vec::new(),
        };
        self.record_body(tag, &mut record, &mut group, &mut submodule.menus)?;
        group.kind = GroupKind::Record(Box::new(record));
        Ok(index.map(|_| group))
    }

    /// The length that a record has to have.
    pub fn record_length(&mut self, tag: &Tag<'a>, given: Option<&Given<'a>>) -> u32 {
        if given.is_none() {
            self.missing(tag, "Length", "taken for 0");
        }
        self.unsigned(given, u32::MAX, "length in bytes").unwrap_or(0)
    }

    /// Reads what a record, or a block of a vendor, consists of.
    pub fn record_body(
        &mut self,
        parent: &Tag<'a>,
        record: &mut Record,
        group: &mut Group,
        menus: &mut Vec<Menu>,
    ) -> Read<()> {
        while let Some(tag) = self.cursor.child(parent)? {
            match tag.name {
                "Ref" => {
                    let item = self.parameter(&tag, record.index)?;
                    self.items.push(item);
                }
                "Const" => self.constant(&tag, record, &mut group.extensions)?,
                "Name" => {
                    let given = self.field(&tag, "TextId")?;
                    group.name_at = given.as_ref().map_or(tag.span, |given| given.span);
                    group.name = self.name(&tag, given);
                }
                "MenuList" => self.menu_list(&tag, menus, &mut group.extensions)?,
                _ => self.unknown(&tag, &mut group.extensions)?,
            }
        }
        // Of the length that they have: items are large.
        group.items = self.items.drain(..).collect();
        Ok(())
    }

    fn constant(&mut self, tag: &Tag<'a>, record: &mut Record, extensions: &mut Extensions) -> Read<()> {
        let [offset, data] = self.fields(tag, &["ByteOffset", "Data"], extensions)?;
        let offset = self.unsigned(offset.as_ref(), u32::MAX, "byte offset").unwrap_or(0);
        let Some(data) = data else {
            self.missing(tag, "Data", "left out");
            return Ok(());
        };
        match octets(&data.text) {
            Some(bytes) => record.constants.push((offset, bytes)),
            None => {
                self.bad(&data, "list of octets such as `0x00,0x1F`", "left out");
                super::reader::note("Const@Data", Some(&data), extensions);
            }
        }
        Ok(())
    }

    fn parameter(&mut self, tag: &Tag<'a>, index: u16) -> Read<Item> {
        const NAMES: [&str; 12] = [
            "DataType",
            "ByteOffset",
            "DefaultValue",
            "AllowedValues",
            "TextId",
            "Changeable",
            "Visible",
            "ValueItemTarget",
            "BitOffset",
            "BitLength",
            "Length",
            "ID",
        ];
        let mut item = Item::new(Binding::Record { index, bit_offset: 0, bits: 0 });
        item.origin = self.cursor.origin(tag);
        let fields = self.fields(tag, &NAMES, &mut item.extensions)?;
        let [data_type, byte, default, allowed, text, changeable, visible, values, bit, bits, length, id] = fields;
        super::reader::note("ID", id.as_ref(), &mut item.extensions);
        item.at.name = text.as_ref().map_or(Span::default(), |given| given.span);
        item.name = self.name(tag, text);
        let place = Place { data_type, byte, bit, bits, length };
        let (ty, is_string) = self.place(tag, place, &mut item);
        self.limits(tag, ty, default, is_string, allowed.as_ref(), &mut item)?;
        if let Some(target) = values {
            self.values(ty, target, &mut item);
        }
        item.at.access = changeable.as_ref().map_or(Span::default(), |given| given.span);
        item.access = if self.flag(changeable.as_ref(), true) { Access::ReadWrite } else { Access::Constant };
        if !self.flag(visible.as_ref(), true) {
            item.behaviour = Some(Box::new(Behaviour { hidden: true, ..Behaviour::default() }));
        }
        if !tag.empty {
            self.no_children(tag, &mut item.extensions)?;
        }
        // Nearly every parameter has its ID there, and nothing else.
        item.extensions.shrink_to_fit();
        Ok(item)
    }

    /// Type and place of a parameter; gives the type of its numbers, and whether it is a string.
    fn place(&mut self, tag: &Tag<'a>, place: Place<'a>, item: &mut Item) -> (Type, bool) {
        let Place { data_type, byte, bit, bits, length } = place;
        item.at.ty = data_type.as_ref().map_or(Span::default(), |given| given.span);
        if byte.is_none() {
            self.missing(tag, "ByteOffset", "taken for 0");
        }
        let byte = self.unsigned(byte.as_ref(), u32::MAX / 8 - 1, "byte offset").unwrap_or(0);
        let length = self.unsigned(length.as_ref(), u16::MAX.into(), "length in bytes");
        let found = self.data_type(tag, data_type.as_ref());
        let mut offset = byte * 8;
        let (ty, bits) = match found {
            Some(DataType::Bit | DataType::BitArea) => {
                offset += self.unsigned(bit.as_ref(), 7, "offset of a bit in its byte").unwrap_or(0);
                match found {
                    Some(DataType::BitArea) => {
                        let bits = self.unsigned(bits.as_ref(), 64, "number of bits").unwrap_or(1).max(1);
                        (Type::Unsigned(u8::try_from(bits).unwrap_or(64)), bits)
                    }
                    _ => (Type::Boolean, 1),
                }
            }
            Some(found) => {
                let (ty, bytes) = found.lower(length, &mut self.types);
                // A Boolean is a byte of which one bit counts.
                (ty, bytes * 8)
            }
            None => (Type::Opaque(None), length.unwrap_or(0) * 8),
        };
        if bits == 0 {
            self.missing(tag, "Length", "it has no bytes");
        }
        item.ty = ty;
        item.bindings = smallvec::smallvec![Binding::Record { index: self.index_of(item), bit_offset: offset, bits }];
        let numbers = match found {
            Some(DataType::Number(number)) => number.base,
            _ => ty,
        };
        (numbers, matches!(found, Some(DataType::String(_))))
    }

    fn index_of(&self, item: &Item) -> u16 {
        match item.bindings.first() {
            Some(Binding::Record { index, .. }) => *index,
            _ => 0,
        }
    }

    /// The data type that `tag` names; one that GSDML doesn't have is reported.
    pub fn data_type(&mut self, tag: &Tag<'a>, given: Option<&Given<'a>>) -> Option<DataType> {
        let Some(given) = given else {
            self.missing(tag, "DataType", "kept as raw bytes");
            return None;
        };
        let found = DataType::find(&given.text);
        if found.is_some() {
            return found;
        }
        let similar = DataType::find_in_any_case(&given.text);
        if let Some((name, _)) = similar {
            let message = format!("`{}` is written in another case than GSDML has it", shortened(&given.text));
            let diagnostic = Diagnostic::new(&codes::UNKNOWN_GSDML_TYPE, given.span, message);
            self.diagnostics.push(diagnostic.label(format!("read as `{name}`")));
        } else {
            let message = format!("`{}` is no data type of GSDML", shortened(&given.text));
            let diagnostic = Diagnostic::new(&codes::UNKNOWN_GSDML_TYPE, given.span, message);
            let diagnostic = diagnostic.label("kept as raw bytes of the length that is given");
            self.diagnostics.push(match given.text.as_ref() {
                "Float" | "Real" | "REAL" => diagnostic.help("a number of 4 bytes is a `Float32`"),
                _ => diagnostic,
            });
        }
        similar.map(|(_, ty)| ty)
    }

    /// Default and allowed values.
    fn limits(
        &mut self,
        tag: &Tag<'a>,
        ty: Type,
        default: Option<Given<'a>>,
        is_string: bool,
        allowed: Option<&Given<'a>>,
        item: &mut Item,
    ) -> Read<()> {
        item.limits = self.allowed_values(allowed, ty, &mut item.extensions);
        if let Some(given) = allowed {
            (item.at.low, item.at.high) = (given.span, given.span);
        }
        let Some(mut given) = default else {
            self.missing(tag, "DefaultValue", "without a default");
            return Ok(());
        };
        if is_string {
            // Blanks around a text are part of it.
            if let Some(attribute) = tag.attribute("DefaultValue")? {
                given.text = attribute.value(self.diagnostics);
            }
        }
        let bits = match item.bindings.first() {
            Some(Binding::Record { bits, .. }) => *bits,
            _ => 0,
        };
        item.default = self.default_value(&given, ty, bits);
        item.at.default = given.span;
        Ok(())
    }

    /// Names of the values of a parameter.
    fn values(&mut self, ty: Type, target: Given<'a>, item: &mut Item) {
        // Two named values of one bit are an enumeration as well.
        let base = if ty == Type::Boolean { Type::Unsigned(1) } else { ty };
        if matches!(base, Type::Integer(_) | Type::Unsigned(_)) && item.ty == ty {
            item.ty = self.types.enumeration(target, base);
            return;
        }
        let message = "only whole numbers can have named values";
        let diagnostic = Diagnostic::new(&codes::GSDML_VALUE, target.span, message);
        self.diagnostics.push(diagnostic.label("kept as an extension attribute"));
        super::reader::note("ValueItemTarget", Some(&target), &mut item.extensions);
    }

    fn menu_list(&mut self, list: &Tag<'a>, menus: &mut Vec<Menu>, rest: &mut Extensions) -> Read<()> {
        while let Some(tag) = self.cursor.child(list)? {
            match tag.name {
                "MenuItem" => {
                    let menu = self.menu(&tag, rest)?;
                    menus.push(menu);
                }
                _ => self.unknown(&tag, rest)?,
            }
        }
        Ok(())
    }

    fn menu(&mut self, parent: &Tag<'a>, rest: &mut Extensions) -> Read<Menu> {
        let [id] = self.fields(parent, &["ID"], rest)?;
        let mut menu = Menu { id: id.map_or_else(CompactString::default, |id| id.text.into()), ..Menu::default() };
        while let Some(tag) = self.cursor.child(parent)? {
            match tag.name {
                "Name" => menu.name = self.text_reference(&tag)?,
                "ParameterRef" => menu.targets.push(self.single(&tag, "ParameterTarget")?),
                "MenuRef" => menu.targets.push(self.single(&tag, "MenuTarget")?),
                _ => self.unknown(&tag, rest)?,
            }
        }
        Ok(menu)
    }
}

/// Where a parameter says that it is.
struct Place<'a> {
    data_type: Option<Given<'a>>,
    byte: Option<Given<'a>>,
    bit: Option<Given<'a>>,
    bits: Option<Given<'a>>,
    length: Option<Given<'a>>,
}
