//! Locations of handles: the location types, and the functions that create the locations of several items.

use std::collections::{BTreeMap, BTreeSet};

use super::code::{list, Doc};
use super::context::Context;
use super::item_addresses::{Buses, ItemAddresses};
use super::reachable::addressable;

/// Rust path from the module of the handles to the module of the windows.
const WINDOWS: &str = "super::windows::";

/// Returns the name of a generated function that creates locations. `at` is the position of the function in the list of
/// these functions.
fn maker(at: usize) -> String {
    format!("location_{}", at + 1)
}

/// The location types of a device's or module's handles, and the functions that create the locations.
pub(super) struct Locations {
    /// The default location type. The type of a handle names its location type only if it is not the default.
    pub usual: Buses,
    /// True if the location type of some items differs from the default.
    pub several: bool,
    /// The location types of all items, and the default location type, without repetitions.
    each: BTreeSet<Buses>,
    /// Functions that create the locations of several items.
    shared: Vec<Shared>,
}

/// A function that creates the locations of several items.
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
            several: each.keys().any(|buses| *buses != usual),
            usual,
            each: each.into_keys().chain([usual]).collect(),
            shared: shared(context, &items_addresses),
        }
    }

    /// Returns the functions that create locations: name, parameters, return type and body.
    pub fn makers(&self) -> Vec<(String, Vec<String>, String, Doc)> {
        let model = |(at, function): (usize, &Shared)| {
            (maker(at), function.parameters.clone(), self.name(function.buses, ""), function.body.clone())
        };
        self.shared.iter().enumerate().map(model).collect()
    }

    /// Returns the code of an item's location.
    pub fn code(&self, context: &Context<'_>, addresses: &ItemAddresses<'_>) -> Doc {
        let found = addresses.maker(context, WINDOWS).and_then(|maker_call| {
            let is_same =
                |shared: &Shared| shared.body == maker_call.body && shared.parameters == maker_call.parameters;
            let at = self.shared.iter().position(is_same)?;
            Some(list(&format!("{}(", maker(at)), maker_call.arguments, ")"))
        });
        found.unwrap_or_else(|| addresses.code(context, &self.name(addresses.buses(), ""), WINDOWS))
    }

    /// Returns the name of a location type. `outer` is the path to the module of the handles.
    pub fn name(&self, buses: Buses, outer: &str) -> String {
        match buses.path() {
            Some(path) => path.to_owned(),
            None => format!("{outer}{}", buses.word()),
        }
    }

    /// Returns the location types that are not part of the runtime: name, documentation and fields.
    pub fn generated_types(&self) -> Vec<(String, String, Vec<Doc>)> {
        let unnamed = self.each.iter().filter(|buses| buses.path().is_none());
        let docs = |buses: &Buses| format!("Location of an item on {}.", buses.titles());
        unnamed.map(|buses| (buses.word(), docs(buses), buses.fields())).collect()
    }

    /// Returns the type argument for the location. `outer` is the path to the module of the handles. Returns `None` if
    /// the location has the default type.
    pub fn argument(&self, buses: Buses, outer: &str) -> Option<String> {
        (buses != self.usual).then(|| self.name(buses, outer))
    }
}

/// Returns the default location type. The default is the union of all location types if all of them are direct.
/// Otherwise, the default is the most frequent location type.
fn usual(each: &BTreeMap<Buses, usize>) -> Buses {
    match each.keys().all(|buses| buses.is_direct()) {
        true => each.keys().fold(Buses::default(), |all, buses| all.union(*buses)),
        false => each.iter().max_by_key(|(_, count)| **count).map_or(Buses::default(), |(buses, _)| *buses),
    }
}

/// Returns the location functions that at least two items use.
fn shared(context: &Context<'_>, items_addresses: &[ItemAddresses<'_>]) -> Vec<Shared> {
    let mut makers: BTreeMap<(Doc, Vec<String>), (usize, Buses)> = BTreeMap::new();
    for addresses in items_addresses {
        if let Some(maker) = addresses.maker(context, WINDOWS) {
            makers.entry((maker.body, maker.parameters)).or_insert((0, addresses.buses())).0 += 1;
        }
    }
    let makers = makers.into_iter().filter(|(_, (count, _))| *count > 1);
    makers.map(|((body, parameters), (_, buses))| Shared { body, parameters, buses }).collect()
}
