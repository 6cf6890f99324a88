//! Name, default value, range, unit and PDO mapping of an item.

use super::physical::{shown_unit, Physical};
use super::types;
use super::words::PLAIN;
use crate::ir::owner::Owner;
use crate::ir::{
    BitFieldEntry, BitMeaning, EnumValue, Group, Item, Limits, Mappable, ObjectCode, Quantity, Scale, Shape, Type,
    TypeDef, Value,
};
use crate::number::hex;

/// Returns the name of an item. Many files state no name, or only a placeholder such as `SubIndex 001`. In this case, sub-index 0
/// is called `Number of entries` (CiA 301). Other sub-indices are called by object and sub-index: `RxPDO 1 mapping, sub-index 1`.
/// The value of an object without sub-indices has the name of the object.
pub fn entry_name(item: &Item, group: &Group) -> String {
    let has_subs = group.object_code().is_some_and(ObjectCode::has_subs);
    match item.object() {
        Some((_, 0)) if has_subs && is_placeholder(&item.name) => "Number of entries".to_owned(),
        Some((_, sub_index)) if has_subs && is_placeholder(&item.name) && !group.name.is_empty() => {
            format!("{}, sub-index {sub_index}", group.name)
        }
        Some(_) if !has_subs && is_placeholder(&item.name) && !group.name.is_empty() => group.name.to_string(),
        _ => item.name.to_string(),
    }
}

/// Returns whether a name states only a sub-index, such as `SubIndex 001`, or is empty.
pub fn is_placeholder(name: &str) -> bool {
    /// The placeholders in lower case, without digits and separators.
    const WORDS: [&str; 3] = ["", "subindex", "subidx"];
    let word: String = name.chars().filter(|letter| letter.is_alphabetic()).flat_map(char::to_lowercase).collect();
    let is_separated = name.chars().all(|letter| letter.is_alphanumeric() || matches!(letter, ' ' | '-' | '_'));
    is_separated && WORDS.contains(&word.as_str()) && (name.is_empty() || !word.is_empty())
}

/// Formats a value of an item. The physical value comes before the raw value. `types` are the types of the device or
/// module that has the item.
pub fn value(item: &Item, value: &Value, types: &[TypeDef]) -> String {
    let basic = types::basic(types, item.ty);
    PLAIN.of_item(item, value, &|value| raw(item, value, basic))
}

/// Returns the meaning of a value: the name of an enumeration value, or the active flags and the fields of a bit field.
/// Commas separate the flags and fields. The name of a field is followed by its number or by the name of its value:
/// `Mode 3`, `Mode: Homing`. Numbers equal to 0, reserved fields, and fields whose meaning depends on a condition are left out.
/// Returns `None` if the value has no name, and all flags and fields are inactive or left out.
pub fn meaning(ty: Type, value: &Value, types: &[TypeDef]) -> Option<String> {
    let number = value.as_int()?;
    match &Owner::of_types(types).definition(ty)?.shape {
        Shape::Enumeration { values, .. } => {
            let is_of = |named: &&EnumValue| (named.range().0..=named.range().1).contains(&number);
            values.iter().find(is_of).map(|named| named.name.to_string())
        }
        Shape::BitField { fields, .. } => {
            let named = fields.iter().filter(|field| !field.is_reserved() && field.when.is_none());
            let names: Vec<String> = named.filter_map(|field| bits(field, number, types)).collect();
            (!names.is_empty()).then(|| names.join(", "))
        }
        _ => None,
    }
}

