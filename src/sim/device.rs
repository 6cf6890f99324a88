//! A device in memory.

use core::fmt;
use std::boxed::Box;
use std::collections::VecDeque;
use std::vec::Vec;

use super::cells::Cells;
use super::fault::Fault;
use super::item_address::ItemAddress;
use super::limits::Limits;
use super::slots::Slots;
use super::values;
use crate::abort::AbortCode;
use crate::axes::Axes;
use crate::bus::Object;
use crate::emergency::Emergency;
use crate::item::Item;
use crate::location::Location;
use crate::node_id::NodeId;
use crate::table::{AccessRights, Entry};
use crate::value::Fixed;

/// The node-ID of a device that was given none.
const FIRST_NODE: NodeId = match NodeId::new(1) {
    Some(node) => node,
    None => unreachable!(),
};

/// What reacts to a write.
type Reaction = Box<dyn FnMut(&mut Device, usize, &Entry) -> Result<(), AbortCode> + Send>;

/// The items after whose write it is called: one, or all.
struct Hook {
    slots: Option<Vec<usize>>,
    reaction: Reaction,
}

/// The dictionary that an object is accessed through.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Network {
    CanOpen,
    EtherCat,
}

/// A device in memory, made from the table of its bindings.
///
/// Clients read and write it with [`client`](Self::client), under the rules of its description. The test, as the device
/// itself, may [`get`](Self::get) and [`set`](Self::set) everything, and [reacts](Self::on_write) to what is written.
///
/// Methods of the device's side fail with an [`AbortCode`]: [`NO_OBJECT`](AbortCode::NO_OBJECT) or
/// [`NO_SUB_INDEX`](AbortCode::NO_SUB_INDEX) where the device has no such item, so that a reaction can hand it on with `?`.
pub struct Device {
    pub(super) slots: Slots,
    pub(super) cells: Cells,
    pub(super) emergencies: VecDeque<Emergency>,
    pub(super) limits: Limits,
    axes: Option<&'static Axes>,
    node: NodeId,
    hooks: Vec<Hook>,
    faults: VecDeque<Fault>,
}

impl Device {
    /// A device after power-on. `entries` is the static table of its bindings (`ENTRIES`); its node-ID is 1.
    ///
    /// Where the description gives no value after power-on, it is empty, 0, or what is nearest to it within the limits.
    #[must_use]
    pub fn new(entries: &[Entry]) -> Self {
        let mut device = Self {
            slots: Slots::new(entries),
            cells: Cells::default(),
            emergencies: VecDeque::new(),
            limits: Limits::REGISTERS,
            axes: None,
            node: FIRST_NODE,
            hooks: Vec::new(),
            faults: VecDeque::new(),
        };
        device.power_cycle();
        device
    }

    /// The same device with another node-ID, after power-on.
    #[must_use]
    pub fn with_node_id(mut self, node: NodeId) -> Self {
        self.node = node;
        self.power_cycle();
        self
    }

    /// The same device with all of its axes (`AXES` of its bindings), after power-on.
    #[must_use]
    pub fn with_axes(mut self, axes: &'static Axes) -> Self {
        self.slots.add_axes(axes);
        self.axes = Some(axes);
        self.power_cycle();
        self
    }

    /// Its node-ID.
    #[must_use]
    pub const fn node_id(&self) -> NodeId {
        self.node
    }

    /// Switches the device off and on: all values are those of power-on, or those that were stored (0x1010).
    pub fn power_cycle(&mut self) {
        self.reset(|_| true);
        self.emergencies.clear();
    }

    pub(super) fn reset(&mut self, which: impl Fn(&Entry) -> bool) {
        self.slots.power_on(self.node, which);
        self.cells.fill(&mut self.slots);
    }

