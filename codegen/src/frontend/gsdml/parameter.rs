//! Reads the parameters of a record.

use super::data_type::DataType;
use super::location::Location;
use super::reader::Reader;
use crate::frontend::xml::{Given, Read};
use crate::ir::{Access, Behavior, Binding, CompactString, Item, OtherSpans, RelatedItems};
use crate::syntax::xml::Tag;

impl<'a> Reader<'a, '_> {
    /// Reads a `Ref` element, which describes a parameter of the record `index`.
    pub fn parameter(&mut self, tag: &Tag<'a>, index: u16, item: &mut Item) -> Read<()> {
        const NAMES: [&str; 12] = [
            "ValueItemTarget",
            "DataType",
            "ByteOffset",
            "BitOffset",
            "BitLength",
            "Length",
            "DefaultValue",
            "AllowedValues",
            "Changeable",
            "Visible",
            "TextId",
            "ID",
        ];
        let start = self.extensions.len();
        item.origin = self.origin(tag);
        let fields = self.attributes(tag, NAMES)?;
        let [values, data_type, byte, bit, bits, length, default, allowed, changeable, visible, text, id] = fields;
        let (id, mut unsuitable_values) = (id.compact(), CompactString::default());
        item.at.name = text.span;
        item.name = self.name(tag, text);
        self.require(tag, &byte, "ByteOffset", "read as 0");
        let location = self.location(tag, &data_type, [&byte, &bit, &bits, &length]);
        let Location { ty, bit_offset, bits, .. } = location;
        if bits == 0 {
            self.missing(tag, "Length", "read as 0 bytes");
        }
        (item.ty, item.at.ty) = (ty, data_type.span);
        item.bindings = smallvec::smallvec![Binding::Record { index, bit_offset, bits }];
        item.limits = self.allowed_values(&allowed, location.number()).into();
        item.at.others = OtherSpans { low: allowed.span, high: allowed.span, ..OtherSpans::default() }.into();
        self.default(tag, default, &location, item)?;
        match self.named_values(&values, ty) {
            Some(named) => item.ty = named,
            None => unsuitable_values = values.compact(),
        }
        if !id.is_empty() || !unsuitable_values.is_empty() {
            item.related = Some(Box::new(RelatedItems { id, unsuitable_values, ..RelatedItems::default() }));
        }
        item.at.access = changeable.span;
        item.access = if self.flag_or(&changeable, true) { Access::ReadWrite } else { Access::Constant };
        if !self.flag_or(&visible, true) {
            item.behavior = Some(Box::new(Behavior { hidden: true, ..Behavior::default() }));
        }
        self.no_children(tag)?;
        item.extensions = self.extensions_since(start);
        Ok(())
    }

    fn default(&mut self, tag: &Tag<'a>, mut given: Given<'a>, location: &Location, item: &mut Item) -> Read<()> {
        if !self.require(tag, &given, "DefaultValue", "the parameter has no default value") {
            return Ok(());
        }
        if matches!(location.data_type, Some(DataType::String(_))) {
            // Spaces around the default value of a string belong to the string.
            given = self.attribute_with_blanks(tag, "DefaultValue")?;
        }
        item.default = self.default_value(&given, location.number(), location.bits);
        item.at.default = given.span;
        Ok(())
    }
}