/// Returns the name of an active flag, or the name of a field with its number or with the name of its value. Returns `None` for a
/// reserved field, an inactive flag or the number 0.
fn bits(field: &BitFieldEntry, number: i128, types: &[TypeDef]) -> Option<String> {
    let bits = number.checked_shr(field.offset.into()).unwrap_or(0) & ((1 << field.bits.min(64)) - 1);
    match field.meaning {
        BitMeaning::Flag { inverted } => ((bits != 0) != inverted).then(|| field.name.to_string()),
        BitMeaning::Number => (bits != 0).then(|| format!("{} {bits}", field.name)),
        BitMeaning::Enumeration(id) => {
            let name = meaning(Type::Named(id), &Value::Int(bits), types);
            Some(format!("{}: {}", field.name, name.unwrap_or_else(|| bits.to_string())))
        }
        BitMeaning::Reserved { .. } => None,
    }
}

/// Returns the default value, or an empty text if there is none.
pub fn default(item: &Item, types: &[TypeDef]) -> String {
    item.default.as_ref().map(|default| value(item, default, types)).unwrap_or_default()
}

/// Returns the range: `0 … 5`, `1, 3 to 7`, `-20.0 … 200.0 °C (raw -200 … 2000)`. The text is empty if the item has no
/// limits. The text contains at most `shown` values of a list.
pub fn range(item: &Item, limits: &Limits, types: &[TypeDef], shown: usize) -> String {
    let physical = Physical::of(item.quantity.as_deref());
    let basic = types::basic(types, item.ty);
    let raw = |value: &Value| raw(item, value, basic);
    match limits.allowed.is_empty() {
        true => PLAIN.range(limits, physical.as_ref(), &raw),
        false => PLAIN.allowed(limits, physical.as_ref(), &raw, shown),
    }
}

/// Returns the default value for a table that has a column for units: `25.0` instead of `25.0 °C (raw 250)`.
pub fn default_cell(item: &Item, types: &[TypeDef]) -> String {
    let Some(value) = &item.default else { return String::new() };
    match Physical::of(item.quantity.as_deref()).filter(|_| !PLAIN.is_named(item, value)) {
        Some(physical) => physical.cell(value, &|value| PLAIN.value(value)),
        None => default(item, types),
    }
}

/// Returns the range for a table that has a column for units: `-20.0 … 200.0`. The text is empty if the item has no
/// limits, or if the range is that of the type.
pub fn range_cell(item: &Item, types: &[TypeDef], shown: usize) -> String {
    let (limits, basic) = (&item.limits, types::basic(types, item.ty));
    if limits.allowed.is_empty()
        && basic.integer_range().is_some_and(|(low, high)| limits.integers() == (Some(low), Some(high)))
    {
        return String::new();
    }
    let Some(physical) = Physical::of(item.quantity.as_deref()) else { return range(item, limits, types, shown) };
    let raw = |value: &Value| PLAIN.value(value);
    let one = |(low, high): &(Value, Value)| match low == high {
        true => physical.cell(low, &raw),
        false => physical.range_cell((Some(low), Some(high)), &raw),
    };
    match (limits.allowed.as_slice(), &limits.low, &limits.high) {
        ([], None, None) => String::new(),
        ([], low, high) => physical.range_cell((low.as_ref(), high.as_ref()), &raw),
        (allowed, ..) => {
            let mut list: Vec<String> = allowed.iter().take(shown).map(one).collect();
            list.extend((allowed.len() > shown).then(|| "…".to_owned()));
            list.join(", ")
        }
    }
}

/// Returns the unit of the physical value. The text is empty if the item has no unit, if the value is a ratio, or if another item
/// contains the exponent of the physical value.
pub fn unit(item: &Item) -> &str {
    match item.quantity.as_deref() {
        Some(Quantity { scale: Some(Scale::Exponent { .. }), .. }) | None => "",
        Some(quantity) => shown_unit(quantity),
    }
}

/// Returns the PDOs that an item can be mapped into, or `None` if it cannot be mapped.
pub fn mappable(mappable: Mappable) -> Option<&'static str> {
    match (mappable.rpdo, mappable.tpdo) {
        (true, true) => Some("any PDO"),
        (true, false) => Some("RPDOs"),
        (false, true) => Some("TPDOs"),
        (false, false) => None,
    }
}

