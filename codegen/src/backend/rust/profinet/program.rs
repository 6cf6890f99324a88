//! The modules and submodules that a program plugs into a device access point. New drive crates use them.

use std::collections::BTreeMap;

use super::image;
use super::scope::{AccessPoint, Scope};
use super::RustOptions;
use crate::ir::{Catalog, Direction, Module, ModuleId, Submodule, SubmoduleId, SubmoduleUse};

/// The generated elements with which a program exchanges data with a PROFINET device.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProfinetProgram {
    /// Number of submodules and of modules without submodules that the slot plan must hold.
    pub places: usize,
    /// Module that the program plugs, and its slot. `None` if the default modules have cyclic data, or no module has.
    pub plugged: Option<(u16, String)>,
    /// Submodule whose cyclic data the program exchanges.
    pub data: Option<ProfinetData>,
}

/// The cyclic data of a submodule.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProfinetData {
    /// Slot of the module.
    pub slot: u16,
    /// Subslot of the submodule.
    pub subslot: u16,
    /// Name of the submodule's Rust module in `submodules`.
    pub submodule: String,
    /// Whether the submodule has the struct `Inputs`.
    pub has_inputs: bool,
    /// Whether the submodule has the struct `Outputs`.
    pub has_outputs: bool,
}

/// Returns the elements for a program that controls the only device access point of `catalog`. Returns `None` if the catalog has
/// no device access point, or several.
pub fn profinet_program(catalog: &Catalog) -> Option<ProfinetProgram> {
    let options = RustOptions::default();
    let scope = Scope::new(catalog, &options);
    let [point] = scope.access_points.as_slice() else { return None };
    let mut plan = Plan { scope: &scope, slots: BTreeMap::new() };
    plan.add_defaults(point);
    let mut plugged = None;
    let mut data = plan.data();
    if data.is_none() {
        (plugged, data) = plan.plug(point).map_or((None, None), |(place, data)| (Some(place), Some(data)));
    }
    let places = plan.slots.values().map(|subslots| subslots.len().max(1)).sum();
    Some(ProfinetProgram { places, plugged, data })
}

/// The submodules in each slot, by subslot.
type Subslots = BTreeMap<u16, SubmoduleId>;

struct Plan<'s> {
    scope: &'s Scope<'s>,
    slots: BTreeMap<u16, Subslots>,
}

impl Plan<'_> {
    /// Plugs the fixed and default modules and submodules of a device access point.
    fn add_defaults(&mut self, point: &AccessPoint<'_>) {
        let own = super::descriptor::slot(point);
        self.slots.insert(own, submodules(&point.device.submodules, true));
        let uses = || point.device.modules.iter();
        let fixed = uses().flat_map(|usage| usage.places.fixed.iter().map(move |slot| (slot, usage.module)));
        let used = uses().flat_map(|usage| usage.places.used.iter().map(move |slot| (slot, usage.module)));
        for (slot, module) in fixed.chain(used) {
            let Some(module) = self.module(module) else { continue };
            let plugged = submodules(&module.submodules, true);
            self.slots.entry(slot).or_insert(plugged);
        }
    }

    fn module(&self, id: ModuleId) -> Option<&Module> {
        Some(self.scope.modules.get(&id.0)?.0)
    }

    /// Plugs the first module with cyclic data in a fixed submodule into a free slot.
    fn plug(&mut self, point: &AccessPoint<'_>) -> Option<((u16, String), ProfinetData)> {
        let physical = &point.settings.slots;
        for usage in &point.device.modules {
            let Some((module, name)) = self.scope.modules.get(&usage.module.0) else { continue };
            let plugged = submodules(&module.submodules, false);
            let is_free = |slot: &u16| {
                let is_allowed = usage.places.allowed.is_empty() || usage.places.allowed.contains(*slot);
                is_allowed && !self.slots.contains_key(slot)
            };
            let Some(slot) = physical.iter().find(is_free) else { continue };
            if let Some(data) = plugged.iter().find_map(|(subslot, id)| self.data_of(slot, *subslot, *id)) {
                let name = name.clone();
                self.slots.insert(slot, plugged);
                return Some(((slot, name), data));
            }
        }
        None
    }

    /// Returns the first submodule with cyclic data, preferably one with both inputs and outputs.
    fn data(&self) -> Option<ProfinetData> {
        let all =
            || self.slots.iter().flat_map(|(slot, subslots)| subslots.iter().map(move |(at, id)| (*slot, *at, *id)));
        let mut found = all().filter_map(|(slot, subslot, id)| self.data_of(slot, subslot, id));
        let first = found.next()?;
        let is_both = |data: &ProfinetData| data.has_inputs && data.has_outputs;
        Some(if is_both(&first) { first } else { found.find(is_both).unwrap_or(first) })
    }

    fn data_of(&self, slot: u16, subslot: u16, id: SubmoduleId) -> Option<ProfinetData> {
        let (submodule, name) = self.scope.submodules.get(&id.0)?;
        let has = |direction| self.has_struct(submodule, direction);
        let (has_inputs, has_outputs) = (has(Direction::Transmit), has(Direction::Receive));
        let data = ProfinetData { slot, subslot, submodule: name.clone(), has_inputs, has_outputs };
        (has_inputs || has_outputs).then_some(data)
    }

    fn has_struct(&self, submodule: &Submodule, direction: Direction) -> bool {
        image::model(submodule, direction, &self.scope.values, self.scope.options).is_some()
    }
}

/// Returns the fixed submodules, and on request also the default submodules, by subslot.
fn submodules(uses: &[SubmoduleUse], with_defaults: bool) -> Subslots {
    let mut plugged = Subslots::new();
    for usage in uses {
        plugged.extend(usage.places.fixed.iter().map(|subslot| (subslot, usage.submodule)));
    }
    for usage in uses.iter().filter(|_| with_defaults) {
        for subslot in usage.places.used.iter() {
            plugged.entry(subslot).or_insert(usage.submodule);
        }
    }
    plugged
}
