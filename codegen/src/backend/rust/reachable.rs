//! Objects that a client can access.

use super::scope::Scope;
use crate::ir::{Group, ObjectCode};

/// Returns the objects that have values, each with its group number in item IDs. Type definitions have no values.
pub(super) fn addressable<'a>(scope: &Scope<'a>) -> impl Iterator<Item = (u32, &'a Group)> + use<'a> {
    scope.positioned_groups().filter(|(_, group)| {
        let is_type =
            matches!(group.object_code(), Some(ObjectCode::DefType | ObjectCode::DefStruct | ObjectCode::Null));
        group.index().is_some() && !is_type && !group.items.is_empty()
    })
}
