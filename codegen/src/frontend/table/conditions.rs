//! Conditions under which an element exists or can be written: values of other items, models, firmware versions, buses.

use compact_str::CompactString;

use super::at::{At, OneOrMany};
use super::buses;
use super::format::{ConditionValues, Conditions};
use super::references::ITEM;
use super::tree::Reader;
use super::value;
use crate::diagnostics::codes;
use crate::ir::{Availability, Condition, ElementRef, Type};

/// Reads the condition of a bit or value. Reports a condition on several items, and reads only its first item.
pub(super) fn condition(reader: &mut Reader<'_, '_>, when: Option<&Conditions>) -> Option<Box<Condition>> {
    let given = when?;
    if let Some((second, _)) = given.0.get(1) {
        let message = "the condition of a bit or value depends on more than one item";
        reader.report(&codes::TABLE_VALUE, reader.span(second), message);
    }
    conditions(reader, given).into_iter().next().map(Box::new)
}

/// Reads conditions that compare the values of other items.
pub(super) fn conditions(reader: &mut Reader<'_, '_>, when: &Conditions) -> Vec<Condition> {
    let mut conditions = Vec::new();
    for (item, given) in when.iter() {
        reader.mention([item], ITEM);
        let (mask, literals) = match &given.value {
            ConditionValues::Values(OneOrMany(values)) => (None, values.as_slice()),
            ConditionValues::Bits(bits) => (bits.mask, bits.value.as_ref().map_or(&[][..], |value| value.0.as_slice())),
        };
        let span = reader.span(given);
        let values = value::listed(reader, literals, (given.start, given.end), Type::Opaque(None));
        let outside =
            |mask: u64| values.iter().filter_map(|value| value.as_int()).any(|value| value & !i128::from(mask) != 0);
        if literals.is_empty() || mask.is_some_and(outside) || mask == Some(0) {
            let message = "the condition is never true: it has no value, or a value with bits outside of its `mask`";
            reader.report(&codes::TABLE_VALUE, span, message);
        }
        conditions.push(Condition { item: reader.reference(item), values, names: Vec::new(), mask });
    }
    conditions
}

/// Reads the models, firmware versions and buses that have an element, and the element that replaces it. `since` is the first
/// firmware version that has the element, and `until` is the first later version that no longer has it. Records the names of the
/// models, so that they are looked up later. Returns `None` if the table states none of these facts.
pub(super) fn availability(
    reader: &mut Reader<'_, '_>,
    models: &Option<Vec<At<String>>>,
    [since, until]: [&Option<String>; 2],
    replaced_by: Option<&str>,
    buses: Option<&Vec<At<String>>>,
) -> Option<Box<Availability>> {
    let models = models.iter().flatten();
    reader.mention(models.clone(), "model");
    let availability = Availability {
        models: models.map(|model| model.value.as_str().into()).collect(),
        since: since.as_deref().map(CompactString::from),
        until: until.as_deref().map(CompactString::from),
        replaced_by: replaced_by.map(ElementRef::from),
        buses: buses.map(|list| buses::read(reader, list)).unwrap_or_default(),
        ..Availability::default()
    };
    (availability != Availability::default()).then(|| Box::new(availability))
}
