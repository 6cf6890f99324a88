//! Corrects the signs of values in conditions. If the item of a condition is signed, a bit pattern with a set sign bit becomes a
//! negative number.

use super::mentions::for_each_condition;
use crate::collections::HashMap;
use crate::ir::owner::Owner;
use crate::ir::{Condition, Device, ItemId, Value};

/// Corrects the signs in the conditions of a device. The references of the device must be resolved.
pub(super) fn run(device: &mut Device) {
    // The values of a condition with a mask have no sign.
    let can_be_negative = |condition: &Condition| {
        condition.mask.is_none() && condition.values.iter().any(|value| value.as_int() > Some(0))
    };
    let mut signed: HashMap<ItemId, Option<u32>> = HashMap::default();
    for_each(device, &mut |condition| {
        signed.extend(condition.item.id.filter(|_| can_be_negative(condition)).map(|id| (id, None)))
    });
    for (id, bits) in &mut signed {
        let ty = device.item(*id).map(|item| Owner::of_types(&device.types).basic(item.ty));
        *bits = ty.filter(|ty| ty.is_signed()).and_then(|ty| ty.bits()).filter(|bits| (1..=64).contains(bits));
    }
    for_each(device, &mut |condition| {
        let bits = condition.item.id.and_then(|id| signed.get(&id).copied().flatten());
        if let Some(bits) = bits.filter(|_| condition.mask.is_none()) {
            condition.values.iter_mut().for_each(|value| as_signed(value, bits));
        }
    });
}

fn as_signed(value: &mut Value, bits: u32) {
    if let Value::Int(number) = value {
        *number -= i128::from(*number >> (bits - 1) == 1) << bits;
    }
}

fn for_each(device: &mut Device, visit: &mut dyn FnMut(&mut Condition)) {
    let items = device.groups.iter_mut().flat_map(|group| &mut group.items);
    let behaviors = items.filter_map(|item| item.behavior.as_deref_mut());
    behaviors.flat_map(|behavior| &mut behavior.write_when).for_each(&mut *visit);
    for_each_condition(&mut device.types, visit);
}
