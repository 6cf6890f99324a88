//! The simulated device.

use core::fmt;
use std::boxed::Box;
use std::collections::VecDeque;
use std::vec::Vec;

use super::behavior::Behavior;
use super::cells::Cells;
use super::clock::Clock;
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

/// Default node-ID.
const FIRST_NODE: NodeId = match NodeId::new(1) {
    Some(node) => node,
    None => unreachable!(),
};

/// Function that is called after a write.
type Reaction = Box<dyn FnMut(&mut Device, usize, &Entry) -> Result<(), AbortCode> + Send>;

/// A reaction, and the positions of the items for which it is called. If `slots` is `None`, the reaction is called for
/// all items.
struct Hook {
    slots: Option<Vec<usize>>,
    reaction: Reaction,
}

/// Network over which an object is accessed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Network {
    CanOpen,
    EtherCat,
}

/// A simulated device, created from the table of its bindings.
///
/// Clients access the device within the access rights and limits of the device description. [`client`](Self::client)
/// creates a client. Tests simulate the behavior of the device: they [`get`](Self::get) and [`set`](Self::set) all
/// items, and [react](Self::on_write) to writes.
///
/// # Errors
///
/// Methods for tests return [`NO_OBJECT`](AbortCode::NO_OBJECT) or [`NO_SUB_INDEX`](AbortCode::NO_SUB_INDEX) if the
/// device doesn't have the item. The error type is [`AbortCode`], so a reaction can return these errors with `?`.
pub struct Device {
    pub(super) slots: Slots,
    pub(super) cells: Cells,
    pub(super) emergencies: VecDeque<Emergency>,
    pub(super) limits: Limits,
    axes: Option<&'static Axes>,
    node: NodeId,
    hooks: Vec<Hook>,
    faults: VecDeque<Fault>,
    pub(super) clock: Clock,
    pub(super) has_cia402: bool,
    pub(super) drives: Vec<Box<dyn Behavior>>,
    /// True if the next step of the simulation changes nothing.
    pub(super) is_settled: bool,
}