    /// The value of an item, whatever the access rights.
    ///
    /// # Errors
    ///
    /// Besides those of every method, [`AbortCode::LENGTH`] where the handle has another type than the table.
    pub fn get<V: Fixed, A, L: Location>(&self, item: Item<V, A, L>) -> Result<V::Native, AbortCode> {
        self.axis_value(&item, 1)
    }

    /// Gives an item a value, as the device itself does: whatever the access rights and limits, and with no reaction.
    /// An item that has another width on Modbus than as an object is two of the table, and both get the value; a client
    /// writes the one of its bus.
    ///
    /// # Errors
    ///
    /// Besides those of every method, [`AbortCode::LENGTH`] where the handle has another type than the table, and
    /// [`AbortCode::TOO_HIGH`] where the value doesn't fit its type.
    pub fn set<V: Fixed, A, L: Location>(&mut self, item: Item<V, A, L>, value: V::Native) -> Result<(), AbortCode> {
        self.set_axis_value(&item, 1, value)
    }

    /// The bytes of an item, the least significant first; texts and domains have no other form.
    ///
    /// # Errors
    ///
    /// Those of every method.
    pub fn bytes(&self, address: impl ItemAddress) -> Result<&[u8], AbortCode> {
        Ok(&self.slots.get(self.slot(&address, 1)?).value)
    }

    /// Gives an item these bytes, as [`set`](Self::set) does.
    ///
    /// # Errors
    ///
    /// Besides those of every method, [`AbortCode::TOO_LONG`], [`AbortCode::TOO_SHORT`] or [`AbortCode::LENGTH`] where they
    /// don't fit the item's type.
    pub fn set_bytes(&mut self, address: impl ItemAddress, bytes: &[u8]) -> Result<(), AbortCode> {
        let at = self.slot(&address, 1)?;
        values::check_length(&self.slots.get(at).entry, bytes)?;
        self.store(at, bytes.to_vec());
        Ok(())
    }

    /// Gives an item a value, as [`set`](Self::set) does, which it has after each power-on, too. Few descriptions tell
    /// the statusword then, for instance.
    ///
    /// # Errors
    ///
    /// Those of [`set`](Self::set).
    pub fn set_initial<V: Fixed, A, L: Location>(
        &mut self,
        item: Item<V, A, L>,
        value: V::Native,
    ) -> Result<(), AbortCode> {
        self.set_axis_value(&item, 1, value)?;
        self.slots_of(&item, 1)?.into_iter().for_each(|at| self.keep(at));
        Ok(())
    }

    /// Gives an item these bytes, as [`set_bytes`](Self::set_bytes) does, which it has after each power-on, too.
    ///
    /// # Errors
    ///
    /// Those of [`set_bytes`](Self::set_bytes).
    pub fn set_initial_bytes(&mut self, address: impl ItemAddress, bytes: &[u8]) -> Result<(), AbortCode> {
        let at = self.slot(&address, 1)?;
        self.set_bytes(address, bytes)?;
        self.keep(at);
        Ok(())
    }

    fn keep(&mut self, at: usize) {
        let slot = self.slots.get_mut(at);
        slot.initial = Some(slot.value.clone());
    }