/// Formats a raw value. The number is decimal if the item has a unit or a scale factor.
fn raw(item: &Item, value: &Value, ty: Type) -> String {
    match item.quantity {
        Some(_) => PLAIN.value(value),
        None => number(value, ty),
    }
}

/// Formats a value for the cell of a table. Large unsigned numbers are hexadecimal.
fn number(value: &Value, ty: Type) -> String {
    match value {
        Value::Int(number) => integer(*number, matches!(ty, Type::Unsigned(_))),
        _ => PLAIN.value(value),
    }
}

/// Formats a number. Large unsigned numbers are hexadecimal, because most of them are bit patterns, addresses and signatures.
pub fn integer(number: i128, is_unsigned: bool) -> String {
    match number {
        0x1_0000.. if is_unsigned => hex(number),
        _ => number.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ir::Binding;

    #[test]
    fn names_that_state_only_a_sub_index() {
        for name in ["", "SubIndex 001", "Sub-Index 1", "subindex_12", "SubIdx 3"] {
            assert!(is_placeholder(name), "{name}");
        }
        for name in ["001", "Highest SubIndex supported", "SubIndex: 1", "Speed"] {
            assert!(!is_placeholder(name), "{name}");
        }
    }

    #[test]
    fn values_and_bits_have_names() {
        let flag =
            |name: &str, offset| BitFieldEntry::new(name.into(), offset, 1, BitMeaning::Flag { inverted: false });
        let ready = BitFieldEntry { meaning: BitMeaning::Flag { inverted: true }, ..flag("Enabled", 2) };
        let mode = BitFieldEntry::new("Mode".into(), 4, 4, BitMeaning::Enumeration(crate::ir::TypeId(0)));
        let fields = vec![flag("Fault", 0), flag("Warning", 1), ready, mode];
        let base = Type::Unsigned(8);
        let values =
            vec![EnumValue::new("Homing".into(), 6), EnumValue { last: Some(3), ..EnumValue::new("Jog".into(), 1) }];
        let types = [
            TypeDef::new("Mode", Shape::Enumeration { base, values, closed: false }, Some(8)),
            TypeDef::new("Status", Shape::BitField { base, fields }, Some(8)),
        ];
        let of = |id, number| meaning(Type::Named(crate::ir::TypeId(id)), &Value::Int(number), &types);
        assert_eq!(of(0, 6).as_deref(), Some("Homing"));
        assert_eq!(of(0, 2).as_deref(), Some("Jog"));
        assert_eq!(of(0, 4), None);
        assert_eq!(of(1, 0x61).as_deref(), Some("Fault, Enabled, Mode: Homing"));
        assert_eq!(of(1, 0x96).as_deref(), Some("Warning, Mode: 9"));
        assert_eq!(meaning(base, &Value::Int(1), &types), None);
    }

    #[test]
    fn an_entry_without_a_name_has_the_name_of_its_object() {
        let object = |name: &str| Group { name: name.into(), ..Group::object(0x1A00, ObjectCode::Record) };
        let entry =
            |sub_index, name: &str| Item { name: name.into(), ..Item::new(Binding::canopen(0x1A00, sub_index)) };
        let mapping = object("TxPDO 1 mapping");
        assert_eq!(entry_name(&entry(0, "SubIndex 000"), &mapping), "Number of entries");
        assert_eq!(entry_name(&entry(2, "SubIndex 002"), &mapping), "TxPDO 1 mapping, sub-index 2");
        assert_eq!(entry_name(&entry(2, ""), &mapping), "TxPDO 1 mapping, sub-index 2");
        assert_eq!(entry_name(&entry(2, "Speed"), &mapping), "Speed");
        assert_eq!(entry_name(&entry(2, "SubIndex 002"), &object("")), "SubIndex 002");
        let value = Group { name: "Speed".into(), ..Group::object(0x1A00, ObjectCode::Var) };
        assert_eq!(entry_name(&entry(0, ""), &value), "Speed");
    }
}
