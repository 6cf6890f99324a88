//! Named types: their basic types and their GSDML names.

use super::docs;
use crate::ir::{Scale, Shape, TimeFormat, Type, TypeDef};

/// Maximum number of type names in a chain of definitions. A longer chain is treated as a cycle.
const DEPTH: usize = 16;

/// Returns the basic type of `ty`. If `ty` is an enumeration, also returns its position.
pub(super) fn resolve(types: &[TypeDef], ty: Type) -> (Type, Option<u32>) {
    let (mut ty, mut enumeration) = (ty, None);
    for _ in 0..DEPTH {
        let Type::Named(id) = ty else { return (ty, enumeration) };
        let Some(definition) = types.get(id.0 as usize) else { break };
        ty = match &definition.shape {
            Shape::Alias(other) => *other,
            Shape::BitField { base, .. } | Shape::Scaled { base, .. } => *base,
            Shape::Enumeration { base, .. } => {
                enumeration = enumeration.or(Some(id.0));
                *base
            }
            Shape::Array { .. } | Shape::Record(_) => break,
        };
    }
    (Type::Opaque(None), None)
}

/// Returns the GSDML name of a type. If the type is scaled, the name includes the scale factor.
pub(super) fn type_name(types: &[TypeDef], ty: Type) -> String {
    match ty {
        Type::Boolean => "Boolean".to_owned(),
        Type::Integer(bits) => format!("Integer{bits}"),
        Type::Unsigned(bits) => format!("Unsigned{bits}"),
        Type::Real32 => "Float32".to_owned(),
        Type::Real64 => "Float64".to_owned(),
        Type::VisibleString(_) => "VisibleString".to_owned(),
        Type::OctetString(_) => "OctetString".to_owned(),
        Type::UnicodeString(_) => "UnicodeString".to_owned(),
        Type::TimeOfDay => "TimeOfDay with date indication".to_owned(),
        Type::TimeDifference => "TimeDifference with date indication".to_owned(),
        Type::Time(TimeFormat::TimeOfDay | TimeFormat::TimeDifference) => format!("{ty}, in ms"),
        Type::Time(_) => ty.to_string(),
        Type::Domain | Type::Opaque(_) => "bytes of an unknown type".to_owned(),
        Type::Named(id) => match types.get(id.0 as usize) {
            Some(definition) => named(types, definition),
            None => "bytes of an unknown type".to_owned(),
        },
    }
}

fn named(types: &[TypeDef], definition: &TypeDef) -> String {
    let name = docs::escape(&definition.name);
    match &definition.shape {
        Shape::Scaled { scale: Scale::Linear { factor, .. }, .. } => format!("{name}, 1 LSB = {factor}"),
        Shape::Enumeration { base, .. } => match base {
            Type::Named(_) => name,
            base => type_name(types, *base),
        },
        _ => name,
    }
}
