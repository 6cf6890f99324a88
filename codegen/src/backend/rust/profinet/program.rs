//! The modules and submodules that the program in a new drive crate plugs into a device access point.

use std::collections::BTreeMap;

use super::image;
use super::scope::{AccessPoint, Scope};
use crate::backend::rust::RustOptions;
use crate::ir::{Catalog, Direction, IoData, ModuleUse, Numbers, Submodule, SubmoduleId, SubmoduleUse};

/// The generated elements with which a program exchanges data with a PROFINET device.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProfinetProgram {
    /// Number of places in the slot plan: one for each submodule, and one for each module without submodules.
    pub places: usize,
    /// Slot and name of the module that the program plugs. `None` if the program exchanges data with the device access
    /// point or with a fixed or default module, or exchanges no data.
    pub plugged: Option<(u16, String)>,
    /// Whether the program also plugs the submodule whose data it exchanges.
    pub plugs_submodule: bool,
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
    let mut plan = Plan { scope: &scope, point, slots: BTreeMap::new() };
    plan.add_defaults();
    let found = plan.data().map(|data| Exchange { plugged: None, plugs_submodule: false, data });
    let found = found.or_else(|| plan.plug_any_submodule()).or_else(|| plan.plug());
    let places = plan.slots.values().map(|slot| slot.submodules.len().max(1)).sum();
    Some(match found {
        Some(Exchange { plugged, plugs_submodule, data }) => {
            ProfinetProgram { places, plugged, plugs_submodule, data: Some(data) }
        }
        None => ProfinetProgram { places, plugged: None, plugs_submodule: false, data: None },
    })
}

/// Cyclic data, and the elements that the program plugs for them.
struct Exchange {
    plugged: Option<(u16, String)>,
    plugs_submodule: bool,
    data: ProfinetData,
}

/// The submodules of a module, by subslot.
type Subslots = BTreeMap<u16, SubmoduleId>;

/// A slot with a module.
struct Slot<'s> {
    submodules: Subslots,
    /// Submodules that the module supports.
    uses: &'s [SubmoduleUse],
    /// Subslots of the module. `None` for the device access point. If the list is empty, the module has the subslots of
    /// its submodules.
    subslots: Option<&'s Numbers>,
}

impl<'s> Slot<'s> {
    /// Returns the first free subslot for a submodule of the module.
    fn free(&self, usage: &SubmoduleUse) -> Option<u16> {
        let places = &usage.places;
        let stated = || self.subslots.filter(|subslots| !subslots.is_empty());
        let listed = places.used.iter().chain(places.allowed.iter());
        let mut possible = listed.chain(stated().into_iter().flat_map(Numbers::iter));
        possible.find(|subslot| {
            let exists = stated().is_none_or(|subslots| subslots.contains(*subslot));
            exists && places.accept(*subslot) && !self.submodules.contains_key(subslot)
        })
    }
}

struct Plan<'s> {
    scope: &'s Scope<'s>,
    point: &'s AccessPoint<'s>,
    slots: BTreeMap<u16, Slot<'s>>,
}

impl<'s> Plan<'s> {
    /// Plugs the fixed and default modules and submodules of the device access point.
    fn add_defaults(&mut self) {
        let device = self.point.device;
        let slot = Slot { submodules: submodules(&device.submodules, true), uses: &device.submodules, subslots: None };
        self.slots.insert(super::descriptor::slot(self.point), slot);
        let fixed = device.modules.iter().flat_map(|usage| usage.places.fixed.iter().map(move |slot| (slot, usage)));
        let used = device.modules.iter().flat_map(|usage| usage.places.used.iter().map(move |slot| (slot, usage)));
        for (slot, usage) in fixed.chain(used) {
            let Some((module, _)) = self.module(usage, true) else { continue };
            self.slots.entry(slot).or_insert(module);
        }
    }

    /// Returns a module and its name. The module has its fixed submodules and, if `with_defaults` is set, its default
    /// submodules.
    fn module(&self, usage: &ModuleUse, with_defaults: bool) -> Option<(Slot<'s>, &'s str)> {
        let (module, name) = self.scope.modules.get(&usage.module.0)?;
        let plugged = submodules(&module.submodules, with_defaults);
        let slot = Slot { submodules: plugged, uses: &module.submodules, subslots: Some(&module.subslots) };
        Some((slot, name))
    }