    /// Axis `number` of the device, from 1: the same items at the places of that axis.
    pub fn axis(&mut self, number: u8) -> DeviceAxis<'_> {
        DeviceAxis { device: self, number }
    }

    /// Calls `reaction` with the value after a client or a PDO wrote this item. Where it fails, the item has its old value
    /// again, and the client gets the abort code.
    ///
    /// # Errors
    ///
    /// Those of every method.
    pub fn on_write<V: Fixed, A, L: Location>(
        &mut self,
        item: Item<V, A, L>,
        reaction: impl FnMut(&mut Device, V::Native) -> Result<(), AbortCode> + Send + 'static,
    ) -> Result<(), AbortCode> {
        self.axis(1).on_write(item, reaction)
    }

    /// Calls `reaction` after a client or a PDO wrote any item, as [`on_write`](Self::on_write) does.
    pub fn on_any_write(
        &mut self,
        reaction: impl FnMut(&mut Device, &Entry) -> Result<(), AbortCode> + Send + 'static,
    ) {
        let mut reaction = reaction;
        let reaction = move |device: &mut Device, _: usize, entry: &Entry| reaction(device, entry);
        self.hooks.push(Hook { slots: None, reaction: Box::new(reaction) });
    }

    /// The next access of a client fails so, and what comes after the one before it where this is called several times.
    /// Process data pass.
    pub fn fail_next(&mut self, fault: impl Into<Fault>) {
        self.faults.push_back(fault.into());
    }

    pub(super) fn take_fault(&mut self) -> Result<(), Fault> {
        self.faults.pop_front().map_or(Ok(()), Err)
    }

    /// What a client reads.
    pub(super) fn upload(&mut self, object: Object) -> Result<&[u8], Fault> {
        self.take_fault()?;
        let slot = self.slots.get(self.slots.of_object(object)?);
        if slot.entry.access == AccessRights::WriteOnly {
            return Err(AbortCode::WRITE_ONLY.into());
        }
        Ok(&slot.value)
    }

    /// What a client writes.
    pub(super) fn download(&mut self, network: Network, object: Object, data: &[u8]) -> Result<(), Fault> {
        self.take_fault()?;
        let at = self.slots.of_object(object)?;
        let entry = self.slots.get(at).entry;
        if matches!(entry.access, AccessRights::ReadOnly | AccessRights::Constant) {
            return Err(AbortCode::READ_ONLY.into());
        }
        values::check_length(&entry, data)?;
        if self.command(object, data)? {
            return Ok(());
        }
        values::check_range(&entry, data)?;
        self.check_pdo_parameter(network, object, data)?;
        let old = self.store(at, data.to_vec());
        if let Err(code) = self.react(at) {
            self.store(at, old);
            return Err(code.into());
        }
        Ok(())
    }

    /// Gives an item a value and returns the old one.
    pub(super) fn store(&mut self, at: usize, value: Vec<u8>) -> Vec<u8> {
        let old = core::mem::replace(&mut self.slots.get_mut(at).value, value);
        self.cells.spread(&mut self.slots, at);
        old
    }

    /// Calls what reacts to the write of an item. A reaction's own changes call nothing.
    pub(super) fn react(&mut self, at: usize) -> Result<(), AbortCode> {
        let entry = self.slots.get(at).entry;
        let mut hooks = core::mem::take(&mut self.hooks);
        let concerned = hooks.iter_mut().filter(|hook| hook.slots.as_ref().map_or(true, |slots| slots.contains(&at)));
        let result = { concerned }.try_for_each(|hook| (hook.reaction)(self, at, &entry));
        // A reaction may have added some.
        hooks.append(&mut self.hooks);
        self.hooks = hooks;
        result
    }

    fn slot(&self, address: &impl ItemAddress, axis: u8) -> Result<usize, AbortCode> {
        let registered = address.register().filter(|_| axis == 1);
        let Some(object) = address.object() else {
            return registered.and_then(|register| self.slots.of_register(register)).ok_or(AbortCode::NO_OBJECT);
        };
        let object = match self.axes {
            Some(axes) => axes.object(axis, object).ok_or(AbortCode::NO_OBJECT)?,
            None if axis == 1 => object,
            None => return Err(AbortCode::NO_OBJECT),
        };
        self.slots.of_object(object)
    }

    /// All places of an item: where it has another width on Modbus, the register is one by itself.
    fn slots_of(&self, address: &impl ItemAddress, axis: u8) -> Result<Vec<usize>, AbortCode> {
        let mut slots = [self.slot(address, axis)?].to_vec();
        let registered = address.register().filter(|_| axis == 1 && address.is_resized());
        slots.extend(registered.and_then(|register| self.slots.of_register(register)).filter(|at| !slots.contains(at)));
        Ok(slots)
    }

    fn axis_value<V: Fixed, A, L: Location>(&self, item: &Item<V, A, L>, axis: u8) -> Result<V::Native, AbortCode> {
        self.value::<V>(self.slot(item, axis)?, item.is_resized())
    }

    fn set_axis_value<V: Fixed, A, L: Location>(
        &mut self,
        item: &Item<V, A, L>,
        axis: u8,
        value: V::Native,
    ) -> Result<(), AbortCode> {
        for at in self.slots_of(item, axis)? {
            self.set_value::<V>(at, value, item.is_resized())?;
        }
        Ok(())
    }

    fn value<V: Fixed>(&self, at: usize, is_resized: bool) -> Result<V::Native, AbortCode> {
        let slot = self.slots.get(at);
        if is_resized {
            let bytes = values::resized(slot.entry.data_type, &slot.value, V::DATA_TYPE)?;
            return V::decode(&bytes).map_err(|_| AbortCode::LENGTH);
        }
        V::decode(&slot.value).map_err(|_| AbortCode::LENGTH)
    }

    fn set_value<V: Fixed>(&mut self, at: usize, value: V::Native, is_resized: bool) -> Result<(), AbortCode> {
        let mut buffer = [0; 8];
        let length = V::encode(value, &mut buffer).map_err(|_| AbortCode::TOO_HIGH)?;
        let mut bytes = buffer.get(..length).ok_or(AbortCode::LENGTH)?.to_vec();
        if is_resized {
            bytes = values::resized(V::DATA_TYPE, &bytes, self.slots.get(at).entry.data_type)?;
        }
        if bytes.len() != self.slots.get(at).value.len() {
            return Err(AbortCode::LENGTH);
        }
        self.store(at, bytes);
        Ok(())
    }
}

