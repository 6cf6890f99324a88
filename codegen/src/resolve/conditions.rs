//! Values of conditions as the other item holds them: a bit pattern that is negative there becomes a negative number.

use std::collections::HashMap;

use crate::ir::owner::{Index, Owner};
use crate::ir::{CompactString, Condition, Device, Shape, TypeDef, Value};

pub(super) fn run(device: &mut Device) {
    let groups = [device.groups.as_slice()];
    let owner = Owner { types: &device.types, groups: &groups };
    let items = Index::new(owner);
    let behaviours = owner.items().filter_map(|item| item.behaviour.as_deref());
    let all = behaviours.flat_map(|own| &own.write_when).chain(device.types.iter().flat_map(of_type));
    // Some bits of an item have no sign.
    let all = all.filter(|own| own.mask.is_none() && own.values.iter().any(|value| value.as_int() > Some(0)));
    let mut bits: HashMap<CompactString, u32> = HashMap::new();
    for condition in all {
        let ty = items.find(&condition.item).map(|item| owner.basic(item.ty)).filter(|ty| ty.is_signed());
        bits.extend(ty.and_then(|ty| ty.bits()).map(|bits| (condition.item.clone(), bits)));
    }
    if bits.is_empty() {
        return;
    }
    let of_items = device.groups.iter_mut().flat_map(|group| &mut group.items);
    let of_items = of_items.filter_map(|item| item.behaviour.as_deref_mut()).flat_map(|own| &mut own.write_when);
    for condition in of_items.chain(device.types.iter_mut().flat_map(of_type_mut)) {
        let Some(&bits) = bits.get(&condition.item).filter(|bits| condition.mask.is_none() && (1..=64).contains(*bits))
        else {
            continue;
        };
        for value in &mut condition.values {
            if let Value::Int(number) = value {
                *number -= i128::from(*number >> (bits - 1) == 1) << bits;
            }
        }
    }
}

fn of_type(definition: &TypeDef) -> Vec<&Condition> {
    match &definition.shape {
        Shape::Enumeration { values, .. } => values.iter().filter_map(|value| value.when.as_ref()).collect(),
        Shape::BitField { fields, .. } => fields.iter().filter_map(|field| field.when.as_ref()).collect(),
        _ => Vec::new(),
    }
}

fn of_type_mut(definition: &mut TypeDef) -> Vec<&mut Condition> {
    match &mut definition.shape {
        Shape::Enumeration { values, .. } => values.iter_mut().filter_map(|value| value.when.as_mut()).collect(),
        Shape::BitField { fields, .. } => fields.iter_mut().filter_map(|field| field.when.as_mut()).collect(),
        _ => Vec::new(),
    }
}
