//! Reads the states and commands of a state machine: bit patterns, or the values of an enumeration.

use super::at::{Entries, TextOr};
use super::format::{MachineTable, PatternTable};
use super::tree::Reader;
use crate::diagnostics::codes;
use crate::ir::{Device, EnumValue, Pattern, Shape, Type, TypeRef};
use crate::text::brief;

/// Returns the base type and the values of the enumeration called `name`.
pub(super) fn enumeration<'d>(device: &'d Device, name: &str) -> Option<(Type, &'d [EnumValue])> {
    device.types.iter().filter(|definition| definition.name == name).find_map(|definition| match &definition.shape {
        Shape::Enumeration { base, values, .. } => Some((*base, &**values)),
        _ => None,
    })
}

/// Reads the states of a machine from bit patterns, or from the values of an enumeration. Ranges of values, and
/// reserved or vendor-specific values, are not states. Also returns a reference to the enumeration.
pub(super) fn states(
    reader: &mut Reader<'_, '_>,
    table: &MachineTable,
    device: &Device,
) -> (Option<TypeRef>, Vec<Pattern>) {
    let Some(given) = &table.states else { return (None, Vec::new()) };
    let name = match &given.value {
        TextOr::Table(entries) => return (None, patterns(reader, entries)),
        TextOr::Text(name) => name,
    };
    let Some((base, values)) = enumeration(device, name) else {
        let is_enumeration = |shape: &Shape| matches!(shape, Shape::Enumeration { .. });
        let known = device.types.iter().filter(|definition| is_enumeration(&definition.shape));
        let known = known.map(|definition| definition.name.as_str());
        reader.unresolved("enumeration", name, reader.span(given), known);
        return (None, Vec::new());
    };
    let mask = base.bits().filter(|&bits| bits < 32).map_or(u32::MAX, |bits| (1 << bits) - 1);
    let single = values.iter().filter(|value| value.last.is_none() && value.zone.is_none());
    let pattern = |value: &EnumValue| Pattern {
        name: value.name.clone(),
        mask,
        value: (value.value & i128::from(mask)) as u32,
        names: value.names.clone(),
        documentation: value.documentation.clone(),
    };
    (Some(TypeRef::new(name.as_str(), reader.span(given))), single.map(pattern).collect())
}

/// Reads the bit patterns of states or commands. Reports a pattern without a mask or value.
pub(super) fn patterns(reader: &mut Reader<'_, '_>, entries: &Entries<PatternTable>) -> Vec<Pattern> {
    let mut patterns = Vec::new();
    for (name, pattern) in entries.iter() {
        let pattern = &pattern.value;
        let (Some(mask), Some(value)) = (pattern.mask, pattern.value) else {
            let message = format!("`{}` needs a `mask` and a `value`", brief(&name.value));
            reader.report(&codes::TABLE_VALUE, reader.span(name), message);
            continue;
        };
        patterns.push(Pattern {
            name: name.value.as_str().into(),
            mask,
            value,
            names: reader.original(pattern.orig.as_deref()),
            documentation: reader.documentation_of(pattern),
        });
    }
    patterns
}
