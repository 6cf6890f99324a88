//! Reads the value list, which contains named values of parameters.

use super::links::ElementKind;
use super::number::range;
use super::reader::Reader;
use super::types::ValueItem;
use super::value::whole;
use crate::frontend::xml::Read;
use crate::ir::EnumValue;
use crate::syntax::xml::Tag;

impl<'a> Reader<'a, '_> {
    /// Reads a `ValueList` element.
    pub fn value_list(&mut self, list: &Tag<'a>) -> Read<()> {
        self.each(list, "ValueItem", Self::value_item)
    }

    fn value_item(&mut self, parent: &Tag<'a>) -> Read<()> {
        let mut item = ValueItem::default();
        item.origin = self.origin(parent);
        let [id] = self.attributes(parent, ["ID"])?;
        self.register(parent, ElementKind::Value, &id, self.format.types.value_items());
        item.id = id.compact();
        while let Some(tag) = self.child(parent)? {
            match tag.name {
                "Help" => item.documentation = self.documentation(&tag)?,
                "Assignments" => {
                    self.each(&tag, "Assign", |reader, tag| {
                        item.values.extend(reader.assign(tag)?);
                        Ok(())
                    })?;
                }
                _ => self.unknown(&tag)?,
            }
        }
        item.values.shrink_to_fit();
        self.format.types.add_values(&id, item);
        Ok(())
    }

    fn assign(&mut self, tag: &Tag<'a>) -> Read<Option<EnumValue>> {
        let [text, content] = self.attributes(tag, ["TextId", "Content"])?;
        let name = self.name(tag, text);
        if !self.require(tag, &content, "Content", "left out") {
            return Ok(None);
        }
        let Some((value, last)) = span_of_values(&content.text) else {
            self.bad(&content, "integer or range of integers", "left out of the enumeration");
            self.note("Assign@Content", &content);
            return Ok(None);
        };
        Ok(Some(EnumValue { last, ..EnumValue::new(name, value) }))
    }
}

/// Reads a value or range, such as `7` or `0..3`. Returns `None` for a descending range and for invalid text.
fn span_of_values(text: &str) -> Option<(i128, Option<i128>)> {
    let (first, last) = range(text, integer)?;
    (first <= last).then_some((first, (first != last).then_some(last)))
}

/// Reads an integer in a value list. Also accepts a number with a zero fraction, such as `7.0`, and hexadecimal digits
/// after `0x`.
fn integer(text: &str) -> Option<i128> {
    let text = text.trim();
    if let Some(digits) = text.strip_prefix("0x").or_else(|| text.strip_prefix("0X")) {
        return u64::from_str_radix(digits, 16).ok().map(i128::from);
    }
    let real = || text.parse::<f64>().ok().filter(|value| value.fract() == 0.0 && value.abs() < 9e15);
    whole(text).map(|(value, _)| value).or_else(|| real().map(|value| value as i128))
}
