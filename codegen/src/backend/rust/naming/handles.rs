//! The names of handles: those of objects, of their entries, and of registers.

use crate::backend::rust::item_addresses::ItemAddresses;
use crate::backend::rust::located::Located;
use crate::backend::rust::method_names::{BESIDE_MESSAGES, RESERVED};
use crate::backend::rust::reachable::{addressable, is_module};
use crate::ir::{Group, Item};
use crate::names::{self, Case, Wish};

/// Constants of an object have nothing to clash with; its methods would be taken for a constructor, or couldn't be called because
/// every type has one of that name.
const RESERVED_IN_OBJECT: [&str; 7] = ["self", "super", "crate", "rt", "new", "into", "try_into"];

/// The names of handles in Rust, as yet without an escape.
#[derive(Default)]
pub(in crate::backend::rust) struct HandleNames {
    /// Those of `Scope::registers`.
    pub registers: Vec<String>,
    /// Those of the objects that have values, and those of the values of each that is a module.
    pub objects: Vec<(String, Vec<String>)>,
}

impl HandleNames {
    /// Whether there is no handle.
    pub(in crate::backend::rust) fn is_empty(&self) -> bool {
        self.registers.is_empty() && self.objects.is_empty()
    }
}

/// The names of the registers and of the objects.
pub(super) fn names(scope: &Located<'_>) -> HandleNames {
    let groups: Vec<&Group> = addressable(scope).collect();
    let register = |(_, item): &(&'_ str, &Item)| ItemAddresses::of(scope, item).suffix();
    let suffixes: Vec<String> = scope.registers.iter().map(register).collect();
    let registers = scope.registers.iter().zip(suffixes);
    let registers = registers.map(|((_, item), suffix)| Wish::new(&item.name, "register", suffix));
    let objects = groups.iter().copied();
    let objects = objects.map(|own| Wish::new(&own.name, "object", format!("{:04X}", own.index().unwrap_or(0))));
    let wishes: Vec<Wish<'_>> = registers.chain(objects).collect();
    let has_messages = scope.device.is_some_and(|device| !device.messages.is_empty());
    let beside = BESIDE_MESSAGES.into_iter().filter(|_| has_messages);
    let reserved: Vec<&str> = RESERVED.into_iter().chain(beside).collect();
    let mut names = names::unique(&wishes, &reserved, Case::Snake).into_iter();
    let registers = names.by_ref().take(scope.registers.len()).collect();
    let subs = |group: &Group| if is_module(group) { sub_names(group) } else { Vec::new() };
    HandleNames { registers, objects: names.zip(groups).map(|(name, group)| (name, subs(group))).collect() }
}

/// Whether a constant is called otherwise than a module or a method.
pub(in crate::backend::rust) fn is_cased(name: &str) -> bool {
    name.to_ascii_uppercase() != name
}

fn sub_names(group: &Group) -> Vec<String> {
    let wishes: Vec<Wish<'_>> =
        group.items.iter().map(|item| Wish::new(&item.name, "sub", item.object().map_or(0, |(_, sub)| sub))).collect();
    names::unique(&wishes, &RESERVED_IN_OBJECT, Case::Snake)
}
