//! Reads parameters, their allowed values and units.

use super::application::{Allowed, AllowedRange, Parameter, ParameterKey, Unit};
use super::attributes::Attributes;
use super::data_type::TypeRef;
use super::reader::{Lang, Reader};
use crate::frontend::xml::{Given, Read};
use crate::ir::Extension;
use crate::syntax::xml::Tag;

/// Value of each [`ParameterKey`].
type Values<'a> = [Given<'a>; ParameterKey::Actual as usize + 1];

/// Reads a `parameter`, `parameterTemplate` or `varDeclaration` element. Also returns its uniqueID.
pub(super) fn read<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<(Given<'a>, Parameter<'a>)> {
    let (mut parameter, start) = (Parameter::default(), reader.extensions.len());
    let mut values = Values::default();
    for (value, given) in values.iter_mut().zip(reader.attributes(parent, ParameterKey::NAMES)?) {
        *value = given;
    }
    let [id, name, access_list] = [ParameterKey::Id, ParameterKey::Name, ParameterKey::AccessList]
        .map(|key| std::mem::take(&mut values[key as usize]));
    reader.note("accessList", &access_list);
    while let Some(tag) = reader.child(parent)? {
        child(reader, &tag, &mut parameter, &mut values)?;
    }
    if !name.is_missing() && parameter.texts.labels.is_empty() {
        parameter.texts.labels.push(Lang::default(), name);
    }
    parameter.attributes = Attributes::take(&mut values);
    parameter.extensions = reader.extensions_since(start);
    parameter.weight = reader.length(parent);
    Ok((id, parameter))
}

fn child<'a>(
    reader: &mut Reader<'a, '_>,
    tag: &Tag<'a>,
    parameter: &mut Parameter<'a>,
    values: &mut Values<'a>,
) -> Read<()> {
    if let Some(ty) = TypeRef::read(reader, tag)? {
        parameter.ty = Some(ty);
        return Ok(());
    }
    match tag.name {
        "label" | "description" => reader.text_or_keep(tag, &mut parameter.texts)?,
        "denotation" => parameter.denotation = Some(Box::new(reader.texts(tag)?)),
        "defaultValue" => values[ParameterKey::Default as usize] = value(reader, tag)?,
        "actualValue" => values[ParameterKey::Actual as usize] = value(reader, tag)?,
        "substituteValue" => {
            let given = value(reader, tag)?;
            reader.note("substituteValue", &given);
        }
        "allowedValues" => parameter.allowed = Some(Box::new(allowed(reader, tag)?)),
        "unit" => parameter.unit = Some(Box::new(unit(reader, tag)?)),
        "property" => {
            let [name, given] = reader.attributes(tag, ["name", "value"])?;
            if !name.is_missing() {
                let (value, span) = (given.compact(), given.span.or(name.span));
                reader.extensions.push(Extension { key: name.compact(), value, span });
            }
        }
        "conditionalSupport" | "variableRef" | "labelRef" | "descriptionRef" => reader.keep(tag)?,
        _ => reader.unknown(tag)?,
    }
    Ok(())
}

/// Returns the attribute `value` of `defaultValue` and similar elements. All other attributes and the child elements
/// become extensions.
fn value<'a>(reader: &mut Reader<'a, '_>, tag: &Tag<'a>) -> Read<Given<'a>> {
    let [given] = reader.attributes(tag, ["value"])?;
    while let Some(inner) = reader.child(tag)? {
        reader.keep(&inner)?;
    }
    Ok(given)
}

/// Reads an `allowedValues` or `allowedValuesTemplate` element.
pub(super) fn allowed<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<Allowed<'a>> {
    let mut allowed = Allowed { template: reader.attribute(parent, "templateIDRef")?, ..Allowed::default() };
    while let Some(tag) = reader.child(parent)? {
        match tag.name {
            "value" => {
                let [given] = reader.attributes(&tag, ["value"])?;
                let texts = reader.texts(&tag)?;
                if !given.is_missing() {
                    allowed.values.push((given, texts));
                }
            }
            "range" => {
                let mut range = AllowedRange::default();
                while let Some(inner) = reader.child(&tag)? {
                    match inner.name {
                        "minValue" => range.low = value(reader, &inner)?,
                        "maxValue" => range.high = value(reader, &inner)?,
                        "step" => range.step = value(reader, &inner)?,
                        _ => reader.keep(&inner)?,
                    }
                }
                allowed.ranges.push(range);
            }
            _ => reader.keep(&tag)?,
        }
    }
    allowed.weight = reader.length(parent);
    Ok(allowed)
}

fn unit<'a>(reader: &mut Reader<'a, '_>, parent: &Tag<'a>) -> Read<Unit<'a>> {
    let [multiplier, uri] = reader.attributes(parent, ["multiplier", "unitURI"])?;
    Ok(Unit { multiplier, uri, texts: reader.texts(parent)? })
}
