//! Constants of items to which generated methods refer.

use std::collections::BTreeMap;

use super::code::{generic, seq, Doc};
use super::context::Context;
use super::item::ItemModel;
use super::item_addresses::ItemAddresses;
use super::links::DocModule;
use super::locations::Locations;
use super::objects::ObjectModel;
use super::value_type;
use crate::ir::ItemId;

/// Objects that contain the error code of a fault, in order of preference. These are the error code of CiA 402, 6.2, and the
/// first entry of the pre-defined error field of CiA 301, 7.5.2.4.
const ERROR_CODES: [(u16, u8); 2] = [(0x603F, 0), (0x1003, 1)];

/// Finds the constants of items.
pub(super) struct Constants<'c, 'a> {
    pub context: &'c Context<'a>,
    pub locations: &'c Locations,
    pub objects: &'c [ObjectModel],
}

/// The constant of an item that is an integer of 8, 16 or 32 bits.
pub(super) struct Constant<'c> {
    model: &'c ItemModel,
    pub path: String,
    /// Path of the location type.
    pub location: String,
    /// True if the item has a unit or a scale.
    pub is_quantity: bool,
}

impl Constants<'_, '_> {
    /// Returns a link to the constant of an item.
    pub fn link(&self, constant: &Constant<'_>) -> String {
        let id = constant.model.id;
        let name = self.context.item(id).map_or("", |item| item.name.as_str());
        self.context.link_to(id.into(), name, DocModule::TOP).unwrap_or_default()
    }

    /// Returns the constant of an object, if the object is an integer of 8, 16 or 32 bits.
    pub fn object(&self, object: (u16, u8)) -> Option<Constant<'_>> {
        self.integer(&|model| model.object == Some(object))
    }

    /// Returns the constant of the object that contains the error code of a fault.
    pub fn error_code(&self) -> Option<Constant<'_>> {
        ERROR_CODES.iter().find_map(|object| self.object(*object).filter(Constant::is_readable))
    }

    /// Returns the constant of the first item for which `is_it` returns true, if this item is an integer of 8, 16 or 32
    /// bits.
    pub fn integer(&self, is_it: &dyn Fn(&ItemModel) -> bool) -> Option<Constant<'_>> {
        let all = self.objects.iter().flat_map(|object| object.items.iter().map(move |item| (object, item)));
        let (object, model) = all.into_iter().find(|(_, item)| is_it(item))?;
        let item = self.context.item(model.id)?;
        let path = object.path(model);
        let location = self.locations.name(ItemAddresses::of(self.context, item).buses(), "objects::");
        value_type::is_word(self.context.base(item.ty)).then_some(Constant {
            model,
            path,
            location,
            is_quantity: item.quantity.is_some(),
        })
    }
}

impl Constant<'_> {
    pub fn id(&self) -> ItemId {
        self.model.id
    }

    pub fn is_readable(&self) -> bool {
        self.model.access != "WriteOnly"
    }

    pub fn is_writable(&self) -> bool {
        matches!(self.model.access, "ReadWrite" | "WriteOnly")
    }
}

/// Returns, for each location type, whether any of its items is read and whether any is written.
pub(super) fn accesses<'l>(
    items: impl IntoIterator<Item = (&'l str, (bool, bool))>,
) -> BTreeMap<&'l str, (bool, bool)> {
    let mut all: BTreeMap<&str, (bool, bool)> = BTreeMap::new();
    for (location, (reads, writes)) in items {
        let access = all.entry(location).or_default();
        *access = (access.0 | reads, access.1 | writes);
    }
    all
}

/// Returns the trait bound that a location type needs so that a client of `bus` can access its items: read them, write
/// them, or both.
pub(super) fn bound(location: &str, bus: &str, access: (bool, bool)) -> Doc {
    let route = match access {
        (true, true) => format!("Route: rt::ReadRoute<{bus}> + rt::WriteRoute<{bus}>"),
        (true, false) => format!("Route: rt::ReadRoute<{bus}>"),
        (false, _) => format!("Route: rt::WriteRoute<{bus}>"),
    };
    seq![location, ": ", generic!("rt::On", bus, route), ","]
}
