//! Reads the object that a line describes: index, name, type and access rights.

use crate::ir::{Access, Binding, Group, Item, ObjectBuses, ObjectCode, Type};
use crate::source::Origin;

pub(super) fn object(words: &[&str], origin: Origin) -> Option<Group> {
    let [index, name, ty, access] = words else { return None };
    let index = u16::from_str_radix(index.strip_prefix("0x")?, 16).ok()?;
    let mut item = Item::new(Binding::Object { buses: ObjectBuses::CANOPEN, index, sub_index: 0 });
    item.name = (*name).into();
    item.ty = Type::Unsigned(ty.strip_prefix('u')?.parse().ok()?);
    item.access = match *access {
        "ro" => Access::ReadOnly,
        "rw" => Access::ReadWrite,
        _ => return None,
    };
    item.origin = origin;
    let mut group = Group::object(index, ObjectCode::Var);
    (group.name, group.origin) = (item.name.clone(), origin);
    group.items.push(item);
    Some(group)
}