impl fmt::Debug for Device {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Device").field("node", &self.node).field("items", &self.slots.len()).finish_non_exhaustive()
    }
}

/// One axis of a device, seen from the device's side; made by [`Device::axis`].
///
/// Its methods are those of the device, with the handles of the first axis. Where there is no such axis, or it doesn't
/// have the item, they fail with [`AbortCode::NO_OBJECT`].
#[derive(Debug)]
pub struct DeviceAxis<'d> {
    device: &'d mut Device,
    number: u8,
}

impl DeviceAxis<'_> {
    /// The value of an item, as [`Device::get`] has it.
    ///
    /// # Errors
    ///
    /// Those of [`Device::get`].
    pub fn get<V: Fixed, A, L: Location>(&self, item: Item<V, A, L>) -> Result<V::Native, AbortCode> {
        self.device.axis_value(&item, self.number)
    }

    /// Gives an item a value, as [`Device::set`] does.
    ///
    /// # Errors
    ///
    /// Those of [`Device::set`].
    pub fn set<V: Fixed, A, L: Location>(&mut self, item: Item<V, A, L>, value: V::Native) -> Result<(), AbortCode> {
        self.device.set_axis_value(&item, self.number, value)
    }

    /// Calls `reaction` after this item was written, as [`Device::on_write`] does.
    ///
    /// # Errors
    ///
    /// Those of [`Device::on_write`].
    pub fn on_write<V: Fixed, A, L: Location>(
        &mut self,
        item: Item<V, A, L>,
        mut reaction: impl FnMut(&mut Device, V::Native) -> Result<(), AbortCode> + Send + 'static,
    ) -> Result<(), AbortCode> {
        let is_resized = item.is_resized();
        let slots = self.device.slots_of(&item, self.number)?;
        let reaction = move |device: &mut Device, at: usize, _: &Entry| {
            let value = device.value::<V>(at, is_resized)?;
            reaction(device, value)
        };
        self.device.hooks.push(Hook { slots: Some(slots), reaction: Box::new(reaction) });
        Ok(())
    }
}
