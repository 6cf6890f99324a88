//! Reads the children of the `dataTypeList` element.

use super::application::{insert, Application};
use super::data_type::{enum_value, DataTypeKind, RawType, TypeRef};
use super::number::integer;
use super::parameter;
use super::reader::{Reader, Texts};
use crate::diagnostics::codes;
use crate::frontend::xml::Read;
use crate::ir::EnumValue;
use crate::syntax::xml::Tag;

/// Reads a child of the `dataTypeList` element and adds its data type.
pub(super) fn read<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>, application: &mut Application<'a>) -> Read<()> {
    if !matches!(tag.name, "array" | "struct" | "enum" | "derived") {
        return reader.unknown(tag);
    }
    let origin = reader.origin(tag);
    let [id, name, size] = reader.attributes(tag, ["uniqueID", "name", "size"])?;
    // The size of an enumeration is redundant, because its values and its base type determine the size.
    reader.note("enum@size", &size);
    let mut texts = Texts::default();
    let kind = match tag.name {
        "array" => array(reader, tag, &mut texts)?,
        "struct" => structure(reader, tag, &mut texts, application)?,
        "enum" => enumeration(reader, tag, &mut texts)?,
        _ => derived(reader, tag, &mut texts)?,
    };
    insert(reader, &mut application.type_ids, id, application.types.len());
    let name = if name.is_missing() { texts.labels.name() } else { name.compact() };
    application.types.push(RawType { name, texts, kind, origin });
    Ok(())
}

/// Reads a child of a data type: the type of an element or base, a label or a description.
fn component<'a>(
    reader: &mut Reader<'a, '_>,
    tag: &Tag<'a>,
    component: &mut Option<TypeRef<'a>>,
    texts: &mut Texts<'a>,
) -> Read<()> {
    match TypeRef::read(reader, tag)? {
        Some(ty) => *component = Some(ty),
        None => reader.text_or_keep(tag, texts)?,
    }
    Ok(())
}

fn array<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, texts: &mut Texts<'a>) -> Read<DataTypeKind<'a>> {
    let (mut dimensions, mut element) = (Vec::new(), None);
    while let Some(tag) = reader.child(parent)? {
        if tag.name != "subrange" {
            component(reader, &tag, &mut element, texts)?;
            continue;
        }
        let bounds = reader.attributes(&tag, ["lowerLimit", "upperLimit"])?;
        match bounds.map(|given| given.text.parse::<i32>().ok()) {
            [Some(low), Some(high)] if low <= high => {
                let count = i64::from(high) - i64::from(low) + 1;
                dimensions.push((low, u32::try_from(count).unwrap_or(u32::MAX)));
            }
            _ => {
                let message = "lowerLimit and upperLimit are not a range of whole numbers";
                reader.report(&codes::XDD_VALUE, tag.span, message, "left out");
            }
        }
    }
    Ok(DataTypeKind::Array { dimensions, element })
}

fn structure<'a>(
    reader: &mut Reader<'a, '_>,
    parent: &Tag<'a>,
    texts: &mut Texts<'a>,
    application: &mut Application<'a>,
) -> Read<DataTypeKind<'a>> {
    let mut variables = Vec::new();
    while let Some(tag) = reader.child(parent)? {
        if tag.name != "varDeclaration" {
            reader.text_or_keep(&tag, texts)?;
            continue;
        }
        let (id, mut variable) = parameter::read(reader, &tag)?;
        variable.field = Some((application.types.len(), variables.len()));
        insert(reader, &mut application.parameter_ids, id, application.parameters.len());
        variables.push(application.parameters.len());
        application.parameters.push(variable);
    }
    Ok(DataTypeKind::Struct(variables))
}

fn enumeration<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, texts: &mut Texts<'a>) -> Read<DataTypeKind<'a>> {
    let (mut base, mut values) = (None, Vec::<EnumValue>::new());
    while let Some(tag) = reader.child(parent)? {
        if tag.name != "enumValue" {
            component(reader, &tag, &mut base, texts)?;
            continue;
        }
        let [given] = reader.attributes(&tag, ["value"])?;
        let texts = reader.texts(&tag)?;
        // A value without a number is one more than the value before it, as in C.
        let value = match given.is_missing() {
            true => Some(values.last().map_or(0, |last| last.value.saturating_add(1))),
            false => integer(&given.text),
        };
        match value {
            Some(value) => values.push(enum_value(value, &texts)),
            None => reader.bad(&given, "enumeration value", "left out"),
        }
    }
    Ok(DataTypeKind::Enum { base, values })
}

fn derived<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>, texts: &mut Texts<'a>) -> Read<DataTypeKind<'a>> {
    let (mut base, mut count) = (None, None);
    while let Some(tag) = reader.child(parent)? {
        if tag.name != "count" {
            component(reader, &tag, &mut base, texts)?;
            continue;
        }
        while let Some(inner) = reader.child(&tag)? {
            if inner.name == "defaultValue" {
                let given = reader.attribute(&inner, "value")?;
                count = reader.unsigned(&given, u32::MAX, "number of elements");
            } else {
                reader.keep(&inner)?;
            }
        }
    }
    Ok(DataTypeKind::Derived { base, count })
}