    /// Plugs the first module with cyclic data into a free slot that accepts it. If no fixed submodule of the module
    /// has cyclic data, also plugs a submodule that has cyclic data. Modules are skipped if the device cannot exchange
    /// so much data.
    fn plug(&mut self) -> Option<Exchange> {
        let AccessPoint { device, settings, .. } = self.point;
        for usage in &device.modules {
            let Some((module, name)) = self.module(usage, false) else { continue };
            let is_free = |slot: &u16| usage.places.accept(*slot) && !self.slots.contains_key(slot);
            let Some(slot) = settings.slots.iter().find(is_free) else { continue };
            let data = module.submodules.iter().find_map(|(subslot, id)| self.data_of(slot, *subslot, *id));
            self.slots.insert(slot, module);
            let fixed = data.filter(|_| self.has_room()).map(|data| (false, data));
            if let Some((plugs_submodule, data)) = fixed.or_else(|| Some((true, self.plug_submodule(slot)?))) {
                return Some(Exchange { plugged: Some((slot, name.to_owned())), plugs_submodule, data });
            }
            self.slots.remove(&slot);
        }
        None
    }

    /// Plugs the first submodule with cyclic data into a free subslot of a plugged module.
    fn plug_any_submodule(&mut self) -> Option<Exchange> {
        let slots: Vec<u16> = self.slots.keys().copied().collect();
        let data = slots.into_iter().find_map(|slot| self.plug_submodule(slot))?;
        Some(Exchange { plugged: None, plugs_submodule: true, data })
    }

    /// Plugs the first submodule with cyclic data into a free subslot of the module in `slot`. Submodules are skipped
    /// if the device cannot exchange so much data.
    fn plug_submodule(&mut self, slot: u16) -> Option<ProfinetData> {
        let uses = self.slots.get(&slot)?.uses;
        uses.iter().find_map(|usage| {
            let subslot = self.slots.get(&slot)?.free(usage)?;
            let data = self.data_of(slot, subslot, usage.submodule)?;
            self.slots.get_mut(&slot)?.submodules.insert(subslot, usage.submodule);
            if self.has_room() {
                return Some(data);
            }
            self.slots.get_mut(&slot)?.submodules.remove(&subslot);
            None
        })
    }

    /// Returns whether the device can exchange the data of all plugged submodules.
    fn has_room(&self) -> bool {
        let ids = self.slots.values().flat_map(|slot| slot.submodules.values());
        let all = ids.filter_map(|id| Some(self.scope.submodules.get(&id.0)?.0)).map(lengths);
        let (inputs, outputs) =
            all.fold((0, 0), |(inputs, outputs), (input, output)| (inputs + input, outputs + output));
        let max = &self.point.settings.max_lengths;
        let fits = |length: u64, max: Option<u16>| max.is_none_or(|max| length <= u64::from(max));
        fits(inputs, max.input) && fits(outputs, max.output) && fits(inputs + outputs, max.data)
    }

    /// Returns the first submodule with both inputs and outputs or, if there is none, the first submodule with cyclic
    /// data.
    fn data(&self) -> Option<ProfinetData> {
        let all = || {
            self.slots.iter().flat_map(|(slot, place)| place.submodules.iter().map(move |(at, id)| (*slot, *at, *id)))
        };
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

/// Returns the lengths of a submodule in the input frame and in the output frame, in bytes. The data of each direction
/// have a provider status in the same frame, and a consumer status in the frame of the opposite direction. A submodule
/// without data has inputs of length 0.
fn lengths(submodule: &Submodule) -> (u64, u64) {
    let (provider, consumer) = submodule.status_lengths;
    let (provider, consumer) = (u64::from(provider), u64::from(consumer));
    let bytes = |data: &IoData| u64::from(data.image.length) + u64::from(data.image.overhead);
    let output = submodule.output.as_deref().map(bytes);
    let input = submodule.input.as_deref().map(bytes).or_else(|| output.is_none().then_some(0));
    let inputs = input.map_or(0, |length| length + provider) + output.map_or(0, |_| consumer);
    let outputs = output.map_or(0, |length| length + provider) + input.map_or(0, |_| consumer);
    (inputs, outputs)
}

/// Returns the fixed submodules and, if `with_defaults` is set, the default submodules, by subslot.
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
