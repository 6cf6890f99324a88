//! The locations of handles: their types, and the functions that make those which several items have.

use std::collections::{BTreeMap, BTreeSet};

use super::code::{list, Doc};
use super::context::Context;
use super::item_addresses::{Buses, ItemAddresses};
use super::reachable::addressable;

/// Where the windows are, as seen from the handles.
const WINDOWS: &str = "super::windows::";

/// The name of the function that makes a location.
fn maker(at: usize) -> String {
    format!("place_{}", at + 1)
}

/// The locations of a device's handles, or of a module's.
pub(super) struct Locations {
    /// The usual one, whose handles need no type of it.
    pub usual: Buses,
    /// Whether not every item has that one.
    pub several: bool,
    /// Those of each item, each once.
    each: BTreeSet<Buses>,
    /// What makes the locations that several items have.
    shared: Vec<Shared>,
}

/// What makes locations of several items.
struct Shared {
    body: Doc,
    parameters: Vec<String>,
    buses: Buses,
}

impl Locations {
    pub fn of(context: &Context<'_>) -> Self {
        let objects = addressable(context).flat_map(|(_, group)| &group.items);
        let items = objects.chain(context.registers.iter().map(|register| register.item));
        let items_addresses: Vec<ItemAddresses<'_>> = items.map(|item| ItemAddresses::of(context, item)).collect();
        let mut each: BTreeMap<Buses, usize> = BTreeMap::new();
        for addresses in &items_addresses {
            *each.entry(addresses.buses()).or_default() += 1;
        }
        let usual = usual(&each);
        Locations {
            several: each.keys().any(|own| *own != usual),
            usual,
            each: each.into_keys().chain([usual]).collect(),
            shared: shared(context, &items_addresses),
        }
    }

    /// The functions that make locations: name, parameters, type and body.
    pub fn makers(&self) -> Vec<(String, Vec<String>, String, Doc)> {
        let model = |(at, own): (usize, &Shared)| {
            (maker(at), own.parameters.clone(), self.name(own.buses, ""), own.body.clone())
        };
        self.shared.iter().enumerate().map(model).collect()
    }

    /// The code of an item's location; `outer` leads from the handle's place to the device's.
    pub fn code(&self, context: &Context<'_>, addresses: &ItemAddresses<'_>, outer: &str) -> Doc {
        let found = addresses.maker(context, WINDOWS).and_then(|own| {
            let is_own = |shared: &Shared| shared.body == own.body && shared.parameters == own.parameters;
            let at = self.shared.iter().position(is_own)?;
            Some(list(&format!("{}{}(", beside_handles(outer), maker(at)), own.arguments, ")"))
        });
        let path = self.name(addresses.buses(), beside_handles(outer));
        found.unwrap_or_else(|| addresses.code(context, &path, &format!("{outer}windows::")))
    }

    /// The name of a location's type; `outer` leads from where it stands to the device's place.
    pub fn name(&self, buses: Buses, outer: &str) -> String {
        match buses.path() {
            Some(path) => path.to_owned(),
            None => format!("{outer}{}", buses.word()),
        }
    }

    /// The locations that the runtime has no name for: name, documentation and fields.
    pub fn own(&self) -> Vec<(String, String, Vec<Doc>)> {
        let unnamed = self.each.iter().filter(|own| own.path().is_none());
        let docs = |own: &Buses| format!("The location of what is found on {}.", own.titles());
        unnamed.map(|own| (own.word(), docs(own), own.fields())).collect()
    }

    /// What follows the type of a value where handles of several locations exist.
    pub fn argument(&self, buses: Buses, outer: &str) -> Option<String> {
        if buses == self.usual {
            return None;
        }
        let outer = if outer.is_empty() { "objects::" } else { beside_handles(outer) };
        Some(self.name(buses, outer))
    }
}

/// The way to where the handles stand, and the locations beside them, of one that leads to the device's place.
fn beside_handles(outer: &str) -> &str {
    outer.strip_prefix("super::").unwrap_or(outer)
}

/// What most items have, unless all are addresses, and some have all of them.
fn usual(each: &BTreeMap<Buses, usize>) -> Buses {
    match each.keys().all(|own| own.is_direct()) {
        true => each.keys().fold(Buses::default(), |all, own| all.union(*own)),
        false => each.iter().max_by_key(|(_, count)| **count).map_or(Buses::default(), |(own, _)| *own),
    }
}

/// What makes more than one of these places.
fn shared(context: &Context<'_>, items_addresses: &[ItemAddresses<'_>]) -> Vec<Shared> {
    let mut makers: BTreeMap<(Doc, Vec<String>), (usize, Buses)> = BTreeMap::new();
    for addresses in items_addresses {
        if let Some(own) = addresses.maker(context, WINDOWS) {
            makers.entry((own.body, own.parameters)).or_insert((0, addresses.buses())).0 += 1;
        }
    }
    let makers = makers.into_iter().filter(|(_, (count, _))| *count > 1);
    makers.map(|((body, parameters), (_, buses))| Shared { body, parameters, buses }).collect()
}