impl Device {
    /// Creates a device after power-on with node-ID 1. `entries` is the static table `ENTRIES` of the bindings.
    ///
    /// If the device description declares no initial value, a text or byte string is empty. A number without a declared
    /// initial value is 0, or the number within its limits that is nearest to 0.
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
            clock: Clock::default(),
            has_cia402: false,
            drives: Vec::new(),
            is_settled: true,
        };
        device.power_cycle();
        device
    }

    /// Returns the device after power-on with another node-ID.
    #[must_use]
    pub fn with_node_id(mut self, node: NodeId) -> Self {
        self.node = node;
        self.power_cycle();
        self
    }

    /// Returns the device after power-on with all of its axes. `axes` is the constant `AXES` of the bindings.
    #[must_use]
    pub fn with_axes(mut self, axes: &'static Axes) -> Self {
        self.slots.add_axes(axes);
        self.axes = Some(axes);
        self.power_cycle();
        self
    }

    /// Changes the node-ID. Values that depend on the node-ID change with the next reset.
    #[cfg(feature = "canopen")]
    pub(super) fn set_node_id(&mut self, node: NodeId) {
        self.node = node;
    }

    /// Returns the node-ID.
    #[must_use]
    pub const fn node_id(&self) -> NodeId {
        self.node
    }

    /// Switches the device off and on. All items return to their stored values (0x1010) or their initial values.
    pub fn power_cycle(&mut self) {
        self.declare_drive_defaults();
        self.reset(|_| true);
        self.emergencies.clear();
        self.start_drives();
    }

    pub(super) fn reset(&mut self, which: impl Fn(&Entry) -> bool) {
        self.slots.power_on(self.node, which);
        self.cells.fill(&mut self.slots);
    }

    /// Returns the value of an item, regardless of its access rights.
    ///
    /// # Errors
    ///
    /// Returns [`AbortCode::LENGTH`] if the length of the item's type differs from the table, [`AbortCode::TOO_HIGH`]
    /// if the value doesn't fit the item's type, and the common errors of the methods for tests (see [`Device`]).
    pub fn get<V: Fixed, A, L: Location>(&self, item: Item<V, A, L>) -> Result<V::Native, AbortCode> {
        self.axis_value(&item, 1)
    }

    /// Sets the value of an item, as the device itself does. Access rights and limits don't apply, and no reaction is
    /// called.
    ///
    /// If the item has different widths as an object and as a register, the table has two entries for the item. The
    /// method `set` changes both entries. A client changes only the entry of its bus.
    ///
    /// # Errors
    ///
    /// Returns [`AbortCode::LENGTH`] if the length of the item's type differs from the table. Returns
    /// [`AbortCode::TOO_HIGH`] if the value doesn't fit its type. Also returns the common errors of the methods for
    /// tests (see [`Device`]).
    pub fn set<V: Fixed, A, L: Location>(&mut self, item: Item<V, A, L>, value: V::Native) -> Result<(), AbortCode> {
        self.set_axis_value(&item, 1, value)
    }

    /// Returns the bytes of an item, the least significant byte first. Use this method for texts and domains, which
    /// [`get`](Self::get) doesn't support.
    ///
    /// # Errors
    ///
    /// Returns [`AbortCode::NO_OBJECT`] or [`AbortCode::NO_SUB_INDEX`] if the device doesn't have the item.
    pub fn bytes(&self, address: impl ItemAddress) -> Result<&[u8], AbortCode> {
        Ok(&self.slots.get(self.slot(&address, 1)?).value)
    }

    /// Sets the bytes of an item, as [`set`](Self::set) does.
    ///
    /// # Errors
    ///
    /// Returns [`AbortCode::TOO_LONG`], [`AbortCode::TOO_SHORT`] or [`AbortCode::LENGTH`] if the bytes don't fit the
    /// item's type. Also returns the common errors of the methods for tests (see [`Device`]).
    pub fn set_bytes(&mut self, address: impl ItemAddress, bytes: &[u8]) -> Result<(), AbortCode> {
        let at = self.slot(&address, 1)?;
        values::check_length(&self.slots.get(at).entry, bytes)?;
        self.store(at, bytes.to_vec());
        Ok(())
    }

    /// Sets the current value of an item, as [`set`](Self::set) does, and its initial value after power-on. Use this
    /// method if the device description declares no initial value, for example for the statusword.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`set`](Self::set).
    pub fn set_initial<V: Fixed, A, L: Location>(
        &mut self,
        item: Item<V, A, L>,
        value: V::Native,
    ) -> Result<(), AbortCode> {
        self.set_axis_value(&item, 1, value)?;
        self.slots_of(&item, 1)?.into_iter().for_each(|at| self.keep(at));
        Ok(())
    }

    /// Sets the current bytes of an item, as [`set_bytes`](Self::set_bytes) does, and its initial value after power-on.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`set_bytes`](Self::set_bytes).
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

    pub(super) fn axis_count(&self) -> u8 {
        self.axes.map_or(1, |axes| axes.count.max(1))
    }

    /// Returns axis `number` of the device. The first axis has number 1. Each axis has the same items at its own
    /// addresses.
    pub fn axis(&mut self, number: u8) -> DeviceAxis<'_> {
        DeviceAxis { device: self, number }
    }

    /// Calls `reaction` with the new value after a client or a PDO has written this item. If `reaction` returns an
    /// abort code, the item gets its old value back, and the client receives the abort code.
    ///
    /// # Errors
    ///
    /// Returns [`AbortCode::NO_OBJECT`] or [`AbortCode::NO_SUB_INDEX`] if the device doesn't have the item.
    pub fn on_write<V: Fixed, A, L: Location>(
        &mut self,
        item: Item<V, A, L>,
        reaction: impl FnMut(&mut Device, V::Native) -> Result<(), AbortCode> + Send + 'static,
    ) -> Result<(), AbortCode> {
        self.axis(1).on_write(item, reaction)
    }

    /// Calls `reaction` after a client or a PDO has written an item of the device, as [`on_write`](Self::on_write)
    /// does.
    pub fn on_any_write(
        &mut self,
        reaction: impl FnMut(&mut Device, &Entry) -> Result<(), AbortCode> + Send + 'static,
    ) {
        let mut reaction = reaction;
        let reaction = move |device: &mut Device, _: usize, entry: &Entry| reaction(device, entry);
        self.hooks.push(Hook { slots: None, reaction: Box::new(reaction) });
    }

    /// Makes the next access of a client fail with `fault`. Each call makes one more access fail, in the order of the
    /// calls. Faults don't affect process data.
    pub fn fail_next(&mut self, fault: impl Into<Fault>) {
        self.faults.push_back(fault.into());
    }

    pub(super) fn take_fault(&mut self) -> Result<(), Fault> {
        self.faults.pop_front().map_or(Ok(()), Err)
    }

    /// Handles a read access of a client.
    pub(super) fn upload(&mut self, object: Object) -> Result<&[u8], Fault> {
        self.take_fault()?;
        let slot = self.slots.get(self.slots.of_object(object)?);
        if slot.entry.access == AccessRights::WriteOnly {
            return Err(AbortCode::WRITE_ONLY.into());
        }
        Ok(&slot.value)
    }

    /// Handles a write access of a client.
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

    /// Sets the value of an item and returns the old value.
    pub(super) fn store(&mut self, at: usize, value: Vec<u8>) -> Vec<u8> {
        self.is_settled = !self.has_cia402;
        let old = core::mem::replace(&mut self.slots.get_mut(at).value, value);
        self.cells.spread(&mut self.slots, at);
        old
    }

    /// Calls the reactions to a write of an item, and then lets the drives react. A value that a reaction changes
    /// triggers no further reactions.
    pub(super) fn react(&mut self, at: usize) -> Result<(), AbortCode> {
        let entry = self.slots.get(at).entry;
        let mut hooks = core::mem::take(&mut self.hooks);
        let concerned = hooks.iter_mut().filter(|hook| hook.slots.as_ref().map_or(true, |slots| slots.contains(&at)));
        let result = { concerned }.try_for_each(|hook| (hook.reaction)(self, at, &entry));
        // A reaction may have added reactions, which are kept.
        hooks.append(&mut self.hooks);
        self.hooks = hooks;
        result?;
        self.observe_drives();
        Ok(())
    }

    pub(super) fn slot(&self, address: &impl ItemAddress, axis: u8) -> Result<usize, AbortCode> {
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

    /// Returns the positions of all entries of an item. If the item has different widths on its buses, the register and
    /// the object are separate entries.
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

/// One axis of a simulated device. Tests access the items of the axis through this type. [`Device::axis`] returns an
/// axis.
///
/// The methods correspond to those of [`Device`], and take the handles of the first axis. The methods return
/// [`AbortCode::NO_OBJECT`] if the axis doesn't exist, and [`AbortCode::NO_OBJECT`] or [`AbortCode::NO_SUB_INDEX`] if
/// the axis doesn't have the item.
#[derive(Debug)]
pub struct DeviceAxis<'d> {
    device: &'d mut Device,
    number: u8,
}

impl DeviceAxis<'_> {
    pub(super) fn device(&mut self) -> &mut Device {
        self.device
    }

    pub(super) const fn number(&self) -> u8 {
        self.number
    }

    /// Returns the value of an item, as [`Device::get`] does.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`Device::get`].
    pub fn get<V: Fixed, A, L: Location>(&self, item: Item<V, A, L>) -> Result<V::Native, AbortCode> {
        self.device.axis_value(&item, self.number)
    }

    /// Sets the value of an item, as [`Device::set`] does.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`Device::set`].
    pub fn set<V: Fixed, A, L: Location>(&mut self, item: Item<V, A, L>, value: V::Native) -> Result<(), AbortCode> {
        self.device.set_axis_value(&item, self.number, value)
    }

    /// Calls `reaction` after a write of this item, as [`Device::on_write`] does.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`Device::on_write`].
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
