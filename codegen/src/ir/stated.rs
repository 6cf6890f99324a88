//! Facts that a description and its overlays state. Lints judge only these facts, and not the facts that profiles add.

use super::owner::Owner;
#[cfg(feature = "table")]
use super::Documentation;
use super::{
    Behavior, CodeTable, Device, EnumValue, Fact, FactOrigin, FactOrigins, Item, Quantity, Type, TypeDef, TypeId,
};

/// Returns whether a fact with this recorded origin was added by a profile.
pub(crate) fn is_of_profile(origin: Option<&FactOrigin>) -> bool {
    matches!(origin, Some(FactOrigin::Standard(_)))
}

/// Returns the fact unless a profile added it.
fn stated<T>(origins: &FactOrigins, fact: Fact, value: Option<T>) -> Option<T> {
    value.filter(|_| !is_of_profile(origins.get(fact)))
}

/// Returns the type definitions that profiles did not add, with their ids.
pub(crate) fn types(types: &[TypeDef]) -> impl Iterator<Item = (TypeId, &TypeDef)> {
    let all = (0..).map(TypeId).zip(types);
    all.filter(|(_, definition)| !is_of_profile(definition.stated_by.as_deref()))
}

/// Returns the type of an item, or the basic type if a profile names the bits or values of the item.
pub(crate) fn ty(owner: Owner<'_>, item: &Item) -> Type {
    match is_of_profile(item.origins.get(Fact::Meaning)) {
        true => owner.basic(item.ty),
        false => item.ty,
    }
}

/// Returns the definition of the type of an item, after following aliases.
pub(crate) fn definition<'a>(owner: Owner<'a>, item: &Item) -> Option<&'a TypeDef> {
    owner.definition(ty(owner, item))
}

/// Returns the values of the enumeration of an item, and whether the list is complete.
pub(crate) fn enumeration<'a>(owner: Owner<'a>, item: &Item) -> Option<(&'a [EnumValue], bool)> {
    owner.enumeration(ty(owner, item))
}

/// Returns the unit and scale factor of an item, unless a profile added them.
pub(crate) fn quantity(item: &Item) -> Option<&Quantity> {
    stated(&item.origins, Fact::Unit, item.quantity.as_deref())
}

/// Returns the storage of an item, the side effects of writing it, and the conditions for reading and writing it, unless a profile
/// added these facts.
pub(crate) fn behavior(item: &Item) -> Option<&Behavior> {
    stated(&item.origins, Fact::Behavior, item.behavior.as_deref())
}

/// Returns `documentation`, the description of an item or group, unless a profile added it. `origins` are the origins of the
/// facts of this item or group.
#[cfg(feature = "table")]
pub(crate) fn description<'d>(
    origins: &FactOrigins,
    documentation: Option<&'d Documentation>,
) -> Option<&'d Documentation> {
    stated(origins, Fact::Description, documentation)
}

/// Returns the code tables of a device, except those that profiles added.
pub(crate) fn code_tables(device: &Device) -> impl Iterator<Item = &CodeTable> {
    device.code_tables.iter().filter(|table| !is_of_profile(table.stated_by.as_deref()))
}
